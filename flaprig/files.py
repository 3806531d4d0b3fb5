"""Files that are never half written: a draft beside the target, renamed when it is complete."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from uuid import uuid4


@contextmanager
def written_whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Path of a draft to write to; it replaces the target on success and vanishes on failure.

    Raises:
        OSError: the folder does not exist or cannot be written.
    """
    target = Path(path)
    # the ending is kept last: many writers choose their format by it
    draft = target.with_name(f".{uuid4().hex}.part{target.suffix}")
    try:
        yield draft
        draft.replace(target)
    finally:
        draft.unlink(missing_ok=True)
