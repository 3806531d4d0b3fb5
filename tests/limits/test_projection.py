import itertools

import numpy as np
import pytest

from flaprig.limits import (
    SINUSOID,
    Bound,
    JointLimits,
    Limits,
    peaks,
    project,
    violations,
)
from flaprig.strokes import FourierStroke, SampledStroke, SunTangStroke, load

A, B, W = np.pi / 3, np.pi / 4, 2.0 * np.pi * 0.2
LOOSE = {"position": (-2.0, 2.0), "velocity": 100.0, "acceleration": 1e3, "jerk": 1e4}


def both(**changes):
    """Limits that are loose but for some bounds, the same for both joints."""
    return Limits(JointLimits(**(LOOSE | changes)), JointLimits(**(LOOSE | changes)))


def test_feasible_stroke_is_left_untouched(sine, rig):
    found = project(sine, rig.with_accelerations(SINUSOID))
    assert found.stroke is sine and not found.changed
    assert found.sweep.amplitude == pytest.approx(A) and found.sweep.active == ()
    kept = project(sine, rig, keep_amplitude=True)
    assert kept.stroke is sine and kept.notices == ()


# share of the sinusoid's need: RMS over amplitude, amplitude ratio, as tried beforehand
TRIED = {0.9: (0.004, 0.99), 0.8: (0.021, 0.97), 0.7: (0.081, 0.86)}
# and today's numbers
TODAY = {0.9: (0.0043644, 0.991458), 0.8: (0.0214236, 0.964915), 0.7: (0.0805690, 0.863547)}


@pytest.mark.parametrize("share", TRIED)
def test_acceleration_below_the_need_of_a_sinusoid(share, sine, rig):
    limits = rig.with_accelerations(SINUSOID.times(share))
    found = project(sine, limits)
    for joint in (found.sweep, found.pitch):
        rms = joint.distance_rms / joint.amplitude
        assert rms == pytest.approx(TRIED[share][0], abs=6e-4)
        assert joint.amplitude_ratio == pytest.approx(TRIED[share][1], abs=6e-3)
        assert joint.active == (Bound.ACCELERATION,) and not joint.amplitude_kept
    assert found.sweep.distance_rms / A == pytest.approx(TODAY[share][0], rel=1e-4)
    assert found.sweep.amplitude_ratio == pytest.approx(TODAY[share][1], abs=1e-5)
    # exact at the bound, and the period is kept
    assert peaks(found.stroke)["sweep"].acceleration == pytest.approx(
        limits.sweep.acceleration, rel=2e-9
    )
    assert violations(found.stroke, limits, 1e-9) == ()
    assert found.stroke.period == pytest.approx(5.0, rel=1e-15)
    assert project(found.stroke, limits).stroke is found.stroke


def test_distances_are_those_of_the_returned_stroke(sine, rig):
    found = project(sine, rig.with_accelerations(SINUSOID.times(0.8)))
    time = np.linspace(0.0, 5.0, 5001)[:-1]
    difference = found.stroke.motion(time).sweep - sine.motion(time).sweep
    assert found.sweep.distance_rms == pytest.approx(np.sqrt(np.mean(difference**2)), rel=1e-6)
    assert found.sweep.distance_max == pytest.approx(np.abs(difference).max(), rel=1e-3)
    assert found.distance_rms == found.sweep.distance_rms > found.pitch.distance_rms
    ratio = found.stroke.sweep_amplitude / A
    assert found.sweep.amplitude_ratio == pytest.approx(ratio, rel=1e-9)


@pytest.mark.parametrize(
    ("bound", "favard", "room"),
    # a spline of 400 samples turns a rate within some of its intervals, not at once
    [("velocity", 4.0, 0.02), ("acceleration", 32.0, 0.002), ("jerk", 192.0, 0.002)],
)
def test_amplitude_that_can_be_kept_is_the_bohr_favard_bound(bound, favard, room, sine):
    """A periodic motion of amplitude A needs at least K A f^k of its k-th derivative."""
    order = list(Bound).index(Bound(bound))
    need = favard * A * 0.2**order
    kept = project(sine, both(**{bound: (1.0 + room) * need}), keep_amplitude=True)
    assert kept.amplitude_kept and "cannot keep" not in "".join(kept.notices)
    assert kept.sweep.amplitude_ratio == pytest.approx(1.0, abs=1e-7)
    assert kept.sweep.active == (Bound(bound),)
    lost = project(sine, both(**{bound: 0.998 * need}), keep_amplitude=True)
    assert not lost.sweep.amplitude_kept and lost.sweep.blocking == (Bound(bound),)
    assert lost.notices[0].startswith("sweep cannot keep its amplitude of 1.0472 rad at 0.2 Hz")
    assert f"within {bound} {0.998 * need:.6g}" in lost.notices[0]
    assert f"(at least {need:.6g} is needed)" in lost.notices[0]
    # what comes instead is the nearest motion
    free = project(sine, both(**{bound: 0.998 * need}))
    assert lost.stroke.sweep == free.stroke.sweep
    with pytest.raises(ValueError, match=f"^project: sweep cannot keep .* within {bound}"):
        project(sine, both(**{bound: 0.998 * need}), keep_amplitude=True, strict=True)


def test_keeping_the_amplitude_costs_distance(sine, rig):
    limits = rig.with_accelerations(SINUSOID.times(0.9))
    free, kept = project(sine, limits), project(sine, limits, keep_amplitude=True)
    assert kept.sweep.amplitude_ratio == pytest.approx(1.0, abs=1e-8)
    assert kept.sweep.distance_rms == pytest.approx(0.0082524 * A, rel=1e-4)
    assert kept.sweep.distance_rms > free.sweep.distance_rms
    assert violations(kept.stroke, limits, 1e-9) == ()


def test_two_bounds_together_can_forbid_an_amplitude(sine):
    # each alone leaves room, 4 A f and 32 A f^2; a bounded rate needs its time to turn
    limits = both(velocity=1.1 * 4.0 * A * 0.2, acceleration=1.1 * 32.0 * A * 0.04)
    found = project(sine, limits, keep_amplitude=True)
    assert found.sweep.blocking == (Bound.VELOCITY, Bound.ACCELERATION)
    assert "velocity" in found.notices[0] and " and acceleration" in found.notices[0]


def test_range_of_the_joint_cuts_both_ends(sine):
    found = project(sine, both(position=(-0.8, 0.9)))
    low, high = peaks(found.stroke)["sweep"].position
    # the range is met but for the short touch, which is bounded a little too strictly
    assert -0.8 <= low < -0.8 + 1e-4 and 0.9 - 1e-4 < high <= 0.9
    assert found.pitch.distance_max < 1e-9
    narrow = project(sine, both(position=(-0.8, 0.9)), keep_amplitude=True)
    assert narrow.sweep.blocking == (Bound.POSITION,)
    assert "within position -0.8 to 0.9 rad" in narrow.notices[0]


def test_amplitude_is_kept_by_a_shift_where_the_range_allows(sine):
    found = project(sine, both(position=(-1.0, 1.2)), keep_amplitude=True)
    assert found.amplitude_kept
    low, high = peaks(found.stroke)["sweep"].position
    assert low >= -1.0 - 1e-9 and high - low == pytest.approx(2.0 * A, rel=1e-7)


def test_answer_is_the_nearest(sine, rig):
    """No feasible stroke on the way from the answer to another feasible one is nearer."""
    limits = rig.with_accelerations(SINUSOID.times(0.8))
    found = project(sine, limits).stroke
    wanted, best = sine.sample(800), found.sample(800)
    rng = np.random.default_rng(4)
    for _ in range(5):
        terms = rng.normal(size=(4, 3)) * [1.0, 0.2, 0.1]
        other = project(FourierStroke.normalized(0.2, *terms, A, B), limits).stroke.sample(800)
        slope = np.mean((best.sweep - wanted.sweep) * (other.sweep - best.sweep))
        assert slope > -1e-5


def test_nine_kinematics_need_only_a_softer_flip(rig):
    for a, b in itertools.product((0.16, 0.32, 0.5), repeat=2):
        stroke = SunTangStroke(0.2, A, B, a, b)
        # the flip's acceleration jumps: no servo can do that, and hardly anything is lost
        limits = rig.with_accelerations(SINUSOID.times(2.5, 11.0))
        found = project(stroke, limits)
        assert found.changed is (b < 0.5)
        assert found.pitch.distance_max < 5e-5 and found.sweep.distance_max < 1e-6
        assert violations(found.stroke, limits, 1e-9) == ()


def test_random_strokes_and_limits(random_stroke, random_limits):
    rng = np.random.default_rng(5)
    for _ in range(25):
        stroke = random_stroke(rng)
        limits = random_limits(rng, stroke, 0.3, 2.0, position=(-0.9, 1.1))
        found = project(stroke, limits, keep_amplitude=bool(rng.integers(2)))
        assert violations(found.stroke, limits, 1e-9) == ()
        if found.changed and not found.notices:
            assert found.sweep.active or found.pitch.active
        assert found.stroke.period == pytest.approx(stroke.period, rel=1e-14)


def test_violation_of_a_millionth_moves_by_a_millionth(sine, rig):
    limits = rig.with_accelerations(SINUSOID.times(1.0 - 1e-6))
    found = project(sine, limits)
    assert 0.0 < found.sweep.distance_max < 1e-5
    assert peaks(found.stroke)["sweep"].acceleration == pytest.approx(
        limits.sweep.acceleration, rel=1e-8
    )


def test_file_of_a_projected_stroke_reads_back_as_it_is(sine, rig, tmp_path):
    found = project(sine, rig.with_accelerations(SINUSOID.times(0.8))).stroke
    found.save(tmp_path / "stroke.csv")
    assert isinstance(found, SampledStroke) and load(tmp_path / "stroke.csv") == found


def test_bad_input_gives_one_sentence(sine, rig):
    for changes, sentence in (
        ({"stroke": 3}, "stroke must be a stroke"),
        ({"limits": None}, "limits must be a Limits"),
        ({"keep_amplitude": 1}, "keep_amplitude must be True or False, got 1"),
        ({"strict": "no"}, "strict must be True or False"),
        ({"samples": 10}, "samples must be a whole number from 32 to 5000"),
    ):
        arguments = {"stroke": sine, "limits": rig} | changes
        with pytest.raises(ValueError, match=f"^project: {sentence}"):
            project(**arguments)


@pytest.mark.parametrize("frequency", [2.21, 10.0, 100.0])
def test_far_beyond_the_limits_there_is_still_a_nearest_stroke(rig, frequency):
    # at 2.21 Hz the solver fails with the usual number of samples, and fewer do
    found = project(SunTangStroke(frequency, A, B, 0.16, 0.16), rig)
    assert found.changed and not violations(found.stroke, rig)
