"""Energy and stability of the rig in water: every joule of the motors is found again."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import mujoco
import numpy as np
import pytest

from flaprig import RIG_WING, UVLM, QuasiSteady, Rig, SunTangStroke, Twin, TwinRun
from flaprig._paths import RIG_XML
from flaprig.aero.models import AirModel
from flaprig.energy import solid_energy
from flaprig.rig import START, Axis, Sensor, readings, weigh_stops
from flaprig.twin_log import StepLog, drive

SINUSOID = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0))
COARSE = UVLM(chordwise=4, spanwise=6, steps_per_cycle=40)
STEADY = QuasiSteady()
# the acrylic plate, and one a tenth as dense: the added mass is 12 and 120 times its inertia
DENSITIES = (1180.0, 118.0)
STEPS = (0.001, 0.002, 0.005)


@cache
def run_of(model: AirModel, time_step: float, density: float) -> TwinRun:
    wing = replace(RIG_WING, density=density)
    rig = Rig.load().with_(wing=wing, model=model)
    return Twin(rig, time_step).run(SINUSOID, cycles=3)


def cycle_lift(run: TwinRun) -> np.ndarray:
    """C_L of every cycle."""
    return run.result.lift.reshape(3, -1).mean(axis=1) / run.result.reference_force


@pytest.mark.parametrize("density", DENSITIES)
@pytest.mark.parametrize("time_step", STEPS)
@pytest.mark.parametrize("model", [COARSE, STEADY], ids=["uvlm", "quasi_steady"])
def test_motor_work_is_found_again(model: AirModel, time_step: float, density: float) -> None:
    """Motor = fluid + kinetic + potential, per cycle; what is missing falls with the step."""
    energy = run_of(model, time_step, density).energy
    # 1e-4 is asked for; explicit steps of the pose leave 2e-7 for each millisecond
    assert np.abs(energy.relative_residual).max() < 4e-4 * time_step
    assert np.all(energy.motor_work > 0.3)
    # after the start nothing is stored: the fluid takes it all
    np.testing.assert_allclose(energy.motor_work[1:], energy.fluid_work[1:], rtol=1e-4)
    assert energy.kinetic[0] > 1e-3
    assert np.all(energy.losses == 0.0)


def test_work_at_the_wrong_rate_is_not_found_again() -> None:
    """The rates of the step's end instead of its middle: the balance can fail."""
    run = run_of(COARSE, 0.005, DENSITIES[0])
    h, m = run.result.histories, run.motors
    torque = np.column_stack([m.sweep_motor_torque, m.pitch_motor_torque])[:-1]
    rate = np.column_stack([h.sweep_rate, h.pitch_rate])[1:]
    # the first cycle holds the start, where the rates jump
    n = run.result.steps_per_cycle
    wrong = np.einsum("nj,nj->n", torque, rate)[:n].sum() * run.time_step
    assert abs(wrong / run.energy.motor_work[0] - 1.0) > 1e-3


@pytest.mark.parametrize("model", [COARSE, STEADY], ids=["uvlm", "quasi_steady"])
def test_lift_does_not_depend_on_step_or_plate(model: AirModel) -> None:
    """Cycle means at 1, 2 and 5 ms and both plates; the free wake makes later cycles scatter."""
    means = np.array([cycle_lift(run_of(model, dt, rho)) for dt in STEPS for rho in DENSITIES])
    assert np.ptp(means[:, 0]) < 0.0015 * means[0, 0]
    late = means[:, 1:].mean(axis=1)
    np.testing.assert_allclose(late, late.mean(), rtol=0.005)


def test_halving_the_step_changes_the_mean_by_less_than_half_a_percent() -> None:
    for model in (COARSE, STEADY):
        runs = [run_of(model, dt, DENSITIES[0]).result.lift for dt in (0.001, 0.002)]
        # all three cycles: their scatter is chaos, not the step
        fine, coarse = (lift.mean() for lift in runs)
        assert coarse == pytest.approx(fine, rel=0.005)


@pytest.mark.parametrize(
    ("old", "new", "loses"),
    [
        ('<joint name="sweep"', '<joint name="sweep" damping="0.05"', 0.2166),
        ('<dcmotor name="sweep"', '<dcmotor name="sweep" damping="0.05"', 0.2166),
        ('<joint name="sweep"', '<joint name="sweep" frictionloss="0.02"', 0.0838),
        ('<joint name="pitch"', '<joint name="pitch" stiffness="0.05"', 0.0),
    ],
    ids=["joint damping", "gear damping", "dry friction", "spring"],
)
def test_losses_have_their_own_account(tmp_path: Path, old: str, new: str, loses: float) -> None:
    """Rigs of other files. Viscous: b w^2 A^2 pi; dry: 4 A F per cycle; a spring loses nothing."""
    path = tmp_path / "rig.xml"
    text = RIG_XML.read_text()
    assert old in text
    path.write_text(text.replace(old, new))
    rig = Rig.load(path).with_(model=STEADY)
    for time_step in (0.001, 0.005):
        energy = Twin(rig, time_step).run(SINUSOID, cycles=2).energy
        assert np.abs(energy.relative_residual).max() < 4e-4 * time_step
        assert energy.losses[1] == pytest.approx(loses, rel=0.005)
    amplitude, omega = SINUSOID.sweep_amplitude, 2.0 * math.pi * SINUSOID.frequency
    exact = {0.2166: 0.05 * math.pi * omega * amplitude**2, 0.0838: 0.02 * 4.0 * amplitude}
    assert loses == pytest.approx(exact.get(loses, 0.0), rel=0.01)


@pytest.mark.parametrize("element", ["joint", "dcmotor"])
def test_friction_is_no_part_of_the_motors_torque(tmp_path: Path, element: str) -> None:
    """The servo's law holds to the last digit beside friction, which MuJoCo takes implicitly."""
    path, old = tmp_path / "rig.xml", f'<{element} name="sweep"'
    path.write_text(RIG_XML.read_text().replace(old, f'{old} damping="0.05"'))
    run = Twin(Rig.load(path).with_(model=STEADY), 0.005).run(SINUSOID, cycles=1)
    m, motor, rate = run.motors, Rig.load().motors.sweep, run.result.histories.sweep_rate
    law = motor.stiffness * (m.sweep_set_point - m.sweep)[:-1] + m.sweep_feedforward[:-1]
    law += motor.damping * (m.sweep_rate_set_point[:-1] - rate[1:])
    # warm copper takes up to 1e-4
    np.testing.assert_allclose(m.sweep_motor_torque[:-1], law, rtol=1e-4)


# ---- free pitch: no motor holds the wing, nor its rotor


def free_model(time_step: float, density: float, model: AirModel) -> mujoco.MjModel:
    """The rig without its pitch servo and without buoyancy, in which the light plate tips over."""
    wing = replace(RIG_WING, density=density)
    rig = Rig.load().with_(wing=wing, model=model, buoyancy=False)
    spec = rig.spec()
    spec.option.timestep = time_step
    spec.delete(spec.sensor(Sensor.PITCH_TORQUE))
    spec.delete(spec.actuator(Axis.PITCH))
    spec.delete(spec.key(START))
    compiled = spec.compile()
    weigh_stops(compiled)
    return compiled


def free_log(model: mujoco.MjModel, cycles: int) -> StepLog:
    steps = round(cycles / (SINUSOID.frequency * model.opt.timestep))
    motion = SINUSOID.motion(np.arange(steps + 1) * model.opt.timestep)
    control = np.zeros((steps, model.nu))
    control[:, 0], control[:, 1] = motion.sweep[:-1], motion.sweep_rate[1:]
    data = mujoco.MjData(model)
    data.qpos[0] = motion.sweep[0]
    return drive(model, data, control)


@pytest.mark.parametrize("density", DENSITIES)
@pytest.mark.parametrize("time_step", STEPS)
@pytest.mark.parametrize("air", [COARSE, STEADY], ids=["uvlm", "quasi_steady"])
def test_free_pitch_is_stable(air: AirModel, time_step: float, density: float) -> None:
    """The wing feathers about 0.25 c and lifts; nothing but water and weight turns it."""
    model = free_model(time_step, density, air)
    log = free_log(model, cycles=3)
    aero = log.sensors[:, readings_of(model)]
    lift = aero[:, 6].reshape(3, -1).mean(axis=1) / 0.15193
    assert np.all((lift > 0.6) & (lift < 2.6))
    # it passes 30 deg both ways, and the stops at 90 deg hold
    pitch = np.degrees(log.qpos[:, 1])
    assert pitch.max() > 30.0 and pitch.min() < -30.0
    assert np.abs(pitch).max() < 91.0
    assert np.abs(log.generalized_force[:, 1]).max() < 1e-12
    work = np.einsum("nj,nj->", log.generalized_force, log.mean_qvel) * time_step
    lost = -np.einsum("nj,nj->", log.loss_force, log.mean_qvel) * time_step
    ends = [sum(solid_energy(model, log.qpos[k], log.qvel[k])) for k in (0, -1)]
    fluid = aero[:, 8].sum() * time_step
    assert fluid + ends[1] - ends[0] + lost == pytest.approx(work, rel=1e-4)


def readings_of(model: mujoco.MjModel) -> slice:
    """Columns of the fluid's sensor."""
    start = int(model.sensor(Sensor.AERO).adr[0])
    return slice(start, start + 9)


def test_readings_of_the_fluid_are_first() -> None:
    model = Rig.load().with_(model=STEADY).compile()
    assert readings(model)[Sensor.AERO] == readings_of(model)
