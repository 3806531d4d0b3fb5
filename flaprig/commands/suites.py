"""What `validate` and `bench` share: parts by name, one of which alone takes options of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import field, make_dataclass
from pathlib import Path
from typing import Any, TypeVar

import flaprig

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
