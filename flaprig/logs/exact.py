"""Samples that are exact: more than few harmonics and no noise, so they stay what they are."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from flaprig.logs.harmonics import Fit
from flaprig.strokes.sampled import MOST_SAMPLES, SampledStroke

Array = NDArray[np.float64]

# what a spline through the samples makes of their noise, as a share of the peak acceleration
_NOISE = 0.01
# a spline whose peak acceleration is this many times the series' has taken noise for motion
_MANY = 3.0
# harmonics below which samples are too few to show a floor of noise
_FEW = 12
# what an encoder is off by at most [rad]
_ENCODER = 0.005
# steps of samples that are exact differ by no more than this share
_EVEN = 1e-3
# a cycle is a whole number of steps within this
_WHOLE = 1e-4
# instants at which accelerations are compared
_COMPARED = 2000


def exact_stroke(
    time: Array, angles: tuple[Array, Array], period: float, fits: tuple[Fit, Fit]
) -> SampledStroke | None:
    """The samples of one cycle as a stroke; None where a series is the better description.

    Args:
        time: instants in [s]. Shape (n,).
        angles: sweep and pitch in [rad]. Shape (n,) each.
        period: in [s].
        fits: series through them.
    """
    stroke = _sampled(time, angles, period)
    if stroke is None:
        return None
    instants = stroke.time[0] + np.arange(_COMPARED) * period / _COMPARED
    motion = stroke.motion(instants)
    for joint, series in zip(("sweep", "pitch"), fits, strict=True):
        own = getattr(motion, f"{joint}_acceleration")
        smooth = _acceleration(series, instants)
        most = float(np.abs(smooth).max())
        apart = float(np.sqrt(np.mean((own - smooth) ** 2)))
        peak = float(np.abs(own).max())
        if peak > 1e-9 and _is_noise(series, apart, peak, most):
            return None
    return stroke


def _is_noise(series: Fit, apart: float, peak: float, most: float) -> bool:
    """Whether what the spline has beyond the series is noise.

    Args:
        series: through the samples.
        apart: root mean square of both accelerations' difference.
        peak: acceleration of the spline.
        most: peak acceleration of the series.
    """
    if series.most < _FEW:
        # too few samples to tell: what is left is motion where it is more than encoders are off
        return series.residual_rms < _ENCODER and apart > _NOISE * most
    if series.has_floor:
        return apart > _NOISE * most
    return peak > _MANY * most


def _sampled(time: Array, angles: tuple[Array, Array], period: float) -> SampledStroke | None:
    """One cycle of even steps, or of free ones whose last sample repeats the first."""
    steps = np.diff(time)
    step = float(np.median(steps))
    count = round(period / step)
    even = float(np.ptp(steps)) <= _EVEN * step and abs(count * step - period) <= _WHOLE * period
    cycles = time.size // count if even else 0
    if even and cycles >= 2:
        # cycles of the same phases: their mean
        means = [angle[: cycles * count].reshape(cycles, count).mean(axis=0) for angle in angles]
        return _made(time[0] + np.arange(count) * (period / count), means)
    return _made(time, list(angles)) if time.size <= MOST_SAMPLES else None


def _made(time: Array, angles: list[Array]) -> SampledStroke | None:
    try:
        return SampledStroke(*(tuple(values.tolist()) for values in (time, *angles)))
    except ValueError:
        return None


def _acceleration(series: Fit, time: Array) -> Array:
    order = np.arange(1, series.harmonics + 1)
    w = 2.0 * np.pi * series.frequency
    angle = np.multiply.outer(w * time, order)
    square = -((w * order) ** 2)
    return np.asarray(np.cos(angle) @ (square * series.cos) + np.sin(angle) @ (square * series.sin))
