"""Servo links and soft servos: lag and rounding as on a comparable tank rig."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from flaprig import QuasiSteady, Rig, SunTangStroke, Twin, TwinRun
from flaprig.motors import XM430_W350, Motor, Motors
from flaprig.rig import Axis
from flaprig.servo_link import ServoLink
from flaprig.set_points import Own

RIG = Rig.load().with_(model=QuasiSteady())
SINUSOID = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0))

# docs/servo_lag.md. DYNAMIXEL X as delivered: P gain 800, no D gain, so that only the back-EMF
# damps; 4096 counts; 41 steps of profile velocity, 0.229 rev/min each (e-Manual, control table)
SHOP = replace(
    XM430_W350,
    stiffness=0.5 * XM430_W350.stiffness,
    damping=0.5 * XM430_W350.damping,
    slew_rate=41 * 0.229 * 2.0 * math.pi / 60.0,
)
# positions at 50 Hz, no rates
BUS = ServoLink(update_interval=0.02, delay=0.004, counts=4096, velocity=False)
# holds its angle like a spring of 0.57 N m/rad, hardly damped: a current-limited position servo
SOFT = replace(XM430_W350, stiffness=0.57, damping=0.02)


@cache
def shop_run(frequency: float, feedforward: bool) -> TwinRun:
    """A pitch of trapezoids, flips of 0.35 cycles, by servos of the shop."""
    sweep, pitch = math.radians(60.0), math.radians(45.0)
    stroke = SunTangStroke(frequency, sweep, pitch, 0.3, 0.35)
    rig = RIG.with_(motors=Motors(replace(SHOP, slew_rate=0.0), SHOP))
    return Twin(rig, 0.004, feedforward, link=BUS).run(stroke)


@cache
def soft_run(frequency: float, feedforward: bool) -> TwinRun:
    stroke = SunTangStroke(frequency, math.radians(60.0), math.radians(45.0))
    rig = RIG.with_(motors=Motors(SOFT, XM430_W350))
    return Twin(rig, 0.004, feedforward).run(stroke)


# measured: 0.06 s at 0.08 Hz to 0.21 s at 0.21 Hz
@pytest.mark.parametrize(("frequency", "lag"), [(0.08, 0.06), (0.21, 0.21)])
def test_pitch_lags_as_measured(frequency: float, lag: float) -> None:
    assert shop_run(frequency, False).lag(Axis.PITCH) == pytest.approx(lag, abs=0.01)


@pytest.mark.parametrize(("frequency", "lag"), [(0.08, 0.07), (0.133, 0.125), (0.21, 0.21)])
def test_sweep_of_a_soft_servo_lags_in_proportion_to_the_frequency(
    frequency: float, lag: float
) -> None:
    """Load as f^2 over rate as f: the lag of a spring grows as f."""
    assert soft_run(frequency, False).lag(Axis.SWEEP) == pytest.approx(lag, abs=0.01)


@pytest.mark.parametrize("frequency", [0.08, 0.21])
def test_feedforward_takes_away_the_lag_that_torque_makes(frequency: float) -> None:
    """All of a soft servo's; of the shop's servo that of its back-EMF, 45 ms. Not the bus's."""
    assert abs(soft_run(frequency, True).lag(Axis.SWEEP)) < 1e-3
    plain, helped = (shop_run(frequency, f).lag(Axis.PITCH) for f in (False, True))
    assert plain - helped == pytest.approx(SHOP.damping / SHOP.stiffness, abs=0.006)
    # the mean age of what is held, two steps of five, and the delay
    assert shop_run(frequency, True).lag(Axis.SWEEP) == pytest.approx(0.012, abs=0.001)


def test_pitch_is_rounded_as_measured() -> None:
    """Third harmonic over first: 0.10 at 0.08 Hz and 0.03 at 0.21 Hz; the amplitude stays."""

    def shape(frequency: float) -> tuple[float, float]:
        run = shop_run(frequency, False)
        harmonics = np.fft.rfft(run.result.averaged(run.motors.pitch))
        swing = np.ptp(run.result.averaged(run.motors.pitch)) / 2.0
        return float(abs(harmonics[3] / harmonics[1])), float(np.degrees(swing))

    third, swing = shape(0.08)
    assert third == pytest.approx(0.105, abs=0.01) and swing == pytest.approx(45.0, abs=0.5)
    third, swing = shape(0.21)
    assert third < 0.03 and swing == pytest.approx(45.0, abs=1.0)


def test_slew_rate_is_the_fastest_pitch() -> None:
    run = shop_run(0.21, False)
    rate = np.abs(run.result.averaged(run.result.histories.pitch_rate)).max()
    assert rate == pytest.approx(SHOP.slew_rate, rel=0.05)
    assert np.abs(run.commanded.pitch_rate).max() > 1.4 * rate


@pytest.mark.parametrize("frequency", [0.08, 0.21])
@pytest.mark.parametrize("feedforward", [False, True])
def test_energy_closes_with_lag(frequency: float, feedforward: bool) -> None:
    """1 % is asked for."""
    for run in (shop_run(frequency, feedforward), soft_run(frequency, feedforward)):
        assert np.abs(run.energy.relative_residual).max() < 2e-5


@pytest.mark.parametrize("time_step", [0.001, 0.005])
def test_servo_with_a_slew_rate_keeps_its_law(time_step: float) -> None:
    """MuJoCo's aim is moved before the law is applied, and starts in the stroke's posture."""
    servo: Motor = replace(XM430_W350, slew_rate=0.8)
    rig = RIG.with_(motors=Motors(XM430_W350, servo))
    run = Twin(rig, time_step, link=ServoLink(velocity=False)).run(SINUSOID, cycles=1)
    m = run.motors
    warm = 1.0 + 3.93e-3 * (m.pitch_temperature - servo.ambient_temperature)
    np.testing.assert_allclose(m.pitch_demand / warm, m.pitch_motor_torque, rtol=0, atol=1e-6)
    assert np.degrees(np.abs(run.motors.pitch[:3]).max()) < 0.1
    # not at rest at zero: the sweep's servo
    other = RIG.with_(motors=Motors(servo, XM430_W350))
    run = Twin(other, time_step).run(SINUSOID, cycles=1)
    assert abs(run.motors.sweep[2] - run.motors.sweep[0]) < 1e-3


def test_default_link_is_perfect() -> None:
    m = Twin(RIG, 0.005).run(SINUSOID, cycles=1).motors
    np.testing.assert_array_equal(m.sweep_set_point, m.sweep_command)
    np.testing.assert_array_equal(m.pitch_rate_set_point, m.pitch_rate_command)


def test_link_holds_delays_and_rounds() -> None:
    """Ten steps held, three late, counts of 0.088 deg."""
    link = ServoLink(update_interval=0.05, delay=0.015, counts=4096)
    m = Twin(RIG, 0.005, link=link).run(SINUSOID, cycles=1).motors
    steps = np.arange(m.time.size)
    heard = np.maximum((steps - 3) // 10 * 10, 0)
    count = 2.0 * np.pi / 4096
    np.testing.assert_array_equal(
        m.sweep_set_point, np.rint(m.sweep_command[heard] / count) * count
    )
    np.testing.assert_array_equal(m.pitch_rate_set_point, m.pitch_rate_command[heard])
    np.testing.assert_array_equal(link.heard(5, 0.005), np.zeros(5))


def test_delay_is_lag() -> None:
    """0.1 s of delay is 0.1 s of lag at any frequency."""
    for frequency in (0.1, 0.2):
        stroke = SunTangStroke(frequency, 1.0, 0.7)
        run = Twin(RIG, 0.005, link=ServoLink(delay=0.1), limits=Own.RIG).run(stroke)
        for axis in Axis:
            assert run.lag(axis) == pytest.approx(0.1, abs=2e-3)


def test_nothing_commanded_has_no_lag() -> None:
    still = SunTangStroke(0.2, 1.0, 0.0)
    assert Twin(RIG, 0.01).run(still, cycles=1).lag(Axis.PITCH) == 0.0


BAD = {
    "update_interval": (-0.1, "update_interval must be a number from 0 to 1 s, got -0.1"),
    "delay": (math.nan, "delay must be a number from 0 to 10 s, got nan"),
    "counts": (4096.5, "counts must be a whole number from 4"),
    "velocity": (1, "velocity must be True or False, got 1"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_link_is_one_sentence(name: str) -> None:
    value, sentence = BAD[name]
    with pytest.raises(ValueError, match=f"ServoLink: {sentence}"):
        ServoLink(**{name: value})  # type: ignore[arg-type]


def test_bad_slew_rate_is_one_sentence() -> None:
    with pytest.raises(ValueError, match="Motor: slew_rate must be a positive number, got -1"):
        replace(XM430_W350, slew_rate=-1.0)
