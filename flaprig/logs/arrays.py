"""A table of named arrays, as flaprig's own NPZ files are."""

from __future__ import annotations

import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from flaprig.logs.numbers import MOST, Array


@dataclass(frozen=True, eq=False)
class ArrayTable:
    """Columns of an NPZ, with the rows counted from 1 as lines.

    Attributes:
        names: of the arrays.
        units: none are known beside those in the names.
        arrays: the columns.
        lines: number of each row.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    arrays: tuple[Array, ...]
    lines: list[int]

    def numbers(self, index: int) -> Array:
        """A column, NaN where a number is not finite. Shape (rows,)."""
        values = self.arrays[index].copy()
        values[~(np.abs(values) <= MOST)] = np.nan
        return values

    def cell(self, row: int, index: int) -> str:
        """What stands in the file."""
        return f"{self.arrays[index][row]:.10g}"

    def is_cut_off(self, row: int) -> bool:
        """Arrays of one length have no short rows."""
        return False


def read_arrays(path: Path, names: Sequence[str] | None = None) -> ArrayTable:
    """The one-dimensional arrays of numbers in an NPZ; nothing in the file is executed.

    Raises:
        ValueError: no NPZ, or no arrays of one length in it.
    """
    try:
        with np.load(path, allow_pickle=False) as archive:
            found = {name: archive[name] for name in archive.files}
    except (ValueError, OSError, zipfile.BadZipFile, MemoryError):
        raise ValueError("this is no NPZ archive of plain arrays") from None
    columns = {
        name: np.asarray(values, np.float64)
        for name, values in found.items()
        if values.ndim == 1 and values.dtype.kind in "iuf"
    }
    lengths = {values.size for values in columns.values()}
    if len(lengths) != 1:
        held = ", ".join(sorted(found)[:12]) or "nothing"
        raise ValueError(f"an NPZ must hold arrays of one length by name (time_s, ...), got {held}")
    if names is not None:
        raise ValueError("names belong to tables of text: the arrays of an NPZ have their own")
    count = lengths.pop()
    return ArrayTable(
        names=tuple(columns),
        units=("",) * len(columns),
        arrays=tuple(columns.values()),
        lines=list(range(1, count + 1)),
    )
