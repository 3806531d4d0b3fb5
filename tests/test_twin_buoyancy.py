"""The zero of the twin: load cell, servo torque and energy of a plate that the water carries."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import mujoco
import numpy as np
import pytest

from flaprig import (
    AIR,
    RIG_WING,
    UVLM,
    QuasiSteady,
    Rig,
    SunTangStroke,
    Twin,
    TwinRun,
    Wing,
    simulate,
)
from flaprig.feedforward import needed_torques
from flaprig.rig import Sensor, controls, coordinates, readings
from flaprig.twin import at_rest
from flaprig.twin_log import drive
from flaprig.twin_record import balance

SINUSOID = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0))
COARSE = UVLM(chordwise=4, spanwise=6, steps_per_cycle=40)
G = 9.81
# moment of the displaced water about the quarter-chord axis, a quarter chord off the centre [N m]
WATER_MOMENT = 1000.0 * RIG_WING.volume * G * 0.015625


def rest(rig: Rig, pitch: float = 0.0) -> tuple[np.ndarray, np.ndarray]:
    """Load cell and fluid of the rig, standing still at a pitch."""
    model = rig.compile()
    data = mujoco.MjData(model)
    data.qpos[coordinates(model)[0]] = 0.3, pitch
    # the servos stand where they are told to
    data.ctrl[controls(model).position] = 0.3, pitch
    mujoco.mj_step(model, data)
    where = readings(model)
    return data.sensordata[where[Sensor.LOAD_CELL]], data.sensordata[where[Sensor.AERO]]


@pytest.mark.parametrize(
    "wing",
    [
        RIG_WING,
        replace(RIG_WING, density=950.0),
        Wing.beta(0.24, 0.06, 0.5),
        Wing.rectangular(0.3, 0.05, 0.04, 0.5, 0.002),
    ],
    ids=["rig", "floats", "beta", "mid-chord"],
)
def test_the_cell_at_rest_reads_weight_less_buoyancy(wing: Wing) -> None:
    """(rho plate - rho water) V g, and its moment about the cell's place at the root."""
    rig = Rig.load().with_(wing=wing)
    cell, fluid = rest(rig)
    # the wing hangs with its chord down
    force = (wing.density - 1000.0) * wing.volume * G
    assert cell[0] == pytest.approx(force, rel=1e-4)
    arm = wing.centroid[1] - wing.root_offset
    assert cell[5] == pytest.approx(-arm * force, rel=1e-4)
    # no lift, no wrench without motion
    np.testing.assert_allclose(fluid, 0.0, atol=1e-6)


def test_the_rig_as_built() -> None:
    assert rest(Rig.load())[0][0] == pytest.approx(0.083, rel=0.01)
    assert rest(Rig.load().with_(buoyancy=False))[0][0] == pytest.approx(0.543, rel=0.01)
    # air carries next to nothing
    assert rest(Rig.load().with_(fluid=AIR))[0][0] == pytest.approx(0.5421, rel=1e-3)


@cache
def run_of(model: UVLM | QuasiSteady, buoyancy: bool) -> TwinRun:
    return Twin(Rig.load().with_(model=model, buoyancy=buoyancy), 0.002).run(SINUSOID)


def pitch_motor(run: TwinRun) -> np.ndarray:
    """[mN m] of the averaged cycles."""
    return 1e3 * run.result.averaged(run.motors.pitch_motor_torque)


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def test_the_servo_turns_without_the_help_of_the_weight() -> None:
    """rms 13.7 instead of 10.0 mN m: the weight pulls the plate to the middle as the rotor's
    inertia is to be pulled, so that where water carries six parts of seven of it the servo has to.
    """
    wet, dry = (run_of(QuasiSteady(), b) for b in (True, False))
    assert rms(pitch_motor(wet)) == pytest.approx(13.71, abs=0.05)
    assert rms(pitch_motor(dry)) == pytest.approx(10.05, abs=0.05)
    # the difference is the displaced water's moment, to the last digit that tracking leaves
    pitch = wet.result.averaged(wet.motors.pitch)
    closed = -1e3 * WATER_MOMENT * np.sin(pitch)
    np.testing.assert_allclose(pitch_motor(wet) - pitch_motor(dry), closed, atol=1e-3)
    # the same in closed form, without a twin: without any weight, with it, and less buoyancy
    motion = SINUSOID.motion(np.linspace(0.0, 5.0, 1001)[:-1])
    plate, x = RIG_WING.inertia, 0.015625
    inertia = (wet.servos.pitch.rotor_inertia + plate[1, 1]) * motion.pitch_acceleration
    inertia += plate[0, 1] * motion.sweep_acceleration * np.cos(motion.pitch)
    fine = simulate(RIG_WING, SINUSOID, QuasiSteady(steps_per_cycle=1000), cycles=1)
    bare, arm = inertia - fine.pitch_torque, G * x * np.sin(motion.pitch)
    found = [rms(1e3 * (bare + mass * arm)) for mass in (0.0, RIG_WING.mass, 180 * RIG_WING.volume)]
    assert found == pytest.approx([14.36, 10.04, 13.70], abs=0.02)


@pytest.mark.parametrize("model", [COARSE, QuasiSteady()], ids=["uvlm", "quasi-steady"])
def test_lift_drag_and_power_are_those_of_the_motion(model: UVLM | QuasiSteady) -> None:
    wet, dry = (run_of(model, b).result for b in (True, False))
    assert wet.cl == pytest.approx(dry.cl, rel=2e-3)
    assert wet.cd == pytest.approx(dry.cd, rel=2e-3)
    # 0.46 N of buoyancy would be a lift coefficient of 2.7 more
    share = wet.histories.pitch_torque_buoyancy
    np.testing.assert_allclose(share, WATER_MOMENT * np.sin(wet.histories.pitch), atol=1e-12)
    h = wet.histories
    power = -(h.sweep_torque * h.sweep_rate + (h.pitch_torque - share) * h.pitch_rate)
    np.testing.assert_allclose(h.power, power, atol=0.01 * np.abs(power).max())


@pytest.mark.parametrize("model", [COARSE, QuasiSteady()], ids=["uvlm", "quasi-steady"])
def test_energy_is_found_again(model: UVLM | QuasiSteady) -> None:
    assert np.abs(run_of(model, True).energy.relative_residual).max() < 1e-6


def test_buoyancy_stores_energy_within_a_cycle() -> None:
    """Tenths of a cycle end at another pitch than they began at."""
    rig = Rig.load().with_(model=QuasiSteady())
    twin = Twin(rig, 0.001)
    model = twin.compile(SINUSOID)
    points, control = twin.commands(model, SINUSOID, 1)
    log = drive(model, at_rest(model, points.motion), control)
    power = log.sensors[:, readings(model)[Sensor.AERO]][:, 8]
    found = balance(rig, model, log, power, 10)
    assert np.abs(found.residual).max() < 1e-6 * found.motor_work.sum()
    # without the water's share it is not
    dry = balance(rig.with_(buoyancy=False), model, log, power, 10)
    assert np.abs(dry.residual).max() > 1e-3 * dry.motor_work.sum()


def test_twin_and_simulate_mean_the_same_pitch_torque() -> None:
    run = run_of(QuasiSteady(), True).result
    theirs = simulate(
        RIG_WING, SINUSOID, QuasiSteady(steps_per_cycle=2500), cycles=3, buoyancy=True
    )
    ours, other = (r.averaged(r.pitch_torque) for r in (run, theirs))
    np.testing.assert_allclose(ours, other, atol=0.02 * np.abs(other).max())


def test_the_feedforward_knows_it() -> None:
    motion = SINUSOID.motion(np.linspace(0.0, 5.0, 101))
    wet, dry = (
        needed_torques(Rig.load().with_(buoyancy=b, model=QuasiSteady()), motion)
        for b in (True, False)
    )
    np.testing.assert_allclose((wet - dry)[:, 0], 0.0, atol=1e-12)
    closed = -WATER_MOMENT * np.sin(motion.pitch[:-1])
    np.testing.assert_allclose((wet - dry)[:, 1], closed, rtol=1e-9, atol=1e-15)
