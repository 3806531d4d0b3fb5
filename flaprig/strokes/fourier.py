"""Strokes of a few harmonics: equations 8 and 9 of the paper, normalised by 10 and 11.

As printed, equations 10 and 11 make the amplitude a peak-to-peak value and keep the offset of the
series. Here an amplitude is half of the peak-to-peak angle, and the mid-range is moved to zero.
"""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from flaprig import _checks as check
from flaprig.strokes.stroke import (
    MOST_ANGLE,
    MOST_FREQUENCY,
    Array,
    Motion,
    PeriodicStroke,
    write_whole,
)

# largest number of harmonics: the extremes are roots of a polynomial of twice this degree
MOST_HARMONICS = 100


@dataclass(frozen=True)
class FourierStroke(PeriodicStroke):
    """Sweep and pitch as mean + sum over n of cos_n cos(n w t) + sin_n sin(n w t), w = 2 pi f.

    The sinusoidal stroke of amplitudes A and B is sweep_cos = (-A,), pitch_sin = (B,).

    Attributes:
        frequency: strokes per second in [Hz].
        sweep_cos: cosine coefficients of the sweep in [rad], n = 1, 2, ... Length n_phi >= 1.
        sweep_sin: sine coefficients of the sweep in [rad]. Length n_phi.
        pitch_cos: cosine coefficients of the pitch in [rad]. Length n_theta >= 1.
        pitch_sin: sine coefficients of the pitch in [rad]. Length n_theta.
        sweep_mean: mean sweep in [rad].
        pitch_mean: mean pitch in [rad].

    Raises:
        ValueError: a coefficient that is not finite, lists of unequal length, or an angle beyond
            one turn, which looks like degrees.
    """

    frequency: float
    sweep_cos: tuple[float, ...]
    sweep_sin: tuple[float, ...]
    pitch_cos: tuple[float, ...]
    pitch_sin: tuple[float, ...]
    sweep_mean: float = 0.0
    pitch_mean: float = 0.0

    def __post_init__(self) -> None:
        owner = "FourierStroke"
        frequency = check.positive(owner, "frequency", self.frequency, "Hz", most=MOST_FREQUENCY)
        object.__setattr__(self, "frequency", frequency)
        for angle in ("sweep", "pitch"):
            values = [getattr(self, f"{angle}_{part}") for part in ("cos", "sin")]
            cos, sin = _checked_pair(owner, f"{angle}_cos", f"{angle}_sin", *values)
            mean = check.finite(owner, f"{angle}_mean", getattr(self, f"{angle}_mean"), "rad")
            object.__setattr__(self, f"{angle}_cos", tuple(cos.tolist()))
            object.__setattr__(self, f"{angle}_sin", tuple(sin.tolist()))
            object.__setattr__(self, f"{angle}_mean", mean)
            # the sum bounds the angle; only where it is large are the extremes worth their time
            if abs(mean) + np.abs(cos).sum() + np.abs(sin).sum() > MOST_ANGLE:
                _refuse_degrees(angle, getattr(self, f"{angle}_extremes"))

    @classmethod
    def normalized(
        cls,
        frequency: float,
        a_sweep: ArrayLike,
        b_sweep: ArrayLike,
        a_pitch: ArrayLike,
        b_pitch: ArrayLike,
        sweep_amplitude: float,
        pitch_amplitude: float,
    ) -> FourierStroke:
        """Equations 8 to 11: any coefficients, scaled to the amplitudes with mid-range zero.

        Args:
            frequency: strokes per second in [Hz].
            a_sweep: cosine coefficients of the sweep, of any scale, n = 1, 2, ...
            b_sweep: sine coefficients of the sweep, as many.
            a_pitch: cosine coefficients of the pitch.
            b_pitch: sine coefficients of the pitch, as many.
            sweep_amplitude: half of the peak-to-peak sweep in [rad], 0 to pi.
            pitch_amplitude: half of the peak-to-peak pitch in [rad], 0 to pi.

        Raises:
            ValueError: bad or unequal lists, all coefficients of an angle zero, or an amplitude
                outside its range.
        """
        phi = _normalized("sweep", a_sweep, b_sweep, sweep_amplitude)
        theta = _normalized("pitch", a_pitch, b_pitch, pitch_amplitude)
        return cls(frequency, phi[0], phi[1], theta[0], theta[1], phi[2], theta[2])

    @cached_property
    def sweep_extremes(self) -> tuple[float, float]:
        """Lowest and highest sweep in [rad]."""
        low, high = _extremes(np.array(self.sweep_cos), np.array(self.sweep_sin))
        return self.sweep_mean + low, self.sweep_mean + high

    @cached_property
    def pitch_extremes(self) -> tuple[float, float]:
        """Lowest and highest pitch in [rad]."""
        low, high = _extremes(np.array(self.pitch_cos), np.array(self.pitch_sin))
        return self.pitch_mean + low, self.pitch_mean + high

    @property
    def sweep_amplitude(self) -> float:
        """Half of the peak-to-peak sweep in [rad]."""
        return 0.5 * (self.sweep_extremes[1] - self.sweep_extremes[0])

    @property
    def pitch_amplitude(self) -> float:
        """Half of the peak-to-peak pitch in [rad]."""
        return 0.5 * (self.pitch_extremes[1] - self.pitch_extremes[0])

    def motion(self, time: ArrayLike) -> Motion:
        """The motion at any instants in [s], of any shape; every value is analytic.

        Raises:
            ValueError: an instant that is not a finite number.
        """
        instants = check.times("FourierStroke", time)
        # the phase is reduced first, so a late cycle is as exact as the first
        phase = 2.0 * np.pi * np.mod(self.frequency * instants, 1.0)
        phi = _derivatives(np.array(self.sweep_cos), np.array(self.sweep_sin), phase)
        theta = _derivatives(np.array(self.pitch_cos), np.array(self.pitch_sin), phase)
        w = 2.0 * np.pi * self.frequency
        return Motion(
            time=instants,
            sweep=self.sweep_mean + phi[0],
            pitch=self.pitch_mean + theta[0],
            sweep_rate=w * phi[1],
            pitch_rate=w * theta[1],
            sweep_acceleration=w**2 * phi[2],
            pitch_acceleration=w**2 * theta[2],
        )

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the stroke as JSON, in [Hz] and [rad], whole or not at all."""
        document = {"stroke": "fourier", "parameters": asdict(self)}
        write_whole(path, json.dumps(document, indent=2) + "\n", "JSON")


def _checked_pair(
    owner: str, cos_name: str, sin_name: str, cos: ArrayLike, sin: ArrayLike
) -> tuple[Array, Array]:
    cosines = check.array(owner, cos_name, cos, most_length=MOST_HARMONICS)
    return cosines, check.array(owner, sin_name, sin, length=cosines.size)


def _refuse_degrees(angle: str, extremes: tuple[float, float]) -> None:
    largest = max(extremes, key=abs)
    if abs(largest) > MOST_ANGLE:
        allowed = f"within {MOST_ANGLE:.6g} rad (radians, not degrees)"
        raise check.fail("FourierStroke", f"largest {angle} angle", allowed, largest)


def _normalized(
    angle: str, a: ArrayLike, b: ArrayLike, amplitude: float
) -> tuple[tuple[float, ...], tuple[float, ...], float]:
    """Coefficients in [rad] with the given amplitude, and the mean that centres the range."""
    owner = "FourierStroke.normalized"
    unit = "rad (radians, not degrees)"
    amplitude = check.in_range(owner, f"{angle}_amplitude", amplitude, 0.0, np.pi, unit)
    cos, sin = _checked_pair(owner, f"a_{angle}", f"b_{angle}", a, b)
    largest = max(np.abs(cos).max(), np.abs(sin).max())
    if largest < check.LEAST:
        allowed = f"not all zero (one of at least {check.LEAST:g})"
        raise check.fail(owner, f"a_{angle} and b_{angle}", allowed, float(largest))
    low, high = _extremes(cos / largest, sin / largest)
    scale = 2.0 * amplitude / (high - low)
    mean = -0.5 * scale * (high + low)
    cos, sin = (scale / largest * values for values in (cos, sin))
    return tuple(cos.tolist()), tuple(sin.tolist()), mean


def _derivatives(cos: Array, sin: Array, phase: Array) -> list[Array]:
    """The series without its mean, and its first and second derivative with phase."""
    n = np.arange(1, cos.size + 1)
    waves = np.multiply.outer(phase, n)
    c, s = np.cos(waves), np.sin(waves)
    orders = [(cos, sin), (n * sin, -n * cos), (-(n**2) * cos, -(n**2) * sin)]
    # asarray: one instant gives an array of no dimensions, not a numpy scalar
    return [np.asarray(c @ a + s @ b) for a, b in orders]


def _extremes(cos: Array, sin: Array) -> tuple[float, float]:
    """Lowest and highest value of the series without its mean, to rounding."""
    # spectrum of the slope; harmonics lost in its rounding only spoil the polynomial
    spectrum = np.arange(1, cos.size + 1) * (1j * cos + sin)
    size = np.abs(spectrum)
    if not size.any():
        return 0.0, 0.0
    spectrum = spectrum[: 1 + int(np.flatnonzero(size > 1e-16 * size.max())[-1])]
    # slope = sum of spectrum e^(int) and its conjugate: a polynomial in z = e^(it)
    polynomial = np.concatenate([spectrum[::-1], [0.0], np.conj(spectrum)]) / size.max()
    roots = np.angle(np.roots(polynomial))
    # roots off the circle and the grid are honest points too: no sorting needed
    phase = np.concatenate([roots, np.linspace(-np.pi, np.pi, 8 * cos.size, endpoint=False)])
    # one Newton step polishes roots of long polynomials
    _, slope, curvature = _derivatives(cos, sin, phase)
    steep = np.abs(curvature) > 1e-6 * np.abs(slope)
    newton = np.divide(slope, curvature, out=np.zeros_like(slope), where=steep)
    phase = np.concatenate([phase, phase - newton])
    values = _derivatives(cos, sin, phase)[0]
    return float(values.min()), float(values.max())
