"""From rows of twelve coefficients to motions: equations 8 to 11, for many strokes at once.

The numbers are those of FourierStroke.normalized: amplitudes are half the peak-to-peak angles and
the mid-range is zero. Accelerations are bounded by their exact peaks, not by samples.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.rigid_motion import RigidMotion
from flaprig.tasks.hover_settings import HARMONICS, SAMPLES, HoverSettings
from flaprig.tasks.series import GRID, ORDER, extremes, samples, slope, waves

Array = NDArray[np.float64]

# an angle whose six coefficients are all below this has no shape
LEAST = 1e-9
_OBSERVED = waves(SAMPLES)
assert SAMPLES == GRID


@dataclass(frozen=True, eq=False)
class Shapes:
    """Normalised strokes; in every array of two, sweep comes before pitch.

    Attributes:
        series: coefficients of the angles in [rad]. Shape (rows, 2, 6).
        mean: that centres each angle's range, in [rad]. Shape (rows, 2).
        observation: both angles over their amplitudes, SAMPLES of each. Shape (rows, 200).
        peak_acceleration: largest size in [rad/s2]. Shape (rows, 2).
    """

    series: Array
    mean: Array
    observation: Array
    peak_acceleration: Array

    def rows(self, chosen: NDArray[np.int64]) -> Shapes:
        """Some of the strokes."""
        parts = (self.series, self.mean, self.observation, self.peak_acceleration)
        return Shapes(*(part[chosen] for part in parts))


def largest_is_one(coefficients: Array) -> Array:
    """Coefficients whose largest is 1 in each angle: the same stroke. Shape (rows, 12)."""
    angles = coefficients.reshape(-1, 2, 2 * HARMONICS)
    return (angles / np.abs(angles).max(axis=2, keepdims=True)).reshape(-1, 4 * HARMONICS)


def has_shape(coefficients: Array) -> NDArray[np.bool_]:
    """Rows that are strokes: finite, and neither angle all zero. Shape (rows,)."""
    size = np.abs(coefficients.reshape(-1, 2, 2 * HARMONICS)).max(axis=2)
    # written so that NaN counts as none
    return ((size > LEAST) & (size < np.inf)).all(axis=1)


def shapes(settings: HoverSettings, coefficients: Array) -> Shapes:
    """Strokes of coefficients (rows, 12) that all have a shape."""
    rows = len(coefficients)
    angle = coefficients.reshape(2 * rows, 2 * HARMONICS)
    values = samples(angle, _OBSERVED)
    # angles and their second derivatives with phase, searched together
    bend = -(ORDER**2) * angle
    both = np.concatenate([values, samples(bend, _OBSERVED)])
    low, high = extremes(np.concatenate([angle, bend]), both)
    half = 0.5 * (high[: 2 * rows] - low[: 2 * rows])
    middle = 0.5 * (high[: 2 * rows] + low[: 2 * rows])
    observation = np.clip((values - middle[:, None]) / half[:, None], -1.0, 1.0)
    amplitudes = (settings.sweep_amplitude, settings.pitch_amplitude)
    scale = np.tile(amplitudes, rows) / half
    peak = np.maximum(high[2 * rows :], -low[2 * rows :]) * scale
    return Shapes(
        series=(angle * scale[:, None]).reshape(rows, 2, 2 * HARMONICS),
        mean=(-scale * middle).reshape(rows, 2),
        observation=observation.reshape(rows, 2 * SAMPLES),
        peak_acceleration=(peak * (2.0 * np.pi * settings.frequency) ** 2).reshape(rows, 2),
    )


@dataclass(frozen=True, eq=False)
class Motions:
    """One cycle of many strokes at equal steps; every array of shape (rows, count).

    Attributes:
        sweep: in [rad].
        pitch: in [rad].
        sweep_rate: in [rad/s].
        pitch_rate: in [rad/s].
        sweep_acceleration: in [rad/s2].
        pitch_acceleration: in [rad/s2].
    """

    sweep: Array
    pitch: Array
    sweep_rate: Array
    pitch_rate: Array
    sweep_acceleration: Array
    pitch_acceleration: Array

    def repeated(self, cycles: int) -> Motions:
        """The same cycle several times."""
        if cycles == 1:
            return self
        return Motions(*(np.tile(getattr(self, f.name), (1, cycles)) for f in fields(self)))


def motions(shape: Shapes, frequency: float, wave: Array) -> Motions:
    """Strokes on the waves of one cycle, as `waves` gives them."""
    rows, w = len(shape.series), 2.0 * np.pi * frequency
    sweep, pitch = np.ascontiguousarray(np.moveaxis(shape.series, 1, 0))
    angle = np.concatenate([sweep, pitch])
    rate = w * slope(angle)
    found = samples(np.concatenate([angle, rate, -((w * ORDER) ** 2) * angle]), wave)
    found = found.reshape(3, 2, rows, -1)
    found[0] += np.moveaxis(shape.mean, 1, 0)[..., None]
    return Motions(*(found[order, joint] for order in range(3) for joint in range(2)))


def rigid_motion(motion: Motions) -> RigidMotion:
    """The wing's motion, as RigidMotion.from_stroke but many times as fast; rows one after another.

    Only the wing axes of its arrays are filled in place of being stacked and crossed.
    """
    shape = motion.sweep.shape
    c, s = np.cos(motion.sweep), np.sin(motion.sweep)
    cos, sin = np.cos(motion.pitch), np.sin(motion.pitch)
    rotation = np.empty((*shape, 3, 3))
    # columns: chord, span, normal
    rotation[..., 0, 0], rotation[..., 1, 0], rotation[..., 2, 0] = sin * s, -sin * c, -cos
    rotation[..., 0, 1], rotation[..., 1, 1], rotation[..., 2, 1] = c, s, 0.0
    rotation[..., 0, 2], rotation[..., 1, 2], rotation[..., 2, 2] = cos * s, -cos * c, sin
    twist, twist_rate = np.zeros((*shape, 6)), np.zeros((*shape, 6))
    rate, acceleration = motion.sweep_rate, motion.sweep_acceleration
    twist[..., 3], twist[..., 4], twist[..., 5] = -rate * cos, -motion.pitch_rate, rate * sin
    turning = rate * motion.pitch_rate
    twist_rate[..., 3] = turning * sin - acceleration * cos
    twist_rate[..., 4] = -motion.pitch_acceleration
    twist_rate[..., 5] = turning * cos + acceleration * sin
    count = motion.sweep.size
    return RigidMotion(
        position=np.zeros((count, 3)),
        rotation=rotation.reshape(count, 3, 3),
        twist=twist.reshape(count, 6),
        twist_rate=twist_rate.reshape(count, 6),
    )
