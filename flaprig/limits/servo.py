"""Limits of a rig from its servos' datasheet and from what they carry.

A box of velocity and acceleration must lie under the motor's torque-speed line. Its corner is put
where the line passes the continuous torque T: at the velocity n (1 - T/stall), n the no-load speed,
the servo still gives T, and gives it for ever. Half of T is for acceleration, T/2 over the inertia
of rotor, plate and added mass; the other half is left for the drag of the fluid, which no bound on
the motion knows and the digital twin judges. Weight less buoyancy belongs to that half, too: it
does not grow with the motion, and on the rig's pitch axis it is 1.3 mN m at most, 0.2 % of T. Jerk:
the acceleration builds up in no less than one time constant of the position loop,
sqrt(inertia/stiffness), so that the loop can follow it.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Protocol

import numpy as np

from flaprig import _checks as check
from flaprig.fluid import WATER, Fluid
from flaprig.limits.limits import JointLimits, Limits
from flaprig.theory import added_inertia_per_span, added_mass_per_span
from flaprig.wing import RIG_WING, Wing

# share of the continuous torque that bounds the acceleration
TORQUE_SHARE = 0.5
# both joints' stops [rad]: models/rig.xml
RIG_RANGE = (-pi / 2.0, pi / 2.0)
# three-point Gauss rule between two stations of the planform: exact for its powers up to five
_STATIONS = np.array([0.1127016653792583, 0.5, 0.8872983346207417])
_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0


class Servo(Protocol):
    """Numbers of a datasheet, as `flaprig.motors.Motor` has them; all at the output horn."""

    @property
    def stall_torque(self) -> float:
        """At zero speed and full voltage in [N m]."""
        ...

    @property
    def peak_torque(self) -> float:
        """Largest torque that the controller lets through, in [N m]."""
        ...

    @property
    def no_load_speed(self) -> float:
        """At zero torque and full voltage in [rad/s]."""
        ...

    @property
    def continuous_torque(self) -> float:
        """That the servo bears for ever in [N m]."""
        ...

    @property
    def torque_constant(self) -> float:
        """Torque over current in [N m/A]."""
        ...

    @property
    def rotor_inertia(self) -> float:
        """Of rotor and gears, seen at the horn, in [kg m2]."""
        ...

    @property
    def stiffness(self) -> float:
        """Of the position controller in [N m/rad]."""
        ...

    @property
    def temperature_limit(self) -> float:
        """Of the winding in [degC]."""
        ...


class Servos(Protocol):
    """The two servos of a rig, as `flaprig.motors.Motors` has them."""

    @property
    def sweep(self) -> Servo:
        """About the vertical."""
        ...

    @property
    def pitch(self) -> Servo:
        """About the span."""
        ...


def servo_limits(
    servo: Servo, inertia: float, position: tuple[float, float] = RIG_RANGE
) -> JointLimits:
    """Limits of a joint from its servo and its load.

    Args:
        servo: the servo's datasheet.
        inertia: of what it carries, added mass included and the rotor not, in [kg m2].
        position: lowest and highest angle in [rad].

    Raises:
        ValueError: an inertia that is not positive, a bad range, or a servo without numbers.
    """
    owner = "servo_limits"
    load = check.positive(owner, "inertia", inertia, "kg m2")
    if not hasattr(servo, "continuous_torque"):
        raise check.fail(owner, "servo", "a Motor, for instance XM430_W350", servo)
    total = load + servo.rotor_inertia
    acceleration = TORQUE_SHARE * servo.continuous_torque / total
    share = servo.continuous_torque / servo.stall_torque
    return JointLimits(
        position=position,
        # a servo that bears its stall torque for ever still needs some speed: a tenth
        velocity=max(1.0 - share, 0.1) * servo.no_load_speed,
        acceleration=acceleration,
        jerk=acceleration / sqrt(total / servo.stiffness),
        torque=servo.peak_torque,
        rms_torque=servo.continuous_torque,
        current=servo.peak_torque / servo.torque_constant,
        temperature=servo.temperature_limit,
    )


def rig_limits(
    servos: Servos,
    wing: Wing = RIG_WING,
    fluid: Fluid = WATER,
    position: tuple[float, float] = RIG_RANGE,
) -> Limits:
    """Limits of a rig: `rig_limits(flaprig.motors.RIG_MOTORS)` for the rig as built.

    Args:
        servos: the sweep's and the pitch's servo.
        wing: the plate that they move; its arm is light beside the added mass and left out.
        fluid: what the plate moves in.
        position: range of both joints in [rad].

    Raises:
        ValueError: a bad argument; the sentence names it.
    """
    for name, value, kind in (("wing", wing, Wing), ("fluid", fluid, Fluid)):
        if not isinstance(value, kind):
            raise check.fail("rig_limits", name, f"a {kind.__name__}", value)
    if not (hasattr(servos, "sweep") and hasattr(servos, "pitch")):
        raise check.fail("rig_limits", "servos", "a Motors, for instance RIG_MOTORS", servos)
    sweep, pitch = load_inertias(wing, fluid)
    return Limits(
        sweep=servo_limits(servos.sweep, sweep, position),
        pitch=servo_limits(servos.pitch, pitch, position),
    )


def load_inertias(wing: Wing, fluid: Fluid) -> tuple[float, float]:
    """Inertia of plate and added mass about the sweep and the pitch axis in [kg m2].

    Added mass by strips, as if the span were endless: 14 % too much in sweep and 5 % in pitch on
    the paper's wing against a vortex lattice, on the safe side. The sweep's is that of the wing
    standing upright, where it is largest.
    """
    table, steps = wing.stations, np.diff(wing.stations, axis=0)
    weights = steps[:, :1] * _WEIGHTS
    r, c, x = np.moveaxis(table[:-1, :, None] + steps[:, :, None] * _STATIONS, 1, 0)
    mass = weights * added_mass_per_span(fluid.density, c)
    turning = weights * added_inertia_per_span(fluid.density, c) + mass * (x + 0.5 * c) ** 2
    plate = wing.inertia
    return float(plate[0, 0] + (mass * r**2).sum()), float(plate[1, 1] + turning.sum())
