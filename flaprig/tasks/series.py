"""Many Fourier series at once: samples and exact extremes of equations 8 and 9, row by row.

Every number is made from its own row alone and in the same order whatever the number of rows, so a
row of many is the row alone, bit for bit. Matrix products do not promise that and are not used.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flaprig.tasks.hover_settings import HARMONICS

Array = NDArray[np.float64]

# order of each harmonic, as a row of coefficients has them: cosines, then sines
ORDER: Array = np.tile(np.arange(1.0, HARMONICS + 1.0), 2)
# instants among which slopes are searched for a change of sign: 33 a period of the third harmonic
GRID = 100
# Newton steps from the chord between two grid points; errors about 1e-3, 1e-6, 1e-12
POLISHES = 2


def waves(count: int) -> Array:
    """cos n t, sin n t at equally spaced phases of one period. Shape (6, count)."""
    phase = 2.0 * np.pi * np.arange(count) / count
    angles = np.multiply.outer(np.arange(1.0, HARMONICS + 1.0), phase)
    return np.concatenate([np.cos(angles), np.sin(angles)])


def slope(series: Array) -> Array:
    """Coefficients of the derivative with phase, of rows (..., 6) cosines, then sines."""
    cos, sin = series[..., :HARMONICS], series[..., HARMONICS:]
    n = ORDER[:HARMONICS]
    return np.concatenate([n * sin, -n * cos], axis=-1)


def samples(series: Array, wave: Array) -> Array:
    """Values of series (rows, 6) on waves (6, count). Shape (rows, count)."""
    total = series[:, :1] * wave[0]
    term = np.empty_like(total)
    for k in range(1, len(wave)):
        np.multiply(series[:, k : k + 1], wave[k], out=term)
        total += term
    return total


_GRID_WAVES = waves(GRID)


def extremes(series: Array, values: Array | None = None) -> tuple[Array, Array]:
    """Lowest and highest value of each series, to rounding. Two arrays of shape (rows,).

    Args:
        series: coefficients. Shape (rows, 6).
        values: of the series on the grid, if they are known. Shape (rows, GRID).
    """
    values = samples(series, _GRID_WAVES) if values is None else values
    derivative = slope(series)
    row, value = _stationary(series, derivative, samples(derivative, _GRID_WAVES))
    low, high = values.min(axis=1), values.max(axis=1)
    np.minimum.at(low, row, value)
    np.maximum.at(high, row, value)
    return low, high


def _stationary(series: Array, derivative: Array, slopes: Array) -> tuple[NDArray[np.int64], Array]:
    """Rows and values of the points where a slope changes its sign between grid points."""
    rising = slopes > 0.0
    row, left = np.nonzero(rising != np.roll(rising, -1, axis=1))
    before, after = slopes[row, left], slopes[row, (left + 1) % GRID]
    step = 2.0 * np.pi / GRID
    first = left * step
    phase = first + step * before / (before - after)
    own, own_slope = series[row], derivative[row]
    own_curvature = slope(own_slope)
    for _ in range(POLISHES):
        wave = _at(phase)
        bend = _sum(own_curvature, wave)
        bend[bend == 0.0] = np.inf
        phase = np.clip(phase - _sum(own_slope, wave) / bend, first, first + step)
    return row, _sum(own, _at(phase))


def _at(phase: Array) -> list[Array]:
    """The six waves at given phases; the higher ones from the first."""
    c, s = np.cos(phase), np.sin(phase)
    c2, s2 = c * c - s * s, 2.0 * c * s
    return [c, c2, c2 * c - s2 * s, s, s2, s2 * c + c2 * s]


def _sum(series: Array, wave: list[Array]) -> Array:
    """Each series at its own phase. Shape (rows,)."""
    total = series[:, 0] * wave[0]
    for k in range(1, len(wave)):
        total += series[:, k] * wave[k]
    return total
