"""A file's table: one line of names, perhaps one of units, and rows of cells with their lines.

The cells are parsed by Python's `csv`; here it is only found out which separator the file has.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass

from flaprig.logs.numbers import Array, column
from flaprig.logs.units import is_unit

# separators that are tried, in the order of preference; the last is any number of blanks
SEPARATORS = {",": "commas", ";": "semicolons", "\t": "tabs", "|": "bars", " ": "blanks"}
# marks of a line that is a remark
REMARKS = ("#", "%", "//", "!")
# lines from which the separator is told, and in which the numbers must begin
_SAMPLE, _HEAD = 50, 200
# a cell that is a number, with a decimal point or a decimal comma
_NUMBER = re.compile(r"^[+-]?(\d[\d.,]*|[.,]\d+)([eE][+-]?\d+)?$")
# cells that stand for a missing number
MISSING = ("", "nan", "na", "n/a", "null", "none", "-", "--", "inf", "+inf", "-inf", "-nan")


@dataclass(frozen=True, eq=False)
class Table:
    """Cells of a file.

    Attributes:
        names: of the columns, as the file has them.
        units: second line of the file, where it holds units; empty strings elsewhere.
        rows: cells of each row; short rows are as they are.
        lines: number of each row's line in the file, from 1.
        separator: what stands between the cells.
    """

    names: tuple[str, ...]
    units: tuple[str, ...]
    rows: list[list[str]]
    lines: list[int]
    separator: str = ","

    def numbers(self, index: int) -> Array:
        """A column as numbers, NaN where a cell is none. Shape (rows,)."""
        return column([row[index] if index < len(row) else "" for row in self.rows])

    def cell(self, row: int, index: int) -> str:
        """What stands in the file."""
        cells = self.rows[row]
        return cells[index] if index < len(cells) else ""

    def is_cut_off(self, row: int) -> bool:
        """Whether a row has fewer cells than the names are."""
        return len(self.rows[row]) < len(self.names)


def read_table(text: str, names: Sequence[str] | None = None) -> Table:
    """The table in a text.

    Args:
        text: of the file.
        names: of the columns, in place of the file's own; None: the first line has them.

    Raises:
        ValueError: no line of names, no rows, or names that are not as many as the columns.
    """
    numbered = [
        (number, line)
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith(REMARKS)
    ]
    if not numbered:
        raise ValueError("a log must have a line of names, got an empty file")

    separator = _separator([line for _, line in numbered[:_SAMPLE]])
    lines = [number for number, _ in numbered]
    rows = _cells([line for _, line in numbered], separator)
    first = _first_numbers(rows)
    unit_row = first > 1 and all(is_unit(cell) for cell in rows[first - 1])
    if names is not None:
        heading = _matching(names, rows[first:])
    elif first == 0:
        raise ValueError(
            f"a log must have a line of names, for instance time_s,sweep_deg,pitch_deg, and line "
            f"{lines[0]} already holds {len(rows[0])} numbers (name the columns: --log-columns)"
        )
    else:
        heading = tuple(rows[first - 1 - unit_row])

    units = tuple(rows[first - 1]) if unit_row else ()
    return Table(
        names=heading,
        units=(*units, *("" for _ in heading[len(units) :])),
        rows=rows[first:],
        lines=lines[first:],
        separator=separator,
    )


def is_number(cell: str) -> bool:
    """Whether a cell is a finite number, with a decimal point or a decimal comma."""
    return bool(_NUMBER.match(cell))


def _separator(lines: Sequence[str]) -> str:
    """The separator that cuts most of the lines into the same number of cells, two at least."""
    best, found = -1.0, ","
    for separator in SEPARATORS:
        widths = [len(row) for row in _cells(lines, separator)]
        common = max(set(widths), key=widths.count)
        share = widths.count(common) / len(widths)
        # a decimal comma beside semicolons or tabs makes commas look regular, too: a separator
        # whose cells are numbers wins over one that only cuts often
        cut = _cells(lines, separator)[-min(len(lines), 20) :]
        cells = [cell for row in cut for cell in row]
        good = sum(is_number(cell) or cell.lower() in MISSING for cell in cells) / len(cells)
        whole = sum(_one_number(cell) for cell in cells) / len(cells)
        score = (common > 1) * (share + good + whole)
        if score > best + 1e-9:
            best, found = score, separator
    return found


def _one_number(cell: str) -> bool:
    """Whether a cell holds at most one decimal mark."""
    return is_number(cell) and cell.count(",") + cell.count(".") <= 1


def _cells(lines: Sequence[str], separator: str) -> list[list[str]]:
    bare = [line.strip() for line in lines] if separator == " " else lines
    rows = list(csv.reader(bare, delimiter=separator, skipinitialspace=True))
    if len(rows) != len(lines):
        # a quotation mark that is never closed swallows lines: then marks mean nothing
        rows = list(csv.reader(bare, delimiter=separator, quoting=csv.QUOTE_NONE))
    return [[cell.strip(" \t\"'") for cell in row] for row in rows]


def _first_numbers(rows: list[list[str]]) -> int:
    """Index of the first row of numbers; what comes before are remarks, names and units."""
    for index, row in enumerate(rows[:_HEAD]):
        if sum(is_number(cell) for cell in row) >= min(2, len(row)):
            return index
    return min(1, len(rows))


def _matching(names: Sequence[str], rows: list[list[str]]) -> tuple[str, ...]:
    """The names given, which must be as many as the columns."""
    width = max((len(row) for row in rows[:_SAMPLE]), default=0)
    if len(names) != width:
        raise ValueError(f"names must be as many as the columns, {width}, got {len(names)}")
    return tuple(names)
