"""Files that are never half written: a draft beside the target, renamed when it is complete."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import uuid4

import numpy as np


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
    ending = os.path.splitext(path)[1]
    if ending not in (".csv", ".npz"):
        raise ValueError(f"{owner}: path must end in .csv or .npz, got {os.fspath(path)!r}")
    with written_whole(path) as draft:
        if ending == ".csv":
            table = np.column_stack(list(columns.values()))
            np.savetxt(draft, table, "%.10g", ",", header=",".join(columns), comments="")
        else:
            with open(draft, "wb") as stream:
                np.savez_compressed(stream, summary=np.array(json.dumps(summary)), **columns)
