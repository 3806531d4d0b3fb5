"""The paper's rig: its measured sinusoid, and its nine kinematics by every model."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM, AirModel, QuasiSteady
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.report import style
from flaprig.strokes import SunTangStroke
from flaprig.validation.case import on_all_cores
from flaprig.validation.outcome import Outcome, Row, Table
from flaprig.wing import RIG_WING

if TYPE_CHECKING:
    from matplotlib.axes import Axes

SOURCE = "paper, table 1"
# the sinusoid, measured in the tank
LIFT, LIFT_TO_DRAG = 1.94, 0.74
# section 2.2: durations of the sweep's and the pitch's reversals [cycles]
DURATIONS = (0.16, 0.32, 0.50)
SINUSOID = SunTangStroke(0.2, math.pi / 3, math.pi / 4)
MODELS: dict[str, AirModel] = {
    "UVLM": UVLM(),
    "extended UVLM": UVLM.extended(),
    "quasi-steady": QuasiSteady(),
}
# what is asked of C_L and L/D of the sinusoid, in percent
WITHIN = (3.0, 4.0)


@dataclass(frozen=True)
class Paper:
    """The sinusoid against the paper's table 1, and its figures 5 and 6 as a table of our own.

    The paper prints no numbers for the other eight kinematics.

    Attributes:
        cycles: of each run; means are over the third to the last, at most three.
    """

    name: ClassVar[str] = "paper"
    claim: ClassVar[str] = "the paper's measured sinusoid and nine kinematics"

    cycles: int = 5

    def run(self, progress: Progress | None = None) -> Outcome:
        """Run the case. ValueError for a parameter out of range."""
        check.whole(self.name, "cycles", self.cycles, 1, 1000)
        pairs = [(sweep, pitch) for sweep in DURATIONS for pitch in DURATIONS]
        jobs = [(name, pair) for name in MODELS for pair in pairs]
        found = dict(
            zip(jobs, on_all_cores(lambda job: self._result(*job), jobs, progress), strict=True)
        )
        rows = [row for name in MODELS for row in _sinusoid(name, found[name, (0.5, 0.5)])]
        data = {
            name: {f"{s:g}/{p:g}": found[name, (s, p)].summary() for s, p in pairs}
            for name in MODELS
        }
        tables = (_nine(pairs, found),)
        return Outcome(tuple(rows), data, lambda path: _draw(path, found), NOTES, tables)

    def _result(self, name: str, durations: tuple[float, float]) -> Result:
        stroke = SunTangStroke(0.2, math.pi / 3, math.pi / 4, *durations)
        return simulate(RIG_WING, stroke, MODELS[name], cycles=self.cycles)


NOTES = (
    "The suction of the UVLM is calibrated on this C_L; the extended UVLM was fitted to C_L and "
    "L/D of this stroke and to 26 others at once. The paper prints no numbers for the other eight.",
)


def _sinusoid(name: str, result: Result) -> list[Row]:
    lift, ratio = WITHIN if name != "quasi-steady" else (None, None)
    spread = result.lift_to_drag_spread
    return [
        Row(f"sinusoid, {name}, C_L", result.cl, LIFT, SOURCE, lift, spread=result.cl_spread),
        Row(
            f"sinusoid, {name}, L/D",
            result.lift_to_drag,
            LIFT_TO_DRAG,
            SOURCE,
            ratio,
            spread=spread,
        ),
    ]


def _nine(
    pairs: Sequence[tuple[float, float]],
    found: Mapping[tuple[str, tuple[float, float]], Result],
) -> Table:
    """C_L and L/D of every model with their spread."""
    header = ["sweep / pitch", *(f"{what}, {name}" for name in MODELS for what in ("C_L", "L/D"))]
    lines = []
    for pair in pairs:
        line = [f"{pair[0]:.2f} / {pair[1]:.2f}"]
        for result in (found[name, pair] for name in MODELS):
            line += [
                f"{result.cl:.3f} ±{result.cl_spread:.3f}",
                f"{result.lift_to_drag:.3f} ±{result.lift_to_drag_spread:.3f}",
            ]
        lines.append(tuple(line))
    return Table("The nine kinematics, durations in cycles", tuple(header), tuple(lines))


def _draw(path: Path, found: Mapping[tuple[str, tuple[float, float]], Result]) -> None:
    with style.figure(7.6, 5.0) as drawing:
        lift, ratio = drawing.subplots(2, 1, sharex=True)
        _bars(lift, {job: r.cl for job, r in found.items()}, "$C_L$", LIFT)
        _bars(ratio, {job: r.lift_to_drag for job, r in found.items()}, "$L/D$", LIFT_TO_DRAG)
        ratio.set_xlabel("duration of sweep reversal / pitch flip [cycles]")
        lift.legend(loc="lower left", ncols=4, bbox_to_anchor=(0.0, 1.0), borderaxespad=0.2)
        style.save(drawing, path)


def _bars(
    axes: Axes, values: Mapping[tuple[str, tuple[float, float]], float], label: str, known: float
) -> None:
    pairs = list(dict.fromkeys(pair for _, pair in values))
    place = np.arange(len(pairs))
    for k, (name, colour) in enumerate(zip(MODELS, style.SERIES, strict=False)):
        heights = [values[name, pair] for pair in pairs]
        axes.bar(place + 0.27 * (k - 1), heights, 0.25, color=colour, label=name)
    axes.plot([place[-1] - 0.42, place[-1] + 0.42], [known] * 2, color=style.INK, label="measured")
    axes.set(ylabel=label, xticks=place, xticklabels=[f"{s:.2f}/{p:.2f}" for s, p in pairs])
    axes.grid(False, axis="x")
    axes.set_axisbelow(True)
