import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from flaprig.strokes import FourierStroke, Stroke

BEST = FourierStroke.normalized(
    # the optimum that the paper's reward has under these laws
    0.2,
    [-1, 0, 0.06],
    [0, 0, 0],
    [0, 0, 0],
    [1, 0, 0.11],
    np.pi / 3,
    np.pi / 4,
)


def coefficients(least, most):
    size = st.shared(st.integers(least, most), key="harmonics")
    one = size.flatmap(lambda n: st.lists(st.floats(-1, 1), min_size=n, max_size=n))
    return st.tuples(one, one, one, one)


def normalized(lists, phi=1.0, theta=0.7):
    for pair in (lists[:2], lists[2:]):
        assume(np.abs(pair).max() > 1e-6)
    return FourierStroke.normalized(0.2, *lists, phi, theta)


@settings(max_examples=60)
@given(lists=coefficients(1, 8))
def test_rates_and_accelerations_are_derivatives(lists, assert_consistent):
    stroke = normalized(lists)
    assert_consistent(stroke, np.linspace(0.0, 5.0, 100), 1e-8)


@settings(max_examples=100)
@given(lists=coefficients(1, 12))
def test_normalized_reaches_both_amplitudes_and_no_further(lists):
    stroke = normalized(lists)
    fine = stroke.sample(20011)
    for angle, amplitude in ((fine.sweep, 1.0), (fine.pitch, 0.7)):
        # a maximum lies within half a step of a sample: curvature at most 12^2 amplitude
        missed = 0.5 * (12 * np.pi / 20011) ** 2 * amplitude
        assert amplitude - missed <= angle.max() <= amplitude * (1 + 1e-12)
        assert amplitude - missed <= -angle.min() <= amplitude * (1 + 1e-12)
    assert stroke.sweep_amplitude == pytest.approx(1.0, abs=1e-12)
    assert stroke.pitch_amplitude == pytest.approx(0.7, abs=1e-12)


@settings(max_examples=30)
@given(lists=coefficients(3, 3), scale=st.floats(1e-6, 1e6))
def test_normalized_keeps_the_shape_and_forgets_the_scale(lists, scale):
    first = normalized(lists)
    second = FourierStroke.normalized(0.2, *(scale * np.array(lists)), 1.0, 0.7)
    a, b = np.array(lists[0] + lists[1]), np.array(first.sweep_cos + first.sweep_sin)
    assert np.abs(a * np.linalg.norm(b) - b * np.linalg.norm(a)).max() < 1e-12
    np.testing.assert_allclose(second.sweep_cos, first.sweep_cos, atol=1e-12)
    assert second.sweep_mean == pytest.approx(first.sweep_mean, abs=1e-12)


def test_extremes_against_closed_form():
    # cos t + r cos 2t: highest 1 + r; lowest -r - 1 / (8 r), where cos t = -1 / (4 r), for r > 1/4
    for r in (0.3, 0.5, 2.0, 100.0):
        stroke = FourierStroke(1.0, [0.01, 0.01 * r], [0, 0], [0.1], [0.0])
        expected = (0.01 * (-r - 1 / (8 * r)), 0.01 * (1 + r))
        assert stroke.sweep_extremes == pytest.approx(expected, rel=1e-14)


def test_extremes_of_flat_tops_and_faint_harmonics():
    # at r = 1/4 three stationary points meet; a 1e-200 harmonic must not spoil the polynomial
    flat = FourierStroke(1.0, [1.0, 0.25, 1e-200], [0, 0, 1e-18], [0.0], [0.0])
    assert flat.sweep_extremes == pytest.approx((-0.75, 1.25), abs=1e-14)
    assert flat.pitch_extremes == (0.0, 0.0) and flat.pitch_amplitude == 0.0


def test_normalized_is_twice_the_printed_scale_with_offset_removed():
    # equations 10 and 11 with 2 phi0: phi0 = 1 means -1 to 1 and not -0.5 to 0.5
    stroke = FourierStroke.normalized(0.2, [-1.0, 0.5], [0, 0], [0, 0], [1, 0], 1.0, 0.5)
    low, high = stroke.sweep_extremes
    assert (low, high) == pytest.approx((-1.0, 1.0), abs=1e-14)
    # range of -cos t + 0.5 cos 2t is -3/4 .. 3/2, by hand
    assert stroke.sweep_cos == pytest.approx((-2 / 2.25, 1 / 2.25), rel=1e-14)
    assert stroke.sweep_mean == pytest.approx(-0.75 / 2.25, rel=1e-14)


def test_pinned_optimum():
    assert BEST.sweep_cos == pytest.approx((-1.1140400, 0.0, 0.0668424), abs=1e-6)
    assert BEST.pitch_amplitude == pytest.approx(np.pi / 4, abs=1e-14)


def test_means_shift_angles_only():
    plain = FourierStroke(0.5, [1.0], [0.2], [0.1], [0.5])
    moved = FourierStroke(0.5, [1.0], [0.2], [0.1], [0.5], 0.3, -0.2)
    a, b = plain.sample(16), moved.sample(16)
    np.testing.assert_allclose(b.sweep - a.sweep, 0.3)
    np.testing.assert_allclose(b.pitch - a.pitch, -0.2)
    np.testing.assert_array_equal(a.pitch_acceleration, b.pitch_acceleration)


def test_periodic_far_from_the_start_any_shape_and_protocol():
    time = np.linspace(0.0, 5.0, 6).reshape(2, 3)
    near, far = BEST.motion(time), BEST.motion(time + 5e5)
    np.testing.assert_allclose(near.sweep, far.sweep, atol=1e-9)
    assert isinstance(BEST, Stroke) and near.pitch_rate.shape == (2, 3)
    assert BEST.motion(0.3).sweep_rate.shape == ()
    assert BEST.motion([]).sweep.shape == (0,)
    again = FourierStroke(0.2, [-1.0], np.zeros(1), [0], [0.5])
    assert hash(again) == hash(FourierStroke(0.2, (-1.0,), (0.0,), (0.0,), (0.5,)))


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"frequency": -0.2}, "frequency must be a positive number in Hz, got -0.2"),
        ({"sweep_cos": []}, "sweep_cos must be a list of 1 to 100 numbers, got 0"),
        ({"sweep_sin": [0.0, 1.0]}, "sweep_sin must be a list of 1 numbers, got 2"),
        ({"pitch_sin": [np.nan]}, r"pitch_sin\[0\] must be a finite number .*, got nan"),
        ({"pitch_cos": "x"}, "pitch_cos must be a list of numbers.*, got 'x'"),
        ({"pitch_mean": np.inf}, "pitch_mean must be .*, got inf"),
        ({"sweep_cos": [60.0]}, "largest sweep angle must be .*radians, not degrees.*60.0"),
        ({"pitch_mean": 45}, "largest pitch angle must be .*radians, not degrees"),
        ({"sweep_cos": [[1.0]]}, r"sweep_cos must be a one-dimensional list, .*got \(1, 1\)"),
    ],
)
def test_bad_fields_give_one_sentence(changes, sentence):
    fields = {
        "frequency": 0.2,
        "sweep_cos": [1.0],
        "sweep_sin": [0.0],
        "pitch_cos": [0.0],
        "pitch_sin": [0.5],
    } | changes
    with pytest.raises(ValueError, match=f"^FourierStroke: {sentence}"):
        FourierStroke(**fields)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({0: [0, 0], 1: [0, 0]}, "a_sweep and b_sweep must be not all zero"),
        ({2: [0, 0], 3: [0.0, 0]}, "a_pitch and b_pitch must be not all zero"),
        ({3: [1, 2, 3]}, "b_pitch must be a list of 2 numbers, got 3"),
        ({1: [np.inf, 0]}, r"b_sweep\[0\] must be a finite number"),
        ({4: 60.0}, "sweep_amplitude must be .*radians, not degrees.*got 60.0"),
        ({5: -0.1}, "pitch_amplitude must be .*, got -0.1"),
    ],
)
def test_bad_normalized_gives_one_sentence(changes, sentence):
    arguments = dict(enumerate([[1, 0], [0, 0.1], [0, 0], [1, 0], 1.0, 0.5])) | changes
    with pytest.raises(ValueError, match=f"^FourierStroke.normalized: {sentence}"):
        FourierStroke.normalized(0.2, *arguments.values())
