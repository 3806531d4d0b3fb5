"""The torque feedforward: exact where the fluid has no memory, a help where it has one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from flaprig import UVLM, QuasiSteady, Rig, SunTangStroke, Twin, TwinRun
from flaprig.feedforward import needed_torques
from flaprig.rig import Axis
from flaprig.strokes.stroke import Motion

SINUSOID = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0))
STEADY = Rig.load().with_(model=QuasiSteady())
COARSE = Rig.load().with_(model=UVLM(chordwise=4, spanwise=6, steps_per_cycle=40))


def rms_error(run: TwinRun, axis: Axis) -> float:
    """In [deg]."""
    return float(np.degrees(np.sqrt(np.mean(run.tracking_error(axis) ** 2))))


@pytest.mark.parametrize("axis", list(Axis))
def test_nothing_is_left_for_the_controller_without_a_wake(axis: Axis) -> None:
    """Quasi-steady air: what the motor gives is what it was told; the rest falls with the step."""
    errors = []
    for time_step in (0.002, 0.004):
        run = Twin(STEADY, time_step).run(SINUSOID)
        told = run.result.averaged(getattr(run.motors, f"{axis}_feedforward"))
        gave = run.result.averaged(getattr(run.motors, f"{axis}_motor_torque"))
        assert np.abs(gave - told).max() < 3.0 * time_step * np.abs(gave).max()
        errors.append(rms_error(run, axis))
    assert errors[0] < 0.01
    # in proportion to the step: the pose goes ahead of the command by a share of it
    assert errors[1] / errors[0] == pytest.approx(2.0, rel=0.1)


def test_under_a_wake_the_error_is_a_fraction() -> None:
    """Default lattice: 0.132 to 0.019 deg in sweep and 0.012 to 0.005 in pitch; here the coarse."""
    plain, helped = (Twin(COARSE, 0.002, f).run(SINUSOID) for f in (False, True))
    assert rms_error(helped, Axis.SWEEP) < 0.25 * rms_error(plain, Axis.SWEEP)
    assert rms_error(helped, Axis.PITCH) < 0.6 * rms_error(plain, Axis.PITCH)
    assert not plain.motors.sweep_feedforward.any()
    # the wake takes part of the load away: lift is the same within the scatter
    assert helped.result.cl == pytest.approx(plain.result.cl, rel=0.02)


def test_torque_in_closed_form() -> None:
    """Sweep at a steady rate with the wing flat on: drag alone, which grows with the square."""
    time = np.linspace(0.0, 0.01, 11)
    zero = np.zeros_like(time)

    def torque(rate: float) -> float:
        motion = Motion(time, 0.0 * time, zero, zero + rate, zero, zero, zero)
        table = needed_torques(STEADY, motion)
        assert table.shape == (10, 2)
        np.testing.assert_allclose(table[:, 0], table[0, 0], rtol=1e-9)
        return float(table[0, 0])

    # alpha = 90 deg: C_D of Dickinson, 0.5 rho C_D c r^3 dr over the span
    drag = 1.92 - 1.55 * math.cos(math.radians(2.04 * 90.0 - 9.82))
    exact = 0.5 * 1000.0 * drag * 0.0625 * (0.275**4 - 0.025**4) / 4.0
    assert torque(1.0) == pytest.approx(exact, rel=0.01)
    assert torque(2.0) == pytest.approx(4.0 * torque(1.0), rel=1e-9)


def test_torque_holds_the_added_mass() -> None:
    """From rest the torque is M times the acceleration, the rotor and the water in it."""
    time = np.linspace(0.0, 0.002, 3)
    zero = np.zeros_like(time)
    motion = Motion(time, zero, zero, 2.0 * time, zero, zero + 2.0, zero)
    first = needed_torques(STEADY, motion)[0, 0]
    # rotor 0.0146, plate and arm about 0.002, water 0.019 kg m2
    assert 0.03 < first / 2.0 < 0.04


def test_cycles_after_the_start_share_their_torques() -> None:
    run = Twin(STEADY, 0.005).run(SINUSOID, cycles=4)
    n = run.result.steps_per_cycle
    table = run.motors.sweep_feedforward
    np.testing.assert_allclose(table[n : 2 * n], table[3 * n :], rtol=0, atol=1e-9)
    assert np.abs(table[:n] - table[n : 2 * n]).max() > 0.01
    exact = needed_torques(STEADY, run.commanded)
    np.testing.assert_allclose(table, exact[:, 0], rtol=0, atol=1e-9)
