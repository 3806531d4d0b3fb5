import numpy as np
import pytest

from flaprig.limits import spline
from flaprig.strokes import SampledStroke

RNG = np.random.default_rng(1)
VALUES = RNG.normal(size=40)
COEFFICIENTS = spline.interpolate(VALUES)


def test_is_the_curve_of_a_sampled_stroke():
    stroke = SampledStroke(np.arange(40) / 40, VALUES, VALUES)
    phases = RNG.random(500)
    motion = stroke.motion(phases)
    for order, name in enumerate(("sweep", "sweep_rate", "sweep_acceleration")):
        expected = getattr(motion, name)
        error = np.abs(spline.values(COEFFICIENTS, phases, order) - expected).max()
        assert error < 1e-12 * np.abs(expected).max()


@pytest.mark.parametrize("order", range(4))
def test_matrix_makes_the_values(order):
    phases = RNG.random(100)
    direct = spline.values(COEFFICIENTS, phases, order)
    made = spline.matrix(phases, 40, order) @ COEFFICIENTS
    np.testing.assert_allclose(made, direct, atol=1e-13 * 40.0**order)


@pytest.mark.parametrize("order", range(4))
def test_extremes_bound_the_curve_and_are_reached(order):
    low, high = spline.extremes(COEFFICIENTS, order)
    dense = spline.values(COEFFICIENTS, np.linspace(0.0, 1.0, 100_001), order)
    size = high - low
    assert low <= dense.min() + 1e-13 * size and high >= dense.max() - 1e-13 * size
    assert dense.min() - low < 1e-6 * size and high - dense.max() < 1e-6 * size


def test_derivatives_of_a_sine():
    c = spline.interpolate(np.sin(2.0 * np.pi * np.arange(200) / 200))
    for order in range(4):
        expected = (2.0 * np.pi) ** order
        assert spline.extremes(c, order)[1] == pytest.approx(expected, rel=1e-6)
