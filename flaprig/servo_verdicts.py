"""What a stroke needs of a servo: torque, speed, current, heat, power, and how well it follows."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from flaprig.limits.limits import JointLimits
from flaprig.motors import COPPER, REFERENCE_TEMPERATURE, Motor
from flaprig.verdict import Tolerances, Verdict

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Work:
    """What one servo did in the averaged cycles; arrays of shape (m,).

    Attributes:
        torque: of the motor, seen at the horn, in [N m].
        demand: torque that its controller asks for in [N m]: the same until the servo saturates.
        speed: of the horn in [rad/s].
        error: angle reached minus angle asked for in [rad].
    """

    torque: Array
    demand: Array
    speed: Array
    error: Array

    @property
    def rms_torque(self) -> float:
        """Root mean square in [N m]."""
        return float(np.sqrt(np.mean(self.torque**2)))

    @property
    def power(self) -> Array:
        """Mechanical, positive when the servo drives, in [W]. Shape (m,)."""
        return self.torque * self.speed


@dataclass(frozen=True)
class LinePoint:
    """The point of a torque-speed cloud that comes nearest to the motor's line, or goes beyond.

    Attributes:
        speed: size of the speed in [rad/s].
        torque: size of the torque asked for in [N m].
        available: torque that the warm motor has at that speed in [N m].
    """

    speed: float
    torque: float
    available: float


def warm_stall_torque(motor: Motor, rms_torque: float) -> float:
    """Stall torque of a winding as warm as that torque makes it in the end, in [N m].

    Copper's resistance grows with temperature; above the temperature limit nothing is meant.
    """
    warm = min(motor.steady_temperature(rms_torque), motor.temperature_limit)
    return motor.stall_torque / (1.0 + COPPER * (warm - REFERENCE_TEMPERATURE))


def line_point(motor: Motor, work: Work) -> LinePoint:
    """The driving point with the smallest share of torque left.

    Braking is not bounded by the line: the back-EMF helps there, and the current is the limit.
    """
    stall = warm_stall_torque(motor, work.rms_torque)
    driving = work.demand * work.speed >= 0.0
    torque, speed = np.abs(work.demand[driving]), np.abs(work.speed[driving])
    if not torque.size:
        return LinePoint(0.0, 0.0, stall)
    available = stall * np.maximum(1.0 - speed / motor.no_load_speed, 0.0)
    used = np.divide(torque, available, out=np.full_like(torque, np.inf), where=available > 0.0)
    worst = int(np.argmax(used))
    return LinePoint(float(speed[worst]), float(torque[worst]), float(available[worst]))


def servo_verdicts(
    joint: str, motor: Motor, allowed: JointLimits, work: Work, tolerances: Tolerances
) -> list[Verdict]:
    """Verdicts on one servo; what the limits leave None is told and not judged."""
    # what is asked for, not what a saturated servo gives
    peak = float(np.abs(work.demand).max())
    current, point = peak / motor.torque_constant, line_point(motor, work)
    percentile = float(np.percentile(np.abs(work.demand), 99))
    rms = float(np.sqrt(np.mean(work.error**2)))
    heat = motor.steady_temperature(work.rms_torque)
    return [
        Verdict(joint, "peak_torque", peak, allowed.torque, "N m"),
        Verdict(joint, "p99_torque", percentile, allowed.torque, "N m"),
        Verdict(joint, "rms_torque", work.rms_torque, allowed.rms_torque, "N m"),
        Verdict(joint, "torque_at_speed", point.torque, point.available, "N m"),
        Verdict(joint, "peak_current", current, allowed.current, "A"),
        Verdict(
            joint,
            "winding_temperature",
            heat,
            allowed.temperature,
            "degC",
            zero=motor.ambient_temperature,
        ),
        Verdict(joint, "rms_tracking_error", rms, tolerances.rms_tracking, "rad"),
        Verdict(
            joint,
            "peak_tracking_error",
            float(np.abs(work.error).max()),
            tolerances.peak_tracking,
            "rad",
        ),
        *_power(joint, work.power),
    ]


def _power(joint: str, power: Array) -> list[Verdict]:
    """Driving and regenerative power; the motor's line bounds the first, the supply the second."""
    driving, back = np.maximum(power, 0.0), np.maximum(-power, 0.0)
    numbers = {
        "peak_power": driving.max(),
        "mean_power": driving.mean(),
        "peak_regenerative_power": back.max(),
        "mean_regenerative_power": back.mean(),
    }
    return [Verdict(joint, name, float(value), None, "W") for name, value in numbers.items()]
