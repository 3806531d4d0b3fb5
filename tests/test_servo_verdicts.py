"""What a stroke needs of a servo, on torques and speeds whose means are known."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from flaprig.limits import rig_limits
from flaprig.motors import COPPER, RIG_MOTORS, XM430_W350
from flaprig.servo_verdicts import Work, line_point, servo_verdicts, warm_stall_torque
from flaprig.verdict import Tolerances, Verdict

PHASE = 2.0 * np.pi * np.arange(1000) / 1000
LIMITS = rig_limits(RIG_MOTORS).sweep


def work(torque: np.ndarray, speed: np.ndarray, error: float = 0.0) -> Work:
    return Work(torque, torque, speed, error * np.sin(PHASE))


def verdicts(done: Work) -> dict[str, Verdict]:
    found = servo_verdicts("sweep", XM430_W350, LIMITS, done, Tolerances())
    return {verdict.name: verdict for verdict in found}


def test_means_of_a_drag_in_phase_with_the_speed() -> None:
    """Torque and speed together: peak over root two, power half the product, nothing returned."""
    found = verdicts(work(0.4 * np.sin(PHASE), 2.0 * np.sin(PHASE), 0.01))
    assert found["peak_torque"].value == pytest.approx(0.4)
    assert found["rms_torque"].value == pytest.approx(0.4 / math.sqrt(2.0))
    assert found["p99_torque"].value == pytest.approx(0.4 * math.cos(0.005 * math.pi), rel=1e-3)
    assert found["peak_power"].value == pytest.approx(0.8)
    assert found["mean_power"].value == pytest.approx(0.4)
    assert found["mean_regenerative_power"].value == 0.0
    assert found["peak_current"].value == pytest.approx(0.4 * XM430_W350.no_load_speed / 12.0)
    assert found["rms_tracking_error"].value == pytest.approx(0.01 / math.sqrt(2.0))


def test_means_of_an_inertia() -> None:
    """Torque a quarter of a cycle ahead: 1/(2 pi) of the product out, and as much back."""
    found = verdicts(work(0.4 * np.cos(PHASE), 2.0 * np.sin(PHASE)))
    for name in ("mean_power", "mean_regenerative_power"):
        assert found[name].value == pytest.approx(0.8 / (2.0 * math.pi), rel=1e-4)
    assert found["peak_regenerative_power"].value == pytest.approx(0.4, rel=1e-4)


def test_continuous_torque_uses_all_of_the_heat() -> None:
    torque = np.full(1000, XM430_W350.continuous_torque)
    found = verdicts(work(torque, np.zeros(1000)))
    assert found["rms_torque"].margin == pytest.approx(0.0, abs=1e-12)
    assert found["winding_temperature"].value == pytest.approx(80.0)
    assert found["winding_temperature"].margin == pytest.approx(0.0, abs=1e-12)
    hotter = verdicts(work(1.01 * torque, np.zeros(1000)))
    assert not hotter["rms_torque"].holds and not hotter["winding_temperature"].holds


def test_run_away_is_judged() -> None:
    """A torque at which copper heats faster than it cools ends at no temperature."""
    found = verdicts(work(np.full(1000, 4.0), np.zeros(1000)))
    assert found["winding_temperature"].value == math.inf
    assert not found["winding_temperature"].holds


def test_warm_motor_has_a_lower_line() -> None:
    assert warm_stall_torque(XM430_W350, 0.0) == pytest.approx(4.1)
    hot = 4.1 / (1.0 + 55.0 * COPPER)
    assert warm_stall_torque(XM430_W350, XM430_W350.continuous_torque) == pytest.approx(hot)
    # above the limit nothing is meant
    assert warm_stall_torque(XM430_W350, 4.0) == pytest.approx(hot)


def test_nearest_point_of_the_line() -> None:
    """Of 0.5 N m at three quarters of the no-load speed and 1 N m at a quarter: the first."""
    free = XM430_W350.no_load_speed
    torque, speed = np.array([1.0, -0.5, 0.1]), free * np.array([0.25, -0.75, 0.0])
    point = line_point(XM430_W350, work(torque, speed))
    assert (point.torque, point.speed) == (0.5, pytest.approx(0.75 * free))
    warm = warm_stall_torque(XM430_W350, math.sqrt(1.26 / 3.0))
    assert point.available == pytest.approx(0.25 * warm)


def test_braking_is_not_bounded_by_the_line() -> None:
    free = XM430_W350.no_load_speed
    braking = work(np.array([-2.0, 0.1]), free * np.array([0.9, 0.1]))
    assert line_point(XM430_W350, braking).torque == 0.1
    only = work(np.array([-2.0, -1.0]), free * np.array([0.9, 0.1]))
    assert line_point(XM430_W350, only).torque == 0.0


def test_beyond_the_no_load_speed_there_is_nothing() -> None:
    done = work(np.array([0.01, 0.01]), np.array([6.0, 1.0]))
    point = line_point(XM430_W350, done)
    assert (point.speed, point.available) == (6.0, 0.0)
    assert not verdicts(done)["torque_at_speed"].holds


def test_a_saturated_servo_is_judged_by_what_is_asked() -> None:
    torque = np.full(1000, 4.1)
    done = replace(work(torque, np.zeros(1000)), demand=1.5 * torque)
    assert verdicts(done)["peak_torque"].margin == pytest.approx(-0.5)
    assert verdicts(done)["rms_torque"].value == pytest.approx(4.1)


def test_limits_that_are_not_given_are_not_judged() -> None:
    free = replace(LIMITS, torque=None, rms_torque=None, current=None, temperature=None)
    done = work(np.full(1000, 9.0), np.zeros(1000))
    found = servo_verdicts("sweep", XM430_W350, free, done, Tolerances())
    assert {v.name for v in found if not v.holds} == {"torque_at_speed"}
