"""Arguments from a command line, and what is wrong with them as one sentence.

The only reader of what tyro prints. tyro draws a box of blocks with rules between them: words,
options that look alike, and where the help is.
"""

from __future__ import annotations

import io
import re
from collections.abc import Sequence
from contextlib import redirect_stderr
from typing import Any, TypeVar

import tyro

Settings = TypeVar("Settings")

# what tyro frames a line with, and a line that is nothing but frame
_FRAME, _RULE = " │|", re.compile(r"[╭╰─╮╯+\-]*")
# how tyro begins a block of options that look alike
_ALIKE = ("Perhaps you meant", "Arguments similar to")


def parse(
    kind: type[Settings] | Any,
    program: str,
    words: Sequence[str] | None,
    about: str | None = None,
    config: Sequence[Any] = (),
) -> Settings:
    """The settings that the words say.

    Args:
        kind: of the settings, a dataclass or a union of subcommands.
        program: what was called, with its subcommand, for instance "flaprig simulate".
        words: of the command line; those of the process when None.
        about: what the help says first.
        config: markers of tyro.

    Raises:
        ValueError: wrong arguments, in one sentence with the options that look alike.
        SystemExit: help was asked for and has been printed.
    """
    complaint = io.StringIO()
    try:
        with redirect_stderr(complaint):
            settings: Settings = tyro.cli(
                kind, prog=program, description=about, args=words, config=tuple(config)
            )
            return settings
    except SystemExit as stop:
        if stop.code in (0, None):
            raise
        said = sentence(complaint.getvalue())
        raise ValueError(f"{said} ({program} --help says what is possible)") from None


def sentence(box: str) -> str:
    """The words of tyro's box, and the options that it takes for the ones meant."""
    blocks = _blocks(box)
    # the title stands in the frame, or is a block of its own
    title = 0 if box.startswith("╭") else 1
    if len(blocks) <= title:
        return " ".join(box.split())
    words = re.sub(r"^Error parsing ([\w-]+): (?=\1: )", "", " ".join(blocks[title])).rstrip(".")
    meant = [
        line.split()[0]
        for block in blocks[title + 1 :]
        if block[0].startswith(_ALIKE)
        for line in block
        if line.startswith("--")
    ]
    meant = list(dict.fromkeys(meant))
    return f"{words}; perhaps you meant {' or '.join(meant)}" if meant else words


def _blocks(box: str) -> list[list[str]]:
    """Lines without frame, by block."""
    blocks: list[list[str]] = [[]]
    for line in box.splitlines():
        text = line.strip(_FRAME)
        if line.startswith("╭") or (text and _RULE.fullmatch(text.replace(" ", ""))):
            blocks.append([])
        elif text:
            blocks[-1].append(text)
    return [block for block in blocks if block]
