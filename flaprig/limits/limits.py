"""What the rig's two joints may do: bounds on position, velocity, acceleration and jerk.

Torque, current and temperature belong to the servo and not to the motion: a stroke's kinematics
cannot break them, the check of a stroke in the digital twin judges them.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.limits.accelerations import Accelerations

# order of the joints in arrays, as in the rig's qpos
JOINTS = ("sweep", "pitch")
# largest angle of a joint's range [rad]: two turns
MOST_POSITION = 4.0 * np.pi
# smallest width of a joint's range [rad]
LEAST_RANGE = 1e-6


class Bound(StrEnum):
    """Bounds on a joint's motion; the order is the order of the derivative."""

    POSITION = "position"
    VELOCITY = "velocity"
    ACCELERATION = "acceleration"
    JERK = "jerk"

    @property
    def unit(self) -> str:
        """SI unit of the bounded quantity."""
        return dict(zip(Bound, ("rad", "rad/s", "rad/s2", "rad/s3"), strict=True))[self]


@dataclass(frozen=True)
class JointLimits:
    """Bounds of one joint; those on the motion hold in both directions.

    Attributes:
        position: lowest and highest angle in [rad].
        velocity: largest rate in [rad/s].
        acceleration: in [rad/s2].
        jerk: in [rad/s3].
        torque: peak that the servo gives in [N m]; None: not judged.
        rms_torque: root mean square that it bears for ever in [N m]; None: not judged.
        current: peak in [A]; None: not judged.
        temperature: of the winding in [degC]; None: not judged.

    Raises:
        ValueError: a bound that is not a positive finite number, or a range without width.
    """

    position: tuple[float, float]
    velocity: float
    acceleration: float
    jerk: float
    torque: float | None = None
    rms_torque: float | None = None
    current: float | None = None
    temperature: float | None = None

    def __post_init__(self) -> None:
        owner = "JointLimits"
        low, high = check.array(
            owner, "position", self.position, "rad", length=2, most=MOST_POSITION
        ).tolist()
        if high - low < LEAST_RANGE:
            allowed = f"(lowest, highest) in rad, at least {LEAST_RANGE:g} rad apart"
            raise check.fail(owner, "position", allowed, (low, high))
        object.__setattr__(self, "position", (low, high))
        for bound in (Bound.VELOCITY, Bound.ACCELERATION, Bound.JERK):
            value = check.positive(owner, bound, getattr(self, bound), bound.unit)
            object.__setattr__(self, bound, value)
        for name, unit in (("torque", "N m"), ("rms_torque", "N m"), ("current", "A")):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, check.positive(owner, name, value, unit))
        if self.temperature is not None:
            args = (owner, "temperature", self.temperature, -100.0, 1000.0, "degC")
            object.__setattr__(self, "temperature", check.in_range(*args))

    def range_of(self, bound: Bound) -> tuple[float, float]:
        """Lowest and highest value that a bound allows."""
        if bound is Bound.POSITION:
            return self.position
        size = float(getattr(self, bound))
        return -size, size


@dataclass(frozen=True)
class Limits:
    """Bounds of both joints.

    Attributes:
        sweep: of the joint about the vertical.
        pitch: of the joint about the span.
    """

    sweep: JointLimits
    pitch: JointLimits

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not isinstance(value, JointLimits):
                raise check.fail("Limits", field.name, "a JointLimits", value)

    def with_accelerations(self, bounds: Accelerations) -> Limits:
        """The same limits with other bounds on the accelerations, as PAPER_KINEMATICS.

        Raises:
            ValueError: bounds that are not Accelerations.
        """
        if not isinstance(bounds, Accelerations):
            raise check.fail("Limits.with_accelerations", "bounds", "an Accelerations", bounds)
        return Limits(
            sweep=replace(self.sweep, acceleration=bounds.sweep),
            pitch=replace(self.pitch, acceleration=bounds.pitch),
        )

    def ranges(self, bound: Bound) -> NDArray[np.float64]:
        """Lowest and highest values of a bound; rows sweep, pitch. Shape (2, 2)."""
        return np.array([getattr(self, joint).range_of(bound) for joint in JOINTS])
