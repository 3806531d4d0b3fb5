"""Periodic quintic splines on equal intervals, as power series of each interval.

The same curve that `SampledStroke` draws through equally spaced samples, here with matrices of
its values and exact extremes, which bounds on the whole cycle need. Cardinal B-spline: I. J.
Schoenberg, Cardinal Spline Interpolation, SIAM (1973). Time is a phase, 0 to 1; derivatives are
with respect to it.
"""

from __future__ import annotations

from math import comb

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

Array = NDArray[np.float64]

# degree of the pieces, and coefficients that reach one interval
DEGREE, REACH = 5, 6
# cells of an interval searched for turning points, one in each
CELLS = 8
# halvings of a cell: down to the rounding of its ends
HALVINGS = 52


def _pieces_of_basis() -> Array:
    """Power series of the six basis functions on one interval. Row m: of coefficient i - 2 + m."""
    table = np.zeros((REACH, REACH))
    for m in range(REACH):
        for j in range(DEGREE - m + 1):
            shift, weight = DEGREE - m - j, (-1) ** j * comb(REACH, j) / 120.0
            for p in range(REACH):
                table[m, p] += weight * comb(DEGREE, p) * shift ** (DEGREE - p)
    return table


BASIS = _pieces_of_basis()


def interpolate(values: Array) -> Array:
    """Coefficients of the spline through values at the phases 0, 1/n, 2/n, ... Shape (n,)."""
    n = values.size
    kernel = np.zeros(n)
    np.add.at(kernel, np.arange(-2, 4) % n, BASIS[:, 0])
    # the kernel is even, so its transform is real, and nowhere below 2/15
    return np.fft.irfft(np.fft.rfft(values) / np.fft.rfft(kernel).real, n)


def pieces(coefficients: Array, order: int = 0) -> Array:
    """Power series of a derivative on each interval, in u from 0 to 1. Shape (n, 6 - order)."""
    n = coefficients.size
    series = coefficients[_reached(np.arange(n), n)] @ BASIS
    for _ in range(order):
        series = n * series[:, 1:] * np.arange(1, series.shape[1])
    return series


def matrix(phases: Array, n: int, order: int = 0) -> csr_array:
    """Matrix that makes values of a derivative at phases out of n coefficients. Shape (k, n)."""
    interval, u = _located(phases, n)
    powers = BASIS
    for _ in range(order):
        powers = n * powers[:, 1:] * np.arange(1, powers.shape[1])
    weights = _horner(powers[None, :, :], u[:, None])
    rows = np.repeat(np.arange(interval.size), REACH)
    columns = _reached(interval, n).ravel()
    return csr_array((weights.ravel(), (rows, columns)), shape=(interval.size, n))


def values(coefficients: Array, phases: Array, order: int = 0) -> Array:
    """A derivative at any phases. Shape as phases."""
    interval, u = _located(phases, coefficients.size)
    return _horner(pieces(coefficients, order)[interval], u)


def turning_points(coefficients: Array, order: int = 0) -> Array:
    """Phases of the extremes of a derivative, knots included. Sorted, shape (k,)."""
    n = coefficients.size
    slope = pieces(coefficients, order + 1)
    edges = np.linspace(0.0, 1.0, CELLS + 1)
    sign = _horner(slope[:, None, :], edges[None, :]) > 0.0
    interval, cell = np.nonzero(sign[:, 1:] != sign[:, :-1])
    low, high = edges[cell], edges[cell + 1]
    rising, series = sign[interval, cell], slope[interval]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        before = (_horner(series, middle) > 0.0) == rising
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return np.unique(np.concatenate([np.arange(n), interval + 0.5 * (low + high)]) / n)


def extremes(coefficients: Array, order: int = 0) -> tuple[float, float]:
    """Lowest and highest value of a derivative over the cycle."""
    found = values(coefficients, turning_points(coefficients, order), order)
    return float(found.min()), float(found.max())


def _reached(interval: NDArray[np.int64], n: int) -> NDArray[np.int64]:
    """Coefficients that reach each interval. Shape (k, 6)."""
    return np.mod(interval[:, None] + np.arange(-2, 4), n)


def _located(phases: Array, n: int) -> tuple[NDArray[np.int64], Array]:
    """Interval of each phase and the place in it, 0 to 1."""
    scaled = np.mod(phases, 1.0) * n
    interval = np.minimum(scaled.astype(np.int64), n - 1)
    return interval, scaled - interval


def _horner(series: Array, u: Array) -> Array:
    """Value of power series, lowest power first along the last axis."""
    total = series[..., -1] + 0.0 * u
    for p in range(series.shape[-1] - 2, -1, -1):
        total = total * u + series[..., p]
    return total
