"""The catalogue: datasheet numbers, and what is derived from them."""

from __future__ import annotations

import math

import pytest

from flaprig.catalogue import CATALOGUE, MX_106, XL330_M288, XL430_W250, XM540_W270, _servo
from flaprig.limits import rig_limits
from flaprig.motors import XM430_W350, Motor, Motors

# recommended voltage [V], stall torque [N m], no-load speed [rev/min], mass [g], limit [degC]:
# ROBOTIS e-Manual
DATASHEET = {
    "XL330-M288": (5.0, 0.52, 103.0, 18.0, 70.0),
    "XL430-W250": (11.1, 1.4, 57.0, 57.2, 72.0),
    "XM430-W210": (12.0, 3.0, 77.0, 82.0, 80.0),
    "XM430-W350": (12.0, 4.1, 46.0, 82.0, 80.0),
    "MX-106": (12.0, 8.4, 45.0, 153.0, 80.0),
    "XM540-W270": (12.0, 10.6, 30.0, 165.0, 80.0),
}


@pytest.mark.parametrize("name", DATASHEET)
def test_datasheet(name: str) -> None:
    motor = CATALOGUE[name]
    numbers = (
        motor.voltage,
        motor.stall_torque,
        motor.no_load_speed * 60.0 / (2.0 * math.pi),
        1e3 * motor.mass,
        motor.temperature_limit,
    )
    assert numbers == pytest.approx(DATASHEET[name])


def test_smallest_comes_first() -> None:
    assert list(CATALOGUE) == list(DATASHEET)
    sizes = [(motor.mass, motor.stall_torque) for motor in CATALOGUE.values()]
    assert sizes == sorted(sizes)
    with pytest.raises(TypeError):
        CATALOGUE["mine"] = XM430_W350  # type: ignore[index]


def test_the_rigs_servo_comes_out_of_its_own_datasheet() -> None:
    own = XM430_W350
    same = _servo(12.0, 4.1, own.no_load_speed, own.mass, 80.0)
    for name in Motor.__dataclass_fields__:
        assert getattr(same, name) == pytest.approx(getattr(own, name)), name


@pytest.mark.parametrize("motor", CATALOGUE.values(), ids=CATALOGUE)
def test_what_is_shared_by_the_family(motor: Motor) -> None:
    assert motor.continuous_torque == pytest.approx(0.2 * motor.stall_torque)
    # the P gain of 1600 in [V/rad], as a share of the supply
    gain = motor.stiffness / motor.stall_torque
    assert gain == pytest.approx(XM430_W350.stiffness / XM430_W350.stall_torque)
    # the continuous torque ends at the limit of this servo
    assert motor.steady_temperature(motor.continuous_torque) == pytest.approx(
        motor.temperature_limit
    )


@pytest.mark.parametrize("motor", [XL330_M288, XL430_W250, MX_106, XM540_W270])
def test_mechanical_time_constant(motor: Motor) -> None:
    """J R/K^2 of servos of one kind is alike; identified ones are within a factor of three."""
    time = motor.rotor_inertia * motor.no_load_speed / motor.stall_torque
    assert 0.4 < time / 17.2e-3 < 3.0


def test_limits_follow_the_servo() -> None:
    """The biggest servo is slow, the smallest one is weak."""
    big = rig_limits(Motors(XM540_W270, XM540_W270))
    small = rig_limits(Motors(XL330_M288, XL330_M288))
    assert big.sweep.velocity < small.sweep.velocity
    assert big.sweep.acceleration > small.sweep.acceleration
    # more of its torque goes into its own rotor
    assert big.pitch.acceleration < small.pitch.acceleration
