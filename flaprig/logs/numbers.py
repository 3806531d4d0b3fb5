"""Cells as numbers: decimal points and commas, and which rows cannot be used."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# lines that a sentence names before it says how many more there are
NAMED = 5
# largest size of a number in a log
MOST = 1e30


def column(cells: Sequence[str]) -> Array:
    """Numbers of one column, NaN where a cell is none; commas may be decimal marks. Shape (n,)."""
    if any("," in cell for cell in cells):
        cells = [_with_a_point(cell) for cell in cells]
    try:
        values = np.array(cells, dtype=np.float64)
    except ValueError:
        values = np.array([_number(cell) for cell in cells])
    with np.errstate(invalid="ignore"):
        values[~(np.abs(values) <= MOST)] = np.nan
    return values


def lines_named(lines: Iterable[int]) -> str:
    """The lines as words: «line 7», «lines 7, 9», «lines 7, 9, 12, 15, 20 and 31 more»."""
    numbers = list(lines)
    if len(numbers) == 1:
        return f"line {numbers[0]}"
    shown = ", ".join(map(str, numbers[:NAMED]))
    rest = len(numbers) - NAMED
    return f"lines {shown}" + (f" and {rest} more" if rest > 0 else "")


def _with_a_point(cell: str) -> str:
    """1,5 and 1.234,5 and 1,234.5 as numbers of Python: the last mark is the decimal one."""
    comma, point = cell.rfind(","), cell.rfind(".")
    if comma > point:
        return cell.replace(".", "").replace(",", ".")
    return cell.replace(",", "")


def _number(cell: str) -> float:
    try:
        # digits grouped by underscores are Python's alone
        return float("nan") if "_" in cell else float(cell)
    except ValueError:
        return float("nan")
