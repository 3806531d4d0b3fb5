"""What `validate` and `bench` share: parts by name, one of which alone takes options of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, make_dataclass
from pathlib import Path
from typing import Any, TypeVar

from rich.console import Console

import flaprig
from flaprig.commands.progress import progress
from flaprig.commands.run_output import timed
from flaprig.report.folder import Folder
from flaprig.report.numbers import as_json

Base = TypeVar("Base")


def one_alone(words: Sequence[str]) -> str | None:
    """The name that comes first where no other follows it, else None.

    Args:
        words: of the command line, after the command.
    """
    if not words or words[0].startswith("-") or "--all" in words:
        return None
    return words[0] if len(words) == 1 or words[1].startswith("-") else None


def with_parameters(part: type, base: type[Base]) -> type[Base]:
    """The options of `base` together with the parameters of a part, as the field `parameters`."""
    parameters: Any = ("parameters", part, field(default_factory=part))
    made = make_dataclass(part.__name__, [parameters], bases=(base,), frozen=True)
    made.__doc__ = f"{part.__doc__}\n\n{base.__doc__}"
    return made


def docs(command: str) -> Path:
    """The folder docs/ of the clone.

    Raises:
        ValueError: a wheel carries none.
    """
    folder = Path(flaprig.__file__).resolve().parents[1] / "docs"
    if not folder.is_dir():
        raise ValueError(f"{command}: --out must be given, since docs/ is not here")
    return folder


@dataclass(frozen=True)
class Page:
    """Where all parts together go inside of their folder.

    Attributes:
        name: of the page's file.
        pictures: folder of the pictures, beside the page.
    """

    name: str
    pictures: str


def run_each(
    parts: Sequence[Any],
    folder: Folder,
    page: Page | None,
    show: Callable[[Any, Any, float], None],
) -> list[tuple[Any, Any, float]]:
    """Run the parts one by one and write their pictures.

    Args:
        parts: what has a name and runs.
        folder: for the pictures.
        page: where they go; None: a picture lies in the folder itself.
        show: is given each part, its outcome and its seconds.

    Returns:
        The same of all parts.
    """
    folder.create()
    if folder.path is not None and page:
        (folder.path / page.pictures).mkdir(parents=True, exist_ok=True)
    found, pictures = [], {}
    for part in parts:
        with timed() as spent, progress(part.name) as told:
            outcome = part.run(told)
        found.append((part, outcome, spent["wall_time_s"]))
        if outcome.draw is not None and page:
            pictures[f"{page.pictures}/{part.name}.png"] = outcome.draw
        elif outcome.draw is not None:
            folder.write(f"{part.name}.png", outcome.draw)
        show(*found[-1])
    # a page's pictures at the end, beside the page: a run that fails leaves the old ones to it
    for place, draw in pictures.items():
        folder.write(place, draw)
    return found


def hand_out(folder: Folder, summary: Any, as_object: bool, page: Page | None, text: str) -> None:
    """Write the page or the summary, and tell.

    Args:
        folder: for the file; may be none.
        summary: of all parts, for JSON.
        as_object: print the summary and nothing else.
        page: which page is written instead of summary.json.
        text: of the page.
    """
    if isinstance(summary, dict):
        # what the parts doubt stands in their own tables
        summary.setdefault("notices", [])
    if folder and page:
        folder.write_text(page.name, text)
    elif folder:
        summary = folder.write_summary(summary)
    if as_object:
        print(as_json(summary))
    elif folder:
        Console().print(folder.sentences(), highlight=False, markup=False)
