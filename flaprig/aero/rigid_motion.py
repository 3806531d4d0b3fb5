"""The wing frame's pose, twist and its rate at many instants, from a stroke or any rigid motion.

Frames as in the paper's figure 2: sweep about the vertical z, pitch from the vertical; wing axes
x chordwise aft, y along the span, z normal. The angular velocity is sweep_rate z - pitch_rate y.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from flaprig.strokes.stroke import Motion

Array = NDArray[np.float64]


def wing_axes(sweep: Array, pitch: Array) -> Array:
    """Rotation from wing to world axes; its columns are chord, span and normal. Shape (n, 3, 3)."""
    zero, one = np.zeros_like(sweep), np.ones_like(sweep)
    span = np.stack([np.cos(sweep), np.sin(sweep), zero], axis=-1)
    along = np.stack([-np.sin(sweep), np.cos(sweep), zero], axis=-1)
    up = np.stack([zero, zero, one], axis=-1)
    chord = -(np.cos(pitch)[..., None] * up + np.sin(pitch)[..., None] * along)
    return np.stack([chord, span, np.cross(chord, span)], axis=-1)


@dataclass(frozen=True, eq=False)
class RigidMotion:
    """A rigid wing's motion at equally spaced instants.

    Attributes:
        position: of the wing frame's origin, world axes, in [m]. Shape (n, 3).
        rotation: wing to world. Shape (n, 3, 3).
        twist: velocity of the origin [m/s] and angular velocity [rad/s], wing axes. Shape (n, 6).
        twist_rate: time derivative of twist's components. Shape (n, 6).
    """

    position: Array
    rotation: Array
    twist: Array
    twist_rate: Array

    @classmethod
    def from_stroke(cls, motion: Motion) -> Self:
        """The wing on the sweep axis, moved by a stroke."""
        cos, sin = np.cos(motion.pitch), np.sin(motion.pitch)
        rate, acceleration = motion.sweep_rate, motion.sweep_acceleration
        zero = np.zeros((motion.sweep.size, 3))
        spin = [-rate * cos, -motion.pitch_rate, rate * sin]
        spin_rate = [
            -acceleration * cos + rate * motion.pitch_rate * sin,
            -motion.pitch_acceleration,
            acceleration * sin + rate * motion.pitch_rate * cos,
        ]
        return cls(
            position=zero,
            rotation=np.ascontiguousarray(wing_axes(motion.sweep, motion.pitch)),
            twist=np.column_stack([zero, *spin]),
            twist_rate=np.column_stack([zero, *spin_rate]),
        )

    def part(self, instants: slice) -> RigidMotion:
        """Some of the instants."""
        return RigidMotion(
            self.position[instants],
            self.rotation[instants],
            self.twist[instants],
            self.twist_rate[instants],
        )

    def __len__(self) -> int:
        return len(self.position)
