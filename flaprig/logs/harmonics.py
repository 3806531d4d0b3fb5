"""Periodic signals by least squares: few harmonics through all samples at their own times.

How many harmonics: the number of least Hannan-Quinn criterion (E. Hannan & B. Quinn, The
determination of the order of an autoregression, J. R. Stat. Soc. B 41 (1979) 190), corrected for
small samples as Akaike's (C. Hurvich & C.-L. Tsai, Biometrika 76 (1989) 297). A harmonic must lower
the sum of squares by more than the noise of the data itself does, so white noise and the steps of
an encoder add none or few.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# most harmonics of a fit: fast flips of the paper, 0.16 cycles, sink below 1e-4 rad at 30
MOST = 60
# harmonics at most, over the longest gap between phases: what a gap can hide, a fit invents
_BY_GAP = 0.4
# harmonics that are tried first
_FEW = 20
# phases are the same within this share of their usual distance
_SAME_PHASE = 0.5
# values that differ by less than this share of the range are one value of an encoder
_ROUNDING = 1e-7
# cycles are copies of each other when this share of their samples is
_COPIED = 0.8
# samples that are weighed at once
_BLOCK = 20_000
# a fit that takes this share of the harmonics that it may has found no floor of noise
_NO_FLOOR = 0.8


@dataclass(frozen=True, eq=False)
class Fit:
    """A Fourier series fitted to samples.

    Attributes:
        frequency: of the first harmonic in [Hz].
        mean: of the series.
        cos: cosine coefficients, n = 1, 2, ... Shape (harmonics,).
        sin: sine coefficients. Shape (harmonics,).
        residual_rms: root mean square of samples minus series, in the signal's unit.
        most: harmonics that the samples could have told.
    """

    frequency: float
    mean: float
    cos: Array
    sin: Array
    residual_rms: float
    most: int

    @property
    def harmonics(self) -> int:
        """Number of harmonics."""
        return int(self.cos.size)

    @property
    def has_floor(self) -> bool:
        """Whether the higher harmonics are noise: else the samples hold more than the series."""
        return self.harmonics < _NO_FLOOR * self.most

    def __call__(self, time: Array) -> Array:
        """The series at instants in [s]. Shape (n,)."""
        parts = [
            _waves(block, self.frequency, self.harmonics) @ self._coefficients
            for block in np.array_split(time, 1 + time.size // _BLOCK)
        ]
        return np.concatenate(parts)

    def slope(self, time: Array) -> Array:
        """Time derivative of the series at instants in [s]. Shape (n,)."""
        w = 2.0 * np.pi * self.frequency * np.arange(1, self.harmonics + 1)
        turned = Fit(self.frequency, 0.0, w * self.sin, -w * self.cos, 0.0, self.most)
        return turned(time)

    @property
    def _coefficients(self) -> Array:
        pairs = np.stack([self.cos, self.sin], axis=1).ravel()
        return np.concatenate([[self.mean], pairs])


def fit(time: Array, values: Array, frequency: float, harmonics: int | None = None) -> Fit:
    """The series of least squares.

    Args:
        time: instants in [s], of any spacing. Shape (n,).
        values: samples. Shape (n,).
        frequency: of the first harmonic in [Hz].
        harmonics: that the series has; None: as many as the noise of the samples lets see.
    """
    most = most_harmonics(time, frequency)
    # few are usually enough: only where they are not, all are tried
    for count in sorted({min(_FEW, most), most}) if harmonics is None else [min(harmonics, most)]:
        # a triangular factor of the waves: the sums of squares of all shorter series at once
        triangle, right, total = _factor(time, values, frequency, count)
        solved: Array = np.asarray(np.linalg.solve(triangle, right), np.float64)
        rest = _residual(time, values, frequency, solved)
        if harmonics is None:
            left = _left(right, float(rest @ rest), total)
            best = _best(left / time.size, _independent(time, values, frequency))
            size = 2 * best + 1
            solved = np.asarray(np.linalg.solve(triangle[:size, :size], right[:size]), np.float64)
            rest = _residual(time, values, frequency, solved)
            if best < _NO_FLOOR * count:
                break
    return Fit(
        frequency=frequency,
        mean=float(solved[0]),
        cos=solved[1::2].copy(),
        sin=solved[2::2].copy(),
        residual_rms=float(np.sqrt(np.mean(rest**2))),
        most=most,
    )


def most_harmonics(time: Array, frequency: float) -> int:
    """Harmonics that the phases of the samples can tell apart, at least one."""
    phase = np.sort(np.mod(time * frequency, 1.0))
    gap = float(np.diff(phase, append=phase[0] + 1.0).max())
    return int(np.clip(_BY_GAP / max(gap, 1e-9), 1, min(MOST, max((time.size - 1) // 3, 1))))


def _waves(time: Array, frequency: float, harmonics: int) -> Array:
    """Columns 1, cos, sin, cos 2, sin 2, ... Shape (n, 2 harmonics + 1)."""
    phase = 2.0 * np.pi * np.mod(time * frequency, 1.0)
    turning = np.repeat(np.exp(1j * phase)[:, None], harmonics, axis=1)
    # powers of the first wave: rounding grows with the harmonic, to 1e-14
    turning = np.cumprod(turning, axis=1)
    table = np.empty((time.size, 2 * harmonics + 1))
    table[:, 0], table[:, 1::2], table[:, 2::2] = 1.0, turning.real, turning.imag
    return table


def _factor(
    time: Array, values: Array, frequency: float, harmonics: int
) -> tuple[Array, Array, float]:
    """R and Q^T y of the waves by Cholesky, and the sum of squares about the mean."""
    size = 2 * harmonics + 1
    square, product = np.zeros((size, size)), np.zeros(size)
    for start in range(0, time.size, _BLOCK):
        part = slice(start, start + _BLOCK)
        table = _waves(time[part], frequency, harmonics)
        square += table.T @ table
        product += table.T @ values[part]
    # a rounding's worth of stiffness where phases are missing
    square[np.diag_indices(size)] *= 1.0 + 1e-13
    lower = np.asarray(np.linalg.cholesky(square), np.float64)
    total = float(np.sum((values - values.mean()) ** 2))
    return lower.T, np.asarray(np.linalg.solve(lower, product), np.float64), total


def _residual(time: Array, values: Array, frequency: float, solved: Array) -> Array:
    harmonics = (solved.size - 1) // 2
    parts = []
    for start in range(0, time.size, _BLOCK):
        part = slice(start, start + _BLOCK)
        parts.append(values[part] - _waves(time[part], frequency, harmonics) @ solved)
    return np.concatenate(parts)


def _independent(time: Array, values: Array, frequency: float) -> int:
    """Samples that count as evidence of their own.

    An encoder rounds the same angle in the same way: what is sampled at the same phases in every
    cycle says the same in every cycle, and a cycle passes every count twice, however often it is
    sampled there.
    """
    phase = np.mod(time * frequency, 1.0)
    order = np.argsort(phase)
    again = np.diff(phase[order]) <= _SAME_PHASE / time.size
    span = float(np.ptp(values))
    equal = np.abs(np.diff(values[order])) <= _ROUNDING * span
    # noise tells cycles apart, and then each of them is evidence
    copied = bool(again.any()) and float(equal[again].mean()) > _COPIED
    copies = int(np.count_nonzero(again)) if copied else 0
    steps = np.diff(np.unique(values))
    steps = steps[steps > _ROUNDING * span]
    passes = 2.0 * span / steps.min() if steps.size else np.inf
    return int(min(time.size - copies, max(passes, 8.0)))


def _left(right: Array, rest: float, total: float) -> Array:
    """Sum of squares that series of 0, 1, 2, ... harmonics leave. Shape (harmonics + 1,)."""
    taken = right[1::2] ** 2 + right[2::2] ** 2
    left = rest + np.concatenate([np.cumsum(taken[::-1])[::-1], [0.0]])
    # rounding is a floor, too
    return np.asarray(np.maximum(left, total * 1e-28 + 1e-300))


def _best(variance: Array, count: int) -> int:
    """Number of harmonics of least information criterion, at least one."""
    # the variance is a parameter, too
    parameters = 2.0 * np.arange(variance.size) + 2.0
    room = count - parameters - 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        correction = np.where(room > 0.0, 2.0 * parameters * (parameters + 1.0) / room, np.inf)
    penalty = 2.0 * np.log(np.log(max(count, 3)))
    criterion = count * np.log(variance) + penalty * parameters + correction
    return max(1, int(np.argmin(criterion)))
