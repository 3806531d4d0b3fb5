"""The period of a measured motion, found from the samples alone.

The first lag at which both angles repeat themselves: the difference function of the pitch detector
YIN (A. de Cheveigne & H. Kawahara, J. Acoust. Soc. Am. 111 (2002) 1917), then the frequency with
which few harmonics leave the least residual. One cycle has nothing that repeats: there the period
is the time after which the motion would be back at its first posture.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from flaprig.logs.harmonics import fit
from flaprig.strokes.sampled import CLOSED_WITHIN

Array = NDArray[np.float64]
Waves = NDArray[np.complex128]

# points of the uniform grid on which lags are compared
_LEAST_GRID, _MOST_GRID = 512, 16_384
# neighbours further apart than this many usual steps are not joined
_GAP = 5.0
# the signals differ from themselves: a lag is only looked for beyond this difference
_AWAY = 0.25
# and repeat themselves: differences are shares of twice the variance
_SAME = 0.1
# least number of grid points, and share of the lag, that must overlap
_OVERLAP, _OVERLAP_SHARE = 4, 0.02
# a first and a last posture that differ by so many steps are not of one cycle
_STEPS_BACK = 3.0
# least difference that is asked about [rad]: encoders and noise
_LEAST_BACK = 0.02
# a record may go on beyond its one cycle by this share
_BEYOND = 0.05
# a rate below this share of the fastest is that of a reversal
_SLOW = 0.1
# samples that make a record fine enough for rates at its ends, over three
_COARSE = 20
# share of a record, as one over it, that gives the rates at its ends
_ENDS = 100
# rates at both ends differ by no more than this share of the fastest
_RATES = 0.6
# an end is closed, or one step short, within this share of a step
_SNAP = 0.3
# steps that a whole cycle may seem to lack at its end
STEPS_SHORT = 1.6
# cycles from which on a frequency is refined by a series, and its harmonics in each round: few
# first, since many see only what is near
_REFINED_FROM = 1.5
_LIMITS = (3, 6, 60)
# samples that a frequency is refined with: more of them change nothing that matters
_ENOUGH = 4000


def repeats(time: Array, signals: Sequence[Array]) -> float | None:
    """The period of samples that hold more than one cycle in [s]; None where nothing repeats.

    Args:
        time: instants in [s], rising. Shape (n,).
        signals: sweep and pitch in [rad]. Shape (n,) each.
    """
    grid = np.linspace(time[0], time[-1], int(np.clip(2 * time.size, _LEAST_GRID, _MOST_GRID)))
    steps = np.diff(time)
    hole = steps > _GAP * np.median(steps)
    known = ~hole[np.clip(np.searchsorted(time, grid, side="right") - 1, 0, steps.size - 1)]
    differences = [
        _difference(np.interp(grid, time, signal), known) for signal in signals if _moves(signal)
    ]
    if not differences:
        return None
    # both angles must repeat
    worst = np.max(differences, axis=0)
    lag = _first_dip(worst)
    if lag is None:
        return None
    step = float(grid[1] - grid[0])
    period = _sharpened(worst, lag) * step
    if time[-1] - time[0] < _REFINED_FROM * period:
        # little repeats: a series would trade its frequency for its harmonics
        return period
    return refined(time, signals, period)


def refined(time: Array, signals: Sequence[Array], period: float) -> float:
    """The period near a given one with which few harmonics leave the least residual in [s].

    Gauss-Newton in the frequency, with the series' own slope.
    """
    thin = slice(None, None, 1 + time.size // _ENOUGH)
    time = time[thin]
    moving = [signal[thin] for signal in signals if _moves(signal)]
    frequency = 1.0 / period
    middle = 0.5 * (time[0] + time[-1])
    for limit in _LIMITS:
        top = bottom = 0.0
        for signal in moving:
            found = fit(time, signal, frequency)
            if found.harmonics > limit:
                found = fit(time, signal, frequency, limit)
            # how the series changes with the frequency: what its coefficients can do is taken out
            change = found.slope(time) * (time - middle) / frequency
            change -= fit(time, change, frequency, found.harmonics)(time)
            weight = 1.0 / max(found.residual_rms, 1e-12) ** 2
            top += weight * float(change @ (signal - found(time)))
            bottom += weight * float(change @ change)
        if bottom <= 0.0:
            break
        # no more than a tenth of a cycle over the record: beyond that the slope means nothing
        most = 0.1 / (time[-1] - time[0])
        frequency += float(np.clip(top / bottom, -most, most))
    return 1.0 / frequency


def one_cycle(time: Array, signals: Sequence[Array]) -> float | None:
    """The period of samples of about one cycle in [s]; None where the ends do not meet.

    The last sample may repeat the first, lie one step before it, or a little after.
    """
    length, step = float(time[-1] - time[0]), float(np.median(np.diff(time)))
    slopes, gaps, rooms, fast = [], [], [], []
    for signal in signals:
        few = max(2, time.size // _ENDS)
        begin, end = _slope(time[:few], signal[:few]), _slope(time[-few:], signal[-few:])
        fastest = float(np.percentile(np.abs(np.gradient(signal, time)), 95.0))
        # between coarse samples a rate may change as it likes
        fine = time.size >= 3 * _COARSE
        if fine and abs(begin - end) > max(_RATES * fastest, _LEAST_BACK / length):
            return None
        slopes.append(0.5 * (begin + end))
        gaps.append(float(signal[0] - signal[-1]))
        largest = float(np.percentile(np.abs(np.diff(signal)), 98.0))
        rooms.append(max(_STEPS_BACK * largest, _LEAST_BACK))
        fast.append(fastest)
    square = float(np.dot(slopes, slopes))
    # the time that closes the gap at the rate of the ends; where both ends are at a reversal no
    # rate tells, and the last sample lies one step before the first as a rule
    slow = not fine or all(abs(s) <= _SLOW * f for s, f in zip(slopes, fast, strict=True))
    late = step if slow else float(np.dot(slopes, gaps)) / square
    late = float(np.clip(late, -_BEYOND * length, _STEPS_BACK * step))
    # a cycle of coarse samples may be closed, too
    if not fine and max(map(abs, gaps)) <= CLOSED_WITHIN:
        late = 0.0
    shifts = (s * late if fine else 0.0 for s in slopes)
    if any(abs(g - s) > r for g, s, r in zip(gaps, shifts, rooms, strict=True)):
        return None
    usual = min((0.0, step), key=lambda each: abs(late - each))
    return length + (usual if abs(late - usual) <= _SNAP * step else late)


def _moves(signal: Array) -> bool:
    """Whether a joint moves by more than an encoder's counts."""
    return float(np.ptp(signal)) > _LEAST_BACK


def _slope(time: Array, signal: Array) -> float:
    return float(np.polynomial.polynomial.polyfit(time - time.mean(), signal, 1)[1])


def _difference(signal: Array, known: NDArray[np.bool_]) -> Array:
    """Mean square of the signal minus itself later, over twice its variance, by lag. Shape (n,).

    Infinite where too little overlaps.
    """
    mask = known.astype(np.float64)
    x = np.where(known, signal - signal[known].mean(), 0.0)
    size = 2 * x.size
    square, plain, weight = (np.fft.rfft(part, size) for part in (x * x, x, mask))

    def correlated(a: Waves, b: Waves) -> Array:
        return np.asarray(np.fft.irfft(np.conj(a) * b, size)[: x.size])

    pairs = correlated(weight, weight)
    total = correlated(square, weight) + correlated(weight, square) - 2 * correlated(plain, plain)
    variance = float(np.sum(x * x) / mask.sum())
    enough = pairs > np.maximum(_OVERLAP, _OVERLAP_SHARE * np.arange(x.size))
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(enough, total / pairs / (2.0 * variance), np.inf)


def _first_dip(difference: Array) -> int | None:
    """The lag of the first deep valley after the signal has gone away from itself.

    A valley that the end of the samples cuts off is none: nothing shows where its bottom is.
    """
    away = np.flatnonzero(difference > _AWAY)
    if not away.size:
        return None
    low = np.flatnonzero(difference[away[0] :] < _SAME)
    if not low.size:
        return None
    start = away[0] + int(low[0])
    above = np.flatnonzero(difference[start:] >= _SAME)
    end = start + int(above[0]) if above.size else difference.size
    bottom = start + int(np.argmin(difference[start:end]))
    beyond = bottom + max(2, int(_OVERLAP_SHARE * bottom))
    return bottom if beyond < difference.size and np.isfinite(difference[beyond]) else None


def _sharpened(difference: Array, lag: int) -> float:
    """A lag, from the valleys at its multiples: the further away, the sharper."""
    found, times = _valley(difference, lag), 1
    while True:
        more = 2 * times
        place = round(found * more)
        width = max(1, int(0.1 * found))
        if place + width + 1 >= difference.size or not np.isfinite(difference[place + width]):
            return found
        low = place - width
        best = low + int(np.argmin(difference[low : place + width + 1]))
        found, times = _valley(difference, best) / more, more


def _valley(difference: Array, lag: int) -> float:
    """The bottom of a valley between points of the grid, by a parabola."""
    before, here, after = difference[lag - 1 : lag + 2]
    bend = before - 2.0 * here + after
    if not np.isfinite(bend) or bend <= 0.0:
        return float(lag)
    return lag + float(np.clip(0.5 * (before - after) / bend, -0.5, 0.5))
