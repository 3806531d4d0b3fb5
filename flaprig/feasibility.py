"""Can the rig do this stroke, by what margin, and what is the nearest thing that it can do?

The stroke runs in the digital twin, within the limits and through Ruckig; what it needs of every
limit is set against what the limit allows. A stroke beyond the limits is judged by what it would
need if it were made exactly (inverse dynamics); what the nearest stroke needs is told beside that.
The cost of limits and tracking is the difference from the same stroke made exactly, in the same
model of the fluid.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.result import Result
from flaprig.aero.simulate import reference_force, simulate
from flaprig.as_asked import asked_torques
from flaprig.files import plain, written_whole
from flaprig.limits import Limits, Projection, project
from flaprig.limits.peaks import check_limits
from flaprig.motion_verdicts import motion_verdicts
from flaprig.rig import Axis, Rig
from flaprig.servo_verdicts import Work, servo_verdicts
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
    run = _run(replace(twin, limits=limits), stroke, projection, cycles, _part(progress, 0.0))
    case = (rig.wing, stroke, rig.model, rig.fluid, cycles)
    told = _part(progress, _TWIN_SHARE)
    prescribed = simulate(*case, progress=told, buoyancy=rig.buoyancy)
    verdicts = motion_verdicts(stroke, projection, limits, tolerances)
    # a stroke that the twin does not make is judged by what it would need
    made = projection.distance_max <= tolerances.resolution
    asked = {} if made else _asked_work(rig, stroke, prescribed, run)
    verdicts += _servo_verdicts(rig, stroke, limits, run, tolerances, asked)
    verdicts += _cost(run.result, prescribed, tolerances)
    # joint by joint, the whole rig last
    verdicts.sort(key=lambda verdict: [*Axis, ""].index(verdict.joint))
    return FeasibilityReport(
        rig, stroke, limits, projection, run, prescribed, tuple(verdicts), asked
    )


def _servo_verdicts(
    rig: Rig,
    stroke: Stroke,
    limits: Limits,
    run: TwinRun,
    tolerances: Tolerances,
    asked: dict[str, Work],
) -> list[Verdict]:
    """Verdicts on both servos: on what they did, or on what they would have to do as asked."""
    verdicts: list[Verdict] = []
    for axis in Axis:
        motor, allowed = getattr(rig.motors, axis), getattr(limits, axis)
        work = servo_work(run, stroke, axis)
        found = servo_verdicts(axis.value, motor, allowed, work, tolerances)
        if asked:
            as_asked = servo_verdicts(axis.value, motor, allowed, asked[axis.value], tolerances)
            found = beside(as_asked, found)
        verdicts += found
    return verdicts


def servo_work(run: TwinRun, stroke: Stroke, axis: Axis) -> Work:
    """What one servo did in the averaged cycles; the error is against the stroke asked for."""
    motors, histories, part = run.motors, run.result.histories, run.result.averaged
    speed = part(getattr(histories, f"{axis}_rate"))
    asked = getattr(stroke.motion(part(histories.time)), axis)
    return Work(
        torque=part(getattr(motors, f"{axis}_motor_torque")),
        demand=part(getattr(motors, f"{axis}_demand")),
        # mean of each step; the last one of a cycle leads into the first again
        speed=0.5 * (speed + np.roll(speed, -1)),
        error=part(getattr(motors, axis)) - asked,
    )


def _asked_work(rig: Rig, stroke: Stroke, prescribed: Result, run: TwinRun) -> dict[str, Work]:
    """What both servos would do on the stroke itself; the errors are the twin's own."""
    torque = asked_torques(rig, stroke, prescribed)
    motion = stroke.motion(prescribed.averaged(prescribed.time))
    return {
        axis.value: Work(
            torque=torque[:, i],
            demand=torque[:, i],
            speed=getattr(motion, f"{axis}_rate"),
            error=servo_work(run, stroke, axis).error,
        )
        for i, axis in enumerate(Axis)
    }


def _run(
    twin: Twin, stroke: Stroke, projection: Projection, cycles: int, progress: Progress | None
) -> TwinRun:
    """The twin on the stroke, or on the nearest one within its limits."""
    try:
        run = twin.run(stroke, cycles, progress)
        started = math.ceil(run.joined_at * stroke.frequency)
        if started >= run.result.averaged_cycles[0]:
            # means are over the last three at most
            run = twin.run(stroke, started + 3, progress)
        return run
    except RuntimeError:
        # no start from rest leads onto a stroke without room: begin at full rate
        run = replace(twin, limits=None).run(projection.stroke, cycles, progress)
    force = reference_force(twin.rig.wing, stroke, twin.rig.fluid)
    result = replace(run.result, reference_force=force, notices=()).doubted(stroke)
    return replace(run, result=result, projection=projection, asked=stroke)


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
