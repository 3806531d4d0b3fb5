import numpy as np
import pytest

from flaprig.limits import Bound, JointLimits, Limits, peaks, violations
from flaprig.strokes import FourierStroke, SampledStroke, SunTangStroke

A, B, W = np.pi / 3, np.pi / 4, 2.0 * np.pi * 0.2


def test_sinusoid(sine):
    for joint, size in (("sweep", A), ("pitch", B)):
        found = peaks(sine)[joint]
        assert found.position == pytest.approx((-size, size), rel=1e-12)
        assert found.velocity == pytest.approx(size * W, rel=1e-12)
        assert found.acceleration == pytest.approx(size * W**2, rel=1e-12)
        assert found.jerk == pytest.approx(size * W**3, rel=1e-9)


@pytest.mark.parametrize("duration", [0.05, 0.16, 0.32])
def test_piecewise_strokes(duration):
    sweep = peaks(SunTangStroke(0.2, A, B, duration, duration))["sweep"]
    plateau, rate = 2.0 * A * 0.2 / (0.5 - duration * (1.0 - 2.0 / np.pi)), np.pi * 0.2 / duration
    assert sweep.velocity == pytest.approx(plateau, rel=1e-12)
    assert sweep.acceleration == pytest.approx(plateau * rate, rel=1e-12)
    # the jerk is largest at a jump of it
    assert sweep.jerk == pytest.approx(plateau * rate**2, rel=1e-8)
    pitch = peaks(SunTangStroke(0.2, A, B, duration, duration))["pitch"]
    assert pitch.acceleration == pytest.approx(B * rate**2, rel=1e-12)
    assert pitch.jerk == np.inf
    smooth = peaks(SunTangStroke(0.2, A, B, duration, duration, "raised_cosine"))["pitch"]
    assert smooth.jerk == pytest.approx(8.0 * np.pi**2 * B * (0.2 / duration) ** 3, rel=1e-8)


def test_samples_and_formula_agree(random_stroke):
    formula = random_stroke(np.random.default_rng(2), 0.2)
    motion = formula.sample(400)
    samples = peaks(SampledStroke(motion.time, motion.sweep, motion.pitch))
    for joint, found in peaks(formula).items():
        assert samples[joint].position == pytest.approx(found.position, abs=1e-9)
        assert samples[joint].acceleration == pytest.approx(found.acceleration, rel=1e-6)
        assert samples[joint].jerk == pytest.approx(found.jerk, rel=1e-5)


def test_never_less_than_on_a_fine_grid(random_stroke):
    rng = np.random.default_rng(3)
    for _ in range(20):
        stroke = random_stroke(rng)
        motion, found = stroke.sample(20_000), peaks(stroke)
        for joint in ("sweep", "pitch"):
            low, high = found[joint].position
            assert low <= getattr(motion, joint).min() and high >= getattr(motion, joint).max()
            for name in ("rate", "acceleration"):
                value = found[joint].velocity if name == "rate" else found[joint].acceleration
                assert value >= np.abs(getattr(motion, f"{joint}_{name}")).max()


def test_violations_name_joint_bound_and_values(sine):
    wide = JointLimits((-2.0, 2.0), 10.0, 10.0, 10.0)
    tight = JointLimits((-0.5, 2.0), 0.9 * B * W, 10.0, 10.0)
    assert violations(sine, Limits(wide, wide)) == ()
    found = violations(sine, Limits(wide, tight))
    assert [(v.joint, v.bound) for v in found] == [
        ("pitch", Bound.POSITION),
        ("pitch", Bound.VELOCITY),
    ]
    assert (found[0].value, found[0].limit) == (pytest.approx(-B), -0.5)
    assert str(found[1]) == "pitch velocity 0.98696 rad/s against 0.888264 rad/s"


def test_bounds_are_met_to_a_billionth(sine):
    for share, count in ((1.0 - 2e-9, 8), (1.0 - 1e-10, 0)):
        limits = Limits(
            *(
                JointLimits((-s * share, s * share), *(s * share * W**k for k in (1, 2, 3)))
                for s in (A, B)
            )
        )
        assert len(violations(sine, limits)) == count


def test_bad_input_gives_one_sentence(sine):
    with pytest.raises(ValueError, match=r"^peaks: stroke must be a stroke"):
        peaks(None)
    with pytest.raises(ValueError, match=r"^violations: limits must be a Limits"):
        violations(sine, 3.0)


def test_resting_pitch_needs_nothing():
    found = peaks(FourierStroke(0.2, [-A], [0.0], [0.0], [0.0], pitch_mean=0.3))["pitch"]
    assert found.position == (0.3, 0.3)
    assert (found.velocity, found.acceleration, found.jerk) == (0.0, 0.0, 0.0)


class Drifting:
    """A user's own stroke, which changes."""

    frequency, period = 0.2, 5.0

    def __init__(self, size):
        self.size = size

    def __getattr__(self, name):
        return getattr(SunTangStroke(0.2, self.size, B), name)


def test_a_stroke_that_changes_is_searched_anew():
    stroke = Drifting(A)
    assert peaks(stroke)["sweep"].position[1] == pytest.approx(A)
    stroke.size = 0.5
    assert peaks(stroke)["sweep"].position[1] == pytest.approx(0.5)


def test_what_is_given_out_is_the_callers(sine):
    peaks(sine).clear()
    assert set(peaks(sine)) == {"sweep", "pitch"}
