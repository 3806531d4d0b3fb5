"""Piecewise strokes: constant rates in mid-stroke, smooth reversals of given durations.

M. Sun & J. Tang, Unsteady aerodynamic force generation by a model fruit fly wing in flapping
motion, J. Exp. Biol. 205 (2002) 55-70; the paper's section 2.2 with a half-sine pitch.
"""

from __future__ import annotations

import json
import os
from dataclasses import asdict, dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike

from flaprig import _checks as check
from flaprig.strokes.stroke import (
    MOST_FREQUENCY,
    Array,
    Motion,
    PeriodicStroke,
    write_whole,
)

# shortest reversal [cycles]: keeps accelerations finite
LEAST_DURATION = 1e-3
# longest reversal [cycles]: one half stroke
MOST_DURATION = 0.5


class PitchProfile(StrEnum):
    """How the pitch angle passes a reversal."""

    # pitch follows half a sine: sinusoidal at duration 0.5, acceleration jumps at the flip's ends
    HALF_SINE = "half_sine"
    # pitch rate follows a raised cosine (Sun & Tang 2002): smooth, not sinusoidal at 0.5
    RAISED_COSINE = "raised_cosine"


@dataclass(frozen=True)
class SunTangStroke(PeriodicStroke):
    """A symmetric stroke with sweep and pitch reversals of given durations.

    Time 0 is the reversal at sweep = -sweep_amplitude, pitch = 0. With both durations 0.5 and the
    half-sine pitch, sweep = -sweep_amplitude cos(2 pi f t), pitch = pitch_amplitude sin(2 pi f t).

    Attributes:
        frequency: strokes per second in [Hz].
        sweep_amplitude: half of the peak-to-peak sweep in [rad], 0 to pi.
        pitch_amplitude: half of the peak-to-peak pitch in [rad], 0 to pi.
        sweep_duration: length of a sweep reversal in cycles, 0.001 to 0.5.
        pitch_duration: length of a pitch flip in cycles, 0.001 to 0.5.
        pitch_profile: shape of the flip, a PitchProfile or its value.

    Raises:
        ValueError: a field outside its range, or an unknown profile.
    """

    frequency: float
    sweep_amplitude: float
    pitch_amplitude: float
    sweep_duration: float = 0.5
    pitch_duration: float = 0.5
    pitch_profile: PitchProfile | str = PitchProfile.HALF_SINE

    def __post_init__(self) -> None:
        owner = "SunTangStroke"
        profile = check.one_of(owner, "pitch_profile", self.pitch_profile, PitchProfile)
        frequency = check.positive(owner, "frequency", self.frequency, "Hz", most=MOST_FREQUENCY)
        object.__setattr__(self, "pitch_profile", profile)
        object.__setattr__(self, "frequency", frequency)
        for name in ("sweep_amplitude", "pitch_amplitude"):
            unit = "rad (radians, not degrees)"
            amplitude = check.in_range(owner, name, getattr(self, name), 0.0, np.pi, unit)
            object.__setattr__(self, name, amplitude)
        for name in ("sweep_duration", "pitch_duration"):
            value = getattr(self, name)
            duration = check.in_range(owner, name, value, LEAST_DURATION, MOST_DURATION, "cycles")
            object.__setattr__(self, name, duration)

    def motion(self, time: ArrayLike) -> Motion:
        """The motion at any instants in [s], of any shape; every value is analytic.

        Raises:
            ValueError: an instant that is not a finite number.
        """
        instants = check.times("SunTangStroke", time)
        side, x = _nearest_reversal(self.frequency * instants)
        sweep = _sweep(x, self.sweep_amplitude, self.sweep_duration)
        flip = _half_sine if self.pitch_profile == PitchProfile.HALF_SINE else _raised_cosine
        pitch = flip(x, self.pitch_amplitude, self.pitch_duration)
        # the laws count time in cycles
        scale = (1.0, self.frequency, self.frequency**2)
        phi = [side * factor * value for factor, value in zip(scale, sweep, strict=True)]
        theta = [side * factor * value for factor, value in zip(scale, pitch, strict=True)]
        return Motion(instants, phi[0], theta[0], phi[1], theta[1], phi[2], theta[2])

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the stroke as JSON, in [Hz], [rad] and cycles, whole or not at all."""
        document = {"stroke": "sun_tang", "parameters": asdict(self)}
        write_whole(path, json.dumps(document, indent=2) + "\n", "JSON")


def _nearest_reversal(cycles: Array) -> tuple[Array, Array]:
    """Sign of the sweep rate around the nearest reversal, and the distance to it in cycles."""
    shifted = np.mod(cycles + 0.25, 1.0)
    first = shifted < 0.5
    return np.where(first, 1.0, -1.0), shifted - np.where(first, 0.25, 0.75)


def _sweep(x: Array, amplitude: float, duration: float) -> tuple[Array, Array, Array]:
    """Sweep, rate and acceleration per cycle around the lower reversal (rate of half-sine form)."""
    # plateau of the rate, from its integral over one half stroke = 2 amplitude
    plateau = 2.0 * amplitude / (0.5 - duration * (1.0 - 2.0 / np.pi))
    flipping, argument = np.abs(x) <= 0.5 * duration, np.pi * x / duration
    rate = np.where(flipping, np.sin(argument), np.sign(x))
    acceleration = np.where(flipping, np.cos(argument), 0.0) * np.pi / duration
    inside = duration / np.pi * (1.0 - np.cos(argument))
    outside = duration / np.pi + np.abs(x) - 0.5 * duration
    travelled = np.where(flipping, inside, outside)
    return plateau * travelled - amplitude, plateau * rate, plateau * acceleration


def _half_sine(x: Array, amplitude: float, duration: float) -> tuple[Array, Array, Array]:
    """Pitch, rate and acceleration per cycle; the acceleration jumps at the ends of the flip."""
    flipping, argument = np.abs(x) <= 0.5 * duration, np.pi * x / duration
    rate = np.pi / duration
    angle = np.where(flipping, np.sin(argument), np.sign(x))
    speed = np.where(flipping, np.cos(argument), 0.0) * rate
    acceleration = np.where(flipping, -np.sin(argument), 0.0) * rate**2
    return amplitude * angle, amplitude * speed, amplitude * acceleration


def _raised_cosine(x: Array, amplitude: float, duration: float) -> tuple[Array, Array, Array]:
    """Pitch, rate and acceleration per cycle with Sun & Tang's (2002) raised-cosine rate."""
    flipping, argument = np.abs(x) <= 0.5 * duration, 2.0 * np.pi * x / duration
    rate = 2.0 / duration
    angle = np.where(flipping, 2.0 * x / duration + np.sin(argument) / np.pi, np.sign(x))
    speed = np.where(flipping, 1.0 + np.cos(argument), 0.0) * rate
    acceleration = np.where(flipping, -np.sin(argument), 0.0) * rate * 2.0 * np.pi / duration
    return amplitude * angle, amplitude * speed, amplitude * acceleration
