"""Arguments from a command line, with what is wrong with them as one sentence."""

from __future__ import annotations

import io
from collections.abc import Sequence
from contextlib import redirect_stderr
from typing import TypeVar

import tyro
from tyro.conf import FlagCreatePairsOff

Settings = TypeVar("Settings")

# what tyro frames its words with
_FRAME = " │╭╮╰╯─-"


def parse(kind: type[Settings], program: str, about: str, argv: Sequence[str] | None) -> Settings:
    """The settings that the arguments say.

    Raises:
        ValueError: wrong arguments, in one sentence.
        SystemExit: help was asked for and has been printed.
    """
    said = io.StringIO()
    try:
        with redirect_stderr(said):
            return tyro.cli(
                kind, prog=program, description=about, args=argv, config=(FlagCreatePairsOff,)
            )
    except SystemExit as stop:
        if stop.code in (0, None):
            raise
        raise ValueError(f"{_sentence(said.getvalue())} ({program} --help)") from None


def _sentence(box: str) -> str:
    """The words in tyro's box, without frame, title and advice."""
    lines = [line.strip(_FRAME) for line in box.splitlines()]
    words = " ".join(" ".join(line for line in lines if line).split())
    words = words.split("For full helptext")[0].strip()
    for title in ("Value error", "Parsing error", "Unrecognized options"):
        words = words.removeprefix(title).lstrip(_FRAME)
    return words.removeprefix("Error parsing Args:").strip()
