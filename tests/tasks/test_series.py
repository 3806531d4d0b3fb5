"""Many Fourier series at once: closed forms, exact extremes, rows that do not see each other."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from flaprig.tasks.series import GRID, extremes, samples, slope, waves

coefficients = st.lists(st.floats(-1.0, 1.0), min_size=6, max_size=6).filter(
    lambda values: max(map(abs, values)) > 1e-6
)


def dense(row: np.ndarray) -> np.ndarray:
    return samples(row[None], waves(30_000))[0]


def test_samples_are_the_series() -> None:
    t = 2.0 * np.pi * np.arange(40) / 40
    a, b = (0.3, -0.2, 0.7), (1.1, 0.4, -0.5)
    expected = sum(a[n - 1] * np.cos(n * t) + b[n - 1] * np.sin(n * t) for n in (1, 2, 3))
    found = samples(np.array([[*a, *b]]), waves(40))[0]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14)


def test_slope_is_the_derivative() -> None:
    row = np.array([0.3, -0.2, 0.7, 1.1, 0.4, -0.5])
    step = 2.0 * np.pi / 30_000
    values = dense(row)
    central = (np.roll(values, -1) - np.roll(values, 1)) / (2.0 * step)
    np.testing.assert_allclose(dense(slope(row)), central, rtol=0, atol=1e-6)


@pytest.mark.parametrize("harmonic", [1, 2, 3])
@pytest.mark.parametrize("phase", [0.0, 0.013, 1.0, 2.5])
def test_one_wave_has_its_amplitude(harmonic: int, phase: float) -> None:
    row = np.zeros(6)
    row[harmonic - 1], row[harmonic + 2] = 2.0 * np.cos(phase), 2.0 * np.sin(phase)
    low, high = extremes(row[None])
    np.testing.assert_allclose([low[0], high[0]], [-2.0, 2.0], rtol=1e-15)


def test_two_waves_in_closed_form() -> None:
    """cos t + k cos 3t, k >= 1/9 its inner minima at cos^2 t = (9 k - 1)/(12 k)."""
    k = 0.5
    c = np.sqrt((9.0 * k - 1.0) / (12.0 * k))
    inner = abs(c + k * (4.0 * c**3 - 3.0 * c))
    largest = max(1.0 + k, inner)
    low, high = extremes(np.array([[1.0, 0.0, k, 0.0, 0.0, 0.0]]))
    np.testing.assert_allclose([low[0], high[0]], [-largest, largest], rtol=1e-15)


@given(coefficients)
def test_extremes_bound_every_sample(values: list[float]) -> None:
    """None is passed, and the sampling error of a parabola is all that is in between."""
    row = np.array(values)
    low, high = extremes(row[None])
    found = dense(row)
    size = np.abs(row).max()
    assert low[0] <= found.min() + 1e-14 * size and found.max() - 1e-14 * size <= high[0]
    np.testing.assert_allclose([low[0], high[0]], [found.min(), found.max()], atol=2e-6 * size)


def test_rows_do_not_see_each_other() -> None:
    """Bit for bit, whatever the number of rows."""
    rows = np.random.default_rng(0).normal(size=(37, 6))
    together = np.array(extremes(rows))
    alone = np.array([extremes(row[None]) for row in rows])[..., 0].T
    np.testing.assert_array_equal(together, alone)
    wave = waves(GRID)
    np.testing.assert_array_equal(
        samples(rows, wave), np.concatenate([samples(row[None], wave) for row in rows])
    )
