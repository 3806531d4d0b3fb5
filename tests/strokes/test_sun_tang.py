import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from flaprig.strokes import FourierStroke, PitchProfile, Stroke, SunTangStroke

SINUSOID = SunTangStroke(0.2, np.pi / 3, np.pi / 4)
DURATIONS = [0.16, 0.32, 0.5]

strokes = st.builds(
    SunTangStroke,
    frequency=st.floats(0.01, 300.0),
    sweep_amplitude=st.floats(0.01, np.pi),
    pitch_amplitude=st.floats(0.01, np.pi),
    sweep_duration=st.floats(0.02, 0.5),
    pitch_duration=st.floats(0.02, 0.5),
    pitch_profile=st.sampled_from(PitchProfile),
)


def away_from_flip_ends(stroke, margin=1e-3):
    """Phases of one cycle that keep off every instant where a derivative jumps."""
    phase = (np.arange(400) + 0.37) / 400
    ends = [
        c + s * d / 2
        for c in (0.0, 0.5, 1.0)
        for s in (-1, 1)
        for d in (stroke.sweep_duration, stroke.pitch_duration)
    ]
    return phase[np.min(np.abs(phase[:, None] - ends), axis=1) > margin] / stroke.frequency


@settings(max_examples=60)
@given(stroke=strokes)
def test_rates_and_accelerations_are_derivatives(stroke, assert_consistent):
    assert_consistent(stroke, away_from_flip_ends(stroke), 1e-6)


@settings(max_examples=60)
@given(stroke=strokes, cycles=st.integers(-50, 50))
def test_periodic_with_exact_amplitudes(stroke, cycles):
    quarters = np.array([0.0, 0.25, 0.5, 0.75])
    motion = stroke.motion((quarters + cycles) / stroke.frequency)
    phi, theta = stroke.sweep_amplitude, stroke.pitch_amplitude
    np.testing.assert_allclose(motion.sweep, [-phi, 0, phi, 0], atol=1e-10)
    np.testing.assert_allclose(motion.pitch, [0, theta, 0, -theta], atol=1e-10 / 0.02)
    one = stroke.sample(360)
    assert np.abs(one.sweep).max() <= phi * (1 + 1e-14)
    assert np.abs(one.pitch).max() <= theta * (1 + 1e-14)


@settings(max_examples=60)
@given(stroke=strokes)
def test_half_strokes_mirror_and_leading_edge_leads(stroke):
    time = away_from_flip_ends(stroke)
    now, later = stroke.motion(time), stroke.motion(time + 0.5 * stroke.period)
    for name in ("sweep", "pitch", "sweep_rate", "pitch_rate", "sweep_acceleration"):
        values = getattr(now, name)
        atol = 1e-9 * np.abs(values).max()
        np.testing.assert_allclose(getattr(later, name), -values, atol=atol)
    # positive angle of attack: pitch has the sign of the sweep rate
    assert np.all(now.pitch * now.sweep_rate > 0)


def test_durations_of_half_a_cycle_are_exactly_sinusoidal():
    sinusoid = FourierStroke(0.2, [-np.pi / 3], [0.0], [0.0], [np.pi / 4])
    time = np.linspace(-7.0, 13.0, 1001)
    ours, theirs = SINUSOID.motion(time), sinusoid.motion(time)
    for name in vars(ours):
        np.testing.assert_allclose(getattr(ours, name), getattr(theirs, name), atol=2e-14)


def peaks(stroke):
    motion = stroke.sample(20000)
    return np.abs(motion.sweep_acceleration).max(), np.abs(motion.pitch_acceleration).max()


def test_peak_accelerations_of_the_rig():
    # closed form of the sinusoid, then the figures of the physics page
    w = 2 * np.pi * 0.2
    assert peaks(SINUSOID) == pytest.approx((w**2 * np.pi / 3, w**2 * np.pi / 4), rel=1e-12)
    assert peaks(SINUSOID) == pytest.approx((1.654, 1.240), abs=5e-4)
    nine = [
        peaks(SunTangStroke(0.2, np.pi / 3, np.pi / 4, d_phi, d_theta))
        for d_phi in DURATIONS
        for d_theta in DURATIONS
    ]
    assert np.max(nine, axis=0) == pytest.approx((3.7227565, 12.1118268), rel=1e-5)


@pytest.mark.parametrize("duration", DURATIONS)
def test_raised_cosine_is_smooth_and_half_sine_jumps(duration):
    end = np.array([duration / 2 - 1e-9, duration / 2 + 1e-9]) / 0.2
    jumps = {}
    for profile in PitchProfile:
        stroke = SunTangStroke(0.2, 1.0, 1.0, 0.5, duration, profile)
        jumps[profile] = abs(np.ptp(stroke.motion(end).pitch_acceleration))
    assert jumps[PitchProfile.RAISED_COSINE] < 1e-6
    if duration < 0.5:
        assert jumps["half_sine"] == pytest.approx((np.pi * 0.2 / duration) ** 2, rel=1e-6)


def test_raised_cosine_rate_is_sun_and_tangs():
    # peak rate 2 theta0 / duration per cycle, at the reversal, zero at the ends of the flip
    stroke = SunTangStroke(2.0, 1.0, 0.7, 0.5, 0.3, "raised_cosine")
    rate = stroke.motion(np.array([0.0, 0.075, 0.15, 0.2]) / 2.0).pitch_rate
    peak = 2 * 2 * 0.7 / 0.3 * 2.0
    np.testing.assert_allclose(rate, [peak, peak / 2, 0.0, 0.0], atol=1e-12 * peak)


def test_sweep_rate_is_constant_between_reversals():
    stroke = SunTangStroke(1.0, 1.0, 0.5, 0.2, 0.2)
    motion = stroke.motion(np.linspace(0.11, 0.39, 50))
    np.testing.assert_allclose(motion.sweep_rate, 2 / (0.5 - 0.2 * (1 - 2 / np.pi)), rtol=1e-14)
    assert np.all(motion.sweep_acceleration == 0.0)


def test_any_shape_and_protocol():
    assert isinstance(SINUSOID, Stroke)
    assert SINUSOID.period == 5.0
    assert SINUSOID.motion(1.25).sweep.shape == ()
    assert SINUSOID.motion(np.zeros((2, 3))).pitch_acceleration.shape == (2, 3)
    np.testing.assert_allclose(SINUSOID.sample(4).time, [0, 1.25, 2.5, 3.75])
    assert SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.5, 0.5, "half_sine") == SINUSOID
    assert hash(SINUSOID) == hash(SunTangStroke(0.2, np.pi / 3, np.pi / 4))


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"frequency": 0.0}, "frequency must be a positive number in Hz, got 0.0"),
        ({"frequency": np.inf}, "frequency must be a number from"),
        ({"frequency": "fast"}, "frequency must be a positive number in Hz, got 'fast'"),
        ({"sweep_amplitude": 60}, "sweep_amplitude must be .*radians, not degrees.*got 60"),
        ({"pitch_amplitude": np.nan}, "pitch_amplitude must be .*, got nan"),
        ({"sweep_duration": 0.0}, "sweep_duration must be a number from 0.001 to 0.5 cycles"),
        ({"pitch_duration": 0.6}, "pitch_duration must be .* cycles, got 0.6"),
        ({"pitch_profile": "sine"}, "one of half_sine, raised_cosine, got 'sine'"),
        ({"pitch_profile": []}, "one of half_sine, raised_cosine, got "),
    ],
)
def test_bad_fields_give_one_sentence(changes, sentence):
    fields = {"frequency": 0.2, "sweep_amplitude": 1.0, "pitch_amplitude": 0.5} | changes
    with pytest.raises(ValueError, match=f"^SunTangStroke: .*{sentence}"):
        SunTangStroke(**fields)


@pytest.mark.parametrize("time", [np.nan, [0.0, np.inf], "now", [None], [True], 1j, [[0], [0, 1]]])
def test_bad_time_gives_one_sentence(time):
    with pytest.raises(ValueError, match=r"^SunTangStroke: time"):
        SINUSOID.motion(time)


@pytest.mark.parametrize("count", [0, -1, 1.5, np.nan, "3", None, 10**9])
def test_bad_count_gives_one_sentence(count):
    with pytest.raises(ValueError, match=r"^SunTangStroke: count must be a whole number"):
        SINUSOID.sample(count)
