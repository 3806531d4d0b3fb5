"""What a servo hears of its set points: at intervals, late, in counts, with or without the rate.

Rigs of the shop send positions over a bus some tens of times a second. Li & Nabawy's tank rig,
driven so, rounded its pitch and lagged by 0.06 to 0.21 s as the frequency rose from 0.08 to 0.21
Hz; docs/servo_lag.md has settings that do it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check

Array = NDArray[np.float64]

# longest update interval and longest delay [s]: more is no control
MOST_INTERVAL, MOST_DELAY = 1.0, 10.0
# most counts of a turn
MOST_COUNTS = 2**31 - 1


@dataclass(frozen=True)
class ServoLink:
    """The line from the computer to both servos. The default is a perfect one.

    Attributes:
        update_interval: between messages in [s], 0 to 1; a servo holds what it was last told.
            Rounded to whole steps of the run; 0: a message every step.
        delay: of a message in [s], 0 to 10; rounded to whole steps.
        counts: of one turn, to which angles are rounded; None: not rounded. A DYNAMIXEL X has 4096,
            0.088 deg each.
        velocity: whether the rate is sent beside the angle. If not, the servo brakes on its rate.

    Raises:
        ValueError: a value of the wrong type or out of its range.
    """

    update_interval: float = 0.0
    delay: float = 0.0
    counts: int | None = None
    velocity: bool = True

    def __post_init__(self) -> None:
        owner = "ServoLink"
        for name, most in (("update_interval", MOST_INTERVAL), ("delay", MOST_DELAY)):
            value = check.in_range(owner, name, getattr(self, name), 0.0, most, "s")
            object.__setattr__(self, name, value)
        if self.counts is not None:
            counts = check.whole(owner, "counts", self.counts, 4, MOST_COUNTS)
            object.__setattr__(self, "counts", counts)
        if not isinstance(self.velocity, bool):
            raise check.fail(owner, "velocity", "True or False", self.velocity)

    def heard(self, steps: int, time_step: float) -> NDArray[np.int64]:
        """The step whose message the servo has in each step. Shape (steps,).

        Before the first message arrives it is that of step 0.
        """
        held = max(1, round(self.update_interval / time_step))
        late = round(self.delay / time_step)
        step = np.arange(steps) - late
        return np.maximum(step - step % held, 0)

    def rounded(self, angle: Array) -> Array:
        """Angles in [rad] as the servo gets them. Shape as angle."""
        if self.counts is None:
            return angle
        count = 2.0 * np.pi / self.counts
        return np.asarray(count * np.rint(angle / count))


# messages without loss, delay or rounding
PERFECT = ServoLink()
