"""The servo's numbers: its straight line and its heat against MuJoCo's own dcmotor."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import mujoco
import numpy as np
import pytest

from flaprig.motors import COPPER, RIG_MOTORS, XM430_W350, Motor, Motors

INPUTS = 7  # mjINPUT_POS | mjINPUT_VEL | mjINPUT_FF


def bench(motor: Motor, inertia: float) -> mujoco.MjModel:
    """One servo turning a flywheel [kg m2], nothing else."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 1e-3
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    body = spec.worldbody.add_body(name="wheel")
    body.add_joint(name="shaft", axis=[0, 0, 1], armature=inertia)
    body.add_geom(size=[1e-3, 1e-3, 1e-3], mass=1e-6)
    servo = spec.add_actuator(name="servo", target="shaft", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_dcmotor(motorconst=[0.0, 0.0], resistance=0.0, ctrlspec=INPUTS, **motor.dcmotor)
    servo.armature = motor.rotor_inertia
    return spec.compile()


def test_line_through_stall_and_no_load() -> None:
    motor = XM430_W350
    assert motor.available_torque(0.0) == motor.stall_torque
    assert motor.available_torque(-motor.no_load_speed / 2) == pytest.approx(motor.stall_torque / 2)
    assert motor.available_torque(2.0 * motor.no_load_speed) == 0.0
    # K i = torque and K omega + R i = V meet at both ends of the line
    assert motor.torque_constant * motor.voltage / motor.resistance == pytest.approx(4.1)
    assert motor.torque_constant * motor.no_load_speed == pytest.approx(motor.voltage)


def test_saturated_servo_runs_at_the_no_load_speed() -> None:
    model = bench(XM430_W350, 0.0)
    data = mujoco.MjData(model)
    data.ctrl[0] = 1e4  # a target out of reach: full voltage
    mujoco.mj_step(model, data, 400)
    assert data.qvel[0] == pytest.approx(XM430_W350.no_load_speed, rel=1e-3)


def test_start_up_takes_the_mechanical_time_constant() -> None:
    """J R / K^2 = 17.2 ms: a free start reaches 1 - 1/e of the no-load speed then."""
    model = bench(XM430_W350, 0.0)
    model.opt.timestep = 1e-4
    data = mujoco.MjData(model)
    data.ctrl[0] = 1e4
    mujoco.mj_step(model, data, 172)
    assert data.qvel[0] / XM430_W350.no_load_speed == pytest.approx(1 - math.exp(-1), rel=0.01)


def test_blocked_servo_gives_the_stall_torque() -> None:
    model = bench(XM430_W350, 1e9)
    data = mujoco.MjData(model)
    data.ctrl[0] = -1e4
    mujoco.mj_step(model, data)
    assert data.actuator_force[0] == pytest.approx(-XM430_W350.stall_torque, rel=1e-6)


def test_continuous_torque_ends_at_the_temperature_limit() -> None:
    motor = replace(XM430_W350, heat_capacity=0.002)  # a fast thermometer: 0.1 s
    assert motor.steady_temperature(motor.continuous_torque) == pytest.approx(80.0)
    model = bench(motor, 1e9)
    data = mujoco.MjData(model)
    # the on-board controller counts on the cold winding, so a hot one is asked for more
    data.ctrl[2] = motor.continuous_torque * (1.0 + COPPER * 55.0)
    mujoco.mj_step(model, data, 3000)
    assert data.actuator_force[0] == pytest.approx(motor.continuous_torque, rel=1e-3)
    # the thermal state is the rise above the ambient temperature
    assert data.act[0] + motor.ambient_temperature == pytest.approx(80.0, abs=0.05)


def test_half_the_torque_and_run_away() -> None:
    rise = XM430_W350.steady_temperature(0.41) - 25.0
    # a quarter of the heat, and less resistance
    assert 0.8 * 55.0 / 4 < rise < 55.0 / 4
    assert XM430_W350.steady_temperature(0.0) == 25.0
    assert XM430_W350.steady_temperature(4.1) == math.inf


def test_servo_holds_its_inertia_well_damped() -> None:
    """Step of 1 deg with the sweep's inertia in water (0.035 kg m2): no more than 5 % over."""
    model = bench(XM430_W350, 0.035 - XM430_W350.rotor_inertia)
    data = mujoco.MjData(model)
    target = data.ctrl[0] = math.radians(1.0)
    track = []
    for _ in range(400):
        mujoco.mj_step(model, data)
        track.append(data.qpos[0])
    assert max(track) < 1.05 * target
    assert track[-1] == pytest.approx(target, rel=1e-3)


def test_numbers_of_today() -> None:
    motor = RIG_MOTORS.sweep
    assert RIG_MOTORS.pitch is motor
    assert motor.no_load_speed == pytest.approx(4.81711, rel=1e-5)
    assert motor.resistance == pytest.approx(7.29109, rel=1e-5)
    assert motor.thermal_resistance == pytest.approx(57.2460, rel=1e-5)
    assert motor.rotor_inertia == pytest.approx(0.0146395, rel=1e-5)
    assert motor.stiffness == pytest.approx(37.7512, rel=1e-5)
    assert motor.damping == pytest.approx(1.70227, rel=1e-5)


@pytest.mark.parametrize("name", [field.name for field in fields(Motor)])
@pytest.mark.parametrize("value", [math.nan, math.inf, -500.0, "12", None, [1.0], True])
def test_bad_number_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(ValueError, match=f"Motor: {name} must be"):
        replace(XM430_W350, **{name: value})


@pytest.mark.parametrize(
    "changes", [{"continuous_torque": 4.2}, {"temperature_limit": 20.0}, {"stall_torque": 0.0}]
)
def test_numbers_that_contradict(changes: dict[str, float]) -> None:
    with pytest.raises(ValueError, match=next(iter(changes))):
        replace(XM430_W350, **changes)


def test_motors_must_be_motors() -> None:
    with pytest.raises(ValueError, match="Motors: pitch must be a Motor, got 4"):
        Motors(sweep=XM430_W350, pitch=4)  # type: ignore[arg-type]


def test_no_rotor_is_allowed() -> None:
    assert replace(XM430_W350, rotor_inertia=0).rotor_inertia == 0.0
    assert np.isfinite(list(XM430_W350.dcmotor["thermal"])).all()
