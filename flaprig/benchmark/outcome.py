"""What a benchmark finds: numbers measured in turns of one run, arrays, and a picture."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True)
class Row:
    """One number, found anew in every turn of a run.

    Attributes:
        quantity: what it is.
        turns: its value in each turn; one value where it is found only once.
        unit: of the values; "x" for a ratio.
        at_least: what the project aims at, or None. Nothing fails where it is not reached.
        at_most: likewise, for what should be small.
        command: what makes the number; that of the benchmark where it is empty.
    """

    quantity: str
    turns: tuple[float, ...]
    unit: str
    at_least: float | None = None
    at_most: float | None = None
    command: str = ""

    @property
    def value(self) -> float:
        """Median of the turns."""
        return float(np.median(self.turns))

    @property
    def low(self) -> float:
        """Smallest of the turns."""
        return min(self.turns)

    @property
    def high(self) -> float:
        """Largest of the turns."""
        return max(self.turns)

    @property
    def reached(self) -> bool | None:
        """Whether the median is where it should be; None without an aim."""
        if self.at_least is None and self.at_most is None:
            return None
        enough = self.at_least is None or self.value >= self.at_least
        return enough and (self.at_most is None or self.value <= self.at_most)

    def summary(self, command: str) -> dict[str, Any]:
        """The row as it stands in JSON.

        Args:
            command: of the benchmark.
        """
        return {
            "quantity": self.quantity,
            "value": self.value,
            "unit": self.unit,
            "spread": self.high - self.low,
            "turns": list(self.turns),
            "at_least": self.at_least,
            "at_most": self.at_most,
            "reached": self.reached,
            "command": self.command or command,
        }


def row(quantity: str, turns: ArrayLike, unit: str, **more: Any) -> Row:
    """A Row of an array, or of one number.

    Args:
        quantity: what it is.
        turns: one value a turn.
        unit: of the values.
        more: fields of Row by name.
    """
    return Row(quantity, tuple(np.atleast_1d(np.asarray(turns, float)).tolist()), unit, **more)


@dataclass(frozen=True)
class Outcome:
    """The result of a benchmark.

    Attributes:
        rows: the table.
        data: arrays and numbers for JSON, by name with unit.
        draw: writes the benchmark's picture to a path; None where there is nothing to look at.
        notes: sentences below the rows: what was compared, what was left out and why.
    """

    rows: tuple[Row, ...]
    data: Mapping[str, Any] = field(default_factory=dict)
    draw: Callable[[Path], None] | None = None
    notes: tuple[str, ...] = ()
