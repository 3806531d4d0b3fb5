"""The twin within limits: the nearest stroke, the start from rest, saturation, what is kept."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from flaprig import QuasiSteady, Rig, SunTangStroke, Twin, TwinRun
from flaprig.limits import SINUSOID as SINUSOIDS_NEED
from flaprig.limits import JointLimits, Limits, RuckigFilter, project, rig_limits
from flaprig.motors import RIG_MOTORS, XM430_W350, Motors
from flaprig.rig import Axis
from flaprig.set_points import Own, own_limits, set_points
from flaprig.strokes.stroke import Stroke
from flaprig.twin_record import settled_cycles

SINUSOID = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0))
# its pitch acceleration jumps, so no jerk will do
FLIP = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0), 0.32, 0.32)
LIMITS = rig_limits(RIG_MOTORS)
# a fifth less than the sinusoid needs
TIGHT = LIMITS.with_accelerations(SINUSOIDS_NEED.times(0.8))
RIG = Rig.load().with_(model=QuasiSteady())
STEP = 0.005


@cache
def run_of(
    stroke: Stroke = SINUSOID, limits: Limits | Own | None = Own.RIG, cycles: int = 3
) -> TwinRun:
    return Twin(RIG, STEP, limits=limits).run(stroke, cycles)


def test_own_limits_are_those_of_servos_wing_and_stops() -> None:
    assert own_limits(RIG, RIG.compile()) == LIMITS
    weak = replace(XM430_W350, continuous_torque=0.1)
    rig = RIG.with_(motors=Motors(weak, XM430_W350))
    found = own_limits(rig, rig.compile())
    assert found.sweep.acceleration < 0.2 * LIMITS.sweep.acceleration
    assert found.pitch == LIMITS.pitch


def test_a_feasible_stroke_passes_untouched() -> None:
    run = run_of()
    assert run.projection is not None and run.projection.stroke is SINUSOID
    assert not run.projection.changed
    late = run.commanded.time >= run.joined_at
    asked = SINUSOID.motion(run.commanded.time[late])
    for name in ("sweep", "pitch", "sweep_rate", "pitch_rate", "pitch_acceleration"):
        np.testing.assert_allclose(
            getattr(run.commanded, name)[late], getattr(asked, name), rtol=0, atol=1e-12
        )


def test_the_start_is_from_rest_and_within_the_limits() -> None:
    """Angle, rate and acceleration are continuous from zero; each bound holds in every step."""
    motion = run_of().commanded
    for axis in Axis:
        allowed: JointLimits = getattr(LIMITS, axis)
        angle, rate, acceleration = (
            getattr(motion, axis + end) for end in ("", "_rate", "_acceleration")
        )
        assert rate[0] == acceleration[0] == 0.0
        assert np.abs(rate).max() <= allowed.velocity
        assert np.abs(acceleration).max() <= allowed.acceleration * (1.0 + 1e-9)
        assert np.abs(np.diff(acceleration)).max() <= allowed.jerk * STEP * (1.0 + 1e-9)
        # no jump: a step moves by its mean rate, but for the bounded acceleration
        slack = allowed.acceleration * STEP**2
        np.testing.assert_allclose(np.diff(angle), rate[1:] * STEP, rtol=0, atol=slack)
    assert 0.05 < run_of().joined_at < 0.3


def test_raw_set_points_jump() -> None:
    """Without limits the pitch is told its full rate at once: the check above can fail."""
    run = run_of(SINUSOID, None)
    assert run.projection is None and run.joined_at == 0.0
    assert run.commanded.pitch_rate[0] > 0.9
    assert "rms_sweep_projection_rad" in run.summary()


def test_set_points_are_the_filters_in_every_tick() -> None:
    """The filter is stepped only until it has joined: stepped to the end it says the same."""
    steps = 400
    found = set_points(FLIP, LIMITS, STEP, steps)
    assert found.projection is not None
    first = found.motion
    control = RuckigFilter(LIMITS, STEP, (first.sweep[0], first.pitch[0]))
    control.follow(found.projection.stroke)
    states = [control.state] + [control.step() for _ in range(steps)]
    np.testing.assert_allclose(first.sweep, [s.position[0] for s in states], rtol=0, atol=1e-11)
    np.testing.assert_allclose(first.pitch, [s.position[1] for s in states], rtol=0, atol=1e-11)
    np.testing.assert_allclose(
        first.pitch_rate, [s.velocity[1] for s in states], rtol=0, atol=1e-11
    )


def test_start_spoils_no_mean() -> None:
    """The third cycle is that of a run without limits, and of one more cycle."""
    free, more = run_of(SINUSOID, None), run_of(cycles=4)
    assert run_of().result.averaged_cycles == (3, 3)
    for other in (free, more):
        assert run_of().result.cl == pytest.approx(other.result.cl, rel=1e-5)
        assert run_of().result.lift_to_drag == pytest.approx(other.result.lift_to_drag, rel=1e-5)
    assert run_of().summary()["joined_at_s"] == run_of().joined_at


@pytest.mark.parametrize(
    ("cycles", "joined", "expected"),
    [(1, 0.1, (1, 1)), (3, 0.1, (3, 3)), (5, 2.0, (3, 5)), (5, 2.1, (4, 5)), (5, 9.0, (5, 5))],
)
def test_a_long_start_is_left_out_of_the_means(
    cycles: int, joined: float, expected: tuple[int, int]
) -> None:
    """The two cycles that are left out hold every start seen so far; a longer one takes more."""
    assert settled_cycles(cycles, joined) == expected


def test_a_stroke_beyond_the_limits_is_replaced_by_the_nearest() -> None:
    run = run_of(SINUSOID, TIGHT)
    nearest = project(SINUSOID, TIGHT)
    assert run.projection is not None and run.projection.changed
    assert run.projection.distance_rms == nearest.distance_rms
    summary = run.summary()
    assert summary["rms_sweep_projection_rad"] == nearest.sweep.distance_rms
    # coefficients divide by the force of the stroke asked for, though the motion is smaller
    assert run.result.reference_force == run_of().result.reference_force
    swing = 0.5 * np.ptp(run.result.averaged(run.motors.sweep)) / SINUSOID.sweep_amplitude
    assert swing == pytest.approx(nearest.sweep.amplitude_ratio, abs=1e-3)
    assert nearest.sweep.amplitude_ratio == pytest.approx(0.965, abs=0.005)
    # the servos are judged by what they were told
    assert np.degrees(np.abs(run.tracking_error(Axis.SWEEP)).max()) < 0.05
    late = run.commanded.time > run.joined_at
    assert np.abs(run.commanded.sweep_acceleration[late]).max() <= TIGHT.sweep.acceleration * (
        1.0 + 1e-9
    )


def test_flips_without_jerk_limit_change_by_microradians() -> None:
    run = run_of(FLIP)
    assert run.projection is not None and run.projection.changed
    assert run.projection.distance_max < 5e-5
    # the sweep needs no change, but is sampled with the pitch
    assert run.projection.sweep.distance_max < 1e-7


def test_angles_beyond_the_stops_come_back_to_them() -> None:
    wide = SunTangStroke(0.2, 1.7, math.radians(45.0))
    run = run_of(wide, cycles=1)
    assert np.abs(run.commanded.sweep).max() == pytest.approx(math.pi / 2.0, abs=1e-8)
    assert np.abs(run.motors.sweep).max() < math.pi / 2.0 + 2e-3


def test_limits_wider_than_the_stops_do_not_help() -> None:
    free = replace(LIMITS.sweep, position=(-2.0, 2.0))
    with pytest.raises(ValueError, match=r"stroke's sweep must be within the joint's range"):
        Twin(RIG, limits=replace(LIMITS, sweep=free)).run(SunTangStroke(0.2, 1.7, 0.5))


@pytest.mark.parametrize("limits", [Own.RIG, None, TIGHT], ids=["own", "none", "tight"])
@pytest.mark.parametrize("feedforward", [False, True])
def test_motor_work_is_found_again(limits: Limits | Own | None, feedforward: bool) -> None:
    """Motors = kinetic + potential + fluid + losses: 1 % is asked for."""
    run = Twin(RIG, STEP, feedforward, limits).run(FLIP)
    assert np.abs(run.energy.relative_residual).max() < 1e-5


# ---- saturation


def weak_run(no_load_speed: float) -> TwinRun:
    """A sweep servo that hardly makes the sinusoid's 1.3 rad/s."""
    weak = replace(XM430_W350, no_load_speed=no_load_speed)
    return Twin(RIG.with_(motors=Motors(weak, XM430_W350)), STEP, limits=None).run(SINUSOID)


def test_saturation_is_where_the_supply_ends() -> None:
    """Torque = the line from stall torque to no-load speed, in each saturated step."""
    run, motor = weak_run(1.2), replace(XM430_W350, no_load_speed=1.2)
    saturated = run.saturated(Axis.SWEEP)[:-1]
    assert 0.4 < saturated.mean() < 0.5
    assert run.summary()["sweep_saturated_fraction"] == run.saturated(Axis.SWEEP).mean()
    assert not run.saturated(Axis.PITCH).any()
    m, rate = run.motors, run.result.histories.sweep_rate
    line = motor.stall_torque * (np.sign(m.sweep_demand) - rate / motor.no_load_speed)[:-1]
    # MuJoCo steps its law implicitly with the controller's damping
    line -= motor.damping * np.diff(rate)
    torque = m.sweep_motor_torque[:-1]
    np.testing.assert_allclose(torque[saturated], line[saturated], rtol=0, atol=1e-5)
    np.testing.assert_allclose(torque[~saturated], m.sweep_demand[:-1][~saturated], atol=1e-5)
    # the servo gives less than it asks for, and is late
    assert np.abs(m.sweep_demand).max() > 10.0 * np.abs(torque).max()
    assert run.lag(Axis.SWEEP) > 0.02
    assert np.abs(run.energy.relative_residual).max() < 1e-5


def test_limits_keep_a_weak_servo_out_of_saturation() -> None:
    weak = replace(XM430_W350, no_load_speed=1.2)
    run = Twin(RIG.with_(motors=Motors(weak, XM430_W350)), STEP).run(SINUSOID)
    assert run.projection is not None and run.projection.changed
    assert not run.saturated(Axis.SWEEP).any()
    assert np.degrees(np.abs(run.tracking_error(Axis.SWEEP)).max()) < 0.1


def test_the_rigs_own_servos_never_saturate() -> None:
    assert run_of().summary()["sweep_saturated_fraction"] == 0.0
    assert run_of().summary()["pitch_saturated_fraction"] == 0.0
