"""From a stroke to the motion that the servos are told: onto the limits, from rest, then exactly.

The stroke is projected onto the limits, which leaves a feasible one as it is; Ruckig leads from
rest onto it at the earliest instant; from there on the filter returns the stroke itself, so that
the rest is computed at once.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.limits import Limits, Mode, Projection, project, rig_limits
from flaprig.limits.limits import MOST_POSITION, Bound
from flaprig.rig import Axis, Rig
from flaprig.strokes.stroke import Motion, Stroke

Array = NDArray[np.float64]

# beyond a stop by no more than this [rad] is rounding of the projection
ROUNDING = 1e-8


class Own(Enum):
    """Limits that follow from what they belong to."""

    # of the rig's own servos, wing, fluid and joint stops
    RIG = "rig"


@dataclass(frozen=True, eq=False)
class SetPoints:
    """The motion that both servos are to make, step by step.

    Attributes:
        motion: at the beginning of each step and the end of the last. Arrays of shape (n + 1,).
        projection: how the stroke that is followed differs from the one asked for; None: no limits.
        joined_at: from when on the stroke is followed in [s]; 0 without limits.
    """

    motion: Motion
    projection: Projection | None = None
    joined_at: float = 0.0


def own_limits(rig: Rig, model: mujoco.MjModel) -> Limits:
    """What the rig's servos can do with its wing in its fluid, between the stops of its joints."""
    found = rig_limits(rig.motors, rig.wing, rig.fluid)
    return Limits(
        sweep=replace(found.sweep, position=stops(model, Axis.SWEEP)),
        pitch=replace(found.pitch, position=stops(model, Axis.PITCH)),
    )


def stops(model: mujoco.MjModel, axis: Axis) -> tuple[float, float]:
    """Lowest and highest angle of a joint in [rad]; two turns each way where it has no stops."""
    joint = model.joint(axis)
    if not joint.limited[0]:
        return -MOST_POSITION, MOST_POSITION
    low, high = joint.range
    return float(low), float(high)


def set_points(stroke: Stroke, limits: Limits | None, time_step: float, steps: int) -> SetPoints:
    """Set points of a run from rest.

    Args:
        stroke: what is asked for.
        limits: what the joints can do; None: the stroke as it is, from its first instant on.
        time_step: of the run in [s].
        steps: of the run.

    Raises:
        ValueError: limits that cannot be used; the sentence names them.
        RuntimeError: no way onto the stroke was found.
    """
    time: Array = np.arange(steps + 1, dtype=np.float64) * time_step
    if limits is None:
        return SetPoints(stroke.motion(time))
    projection = project(stroke, limits)
    motion = projection.stroke.motion(time)
    start, joined = _start(projection.stroke, limits, time_step, steps)
    columns = [
        np.concatenate([start[:, i], column[len(start) :]])
        for i, column in enumerate(_columns(motion))
    ]
    return SetPoints(Motion(time, *columns), projection, joined)


def check_stops(model: mujoco.MjModel, motion: Motion) -> None:
    """Refuse a motion that leaves the joints' stops.

    Raises:
        ValueError: names the joint and the angle.
    """
    for axis in Axis:
        (low, high), angle = stops(model, axis), getattr(motion, axis)
        worst = float(angle[np.argmax(np.maximum(low - angle, angle - high))])
        if not low - ROUNDING <= worst <= high + ROUNDING:
            allowed = (
                f"within the joint's range, {low:.4f} to {high:.4f} rad "
                f"({np.degrees(low):.0f} to {np.degrees(high):.0f} deg)"
            )
            raise check.fail("Twin.run", f"stroke's {axis}", allowed, round(worst, 4))


def _start(stroke: Stroke, limits: Limits, time_step: float, steps: int) -> tuple[Array, float]:
    """Set points from rest in the stroke's first posture until it is joined. Shape (k, 6)."""
    # ruckig takes a while to import
    from flaprig.limits import RuckigFilter

    first = stroke.motion(0.0)
    low, high = limits.ranges(Bound.POSITION).T
    sweep, pitch = np.clip([float(first.sweep), float(first.pitch)], low, high).tolist()
    control = RuckigFilter(limits, time_step, (sweep, pitch))
    joined = control.follow(stroke)
    states = [control.state]
    while control.mode is Mode.JOINING and len(states) <= steps:
        states.append(control.step())
    return np.array([(*s.position, *s.velocity, *s.acceleration) for s in states]), joined


def _columns(motion: Motion) -> tuple[Array, ...]:
    return (
        motion.sweep,
        motion.pitch,
        motion.sweep_rate,
        motion.pitch_rate,
        motion.sweep_acceleration,
        motion.pitch_acceleration,
    )
