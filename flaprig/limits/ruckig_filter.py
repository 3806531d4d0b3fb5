"""Set points for the servos within their limits, one for each control interval.

Ruckig knows no moving target: to get onto a stroke, the earliest instant is searched at which a
motion of exactly that duration meets the stroke's angle, rate and acceleration; from there on the
stroke is followed from interval to interval. A stroke beyond the limits is refused: followed
naively it would swing out by more than its own amplitude. The motions themselves are in
`ruckig_motion.py`.
"""

from __future__ import annotations

from math import ceil

import numpy as np

from flaprig import _checks as check
from flaprig.limits.intercept import STRIDES, earliest
from flaprig.limits.limits import Bound, Limits
from flaprig.limits.peaks import check_limits, violations
from flaprig.limits.reference import Mode, Reference, State
from flaprig.limits.ruckig_motion import MET, PlannedMotion, Planner
from flaprig.strokes.stroke import Stroke, check_stroke

# control interval [s]: of a servo bus at a usual rate, 1 kHz
INTERVAL = 1e-3
LEAST_INTERVAL, MOST_INTERVAL = 1e-5, 0.1
# longest search, in cycles of the stroke, in times of a plain motion to its first posture, and in
# intervals
MOST_CYCLES, MOST_TRIPS, MOST_TICKS = 2, 4, 5_000_000


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
        args = (owner, "interval", interval, LEAST_INTERVAL, MOST_INTERVAL, "s")
        self.interval = check.in_range(*args)
        angles = check.array(owner, "posture", posture, "rad", length=2)
        self._planner = Planner(limits, self.interval)
        if not self._planner.inside((float(angles[0]), float(angles[1]))):
            allowed = f"inside the range {limits.ranges(Bound.POSITION).tolist()} in rad"
            raise check.fail(owner, "posture", allowed, angles.tolist())
        self.state = State.at_rest((float(angles[0]), float(angles[1])))
        self.mode, self.ticks, self.joins_at, self.replaced = Mode.RESTING, 0, 0.0, 0
        # the motion under way and the ticks at which it begins and ends
        self._motion: PlannedMotion | None = None
        self._began, self._ends = 0, 0
        self._reference: Reference | None = None
        # motion and begin of the interval just gone, for `within`
        self._gone: tuple[PlannedMotion | None, int] = (None, 0)
        self._accepted: list[Stroke] = []
        # the last tick at which a stop that was asked for begins; None: none was
        self._stop_by: int | None = None

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
        motion = self._planner.exact(self.state, target, length * self.interval)
        self._begin(Mode.JOINING, motion, length)
        self._reference, self._stop_by = reference, None
        self.joins_at = self._ends * self.interval
        return self.joins_at

    def stop(self) -> None:
        """Come to rest as early as the limits allow.

        Where the brake would leave the joints' range it begins later, within a cycle.

        Raises:
            RuntimeError: it would leave the range all over the cycle; the stroke goes on.
        """
        if self.mode in (Mode.JOINING, Mode.FOLLOWING):
            self._stop_by = self.ticks
            if not self._brakes():
                self._stop_by = self._last_chance()

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
        if self._stop_by is not None and not self._brakes() and self.ticks >= self._stop_by:
            raise self._no_stop()
        return self.state

    def within(self, share: float) -> State:
        """The motion inside the interval just gone, share 0 at its begin to 1 at its end."""
        time, (motion, began) = self.ticks - 1 + share, self._gone
        if motion is not None:
            return motion.state((time - began) * self.interval)
        if self._reference is not None:
            return self._reference.at_times(np.array([time * self.interval]))[0]
        return self.state

    def _begin(self, mode: Mode, motion: PlannedMotion | None, length: int) -> None:
        self.mode, self._motion = mode, motion
        self._began, self._ends = self.ticks, self.ticks + length

    def _follow(self) -> None:
        """One interval along the stroke."""
        assert self._reference is not None
        target = self._reference.at(self.ticks)
        self._motion = self._planner.exact(self.state, target, self.interval)
        self._began = self.ticks - 1
        # the reference keeps the limits by itself
        self.replaced += self._motion is None
        self.state = target

    def _arrive(self) -> None:
        if self.mode is Mode.STOPPING:
            self.mode, self._reference = Mode.RESTING, None
            self.state = State.at_rest(self.state.position)
        else:
            assert self._reference is not None
            self.mode, self.state = Mode.FOLLOWING, self._reference.at(self.ticks)

    def _brakes(self) -> bool:
        """Begin to brake where that keeps the range."""
        motion = self._planner.brake(self.state)
        if motion is not None:
            self._stop_by = None
            self._begin(Mode.STOPPING, motion, ceil(motion.duration / self.interval - MET))
        return motion is not None

    def _last_chance(self) -> int:
        """A tick ahead from which the brake keeps the range."""
        assert self._reference is not None
        cycle = self._reference.stroke.period / self.interval
        joined = self._ends if self.mode is Mode.JOINING else self.ticks
        ahead = joined + np.unique(np.linspace(0.0, cycle, STRIDES + 1).astype(np.int64))
        for tick, state in zip(ahead.tolist(), self._reference.states(ahead), strict=True):
            if self._planner.brake(state) is not None:
                return int(tick)
        raise self._no_stop()

    def _no_stop(self) -> RuntimeError:
        self._stop_by = None
        return RuntimeError(
            "RuckigFilter.stop: nowhere in a whole cycle can both joints come to rest inside their "
            "range; a wider range, or more acceleration and jerk, leaves room for the brake"
        )

    def _earliest(self, reference: Reference) -> int:
        """Ticks until the earliest instant at which the stroke can be met, at least one."""
        posture = reference.at(self.ticks).position
        trip = self._planner.longest_trip(self.state, posture)
        longest = (MOST_CYCLES * reference.stroke.period + MOST_TRIPS * trip) / self.interval
        longest = min(longest, MOST_TICKS)
        found = earliest(reference, self.ticks, longest, self._meets)
        if found is None:
            raise RuntimeError(
                f"RuckigFilter.follow: no way onto the stroke within {longest * self.interval:.3g} "
                "s; its range or accelerations leave no room"
            )
        return found

    def _meets(self, target: State, length: int) -> bool:
        """Whether a state can be reached in exactly so many ticks, inside the range."""
        return self._planner.exact(self.state, target, length * self.interval) is not None
