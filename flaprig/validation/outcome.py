"""What a validation case finds: rows of ours beside a reference, arrays, and a picture."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any


class Verdict(StrEnum):
    """Whether a row is within its tolerance; most rows without one only tell."""

    WITHIN = "within"
    OUTSIDE = "outside"
    TOLD = ""


@dataclass(frozen=True)
class Row:
    """One number of ours and what it should be.

    Attributes:
        quantity: what it is, with its unit.
        value: ours.
        reference: theirs; None where nothing is known.
        source: who says so.
        tolerance: largest size of the error; None where the row only tells.
        relative: whether the error is in percent of the reference, else in the quantity's unit.
        spread: standard deviation of ours from cycle to cycle; NaN where there is none.
    """

    quantity: str
    value: float
    reference: float | None = None
    source: str = ""
    tolerance: float | None = None
    relative: bool = True
    spread: float = math.nan

    @property
    def error(self) -> float:
        """Ours minus theirs, in percent of theirs or in the unit; NaN without a reference."""
        if self.reference is None:
            return math.nan
        difference = self.value - self.reference
        return 100.0 * difference / abs(self.reference) if self.relative else difference

    @property
    def verdict(self) -> Verdict:
        """Within or outside of the tolerance; a value that is no number is outside."""
        if self.tolerance is None:
            return Verdict.TOLD
        return Verdict.WITHIN if abs(self.error) <= self.tolerance else Verdict.OUTSIDE

    def summary(self) -> dict[str, Any]:
        """The row as it stands in JSON."""
        return {
            "quantity": self.quantity,
            "value": self.value,
            "spread": self.spread,
            "reference": self.reference,
            "source": self.source,
            "error": self.error,
            "error_in": "percent" if self.relative else "unit",
            "tolerance": self.tolerance,
            "verdict": self.verdict.value,
        }


@dataclass(frozen=True)
class Table:
    """Numbers that are read across, as text.

    Attributes:
        title: above it.
        header: of the columns; the first one names the lines.
        lines: as many cells as the header has.
    """

    title: str
    header: tuple[str, ...]
    lines: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Outcome:
    """The result of a case.

    Attributes:
        rows: the table.
        data: arrays and numbers for JSON, by name with unit.
        draw: writes the case's picture to a path; None where there is nothing to look at.
        notes: sentences below the rows: what the numbers mean, what was left out and why.
        tables: what is told beside the rows.
    """

    rows: tuple[Row, ...]
    data: Mapping[str, Any] = field(default_factory=dict)
    draw: Callable[[Path], None] | None = None
    notes: tuple[str, ...] = ()
    tables: tuple[Table, ...] = ()

    @property
    def missed(self) -> tuple[Row, ...]:
        """Rows outside of their tolerance."""
        return tuple(row for row in self.rows if row.verdict is Verdict.OUTSIDE)
