"""What a load on the wing means to the rig: lift, side force, drag and joint torques, each once.

Wing axes as in rigid_motion: x chordwise aft, y along the span, z normal; the pitch is the angle
of the chord from the vertical. Drag is the force against the sweep (paper, eq. 12).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# a wing slower than this share of its peak sweep rate counts as slowing down to a stand: there the
# direction of its sweep hangs on rounding
STANDS_BELOW = 1e-3


def upward(vector: Array, pitch: Array) -> Array:
    """Upward part of forces or torques in wing axes: lift, or the torque about the sweep axis.

    Args:
        vector: chordwise, spanwise and normal part. Shape (..., 3).
        pitch: in [rad]. Shape (...).
    """
    return np.asarray(np.sin(pitch) * vector[..., 2] - np.cos(pitch) * vector[..., 0])


def side_force(force: Array, pitch: Array) -> Array:
    """Force along the stroke plane, positive against increasing sweep, in the force's unit.

    Args:
        force: in wing axes. Shape (..., 3).
        pitch: in [rad]. Shape (...).
    """
    return np.asarray(np.sin(pitch) * force[..., 0] + np.cos(pitch) * force[..., 2])


def sweep_direction(rate: Array, acceleration: Array, step: float) -> Array:
    """Mean sign of the sweep rate over the interval that each sample stands for; -1 to 1.

    Times the side force it is the drag. A sample stands for half a step on either side. Where the
    sweep turns inside of that interval, the time after the turn counts against the time before it,
    so that no mean jumps when a reversal moves across a sample: means are continuous in the motion,
    and right to second order in the step. Two things have no order: a reversal that is shorter than
    a step, and a rate that touches zero without a change of sign.

    Args:
        rate: of the sweep at samples of a whole motion in [rad/s]. The last axis is time.
        acceleration: at the same samples in [rad/s2]. Shape of rate.
        step: time between samples in [s].
    """
    peak = np.abs(rate).max(axis=-1, keepdims=True)
    # change of the rate to the interval's ends
    change = np.maximum(0.5 * step * np.abs(acceleration), STANDS_BELOW * peak)
    share = np.divide(rate, change, out=np.zeros_like(change), where=change > 0.0)
    return np.clip(share, -1.0, 1.0)
