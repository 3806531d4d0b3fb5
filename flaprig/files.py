"""Files that are never half written: a draft beside the target, renamed when it is complete.

A draft is locked for as long as its writer lives, so that one left by a killed process is known.
Drafts and folders reach the disk before the rename counts: a power failure leaves the old file or
the new one.
"""

from __future__ import annotations

import fcntl
import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np

# number of the run whose files are being written
_RUN: ContextVar[str | None] = ContextVar("run", default=None)
# names of drafts, as written_whole makes them
_DRAFT = re.compile(r"\.[0-9a-f]{32}\.part(\.[^.]*)?")


@contextmanager
def written_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Path of a draft to write to; it replaces the target on success and vanishes on failure.

    Raises:
        OSError: the folder does not exist or cannot be written; names the target.
    """
    target = Path(path)
    # the ending is kept last: many writers choose their format by it
    draft = target.with_name(f".{uuid4().hex}.part{target.suffix}")
    try:
        with _locked_draft(draft):
            yield draft
            to_disk(draft)
            draft.replace(target)
        with suppress(OSError):
            # some file systems know no such thing
            to_disk(target.parent)
    except OSError as error:
        if error.filename is not None and Path(os.fsdecode(error.filename)) == draft:
            # nobody knows the draft's name
            raise OSError(error.errno, error.strerror, os.fspath(target)) from None
        raise
    finally:
        draft.unlink(missing_ok=True)


@contextmanager
def _locked_draft(draft: Path) -> Iterator[None]:
    """An empty draft that no sweep takes for an abandoned one."""
    number = os.open(draft, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o666)
    try:
        with suppress(OSError):
            fcntl.flock(number, fcntl.LOCK_SH | fcntl.LOCK_NB)
        yield
    finally:
        os.close(number)


def to_disk(path: Path) -> None:
    """Return when a file or a folder is on the disk.

    Raises:
        OSError: it cannot be written there, as on a full disk.
    """
    number = os.open(path, os.O_RDONLY)
    try:
        os.fsync(number)
    finally:
        os.close(number)


def sweep_drafts(folder: Path) -> None:
    """Remove the drafts in a folder whose writers were killed."""
    for draft in folder.iterdir():
        if not _DRAFT.fullmatch(draft.name):
            continue
        with suppress(OSError):
            number = os.open(draft, os.O_RDONLY)
            try:
                # whoever still writes holds it
                fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
                draft.unlink()
            finally:
                os.close(number)


class FolderLock:
    """A folder that one process alone writes results into; freed with `release`, or by its end.

    Args:
        folder: exists.

    Raises:
        ValueError: another process writes into it.
        OSError: the folder cannot be opened.
    """

    def __init__(self, folder: Path) -> None:
        self._number = os.open(folder, os.O_RDONLY)
        try:
            fcntl.flock(self._number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            self.release()
            sentence = f"--out must be a folder that no other run writes into, got {folder}"
            raise ValueError(f"{sentence}: one does at this moment") from None
        except OSError:
            # a file system without locks
            return

    def release(self) -> None:
        """Let others write."""
        if self._number >= 0:
            os.close(self._number)
        self._number = -1

    def __del__(self) -> None:
        # a run that nobody holds any more is over; not begun where the constructor has failed
        if "_number" in vars(self):
            self.release()


@contextmanager
def marked_files(run_id: str | None) -> Iterator[None]:
    """Files written inside of the block say the run's number, where their format has room."""
    before = _RUN.set(run_id)
    try:
        yield
    finally:
        _RUN.reset(before)


def run_mark() -> dict[str, str]:
    """The entry `run_id` for a file's own summary; empty where no run is told."""
    run_id = _RUN.get()
    return {} if run_id is None else {"run_id": run_id}


def plain(value: Any) -> Any:
    """What JSON can hold: arrays as lists, NaN and infinity as None."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray | np.generic):
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def check_ending(owner: str, path: str | os.PathLike[str], *allowed: str) -> None:
    """Refuse a path that does not end as one of the allowed endings, which choose the format.

    Raises:
        ValueError: another ending; names the allowed ones.
    """
    if os.path.splitext(path)[1] not in allowed:
        words = f"{owner}: path must end in {' or '.join(allowed)}"
        raise ValueError(f"{words}, got {os.fspath(path)!r}")


def write_table(
    owner: str,
    path: str | os.PathLike[str],
    columns: Mapping[str, Any],
    summary: Mapping[str, Any],
) -> None:
    """Write columns of equal length, CSV or NPZ by the path's ending, names in the header.

    The NPZ also holds the summary as JSON text.

    Raises:
        ValueError: an ending that is neither .csv nor .npz.
        OSError: the folder does not exist or cannot be written.
    """
    check_ending(owner, path, ".csv", ".npz")
    with written_whole(path) as draft:
        if os.path.splitext(path)[1] == ".csv":
            table = np.column_stack(list(columns.values()))
            np.savetxt(draft, table, "%.10g", ",", header=",".join(columns), comments="")
        else:
            text = json.dumps(plain(run_mark() | dict(summary)), allow_nan=False)
            with open(draft, "wb") as stream:
                np.savez_compressed(stream, summary=np.array(text), **columns)
