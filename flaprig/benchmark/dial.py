"""The wake's dial: what detail costs in time, and the lack of it in loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.aero.uvlm import WAKE_DETAIL
from flaprig.benchmark.benchmark import STROKE
from flaprig.benchmark.outcome import Outcome, Row, row
from flaprig.benchmark.turns import in_turn
from flaprig.report import style
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING

Array = NDArray[np.float64]

# what the project aims at: means of the first cycle beside those of brute force [%]
AIM = 0.3
# kinematics are drawn from these: sweep and pitch amplitude [rad], both reversals [cycles]
LOW, HIGH = np.radians([40.0, 30.0]), np.radians([75.0, 60.0])
REVERSAL = 0.16, 0.5
# relative width of the band of pitch amplitudes in which neighbouring strokes lie
BAND = 1e-3
NOTE = (
    "First cycle: the largest and the rms difference of mean lift and drag from brute force over "
    "kinematics drawn from the rig's whole range. Last cycle: a free wake is chaotic, so the means "
    f"over strokes within {BAND:.1%} of pitch amplitude are compared, in units of the standard "
    "deviation among those of brute force."
)


@dataclass(frozen=True)
class Dial:
    """Speed and loads of the rig case with less and less detail in the old wake.

    Attributes:
        details: values of `wake_detail` [cycles] beside brute force.
        kinematics: strokes whose first cycles are compared.
        neighbours: strokes whose last cycles are compared.
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: steps in a cycle.
        cycles: of the rig case, whose whole wake is kept.
        turns: of the times.
    """

    name: ClassVar[str] = "dial"
    claim: ClassVar[str] = "the wake's detail: its price in time and in loads"

    details: tuple[float, ...] = (0.125, 0.25, 0.375, 0.5, 0.75)
    kinematics: int = 40
    neighbours: int = 16
    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 3
    turns: int = 5

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        self._check()
        whole = {"wake_cycles": float(self.cycles), "wake_fade": 0.0}
        works = {
            detail: partial(
                simulate, RIG_WING, STROKE, self._model(detail, **whole), cycles=self.cycles
            )
            for detail in (0.0, *self.details)
        }
        told = progress or (lambda fraction: None)
        taken = in_turn(works, self.turns, lambda fraction: told(0.4 * fraction))
        faster = {detail: taken[0.0] / taken[detail] for detail in self.details}
        first = self._first()
        told(0.6)
        last = self._last(whole)
        told(1.0)
        rows = [each for d in self.details for each in _rows(d, faster[d], first[d], last[d])]
        return Outcome(tuple(rows), {}, lambda path: _draw(path, faster, first), (NOTE,))

    def _check(self) -> None:
        if not self.details:
            raise check.fail(self.name, "details", "at least one number", self.details)
        for detail in self.details:
            check.in_range(self.name, "details", detail, 0.01, 100.0, "cycles")
        check.whole(self.name, "kinematics", self.kinematics, 1, 10_000)
        check.whole(self.name, "neighbours", self.neighbours, 2, 10_000)
        check.whole(self.name, "cycles", self.cycles, 1, 20)
        check.whole(self.name, "turns", self.turns, 1, 1000)

    def _model(self, detail: float, **settings: Any) -> UVLM:
        grid = (self.chordwise, self.spanwise, self.steps_per_cycle)
        return UVLM(*grid, wake_detail=detail, **settings)

    def _first(self) -> dict[float, Array]:
        """Differences of the first cycle's means from brute force [%]. Shape (strokes, 2) each."""
        strokes = drawn(self.kinematics)
        means = {d: cycle_means(strokes, self._model(d), 1)[..., 0] for d in (0.0, *self.details)}
        return {d: 100.0 * (means[d] / means[0.0] - 1.0) for d in self.details}

    def _last(self, whole: dict[str, float]) -> dict[float, Array]:
        """Differences of the last cycle's means over neighbours, over their spread. Shape (2,)."""
        near = 1.0 + BAND * np.linspace(-0.5, 0.5, self.neighbours)
        amplitude = STROKE.pitch_amplitude
        strokes = [replace(STROKE, pitch_amplitude=float(n * amplitude)) for n in near]
        means = {
            d: cycle_means(strokes, self._model(d, **whole), self.cycles)[..., -1]
            for d in (0.0, *self.details)
        }
        exact, spread = means[0.0].mean(axis=0), means[0.0].std(axis=0, ddof=1)
        return {d: (means[d].mean(axis=0) - exact) / spread for d in self.details}


def drawn(count: int) -> list[SunTangStroke]:
    """Strokes from all over what the rig may do, always the same."""
    rng = np.random.default_rng(1)
    return [
        SunTangStroke(STROKE.frequency, *rng.uniform(LOW, HIGH), *rng.uniform(*REVERSAL, 2))
        for _ in range(count)
    ]


def cycle_means(strokes: Sequence[SunTangStroke], model: UVLM, cycles: int) -> Array:
    """Mean lift and drag [N] by stroke and cycle. Shape (strokes, 2, cycles)."""
    found = simulate_batch(RIG_WING, strokes, model, cycles=cycles)
    forces = np.array([(result.lift, result.drag) for result in found])
    return forces.reshape(len(found), 2, cycles, -1).mean(axis=-1)


def _rows(detail: float, faster: Array, first: Array, last: Array) -> list[Row]:
    words = f"detail {detail:g}"
    aim = {"at_most": AIM} if detail == WAKE_DETAIL else {}
    return [
        row(f"{words}, faster than brute force", faster, "x"),
        row(f"{words}, largest change of a first cycle", np.abs(first).max(), "%", **aim),
        row(f"{words}, rms change of first cycles", np.sqrt(np.mean(first**2)), "%"),
        row(f"{words}, change of last cycles over their spread", np.abs(last).max(), "sd"),
    ]


def _draw(path: Path, faster: dict[float, Array], first: dict[float, Array]) -> None:
    """Each stroke's change of lift and drag against the speed."""
    with style.figure(6.2, 3.6) as drawing:
        axes = drawing.subplots()
        for detail, change in first.items():
            speed = float(np.median(faster[detail]))
            for index, (words, colour) in enumerate(
                (("lift", style.BLUE), ("drag", style.VERMILION))
            ):
                places = np.full(len(change), speed + 0.2 * (index - 0.5))
                label = words if detail == min(first) else None
                axes.plot(places, change[:, index], "_", ms=9, color=colour, label=label)
            axes.text(speed, 1.02, f"{detail:g}", ha="center", transform=axes.get_xaxis_transform())
        axes.axhspan(-AIM, AIM, color=style.PALE, zorder=0)
        axes.set(xlabel="times faster than brute force, 3 cycles of whole wake")
        axes.set(ylabel="change of a first cycle's mean [%]")
        axes.set_title("Age of full detail [cycles]", pad=20)
        axes.legend()
        style.save(drawing, path)
