"""Angles as position counts of a servo, with the zero and the direction of its mounting."""

from __future__ import annotations

import os
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.files import written_whole
from flaprig.strokes.stroke import Motion

# ROBOTIS e-Manual, XM430-W350: 4096 pulses a turn; position control takes 0 to 4095, and 2048
# is the middle, marked on the horn
XM430_COUNTS, XM430_ZERO = 4096, 2048
# order of the joints in tables
JOINTS = ("sweep", "pitch")
# widest register accepted
MOST_COUNT = 2**31 - 1


@dataclass(frozen=True)
class JointCounts:
    """How one servo counts its angle.

    Attributes:
        per_turn: counts of one turn of the joint.
        zero: count at the angle 0 of the model.
        direction: +1 where counts grow with the model's angle, else -1.
        lowest: smallest count that the servo accepts.
        highest: largest count that the servo accepts.

    Raises:
        ValueError: a value that is not a whole number, or out of its range.
    """

    per_turn: int = XM430_COUNTS
    zero: int = XM430_ZERO
    direction: int = 1
    lowest: int = 0
    highest: int = XM430_COUNTS - 1

    def __post_init__(self) -> None:
        owner = "JointCounts"
        object.__setattr__(
            self, "per_turn", check.whole(owner, "per_turn", self.per_turn, 4, MOST_COUNT)
        )
        for name in ("zero", "lowest", "highest"):
            value = check.whole(owner, name, getattr(self, name), -MOST_COUNT, MOST_COUNT)
            object.__setattr__(self, name, value)
        if self.direction not in (1, -1):
            raise check.fail(owner, "direction", "1 or -1", self.direction)
        if not self.lowest <= self.zero <= self.highest:
            allowed = f"from lowest to highest, {self.lowest} to {self.highest}"
            raise check.fail(owner, "zero", allowed, self.zero)

    def counts(self, angle: NDArray[np.float64]) -> NDArray[np.int64]:
        """Nearest counts of angles in [rad]: off by half a count at most. Shape as angle.

        Raises:
            ValueError: an angle that is not finite, or beyond the counts of the servo.
        """
        if not np.isfinite(angle).all():
            raise check.fail("JointCounts.counts", "angle", "finite, in rad", angle)
        scaled = self.zero + self.direction * np.asarray(angle) * self.per_turn / (2.0 * np.pi)
        found = np.rint(scaled)
        worst = found.flat[np.argmax(np.maximum(self.lowest - found, found - self.highest))]
        if not self.lowest <= worst <= self.highest:
            allowed = f"within {self.lowest} to {self.highest} counts"
            raise check.fail("JointCounts.counts", "angle", allowed, f"{worst:.0f} counts")
        return found.astype(np.int64)

    def angles(self, counts: NDArray[np.int64] | NDArray[np.float64]) -> NDArray[np.float64]:
        """Angles in [rad] of counts, whole or averaged. Shape as counts."""
        turned = self.direction * (np.asarray(counts, dtype=np.float64) - self.zero)
        return np.asarray(turned * (2.0 * np.pi / self.per_turn))


@dataclass(frozen=True)
class PositionCounts:
    """How the two servos of a rig count.

    Attributes:
        sweep: of the sweep servo.
        pitch: of the pitch servo.
    """

    sweep: JointCounts = JointCounts()
    pitch: JointCounts = JointCounts()

    def __post_init__(self) -> None:
        for name in JOINTS:
            if not isinstance(getattr(self, name), JointCounts):
                raise check.fail("PositionCounts", name, "a JointCounts", getattr(self, name))

    def table(self, motion: Motion) -> NDArray[np.int64]:
        """Counts of a motion; columns sweep, pitch. Shape (n, 2).

        Raises:
            ValueError: an angle beyond the counts of its servo.
        """
        columns = [getattr(self, joint).counts(getattr(motion, joint)) for joint in JOINTS]
        return np.column_stack(columns)

    def save(self, path: str | os.PathLike[str], motion: Motion) -> None:
        """Write time_s,sweep_count,pitch_count, a row a set point, whole or not at all.

        The rows keep the times of the motion: filter it at the servo's control interval.

        Raises:
            ValueError: an angle beyond the counts of its servo.
            OSError: the folder does not exist or cannot be written.
        """
        rows = zip(motion.time.tolist(), self.table(motion).tolist(), strict=True)
        lines = [f"{time:.10g},{sweep},{pitch}" for time, (sweep, pitch) in rows]
        with written_whole(path) as draft:
            draft.write_text("\n".join(["time_s,sweep_count,pitch_count", *lines, ""]), "utf-8")


# both servos of the rig as built, mounted with their middle at the model's zero
XM430_RIG = PositionCounts()
