"""Can the rig do this stroke, by what margin, and what is the nearest thing that it can do?

The stroke runs in the digital twin, within the limits and through Ruckig; what it needs of every
limit is set against what the limit allows. A stroke beyond the limits is judged by what it would
need if it were made exactly (inverse dynamics); what the nearest stroke needs is told beside that.
The cost of limits and tracking is the difference from the same stroke made exactly, in the same
model of the fluid.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.files import plain, written_whole
from flaprig.limits import Limits, Projection, project
from flaprig.limits.peaks import check_limits
from flaprig.motion_verdicts import motion_verdicts
from flaprig.nearest_run import nearest_run
from flaprig.rig import Axis, Rig
from flaprig.servo_verdicts import Work, servo_verdicts
from flaprig.servo_work import asked_work, servo_work
from flaprig.set_points import own_limits
from flaprig.strokes.stroke import Stroke, check_stroke
from flaprig.twin import TIME_STEP, Twin, TwinRun
from flaprig.verdict import Tolerances, Verdict, beside, narrowest

__all__ = ["FeasibilityReport", "Tolerances", "Verdict", "check_feasibility"]

# share of the whole time that the twin takes, the rest is the exact motion's
_TWIN_SHARE = 0.7
# smallest lift over drag that changes are shares of: a stroke without lift has no percent of it
_LEAST_LIFT = 0.1
# first line of a saved report
HEADER = "joint,quantity,unit,value,bound,margin,holds,nearest"


@dataclass(frozen=True, eq=False)
class FeasibilityReport:
    """Verdicts on a stroke, and the runs that they come from.

    Attributes:
        rig: the rig.
        stroke: the one asked for.
        limits: of the rig's joints.
        projection: the nearest stroke within the limits; the one asked for where that is within.
        run: of the twin.
        prescribed: loads of the stroke asked for when it is made exactly.
        verdicts: on every limit; those with no bound only tell a number.
        asked_work: what the servos would do on the stroke asked for, by joint; empty where the
            twin makes it.
    """

    rig: Rig
    stroke: Stroke
    limits: Limits
    projection: Projection
    run: TwinRun
    prescribed: Result
    verdicts: tuple[Verdict, ...]
    asked_work: dict[str, Work] = field(default_factory=dict)

    @property
    def notices(self) -> tuple[str, ...]:
        """What was changed of the stroke, and what is doubtful; sentences."""
        found = [*self.run.notices, *self.prescribed.notices]
        if self.asked_work:
            found.append(
                "the rig cannot make this stroke: the values judged are what it would need as "
                "asked (inverse dynamics); the nearest stroke's stand beside them"
            )
        return tuple(dict.fromkeys(found))

    @property
    def feasible(self) -> bool:
        """Whether every limit is kept."""
        return all(verdict.holds for verdict in self.verdicts)

    @property
    def broken(self) -> tuple[Verdict, ...]:
        """Verdicts on the limits that are not kept."""
        return tuple(verdict for verdict in self.verdicts if not verdict.holds)

    @property
    def worst(self) -> Verdict:
        """The judged verdict with the smallest margin."""
        return narrowest(self.verdicts)

    def verdict(self, key: str) -> Verdict:
        """The verdict of a key, for instance sweep_peak_torque_Nm.

        Raises:
            KeyError: there is none; names all.
        """
        found = {verdict.key: verdict for verdict in self.verdicts}
        if key not in found:
            raise KeyError(f"no verdict {key}; there are {', '.join(found)}")
        return found[key]

    def feasible_joint(self, joint: str) -> bool:
        """Whether every limit of one joint is kept."""
        return all(v.holds for v in self.verdicts if v.joint == Axis(joint).value)

    def work(self, joint: str) -> Work:
        """What the servo of a joint did in the averaged cycles."""
        return servo_work(self.run, self.stroke, Axis(joint))

    def summary(self) -> dict[str, Any]:
        """The whole verdict, coefficients, and every verdict by its key with unit.

        What is not finite is None, as JSON has it: the spread of one cycle, an endless margin.
        """
        summary = {
            "feasible": self.feasible,
            "broken": [verdict.key for verdict in self.broken],
            "worst": self.worst.key,
            "worst_margin": self.worst.margin,
            "cl": self.run.result.cl,
            "cl_spread": self.run.result.cl_spread,
            "lift_to_drag": self.run.result.lift_to_drag,
            "lift_to_drag_spread": self.run.result.lift_to_drag_spread,
            "prescribed_cl": self.prescribed.cl,
            "prescribed_lift_to_drag": self.prescribed.lift_to_drag,
            "nearest_stroke_rms_rad": self.projection.distance_rms,
            "flown_sweep_amplitude_rad": self.run.flown_amplitude(Axis.SWEEP),
            "flown_pitch_amplitude_rad": self.run.flown_amplitude(Axis.PITCH),
            "verdicts": {verdict.key: verdict.summary() for verdict in self.verdicts},
            "notices": list(self.notices),
        }
        return {key: plain(value) for key, value in summary.items()}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the verdicts as CSV, whole or not at all.

        Raises:
            ValueError: an ending other than .csv.
            OSError: the folder does not exist or cannot be written.
        """
        if os.path.splitext(path)[1] != ".csv":
            raise check.fail("FeasibilityReport.save", "path", "one that ends in .csv", str(path))
        rows = [HEADER, *map(_row, self.verdicts)]
        with written_whole(path) as draft:
            draft.write_text("\n".join(rows) + "\n", encoding="utf-8")


def check_feasibility(
    rig: Rig,
    stroke: Stroke,
    cycles: int = 3,
    limits: Limits | None = None,
    tolerances: Tolerances | None = None,
    time_step: float = TIME_STEP,
    feedforward: bool = True,
    progress: Progress | None = None,
) -> FeasibilityReport:
    """Judge a stroke on a rig.

    Args:
        rig: the rig with its wing, fluid, servos and model of the fluid.
        stroke: what is asked for.
        cycles: of the twin and of the exact motion, 2 to 1000; verdicts are on the averaged ones,
            of three cycles the third. The start from rest is in the first; where it takes longer
            the twin runs on.
        limits: of the joints; None: the rig's own, from its servos, wing, fluid and stops.
        tolerances: how far the rig may be from the stroke; None: Tolerances().
        time_step: of MuJoCo in [s].
        feedforward: whether the servos are told the torque that the motion needs.
        progress: called with the fraction done.

    Raises:
        ValueError: a bad argument; the sentence names it.
        FloatingPointError: MuJoCo or the wake gave up.
        ImportError: the plugin library is missing or does not fit MuJoCo.
    """
    owner = "check_feasibility"
    check_stroke(owner, stroke)
    check.callback(owner, "progress", progress)
    twin = Twin(rig, time_step, feedforward)
    cycles = check.whole(owner, "cycles", cycles, 2, 1000)
    tolerances = Tolerances() if tolerances is None else tolerances
    if not isinstance(tolerances, Tolerances):
        raise check.fail(owner, "tolerances", "a Tolerances", tolerances)
    limits = own_limits(rig, rig.spec().compile()) if limits is None else limits
    check_limits(owner, limits)
    projection = project(stroke, limits)
    run = nearest_run(
        replace(twin, limits=limits), stroke, projection, cycles, _part(progress, 0.0)
    )
    prescribed = _as_prescribed(rig, stroke, cycles, _part(progress, _TWIN_SHARE))
    # a stroke that the twin does not make is judged by what it would need
    made = projection.distance_max <= tolerances.resolution
    asked = {} if made else asked_work(rig, stroke, prescribed, run)
    judged = FeasibilityReport(rig, stroke, limits, projection, run, prescribed, (), asked)
    return replace(judged, verdicts=_verdicts(judged, tolerances))


def _verdicts(runs: FeasibilityReport, tolerances: Tolerances) -> tuple[Verdict, ...]:
    """Verdicts on the runs of a report, joint by joint, the whole rig last."""
    found = motion_verdicts(runs.stroke, runs.projection, runs.limits, tolerances)
    found += _servo_verdicts(runs, tolerances)
    found += _cost(runs.run.result, runs.prescribed, tolerances)
    return tuple(sorted(found, key=lambda verdict: [*Axis, ""].index(verdict.joint)))


def _as_prescribed(rig: Rig, stroke: Stroke, cycles: int, progress: Progress | None) -> Result:
    """Loads of the stroke when it is made exactly."""
    case = (rig.wing, stroke, rig.model, rig.fluid, cycles)
    return simulate(*case, progress=progress, buoyancy=rig.buoyancy)


def _servo_verdicts(runs: FeasibilityReport, tolerances: Tolerances) -> list[Verdict]:
    """Verdicts on both servos: on what they did, or on what they would have to do as asked."""
    verdicts: list[Verdict] = []
    for axis in Axis:
        motor, allowed = getattr(runs.rig.motors, axis), getattr(runs.limits, axis)
        work = runs.work(axis)
        found = servo_verdicts(axis.value, motor, allowed, work, tolerances)
        if runs.asked_work:
            work = runs.asked_work[axis.value]
            as_asked = servo_verdicts(axis.value, motor, allowed, work, tolerances)
            found = beside(as_asked, found)
        verdicts += found
    return verdicts


def _cost(reached: Result, exact: Result, tolerances: Tolerances) -> list[Verdict]:
    """Change of C_L and L/D, signed, as a share of the exact motion's."""
    least = {"cl": _LEAST_LIFT * abs(exact.cd), "lift_to_drag": _LEAST_LIFT}
    found = []
    for name, size in least.items():
        wanted = getattr(exact, name)
        change = (getattr(reached, name) - wanted) / max(abs(wanted), size)
        bound = float(np.copysign(tolerances.coefficients, change))
        found.append(Verdict("", f"{name}_change", float(change), bound, ""))
    return found


def _part(progress: Progress | None, done: float) -> Progress | None:
    """Progress of the first or the second run as progress of both."""
    if progress is None:
        return None
    share = 1.0 - _TWIN_SHARE if done else _TWIN_SHARE
    return lambda fraction: progress(done + share * fraction)


def _row(verdict: Verdict) -> str:
    numbers = (
        "" if value is None else f"{value:.10g}"
        for value in (verdict.value, verdict.bound, verdict.margin)
    )
    nearest = "" if verdict.nearest is None else f"{verdict.nearest:.10g}"
    holds = str(verdict.holds).lower()
    words = (verdict.joint, verdict.name, verdict.unit, *numbers, holds, nearest)
    return ",".join(words)
