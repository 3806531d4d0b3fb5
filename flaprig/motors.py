"""The rig's two servos: DYNAMIXEL XM430-W350 as MuJoCo's `dcmotor` element takes it.

Datasheet: ROBOTIS e-Manual, XM430-W350-T/R, https://emanual.robotis.com/docs/en/dxl/x/xm430-w350/.
Motor equations: MuJoCo DC Motor Model, https://mujoco.readthedocs.io/en/latest/_static/dcmotor.pdf.
All torques, speeds and inertias are at the output horn, after the gears. Gear friction is left
out: the datasheet does not print it, and it never reaches the wing. Its trace is the current: the
line through stall torque and no-load speed stalls at 1.65 A, the real servo at 2.3 A, so currents
here are 0.72 of the real ones. The thermal resistance is set from the torque and makes up for it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

from flaprig import _checks as check

# temperature coefficient of the resistance of copper [1/K]: IEC 60028, at 20 degrees Celsius
COPPER = 3.93e-3
# temperature at which a datasheet's resistance is meant [degC]: the maxon catalogue's convention
REFERENCE_TEMPERATURE = 25.0


@dataclass(frozen=True)
class Motor:
    """A geared direct-current servo with its on-board position controller.

    Attributes:
        voltage: supply, which the other electrical numbers belong to, in [V].
        stall_torque: at zero speed and full voltage in [N m].
        no_load_speed: at zero torque and full voltage in [rad/s].
        continuous_torque: that the servo bears for ever in [N m], at most the stall torque.
        temperature_limit: winding temperature reached at the continuous torque in [degC].
        ambient_temperature: of the air around the servo in [degC].
        heat_capacity: of what warms with the winding in [J/K].
        rotor_inertia: of rotor and gears, seen at the horn, in [kg m2]; zero is allowed.
        stiffness: proportional gain of the controller in [N m/rad].
        damping: derivative gain of the controller in [N m s/rad].
        mass: of the whole servo in [kg].
        slew_rate: at which the controller moves its aim to the angle it is told, in [rad/s], as the
            profile velocity of a DYNAMIXEL does; 0: at once.
        torque_limit: that the controller's current limit allows, in [N m]; 0: the stall torque.

    Raises:
        ValueError: a value that is not a positive finite number, a continuous torque above the
            stall torque, or a temperature limit that is not above the ambient temperature.
    """

    voltage: float
    stall_torque: float
    no_load_speed: float
    continuous_torque: float
    temperature_limit: float
    ambient_temperature: float
    heat_capacity: float
    rotor_inertia: float
    stiffness: float
    damping: float
    mass: float
    slew_rate: float = 0.0
    torque_limit: float = 0.0

    def __post_init__(self) -> None:
        owner = "Motor"
        for field in fields(self):
            object.__setattr__(self, field.name, _checked(field.name, getattr(self, field.name)))
        torque, limit = self.continuous_torque, self.temperature_limit
        if torque > self.stall_torque:
            raise check.fail(owner, "continuous_torque", "at most the stall torque", torque)
        if limit <= self.ambient_temperature:
            raise check.fail(owner, "temperature_limit", "above the ambient temperature", limit)

    @property
    def torque_constant(self) -> float:
        """K, back-EMF over speed and torque over current, in [V s/rad] = [N m/A]."""
        return self.voltage / self.no_load_speed

    @property
    def peak_torque(self) -> float:
        """Largest torque that the controller lets through, in [N m]."""
        return self.torque_limit or self.stall_torque

    @property
    def resistance(self) -> float:
        """R of the winding at the reference temperature in [Ohm]."""
        return self.torque_constant * self.voltage / self.stall_torque

    @property
    def thermal_resistance(self) -> float:
        """Winding to air in [K/W]: the continuous torque ends at the temperature limit."""
        hot = self.resistance * (1.0 + COPPER * (self.temperature_limit - REFERENCE_TEMPERATURE))
        loss = (self.continuous_torque / self.torque_constant) ** 2 * hot
        return (self.temperature_limit - self.ambient_temperature) / loss

    def available_torque(self, speed: float) -> float:
        """Largest torque at a speed in [rad/s], in [N m]: the straight line of a DC motor."""
        rest = self.stall_torque * (1.0 - abs(speed) / self.no_load_speed)
        return max(rest, 0.0)

    def steady_temperature(self, rms_torque: float) -> float:
        """Winding temperature that a torque of this root mean square ends at, in [degC].

        The torque is the one delivered: MuJoCo's controller counts on the cold winding, so what a
        hot servo delivers is less than what it is asked for.

        Infinite when the winding's growing resistance heats faster than the air cools.
        """
        cold = (rms_torque / self.torque_constant) ** 2 * self.resistance * self.thermal_resistance
        if COPPER * cold >= 1.0:
            return math.inf
        offset = COPPER * (self.ambient_temperature - REFERENCE_TEMPERATURE)
        return self.ambient_temperature + cold * (1.0 + offset) / (1.0 - COPPER * cold)

    @property
    def dcmotor(self) -> dict[str, list[float]]:
        """The attributes of MuJoCo's `dcmotor` element, `armature` aside."""
        return {
            "nominal": [self.voltage, self.stall_torque, self.no_load_speed],
            # torque, current, current rate: the torque limit stands for the current limit
            "saturation": [self.peak_torque, 0.0, 0.0],
            # resistance, capacity, time constant (from the two), copper, reference, ambient
            "thermal": [
                self.thermal_resistance,
                self.heat_capacity,
                0.0,
                COPPER,
                REFERENCE_TEMPERATURE,
                self.ambient_temperature,
            ],
            # kp, ki, kd, slew rate, integrator limit, voltage limit
            "controller": [
                *(self.stiffness, 0.0, self.damping),
                *(self.slew_rate, 0.0, self.voltage),
            ],
        }


@dataclass(frozen=True)
class Motors:
    """The two servos of a rig.

    Attributes:
        sweep: the servo on the stand, about the vertical axis.
        pitch: the servo on the arm, about the span.
    """

    sweep: Motor
    pitch: Motor

    def __post_init__(self) -> None:
        for name, motor in (("sweep", self.sweep), ("pitch", self.pitch)):
            if not isinstance(motor, Motor):
                raise check.fail("Motors", name, "a Motor", motor)


def continuous_torque(
    thermal_resistance: float,
    torque_constant: float,
    resistance: float,
    temperature_limit: float,
    ambient_temperature: float,
) -> float:
    """Torque in [N m] that ends at the temperature limit: Motor.thermal_resistance turned round.

    Args:
        thermal_resistance: winding to air in [K/W].
        torque_constant: torque over current in [N m/A].
        resistance: of the winding at the reference temperature in [Ohm].
        temperature_limit: of the winding in [degC].
        ambient_temperature: of the air in [degC].
    """
    hot = resistance * (1.0 + COPPER * (temperature_limit - REFERENCE_TEMPERATURE))
    loss = (temperature_limit - ambient_temperature) / thermal_resistance
    return torque_constant * math.sqrt(loss / hot)


# unit, and the largest value that a servo can have, where it is not check.MOST
_MOST = {
    "voltage": ("V", 1e4),
    "stall_torque": ("N m", 1e6),
    "no_load_speed": ("rad/s", 1e6),
    "continuous_torque": ("N m", 1e6),
    "mass": ("kg", 1e4),
}


def _checked(name: str, value: float) -> float:
    """The value as a float; temperatures may be negative, and what may be left out zero."""
    if name in ("temperature_limit", "ambient_temperature"):
        return check.in_range("Motor", name, value, -100.0, 1000.0, "degC")
    if name in ("rotor_inertia", "slew_rate", "torque_limit") and value == 0.0:
        return 0.0
    return check.positive("Motor", name, value, *_MOST.get(name, ()))


# stall torque over no-load speed at 12 V [N m s/rad], from the two lines below: K^2/R
_SPEED_DROP = 4.1 / (46.0 * 2.0 * math.pi / 60.0)
# mechanical time constant J R/K^2 of this family of servos [s]: mean of MX-64 (0.01195 kg m2,
# 3.949 Ohm, 1.622 N m/A: 17.9 ms) and MX-106 (0.02661, 2.965, 2.191: 16.4 ms), identified on a
# pendulum by Duclusaud et al., Extended Friction Models for the Physics Simulation of Servo
# Actuators, arXiv 2410.08650, parameter files of Rhoban/bam, model m1. ROBOTIS prints no rotor
# inertia; coreless motors of one family share this constant better than they share the inertia
_MECHANICAL_TIME = 17.2e-3
# position P gain [register units]: twice the factory value of 800 (e-Manual, control table 84),
# so that water and inertia pull the wing less than 0.5 deg off a 0.2 Hz stroke without feedforward
_POSITION_P_GAIN = 1600.0

XM430_W350 = Motor(
    # e-Manual: recommended input voltage 12.0 V
    voltage=12.0,
    # e-Manual: stall torque 4.1 N m at 12.0 V (2.3 A). The factory current limit, 1193 steps of
    # 2.69 mA = 3.2 A, is never reached at 12 V
    stall_torque=4.1,
    # e-Manual: no-load speed 46 rev/min at 12.0 V
    no_load_speed=46.0 * 2.0 * math.pi / 60.0,
    # ROBOTIS, Torque Ratings, 7 May 2020: where none is given, 0.20 of the stall torque
    continuous_torque=0.2 * 4.1,
    # e-Manual: temperature limit 80 degC (control table 31), operating temperature up to 80 degC
    temperature_limit=80.0,
    # temperature of the laboratory, assumed
    ambient_temperature=25.0,
    # estimate: a third of the 82 g is motor; steel, copper and magnets at 450 J/(kg K). Small on
    # purpose: the real case soaks up more heat, so the real servo warms later
    heat_capacity=0.082 / 3.0 * 450.0,
    # the family's time constant times K^2/R, see above: 14.6e-3 kg m2
    rotor_inertia=_MECHANICAL_TIME * _SPEED_DROP,
    # e-Manual, position PID gain: volts = gain/128 per pulse, 4096 pulses a turn, 885 steps of PWM
    # are 12 V; torque = volts K/R: 37.8 N m/rad
    stiffness=_POSITION_P_GAIN / 128.0 * 4096.0 / (2.0 * math.pi) / 885.0 * 4.1,
    # twice K^2/R: the damping that the motor's back-EMF gives by itself (MuJoCo's controller
    # takes it out) and as much again from the D gain; damping ratio 0.7 to 1.1 in water
    damping=2.0 * _SPEED_DROP,
    # e-Manual: weight 82 g
    mass=0.082,
)

# sweep and pitch: paper section 2.2 has two independent servo motors and names neither; this one
# stalls at 20 times the torque that water asks of the sweep (UVLM: 0.2 N m, pitch 0.014 N m)
RIG_MOTORS = Motors(sweep=XM430_W350, pitch=XM430_W350)
