"""A stroke on the clock of a controller: its states at whole numbers of control intervals."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from flaprig.strokes.stroke import Stroke

Pair = tuple[float, float]

# ticks computed at once: one call of a stroke costs as much as some hundred instants
BLOCK = 512


class Mode(StrEnum):
    """What a controller is doing."""

    RESTING = "resting"
    # on the way to a stroke
    JOINING = "joining"
    FOLLOWING = "following"
    STOPPING = "stopping"


@dataclass(frozen=True, slots=True)
class State:
    """Set point of both joints, in the order sweep, pitch.

    Attributes:
        position: angles in [rad].
        velocity: rates in [rad/s].
        acceleration: in [rad/s2].
    """

    position: Pair
    velocity: Pair
    acceleration: Pair

    @classmethod
    def at_rest(cls, position: Pair) -> State:
        """Standing at two angles in [rad]."""
        return cls((position[0], position[1]), (0.0, 0.0), (0.0, 0.0))


class Reference:
    """States of a stroke whose time zero is `start` on the controller's clock, both in [s]."""

    def __init__(self, stroke: Stroke, start: float, interval: float) -> None:
        self.stroke, self.start, self.interval = stroke, start, interval
        self._first, self._block = 0, list[State]()

    def at(self, tick: int) -> State:
        """State at one tick; neighbours are kept for later."""
        if not self._first <= tick < self._first + len(self._block):
            self._first, self._block = tick, self.states(np.arange(tick, tick + BLOCK))
        return self._block[tick - self._first]

    def states(self, ticks: NDArray[np.int64]) -> list[State]:
        """States at any ticks."""
        return self.at_times(np.asarray(ticks * self.interval, dtype=np.float64))

    def at_times(self, time: NDArray[np.float64]) -> list[State]:
        """States at any instants of the controller's clock in [s]."""
        motion = self.stroke.motion(time - self.start)
        pairs = (
            (motion.sweep, motion.pitch),
            (motion.sweep_rate, motion.pitch_rate),
            (motion.sweep_acceleration, motion.pitch_acceleration),
        )
        columns = (zip(a.tolist(), b.tolist(), strict=True) for a, b in pairs)
        return [State(*row) for row in zip(*columns, strict=True)]
