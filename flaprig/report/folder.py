"""A folder of results in which every file is whole and of one run, and known to be so.

What earlier runs have left is removed when the first file of the new run is complete: a run that
fails before that leaves the old results whole. Files that no run wrote are never touched. Two runs
cannot write into one folder at a time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any
from uuid import uuid4

from flaprig.files import FolderLock, marked_files, sweep_drafts, to_disk, written_whole
from flaprig.report.numbers import as_json
from flaprig.report.record import HIDDEN, SUMMARY, Record, earlier_files


class Folder:
    """Files of one run; without a path nothing is written.

    Attributes:
        path: the folder, or None.
        written: files that are complete, in the order in which they appeared.
        removed: names of earlier runs' files that were removed.
    """

    def __init__(self, path: Path | None) -> None:
        self.path = path
        self.written: list[Path] = []
        self.removed: list[str] = []
        self._shared = False
        self._lock: FolderLock | None = None
        self._record: Record | None = None

    def __bool__(self) -> bool:
        return self.path is not None

    def share(self, path: Path) -> None:
        """Write into a folder that is not the run's own: what else is there stays as it is."""
        self.path, self._shared = path, True

    def create(self) -> None:
        """Make the folder, before anything is computed for it, and keep other runs out of it.

        Raises:
            ValueError: the path is a file, or lies in one; or another run writes there.
            OSError: the folder cannot be made.
        """
        if self.path is None:
            return
        try:
            self.path.mkdir(parents=True, exist_ok=True)
        except (FileExistsError, NotADirectoryError):
            sentence = f"--out must be a folder, and {self.path} is or lies in a file"
            raise ValueError(sentence) from None
        if self._shared or self._record is not None:
            return
        self._lock = FolderLock(self.path)
        sweep_drafts(self.path)
        self._record = Record(uuid4().hex, stale=earlier_files(self.path))

    def write(self, name: str, writer: Callable[[Path], object]) -> None:
        """Let the writer write the file of that name; it appears when it is complete.

        Raises:
            OSError: the file cannot be written.
        """
        if self.path is None:
            return
        self.create()
        target = self.path / name
        with written_whole(target) as draft, marked_files(self._run_id):
            writer(draft)
            # only what is safely on the disk may cost the old files
            to_disk(draft)
            self._claim(name)
        if target not in self.written:
            self.written.append(target)

    def write_text(self, name: str, text: str) -> None:
        """Write a text file."""
        self.write(name, lambda draft: draft.write_text(text, encoding="utf-8"))

    def write_summary(self, summary: Mapping[str, Any]) -> dict[str, Any]:
        """Write summary.json; what it holds: the summary, the run's number and its files so far.

        Written again at the end of a run it lists all files; without a path the summary comes back.

        Raises:
            OSError: the file cannot be written.
        """
        if self.path is None:
            return dict(summary)
        names = [path.relative_to(self.path).as_posix() for path in self.written]
        files = sorted({*names, SUMMARY})
        whole = {**summary, "run_id": self._run_id, "files": files}
        self.write_text(SUMMARY, as_json(whole) + "\n")
        if self._record is not None and set(self._record.files) == set(files):
            # the summary holds the list now
            (self.path / HIDDEN).unlink(missing_ok=True)
        return whole

    def sentences(self) -> str:
        """What was written, and which files of earlier runs are gone and were not written anew."""
        names = [path.name for path in self.written]
        words = f"Written to {self.path}: {', '.join(names)}"
        gone = [name for name in self.removed if Path(name).name not in names and name != HIDDEN]
        return f"{words}. Removed, of an earlier run: {', '.join(gone)}" if gone else words

    def release(self) -> None:
        """Let other runs write into the folder."""
        if self._lock is not None:
            self._lock.release()
        self._lock = None

    @property
    def _run_id(self) -> str | None:
        return self._record.run_id if self._record else None

    def _claim(self, name: str) -> None:
        """Put the name on the run's list; the first one makes the folder the run's own."""
        if self._record is None or self.path is None:
            return
        record, stale = self._record, [old for old in self._record.stale if old != name]
        if name not in record.files:
            record.files.append(name)
        record.save(self.path)
        for old in stale:
            if (self.path / old).is_file():
                (self.path / old).unlink(missing_ok=True)
                self.removed.append(old)
        if record.stale:
            record.stale = []
            record.save(self.path)
