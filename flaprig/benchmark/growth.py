"""How the cost of a run grows: with its length, with finer steps, with the panels of the wing."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.benchmark.benchmark import STROKE
from flaprig.benchmark.growth_picture import Curve, draw
from flaprig.benchmark.outcome import Outcome, Row, row
from flaprig.benchmark.turns import in_turn
from flaprig.wing import RIG_WING

Array = NDArray[np.float64]

# nothing fades at the end of a wake that has no end
WHOLE: dict[str, Any] = {"wake_fade": 0.0}
BRUTE: dict[str, Any] = WHOLE | {"wake_detail": 0}
# what the project aims at: exponent of the total cost with the default dial
AIM = 2.2
# "linear" leaves room for what a noisy machine does to a fit
LINEAR = 1.1
NOTE = (
    "The exponent is that of the whole run. With finer steps the dial keeps its accuracy, half a "
    "cycle of full detail, and so its gain is a constant there."
)


@dataclass(frozen=True)
class Series:
    """Runs that differ in one size.

    Attributes:
        name: what grows, and which wake.
        sizes: along the horizontal axis.
        model: the air for a size.
        cycles: length of the run for a size.
        axis: what the size is.
        at_most: the aim of the exponent, or None.
        beyond_first: whether the first run's cost is taken off the others': what a further cycle
            costs, once the wake is as long as it gets.
    """

    name: str
    sizes: tuple[int, ...]
    model: Callable[[int], UVLM]
    cycles: Callable[[int], int]
    axis: str
    at_most: float | None = None
    beyond_first: bool = False

    def run(self, size: int) -> None:
        """One run."""
        simulate(RIG_WING, STROKE, self.model(size), cycles=self.cycles(size))

    def row(self, taken: Array) -> Row:
        """The exponent over all sizes, by turn. Shape of the seconds (sizes, turns)."""
        sizes = np.array(self.sizes, dtype=float)
        if self.beyond_first:
            taken, sizes = taken[1:] - taken[0], sizes[1:] - sizes[0]
        name = f"{self.name}{self.after}, {self.axis} {self.sizes[0]} to {self.sizes[-1]}"
        return row(name, exponent(sizes, taken), "exponent", at_most=self.at_most)

    @property
    def after(self) -> str:
        """What the exponent leaves out."""
        return " after the first" if self.beyond_first else ""


def exponent(sizes: ArrayLike, taken: ArrayLike) -> Array:
    """Slope of log time over log size, by least squares. Shape (turns,), or ().

    Args:
        sizes: shape (n,).
        taken: seconds. Shape (n,) or (n, turns).
    """
    x, y = np.log(np.asarray(sizes, float)), np.log(np.maximum(np.asarray(taken, float), 1e-9))
    away = x - x.mean()
    return np.asarray(away @ y / (away @ away))


@dataclass(frozen=True)
class Growth:
    """Wall time against steps, steps per cycle and panels, and the exponents of the total cost.

    Attributes:
        steps: steps in the one cycle of a run, 8 to 2000.
        cycles: lengths of runs in steps of `steps_per_cycle`, 1 to 100.
        spanwise: panels along the span, even, 2 to 44; half as many are along the chord.
        steps_per_cycle: where the run's length or the panels grow.
        turns: of everything.
    """

    name: ClassVar[str] = "growth"
    claim: ClassVar[str] = "cost against steps, finer steps and panels"

    steps: tuple[int, ...] = (50, 100, 200, 350, 500)
    cycles: tuple[int, ...] = (1, 2, 3, 5)
    spanwise: tuple[int, ...] = (6, 12, 18, 24)
    steps_per_cycle: int = 100
    turns: int = 3

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        self._check()
        listed = self.series()
        works = {(s.name, n): partial(s.run, n) for s in listed for n in s.sizes}
        # threads, caches and the clock of the processor wake up
        listed[0].run(listed[0].sizes[0])
        taken = in_turn(works, self.turns, progress)
        rows, curves = [], []
        for each in listed:
            table = np.array([taken[each.name, size] for size in each.sizes])
            rows.append(each.row(table))
            words = f"{each.name} ({rows[-1].value:.2f}{each.after})"
            curves.append(Curve(words, each.axis, each.sizes, np.median(table, axis=1)))
            rows.append(row(f"{each.name}, {each.axis} {each.sizes[-1]}", table[-1], "s"))
        data = [
            {"name": c.name, "axis": c.axis, "sizes": c.sizes, "median_s": c.taken} for c in curves
        ]
        return Outcome(tuple(rows), {"series": data}, lambda path: draw(path, curves), (NOTE,))

    def series(self) -> tuple[Series, ...]:
        """Everything that is run."""
        fine, grids = self.steps, {n * n // 2: n for n in self.spanwise}
        long = tuple(cycles * self.steps_per_cycle for cycles in self.cycles)
        brute, dial, short = self._whole(BRUTE), self._whole(WHOLE), self._whole({})
        steps, per_cycle, all_of = "steps", "steps per cycle", self._cycles
        return (
            Series("whole wake, brute force", long, brute, all_of, steps),
            Series("whole wake, default dial", long, dial, all_of, steps, AIM),
            Series("wake of one cycle", long, short, all_of, steps, LINEAR, beyond_first=True),
            Series("one cycle, brute force", fine, _fine(BRUTE), _one, per_cycle),
            Series("one cycle, default dial", fine, _fine(WHOLE), _one, per_cycle),
            Series("defaults", tuple(grids), partial(self._grid, grids), _one, "panels"),
        )

    def _cycles(self, steps: int) -> int:
        return steps // self.steps_per_cycle

    def _whole(self, settings: dict[str, Any]) -> Callable[[int], UVLM]:
        """A wake as long as the run; that of the defaults without settings."""
        return lambda steps: UVLM(
            steps_per_cycle=self.steps_per_cycle,
            wake_cycles=float(self._cycles(steps)) if settings else 1.0,
            **settings,
        )

    def _grid(self, grids: Mapping[int, int], panels: int) -> UVLM:
        return UVLM(grids[panels] // 2, grids[panels], self.steps_per_cycle)

    def _check(self) -> None:
        least = {"steps": 2, "cycles": 3, "spanwise": 2}
        limits = {"steps": (8, 2000), "cycles": (1, 100), "spanwise": (2, 44)}
        for name, fewest in least.items():
            sizes: Sequence[int] = getattr(self, name)
            for size in sizes:
                check.whole(self.name, name, size, *limits[name])
            if len(sizes) < fewest or list(sizes) != sorted(set(sizes)):
                allowed = f"at least {fewest} numbers that increase"
                raise check.fail(self.name, name, allowed, sizes)
        if any(size % 2 for size in self.spanwise):
            raise check.fail(self.name, "spanwise", "even numbers", self.spanwise)
        check.whole(self.name, "steps_per_cycle", self.steps_per_cycle, 8, 2000)
        check.whole(self.name, "turns", self.turns, 1, 100)


def _one(size: int) -> int:
    return 1


def _fine(settings: dict[str, Any]) -> Callable[[int], UVLM]:
    return lambda steps: UVLM(steps_per_cycle=steps, **settings)
