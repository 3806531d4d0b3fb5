"""Motions of both joints from state to state within their limits, planned by Ruckig.

L. Berscheid & T. Kroeger, Jerk-limited Real-time Trajectory Generation with Arbitrary Target
States, Robotics: Science and Systems (2021). Three things are not left to Ruckig. The extremes of
the angles come from the motion's own cubic pieces, since `Trajectory.position_extrema` misses some
and reports an angle of 0 that a brake never visits. Limits far beyond what a motion of the given
duration can use are capped, since Ruckig loses its accuracy there. Whether a target is met is
judged to rounding, where Ruckig itself is content with 1e-8.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import copysign, sqrt
from typing import Any

from ruckig import (
    ControlInterface,
    InputParameter,
    Result,
    Ruckig,
    RuckigError,
    Synchronization,
    Trajectory,
)

from flaprig.limits.limits import Bound, Limits
from flaprig.limits.reference import Pair, State

# Ruckig gets bounds wider by this share, so that a reference on a bound is not refused for rounding
WIDER = 5e-10
# a duration [s], an angle [rad] or a rate [rad/s] counts as met within this
MET = 1e-12
# rounding of an angle [rad]: over the interval squared, that of an acceleration; and rounding of
# large numbers, as a share of them
ROUNDING, SHARE = 1e-15, 4e-15
# a cap is so many times what a smooth motion between two states in the given duration needs; the
# next one is tried where a motion misses its target by rounding or leaves the range. They depend on
# the states and the duration only: looser limits can therefore only add motions
REACHES = (1000.0, 100.0, 30.0, 10.0)


@dataclass(frozen=True, slots=True)
class PlannedMotion:
    """One motion of both joints.

    Attributes:
        joints: for each joint the plan that it takes its part from, sweep before pitch.
        duration: in [s].
    """

    joints: tuple[Trajectory, Trajectory]
    duration: float

    def state(self, time: float) -> State:
        """The state some time after the beginning, in [s]."""
        sweep, pitch = self.joints
        parts = sweep.at_time(time)
        if pitch is not sweep:
            others = pitch.at_time(time)
            return State(*((a[0], b[1]) for a, b in zip(parts, others, strict=True)))
        return State(*map(tuple, parts))


class Planner:
    """Motions within limits; every one of them keeps velocity, acceleration and jerk."""

    def __init__(self, limits: Limits, interval: float) -> None:
        self._range: list[list[float]] = limits.ranges(Bound.POSITION).tolist()
        self._bounds = [
            (limits.ranges(bound)[:, 1] * (1.0 + WIDER)).tolist()
            for bound in (Bound.VELOCITY, Bound.ACCELERATION, Bound.JERK)
        ]
        self._joint_bounds = tuple(zip(*self._bounds, strict=True))
        # largest rates of the motion last planned, by joint
        self._speeds = self._joint_bounds[0][0], self._joint_bounds[1][0]
        self._rounding = MET + ROUNDING / interval**2
        self._ruckig = Ruckig(2, interval)
        self._way, self._brake = InputParameter(2), InputParameter(2)
        self._brake.max_velocity, self._brake.max_acceleration, self._brake.max_jerk = self._bounds
        self._brake.control_interface = ControlInterface.Velocity
        # each joint as early as it can
        self._brake.synchronization = Synchronization.No
        self._brake.target_velocity = self._brake.target_acceleration = [0.0, 0.0]

    def brake(self, state: State) -> PlannedMotion | None:
        """The shortest way to rest, or None where it would leave the range."""
        motion = self._calculate(self._brake, state)
        if motion is None or not all(self._keeps_range(motion, joint) for joint in (0, 1)):
            return None
        return PlannedMotion((motion, motion), motion.duration)

    def exact(self, state: State, target: State, duration: float) -> PlannedMotion | None:
        """A motion of exactly a duration in [s] that meets a target inside the range, or None."""
        found: list[Trajectory | None] = [None, None]
        for reach in REACHES:
            motion = self.at_least(state, target, duration, reach)
            if motion is None:
                continue
            if motion.duration > duration + MET:
                break
            end = motion.at_time(duration)
            for joint in (0, 1):
                if found[joint] is None and self._met(end, target, joint):
                    # most ticks along a stroke are too short to reach an end of the range
                    angle, way = state.position[joint], self._speeds[joint] * duration
                    near = self._allowed(joint, angle - way, angle + way)
                    found[joint] = motion if near or self._keeps_range(motion, joint) else None
            sweep, pitch = found
            if sweep is not None and pitch is not None:
                return PlannedMotion((sweep, pitch), duration)
        return None

    def at_least(
        self, state: State, target: State, duration: float, reach: float = REACHES[0]
    ) -> Trajectory | None:
        """The shortest motion to a target, of no less than a duration in [s]."""
        asked = self._way
        asked.target_position = target.position
        asked.target_velocity = target.velocity
        asked.target_acceleration = target.acceleration
        asked.minimum_duration = duration
        sweep = self._capped(state, target, duration, reach, 0)
        pitch = self._capped(state, target, duration, reach, 1)
        self._speeds = sweep[0], pitch[0]
        asked.max_velocity = self._speeds
        asked.max_acceleration = sweep[1], pitch[1]
        asked.max_jerk = sweep[2], pitch[2]
        return self._calculate(asked, state)

    def inside(self, posture: Pair) -> bool:
        """Whether both angles in [rad] are inside the joints' range."""
        return all(self._allowed(joint, angle, angle) for joint, angle in enumerate(posture))

    def longest_trip(self, state: State, posture: Pair) -> float:
        """More than the shortest way to rest in a posture takes, in [s].

        A quintic polynomial from rest to rest over D in T peaks at 15/8 D/T, 10/sqrt(3) D/T^2 and
        60 D/T^3; a brake comes before it.
        """
        trips = [0.0]
        for joint, (speed, acceleration, jerk) in enumerate(self._joint_bounds):
            way = abs(posture[joint] - state.position[joint])
            rate, push = abs(state.velocity[joint]), abs(state.acceleration[joint])
            brake = 2.0 * (rate / acceleration + push / jerk + sqrt(rate / jerk))
            way += rate * brake
            trip = max(
                1.875 * way / speed,
                sqrt(10.0 / sqrt(3.0) * way / acceleration),
                (60.0 * way / jerk) ** (1.0 / 3.0),
            )
            trips.append(trip + brake)
        return max(trips)

    def _capped(
        self, state: State, target: State, duration: float, reach: float, joint: int
    ) -> tuple[float, float, float]:
        """Bounds on velocity, acceleration and jerk of one joint, no wider than can be used."""
        speed, acceleration, jerk = self._joint_bounds[joint]
        way = abs(target.position[joint] - state.position[joint])
        rate = abs(state.velocity[joint]) + abs(target.velocity[joint])
        push = abs(state.acceleration[joint]) + abs(target.acceleration[joint])
        need = reach * ((way / duration + rate) / duration + push)
        # a motion that needs nothing at all still wants bounds above zero
        if need == 0.0:
            return speed, acceleration, jerk
        return (
            min(speed, need * duration),
            min(acceleration, need),
            min(jerk, need / duration),
        )

    def _calculate(self, asked: InputParameter, state: State) -> Trajectory | None:
        asked.current_position = state.position
        asked.current_velocity = state.velocity
        asked.current_acceleration = state.acceleration
        motion = Trajectory(2)
        try:
            result = self._ruckig.calculate(asked, motion)
        except RuckigError:
            return None
        return motion if result in (Result.Working, Result.Finished) else None

    def _met(self, reached: Any, target: State, joint: int) -> bool:
        rate, push = target.velocity[joint], target.acceleration[joint]
        return bool(
            abs(reached[0][joint] - target.position[joint]) <= MET
            and abs(reached[1][joint] - rate) <= MET + SHARE * abs(rate)
            and abs(reached[2][joint] - push) <= self._rounding + SHARE * abs(push)
        )

    def _keeps_range(self, motion: Trajectory, joint: int) -> bool:
        angles = list(_extremes(motion.profiles[0][joint]))
        angles.append(motion.at_time(motion.duration)[0][joint])
        return self._allowed(joint, min(angles), max(angles))

    def _allowed(self, joint: int, lowest: float, highest: float) -> bool:
        """Whether angles are inside the joint's range."""
        low, high = self._range[joint]
        return low - WIDER <= lowest and highest <= high + WIDER


def _extremes(profile: Any) -> Iterator[float]:
    """Angles in [rad] at the ends of a plan's pieces and where a rate is zero inside one."""
    for part in (profile.brake, profile, profile.accel):
        for length, j, a, v, p in zip(part.t, part.j, part.a, part.v, part.p, strict=False):
            if length <= 0.0:
                continue
            yield p
            for time in _roots(0.5 * j, a, v):
                if 0.0 < time < length:
                    yield p + time * (v + time * (a / 2.0 + time * j / 6.0))


def _roots(square: float, linear: float, constant: float) -> Iterator[float]:
    """Real zeros of a polynomial of degree two; none where it is constant."""
    rest = linear * linear - 4.0 * square * constant
    if rest < 0.0:
        return
    # without the difference of nearly equal numbers
    sum_ = -0.5 * (linear + copysign(sqrt(rest), linear))
    if square != 0.0:
        yield sum_ / square
    if sum_ != 0.0:
        yield constant / sum_
