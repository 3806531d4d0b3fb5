"""The periodic part of a record: without rest, ramps and strays, and a series through it.

The series is fitted again and again without the samples that lie far from it (trimmed least
squares); what was dropped in one piece at an end is a start or a stop, what was dropped alone is a
stray.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import degrees

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from flaprig.logs.harmonics import Fit, fit

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

JOINTS = ("sweep", "pitch")
_ALL = slice(None)
# a sample is dropped that lies this many robust standard deviations from the series
_FAR = 6.0
# and by this share of the joint's range, and by this angle [rad]: three counts of 4096
_FAR_SHARE, _FAR_LEAST = 0.005, 0.005
# rounds of fitting and dropping
_ROUNDS = 12
# windows that a record is divided into when rest is looked for, and least samples of one
_WINDOWS, _LEAST_WINDOW = 20, 5
# a window is rest when its range is below this share of the moving ones'
_REST = 0.02
# or below so many standard deviations of the noise
_REST_NOISE = 8.0
# samples of a bin when cycles are compared, and bins of a cycle
_BINS = 24


@dataclass(frozen=True, eq=False)
class Periodic:
    """Series through both angles of a record.

    Attributes:
        fits: of sweep and pitch.
        kept: samples that they went through. Shape (n,).
        scatter: largest distance of a single cycle's course from that of all in [rad], by joint;
            noise of single samples averaged out.
    """

    fits: tuple[Fit, Fit]
    kept: Flags
    scatter: tuple[float, float]


def moving_part(angles: tuple[Array, Array]) -> slice:
    """The longest stretch in which something moves; all of it where nothing rests.

    Args:
        angles: sweep and pitch in [rad]. Shape (n,) each.
    """
    count = angles[0].size
    width = max(_LEAST_WINDOW, count // _WINDOWS)
    if count < 2 * width:
        return slice(0, count)
    active = np.zeros(count, dtype=bool)
    for angle in angles:
        span = maximum_filter1d(angle, width) - minimum_filter1d(angle, width)
        most = float(np.percentile(span, 90.0))
        room = max(_REST * most, min(_REST_NOISE * noise_of(angle), 5.0 * _REST * most), _FAR_LEAST)
        # a window is as wide as the filter: what moves reaches half of it further
        active |= maximum_filter1d((span > room).astype(np.int8), width) > 0
    edges = np.flatnonzero(np.diff(np.concatenate([[0], active, [0]])))
    if not edges.size:
        return slice(0, count)
    starts, ends = edges[0::2], edges[1::2]
    best = int(np.argmax(ends - starts))
    # the filters saw the motion half a window early, and once more: give back what rests
    back = width - 1
    first = int(starts[best]) + (back if starts[best] > 0 else 0)
    last = int(ends[best]) - (back if ends[best] < count else 0)
    return slice(first, last) if last - first > 2 * width else slice(0, count)


def periodic(
    time: Array,
    angles: tuple[Array, Array],
    frequency: float,
    trim: bool = True,
    ends: bool = True,
    begin: slice = _ALL,
) -> Periodic:
    """Series through the samples that belong to the periodic motion.

    Args:
        time: instants in [s], rising. Shape (n,).
        angles: sweep and pitch in [rad]. Shape (n,) each.
        frequency: of the motion in [Hz].
        trim: whether samples far from the series are left out.
        ends: whether what is far at an end is a start or a stop.
        begin: samples that the first series goes through.
    """
    kept = np.zeros(time.size, dtype=bool)
    kept[begin] = True
    fits = _fits(time, angles, frequency, kept)
    for _ in range(_ROUNDS if trim else 0):
        near = np.ones(time.size, dtype=bool)
        for angle, series in zip(angles, fits, strict=True):
            distance = np.abs(angle - series(time))
            spread = 1.4826 * float(np.median(distance[kept]))
            room = max(_FAR * spread, _FAR_SHARE * float(np.ptp(angle[kept])), _FAR_LEAST)
            near &= distance <= room
        if ends:
            first, last = _ends(near, time, 1.0 / frequency)
            near[:first] = near[last:] = False
        # a cycle must be left, else the series has lost the motion
        if near.sum() < 8 or np.ptp(time[near]) * frequency < 0.9 or np.array_equal(near, kept):
            break
        kept = near
        fits = _fits(time, angles, frequency, kept)
    scatter = [
        _scatter(time[kept], angle[kept] - series(time[kept]), frequency)
        for angle, series in zip(angles, fits, strict=True)
    ]
    return Periodic(fits, kept, (scatter[0], scatter[1]))


def ends_of(kept: Flags) -> tuple[int, int]:
    """First and last-but-one index of what was kept."""
    places = np.flatnonzero(kept)
    return int(places[0]), int(places[-1]) + 1


def degrees_of(angle: float) -> str:
    """An angle in [rad] as «0.0262 rad (1.5 deg)»."""
    return f"{angle:.3g} rad ({degrees(angle):.3g} deg)"


def _fits(
    time: Array, angles: tuple[Array, Array], frequency: float, kept: Flags
) -> tuple[Fit, Fit]:
    sweep, pitch = (fit(time[kept], angle[kept], frequency) for angle in angles)
    return sweep, pitch


def noise_of(angle: Array) -> float:
    """Standard deviation of what changes from sample to sample, by the second differences."""
    return 1.4826 * float(np.median(np.abs(np.diff(angle, 2)))) / np.sqrt(6.0)


def _ends(near: Flags, time: Array, period: float) -> tuple[int, int]:
    """Where the motion begins and ends: what is mostly far before and after is a start, a stop."""
    count = near.size
    room = int(np.searchsorted(time, time[0] + 1.5 * period))
    first = _stretch(near[: min(room, count // 2)])
    room = count - int(np.searchsorted(time, time[-1] - 1.5 * period))
    last = count - _stretch(near[::-1][: min(room, count // 2)])
    return first, last


def _stretch(near: Flags) -> int:
    """Length of the longest beginning half of which is far and that ends with a far sample."""
    if not near.size:
        return 0
    share = np.cumsum(~near) / np.arange(1, near.size + 1)
    mostly = np.flatnonzero((share >= 0.5) & ~near)
    # one far sample at the very end is a stray and no start
    return int(mostly[-1]) + 1 if mostly.size > 2 else 0


def _scatter(time: Array, rest: Array, frequency: float) -> float:
    """Largest distance of a cycle's course from the series, beyond what noise explains."""
    cycle = np.floor((time - time[0]) * frequency).astype(int)
    place = np.floor(np.mod(time * frequency, 1.0) * _BINS).astype(int)
    group = cycle * _BINS + place
    count = np.bincount(group)
    total = np.bincount(group, weights=rest)
    full = count >= 2
    if cycle[-1] < 1 or not full.any():
        return 0.0
    mean = np.abs(total[full] / count[full])
    noise = float(np.std(np.diff(rest))) / np.sqrt(2.0)
    # four standard deviations of a mean of so many samples are noise
    beyond = mean - 4.0 * noise / np.sqrt(count[full])
    return float(max(beyond.max(), 0.0))
