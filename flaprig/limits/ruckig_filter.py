"""Set points for the servos within their limits, one for each control interval, made by Ruckig.

L. Berscheid & T. Kroeger, Jerk-limited Real-time Trajectory Generation with Arbitrary Target
States, Robotics: Science and Systems (2021). The only file that imports ruckig. Ruckig knows no
moving target: to get onto a stroke, the earliest instant is searched at which a motion of exactly
that duration meets the stroke's angle, rate and acceleration; from there on the stroke is followed
from interval to interval with `minimum_duration`. A stroke beyond the limits is refused: followed
naively it would swing out by more than its own amplitude.
"""

from __future__ import annotations

from math import ceil

import numpy as np
from ruckig import (
    ControlInterface,
    InputParameter,
    Result,
    Ruckig,
    RuckigError,
    Synchronization,
    Trajectory,
)

from flaprig import _checks as check
from flaprig.limits.intercept import earliest
from flaprig.limits.limits import Bound, Limits
from flaprig.limits.peaks import check_limits, violations
from flaprig.limits.reference import Mode, Reference, State
from flaprig.strokes.stroke import Stroke, check_stroke

# control interval [s]: of a servo bus at a usual rate, 1 kHz
INTERVAL = 1e-3
LEAST_INTERVAL, MOST_INTERVAL = 1e-5, 0.1
# Ruckig gets bounds wider by this share, so that a reference on a bound is not refused for rounding
WIDER = 5e-10
# a duration [s], an angle [rad] or a rate [rad/s] counts as met within this
MET = 1e-12
# rounding of an angle [rad]: over the interval squared, that of an acceleration
ROUNDING = 1e-15
# longest search, in cycles of the stroke and in times of a plain motion to its first posture
MOST_CYCLES, MOST_TRIPS = 2, 4


class RuckigFilter:
    """Both joints' set points, tick by tick.

    Attributes:
        limits: bounds that every set point keeps, and every instant between two of them.
        interval: between set points in [s].
        ticks: intervals since the beginning.
        state: the present set point.
        mode: what is going on.
        joins_at: when the present or last joining is or was complete in [s].
        replaced: ticks in which Ruckig missed the reference by rounding and the reference itself,
            which keeps the limits, was taken.
    """

    def __init__(
        self, limits: Limits, interval: float = INTERVAL, posture: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        """At rest.

        Args:
            limits: bounds of both joints.
            interval: between set points in [s], 1e-5 to 0.1.
            posture: sweep and pitch to begin at in [rad], inside the joints' range.

        Raises:
            ValueError: a bad argument; the sentence names it.
        """
        owner = "RuckigFilter"
        check_limits(owner, limits)
        self.limits = limits
        self._range = limits.ranges(Bound.POSITION).tolist()
        args = (owner, "interval", interval, LEAST_INTERVAL, MOST_INTERVAL, "s")
        self.interval = check.in_range(*args)
        angles = check.array(owner, "posture", posture, "rad", length=2)
        if not self._allowed(angles.tolist(), angles.tolist()):
            allowed = f"inside the range {limits.ranges(Bound.POSITION).tolist()} in rad"
            raise check.fail(owner, "posture", allowed, angles.tolist())
        self.state = State.at_rest((float(angles[0]), float(angles[1])))
        self.mode, self.ticks, self.joins_at, self.replaced = Mode.RESTING, 0, 0.0, 0
        self._ruckig = Ruckig(2, self.interval)
        self._input, self._brake = _inputs(limits)
        # the motion under way and the ticks at which it begins and ends
        self._motion: Trajectory | None = None
        self._began, self._ends = 0, 0
        self._reference: Reference | None = None
        # motion and begin of the interval just gone, for `within`
        self._gone: tuple[Trajectory | None, int] = (None, 0)
        self._accepted: list[Stroke] = []
        self._stop_asked = False

    @property
    def time(self) -> float:
        """Time since the beginning in [s]."""
        return self.ticks * self.interval

    def accept(self, stroke: Stroke) -> None:
        """Check a stroke ahead of time; `follow` then need not (some milliseconds).

        Raises:
            ValueError: not a stroke, or one beyond the limits; the sentence names the bound.
        """
        check_stroke("RuckigFilter", stroke)
        if any(stroke is known for known in self._accepted):
            return
        broken = violations(stroke, self.limits)
        if broken:
            found = "; ".join(map(str, broken))
            raise ValueError(
                f"RuckigFilter: stroke must be within the limits (project it first), got {found}"
            )
        self._accepted.append(stroke)

    def follow(self, stroke: Stroke, start: float = 0.0) -> float:
        """Get onto a stroke as early as the limits allow, from whatever is going on.

        Args:
            stroke: within the limits.
            start: when the stroke's time is zero, on the filter's clock, in [s].

        Returns:
            When the stroke is reached, on the filter's clock, in [s].

        Raises:
            ValueError: a stroke beyond the limits, or a bad start.
            RuntimeError: no way onto the stroke was found.
        """
        self.accept(stroke)
        start = check.finite("RuckigFilter.follow", "start", start, "s")
        reference = Reference(stroke, start, self.interval)
        length = self._earliest(reference)
        target = reference.at(self.ticks + length)
        self._begin(Mode.JOINING, self._to(target, length * self.interval), length)
        self._reference, self._stop_asked = reference, False
        self.joins_at = self._ends * self.interval
        return self.joins_at

    def stop(self) -> None:
        """Come to rest as early as the limits allow; where the brake would leave the joints' range
        it begins later.
        """
        if self.mode in (Mode.JOINING, Mode.FOLLOWING):
            self._stop_asked = True
            self._try_to_stop()

    def step(self) -> State:
        """The set point of the next tick."""
        self.ticks += 1
        if self.mode is Mode.FOLLOWING:
            self._follow()
        self._gone = self._motion, self._began
        if self.mode in (Mode.JOINING, Mode.STOPPING):
            self.state = self.within(1.0)
            if self.ticks >= self._ends:
                self._arrive()
        if self._stop_asked:
            self._try_to_stop()
        return self.state

    def within(self, share: float) -> State:
        """The motion inside the interval just gone, share 0 at its begin to 1 at its end."""
        time, (motion, began) = self.ticks - 1 + share, self._gone
        if motion is not None:
            return _state(motion, (time - began) * self.interval)
        if self._reference is not None:
            return self._reference.at_times(np.array([time * self.interval]))[0]
        return self.state

    def _begin(self, mode: Mode, motion: Trajectory | None, length: int) -> None:
        self.mode, self._motion = mode, motion
        self._began, self._ends = self.ticks, self.ticks + length

    def _follow(self) -> None:
        """One interval along the stroke."""
        assert self._reference is not None
        target = self._reference.at(self.ticks)
        motion = self._to(target, self.interval)
        self._motion, self._began = motion, self.ticks - 1
        if motion is not None:
            reached = _state(motion, self.interval)
            if self._met(reached, target):
                self.state = reached
                return
        # the reference keeps the limits by itself
        self._motion, self.state, self.replaced = None, target, self.replaced + 1

    def _arrive(self) -> None:
        if self.mode is Mode.STOPPING:
            self.mode, self._reference = Mode.RESTING, None
            self.state = State.at_rest(self.state.position)
        else:
            assert self._reference is not None
            self.mode, self.state = Mode.FOLLOWING, self._reference.at(self.ticks)

    def _try_to_stop(self) -> None:
        motion = self._calculate(self._brake)
        if motion is not None and self._keeps_range(motion):
            length = ceil(motion.duration / self.interval - MET)
            self._stop_asked = False
            self._begin(Mode.STOPPING, motion, length)

    def _earliest(self, reference: Reference) -> int:
        """Ticks until the earliest instant at which the stroke can be met, at least one."""
        longest = MOST_CYCLES * reference.stroke.period / self.interval
        trip = self._to(State.at_rest(reference.at(self.ticks).position), 0.0)
        if trip is not None:
            longest += MOST_TRIPS * trip.duration / self.interval
        found = earliest(reference, self.ticks, longest, self._meets)
        if found is None:
            raise RuntimeError(
                f"RuckigFilter.follow: no way onto the stroke within {longest * self.interval:.3g} "
                "s; its range or accelerations leave no room"
            )
        return found

    def _meets(self, target: State, length: int) -> bool:
        """Whether a state can be reached in exactly so many ticks, inside the range."""
        motion = self._to(target, length * self.interval)
        return (
            motion is not None
            and abs(motion.duration - length * self.interval) <= MET
            and self._met(_state(motion, motion.duration), target)
            and self._keeps_range(motion)
        )

    def _met(self, reached: State, target: State) -> bool:
        """Whether a state is another one but for rounding; Ruckig itself is content with 1e-8."""
        accelerations = zip(reached.acceleration, target.acceleration, strict=True)
        rates = zip(reached.velocity, target.velocity, strict=True)
        angles = zip(reached.position, target.position, strict=True)
        return (
            max(abs(a - b) for a, b in angles) <= MET
            and max(abs(a - b) for a, b in rates) <= MET
            and max(abs(a - b) for a, b in accelerations) <= MET + ROUNDING / self.interval**2
        )

    def _to(self, target: State, duration: float) -> Trajectory | None:
        """Motion from the present state to another in no less than a duration in [s]."""
        asked = self._input
        asked.target_position = target.position
        asked.target_velocity = target.velocity
        asked.target_acceleration = target.acceleration
        asked.minimum_duration = duration
        return self._calculate(asked)

    def _calculate(self, asked: InputParameter) -> Trajectory | None:
        asked.current_position = self.state.position
        asked.current_velocity = self.state.velocity
        asked.current_acceleration = self.state.acceleration
        motion = Trajectory(2)
        try:
            result = self._ruckig.calculate(asked, motion)
        except RuckigError:
            return None
        return motion if result in (Result.Working, Result.Finished) else None

    def _keeps_range(self, motion: Trajectory) -> bool:
        extrema = motion.position_extrema
        return self._allowed([e.min for e in extrema], [e.max for e in extrema])

    def _allowed(self, lowest: list[float], highest: list[float]) -> bool:
        """Whether angles are inside the joints' range."""
        return all(
            low - WIDER <= a and b <= high + WIDER
            for (low, high), a, b in zip(self._range, lowest, highest, strict=True)
        )


def _state(motion: Trajectory, time: float) -> State:
    position, velocity, acceleration = motion.at_time(time)
    return State(tuple(position), tuple(velocity), tuple(acceleration))


def _inputs(limits: Limits) -> tuple[InputParameter, InputParameter]:
    """What Ruckig is asked for: a way to a state, and a brake."""
    way, brake = InputParameter(2), InputParameter(2)
    for asked in (way, brake):
        bounds = [(limits.ranges(b)[:, 1] * (1.0 + WIDER)).tolist() for b in list(Bound)[1:]]
        asked.max_velocity, asked.max_acceleration, asked.max_jerk = bounds
    brake.control_interface = ControlInterface.Velocity
    # each joint as early as it can
    brake.synchronization = Synchronization.No
    brake.target_velocity = brake.target_acceleration = [0.0, 0.0]
    return way, brake
