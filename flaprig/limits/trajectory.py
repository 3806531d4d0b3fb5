"""A stroke as the servos are to be told it: set points from rest to rest, within the limits."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from flaprig import _checks as check
from flaprig.files import write_table
from flaprig.limits.limits import JOINTS, Bound, Limits
from flaprig.limits.peaks import check_limits
from flaprig.limits.projection import Projection, project
from flaprig.limits.reference import Mode, State
from flaprig.limits.ruckig_filter import INTERVAL, RuckigFilter
from flaprig.strokes.stroke import Motion, Stroke, check_stroke

Array = NDArray[np.float64]

# most cycles of one trajectory, and most set points before the brake and of the brake
MOST_CYCLES, MOST_TICKS = 1000, 5_000_000
# unit of each derivative in the names of columns
UNITS = {"": "rad", "_rate": "rad_per_s", "_acceleration": "rad_per_s2"}


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Set points at equal intervals, beginning and ending at rest.

    Attributes:
        motion: angles, rates and accelerations of the set points; its time is the controller's
            clock, on which the stroke's time zero is 0. Arrays of shape (n,).
        interval: between set points in [s].
        stroke: what is followed, within the limits.
        projection: how it differs from the stroke that was wanted.
        joined_at: from when the stroke is followed in [s].
        left_at: until when it is followed in [s].
    """

    motion: Motion
    interval: float
    stroke: Stroke
    projection: Projection
    joined_at: float
    left_at: float

    @property
    def notices(self) -> tuple[str, ...]:
        """What was changed of the stroke that was wanted; sentences."""
        return self.projection.notices

    @property
    def following(self) -> NDArray[np.bool_]:
        """Set points at which the stroke is followed, and not joined or left. Shape (n,)."""
        time, room = self.motion.time, 0.5 * self.interval
        return np.asarray((time > self.joined_at - room) & (time < self.left_at + room))

    def columns(self, torque: ArrayLike | None = None) -> dict[str, Array]:
        """Arrays by name with unit: time_s, sweep_rad, ..., sweep_torque_Nm when it is given.

        `following` is 1 where the stroke is followed and 0 during start and stop.

        Args:
            torque: of the sweep and the pitch servo at the set points in [N m]. Shape (n, 2).

        Raises:
            ValueError: torques that are not finite or of another shape.
        """
        table = {"time_s": self.motion.time}
        for ending, unit in UNITS.items():
            for joint in JOINTS:
                table[f"{joint}{ending}_{unit}"] = getattr(self.motion, joint + ending)
        table["following"] = self.following.astype(np.float64)
        if torque is not None:
            values = _checked_torque(torque, self.motion.time.size)
            table |= {f"{joint}_torque_Nm": values[:, i] for i, joint in enumerate(JOINTS)}
        return table

    def save(self, path: str | os.PathLike[str], torque: ArrayLike | None = None) -> None:
        """Write the columns, CSV or NPZ by the path's ending, whole or not at all.

        Raises:
            ValueError: another ending, or bad torques.
            OSError: the folder does not exist or cannot be written.
        """
        summary = {
            "interval_s": self.interval,
            "frequency_Hz": self.stroke.frequency,
            "joined_at_s": self.joined_at,
            "left_at_s": self.left_at,
            "projection_rms_rad": self.projection.distance_rms,
            "notices": list(self.notices),
        }
        write_table("Trajectory.save", path, self.columns(torque), summary)


def filtered(
    stroke: Stroke,
    limits: Limits,
    cycles: int = 3,
    interval: float = INTERVAL,
    posture: tuple[float, float] | None = None,
    keep_amplitude: bool = False,
) -> Trajectory:
    """Project a stroke onto the limits, start from rest, follow it for some cycles and stop.

    Args:
        stroke: what is wanted.
        limits: what both joints can do.
        cycles: that are followed after the start, 1 to 1000.
        interval: between set points in [s].
        posture: sweep and pitch to begin at in [rad]; None: the stroke's first.
        keep_amplitude: passed on to `project`.

    Raises:
        ValueError: a bad argument; the sentence names it.
        RuntimeError: no way onto the stroke was found or it is too long, or the brake would leave
            the joints' range wherever it begins.
    """
    owner = "filtered"
    check_stroke(owner, stroke)
    check_limits(owner, limits)
    cycles = check.whole(owner, "cycles", cycles, 1, MOST_CYCLES)
    projection = project(stroke, limits, keep_amplitude)
    followed = projection.stroke
    if posture is None:
        first = followed.motion(0.0)
        low, high = limits.ranges(Bound.POSITION).T
        posture = tuple(np.clip([float(first.sweep), float(first.pitch)], low, high).tolist())
    control = RuckigFilter(limits, interval, posture)
    if (cycles + 4) * followed.period / control.interval > MOST_TICKS:
        allowed = f"long enough for at most {MOST_TICKS} set points"
        raise check.fail(owner, "interval", allowed, interval)
    states, joined, left = _played(control, followed, cycles)
    return Trajectory(
        _motion(states, control.interval), control.interval, followed, projection, joined, left
    )


def _played(control: RuckigFilter, stroke: Stroke, cycles: int) -> tuple[list[State], float, float]:
    """Every set point, and when the stroke is joined and left."""
    states = [control.state]
    joined = control.follow(stroke)
    until = control.ticks + round((joined + cycles * stroke.period) / control.interval)
    if until > MOST_TICKS:
        raise RuntimeError(
            f"filtered: the stroke is joined after {joined:.4g} s, and following it ends after "
            f"{until} set points, more than {MOST_TICKS}; a longer interval or looser limits help"
        )
    while control.ticks < until:
        states.append(control.step())

    control.stop()
    # the joints' range may delay the brake, which the filter bounds by a cycle
    left = control.time
    while control.mode is not Mode.RESTING:
        if len(states) > 2 * MOST_TICKS:
            raise RuntimeError(
                f"filtered: the brake takes more than {MOST_TICKS} set points; a longer interval "
                "or looser limits help"
            )
        left = control.time if control.mode is Mode.FOLLOWING else left
        states.append(control.step())
    return states, joined, left


def _motion(states: list[State], interval: float) -> Motion:
    table = np.array([(*s.position, *s.velocity, *s.acceleration) for s in states])
    time = np.arange(len(states), dtype=np.float64) * interval
    return Motion(time, *np.ascontiguousarray(table.T))


def _checked_torque(torque: ArrayLike, count: int) -> Array:
    values = np.asarray(torque, dtype=np.float64)
    if values.shape != (count, 2) or not np.isfinite(values).all():
        allowed = f"finite numbers in N m of shape ({count}, 2)"
        raise check.fail("Trajectory", "torque", allowed, values.shape)
    return values
