"""A folder of results in which every file is whole, and which knows what it holds so far."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from flaprig.files import written_whole


class Folder:
    """Files of one run; without a path nothing is written.

    Attributes:
        path: the folder, or None.
        written: files that are complete, in the order in which they appeared.
    """

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.written: list[Path] = []

    def __bool__(self) -> bool:
        return self.path is not None

    def create(self) -> None:
        """Make the folder, before anything is computed for it.

        Raises:
            ValueError: the path is a file, or lies in one.
            OSError: the folder cannot be made.
        """
        if self.path is None:
            return
        try:
            self.path.mkdir(parents=True, exist_ok=True)
        except (FileExistsError, NotADirectoryError):
            sentence = f"--out must be a folder, and {self.path} is or lies in a file"
            raise ValueError(sentence) from None

    def write(self, name: str, writer: Callable[[Path], object]) -> None:
        """Let the writer write the file of that name; it appears when it is complete.

        Raises:
            OSError: the file cannot be written.
        """
        if self.path is None:
            return
        target = self.path / name
        with written_whole(target) as draft:
            writer(draft)
        self.written.append(target)

    def write_text(self, name: str, text: str) -> None:
        """Write a text file."""
        self.write(name, lambda draft: draft.write_text(text, encoding="utf-8"))
