"""Convergence of the rig's loads in every numerical setting of the lattice."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.report import style
from flaprig.validation.case import on_all_cores
from flaprig.validation.outcome import Outcome, Row, Table
from flaprig.validation.paper import SINUSOID
from flaprig.wing import RIG_WING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = NDArray[np.float64]

# what is looked at: key of a result's summary, words
QUANTITIES = {
    "cl": "C_L",
    "cd": "C_D",
    "lift_to_drag": "L/D",
    "peak_sweep_torque_Nm": "sweep torque, peak",
    "peak_pitch_torque_Nm": "pitch torque, peak",
}
# refinement from mesh to mesh and from step to step
RATIO = 1.5
# Roache's factor of safety for three grids
SAFETY = 1.25
NOTES = (
    "An order is of the last three values, 1.5 apart; none where they do not converge one way, "
    "since the spread of a free wake is larger than their difference.",
)

Found = dict[UVLM, dict[str, Any]]


@dataclass(frozen=True)
class Sweep:
    """One setting, varied.

    Attributes:
        name: on the picture.
        values: along its axis.
        models: the lattice at each value.
        refines: whether the last three are a geometric refinement that can be extrapolated; the
            middle one of them is the default.
    """

    name: str
    values: tuple[float, ...]
    models: tuple[UVLM, ...]
    refines: bool = False


def sweeps(base: UVLM) -> tuple[Sweep, ...]:
    """The settings around a lattice's own."""
    panels = tuple(
        replace(base, chordwise=c, spanwise=2 * c) for c in (3, 4, 6, 9) if 2 * c * c <= 1024
    )
    steps = tuple(replace(base, steps_per_cycle=n) for n in (45, 67, 100, 150))
    plain = {
        "core": (0.1, 0.15, 0.2, 0.3),
        "wake_cycles": (0.5, 0.75, 1.0, 1.5),
        "wake_detail": (0.125, 0.25, 0.5, 1.0),
        "wake_fade": (0.0, 0.1, 0.25, 0.5),
        "shedding_fraction": (0.2, 0.25, 1.0 / 3.0, 0.5),
    }
    words = {
        "core": "vortex core [chords]",
        "wake_cycles": "wake kept [cycles]",
        "wake_detail": "age of full detail [cycles]",
        "wake_fade": "share of it that fades",
        "shedding_fraction": "shedding fraction",
    }
    return (
        Sweep("panels along the chord", (3, 4, 6, 9), panels, True),
        Sweep("steps per cycle", (45, 67, 100, 150), steps, True),
        *(
            Sweep(words[name], values, tuple(_with(base, name, v) for v in values))
            for name, values in plain.items()
        ),
    )


def _with(base: UVLM, name: str, value: float) -> UVLM:
    changes: dict[str, Any] = {name: value}
    return replace(base, **changes)


@dataclass(frozen=True)
class Convergence:
    """Means and peaks of the rig's sinusoid against panels, steps, core, wake and shedding.

    Panels are as wide as long times 1.04; both are refined together. The uncertainty of a number
    is what refinement of panels and steps would still change, with Roache's factor of safety, and
    the spread from cycle to cycle, added as squares.

    Attributes:
        cycles: of each run; means are over the third to the last, at most three.
        neighbours: strokes over which every number is averaged. Their frequencies are a ten
            millionth apart, enough for a chaotic wake to roll up otherwise.
    """

    name: ClassVar[str] = "convergence"
    claim: ClassVar[str] = "refinement of the rig's loads, and their uncertainty"

    cycles: int = 5
    neighbours: int = 8

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "cycles", self.cycles, 2, 100)
        check.whole(self.name, "neighbours", self.neighbours, 1, 100)
        base = UVLM()
        varied = sweeps(base)
        models = list(dict.fromkeys([base, *(m for sweep in varied for m in sweep.models)]))
        # the longest first, so that the cores end together
        models.sort(key=_work, reverse=True)
        found = dict(zip(models, on_all_cores(self._summary, models, progress), strict=True))
        rows = _rows(varied, found)
        data = {
            sweep.name: {
                "values": sweep.values,
                **{key: [found[m][key] for m in sweep.models] for key in QUANTITIES},
            }
            for sweep in varied
        }
        tables = (_table(varied, found),)
        return Outcome(
            tuple(rows), data, lambda path: _draw(path, varied, found, base), NOTES, tables
        )

    def _summary(self, model: UVLM) -> dict[str, Any]:
        near = [
            replace(SINUSOID, frequency=SINUSOID.frequency * (1.0 + 1e-7 * k))
            for k in range(self.neighbours)
        ]
        found = [simulate(RIG_WING, s, model, cycles=self.cycles).summary() for s in near]
        keys = [key for key in found[0] if key.removesuffix("_spread") in QUANTITIES]
        # a single cycle has no spread
        keys = [key for key in keys if found[0][key] is not None]
        return {key: float(np.mean([f[key] for f in found])) for key in keys}


def _work(model: UVLM) -> float:
    """About proportional to the time of a run."""
    rows = model.steps_per_cycle * model.wake_cycles
    return model.steps_per_cycle * (rows * model.spanwise) ** 2


def order(values: Sequence[float]) -> float:
    """Observed order of the last three of a refinement; NaN where they do not converge."""
    coarse, middle, fine = values[-3:]
    if (coarse - middle) * (middle - fine) <= 0.0:
        return math.nan
    return math.log((coarse - middle) / (middle - fine)) / math.log(RATIO)


def left_to_gain(values: Sequence[float]) -> float:
    """What refinement would still change of the middle of the last three, with a factor of safety.

    The order is held within 0.5 and 2; where none is seen it is taken as 1.
    """
    seen = order(values)
    used = 1.0 if math.isnan(seen) else min(2.0, max(0.5, seen))
    middle, fine = values[-2:]
    limit = fine + (fine - middle) / (RATIO**used - 1.0)
    return SAFETY * abs(limit - middle)


def _rows(varied: Sequence[Sweep], found: Found) -> list[Row]:
    """The uncertainty of each quantity."""
    rows = []
    for key, words in QUANTITIES.items():
        value = found[UVLM()][key]
        parts = [left_to_gain([found[m][key] for m in s.models]) for s in varied if s.refines]
        # a peak has no spread, nor has a mean over one cycle
        spread = found[UVLM()].get(f"{key}_spread", 0.0)
        total = math.sqrt(sum(part**2 for part in parts) + spread**2)
        rows.append(Row(f"{words}, numerical uncertainty [%]", 100.0 * total / abs(value)))
    return rows


def _table(varied: Sequence[Sweep], found: Found) -> Table:
    """Orders and what is left to gain, and the range over every setting."""
    refined = [s for s in varied if s.refines]
    header = ["quantity", "default"]
    header += [f"{word} in {s.name}" for s in refined for word in ("order", "left to gain")]
    header += [f"range over {s.name}" for s in varied if not s.refines]
    lines = []
    for key, words in QUANTITIES.items():
        value = found[UVLM()][key]
        line = [words, f"{value:.4g}"]
        for sweep in refined:
            values = [found[m][key] for m in sweep.models]
            seen = order(values)
            line.append("none" if math.isnan(seen) else f"{seen:.1f}")
            line.append(f"{100.0 * left_to_gain(values) / abs(value):.2f} %")
        for sweep in varied:
            if not sweep.refines:
                values = [found[m][key] for m in sweep.models]
                line.append(f"{100.0 * np.ptp(values) / abs(value):.1f} %")
        lines.append(tuple(line))
    return Table("Every setting around the default", tuple(header), tuple(lines))


def _draw(path: Path, varied: Sequence[Sweep], found: Found, base: UVLM) -> None:
    with style.figure(11.0, 5.2) as drawing:
        grid = drawing.subplots(2, 4, sharey=True)
        for axes in grid.flat[len(varied) :]:
            axes.set_axis_off()
        for axes, sweep in zip(grid.flat, varied, strict=False):
            for (key, words), colour in zip(QUANTITIES.items(), style.SERIES, strict=True):
                change = [100.0 * (found[m][key] / found[base][key] - 1.0) for m in sweep.models]
                axes.plot(sweep.values, change, "o-", ms=3.5, color=colour, label=words)
            _dress(axes, sweep, base)
        grid[0, 0].set_ylabel("change from the default [%]")
        grid[1, 0].set_ylabel("change from the default [%]")
        handles, labels = grid[0, 0].get_legend_handles_labels()
        drawing.legend(handles, labels, loc="outside upper center", ncols=5)
        style.save(drawing, path)


def _dress(axes: Axes, sweep: Sweep, base: UVLM) -> None:
    default = sweep.values[sweep.models.index(base)]
    axes.axvline(default, color=style.GREY, linewidth=0.8, linestyle=":")
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.set_xlabel(sweep.name)
