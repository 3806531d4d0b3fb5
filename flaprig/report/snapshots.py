"""Wing and wake at chosen instants of a prescribed stroke, for pictures and animations."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.air import Air, Progress
from flaprig.aero.models import UVLM
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER, Fluid
from flaprig.strokes.stroke import Stroke
from flaprig.wing import Wing

Array = NDArray[np.float64]

# panels drawn along the chord of a wing: enough for a pointed tip to look smooth
CHORDWISE = 2


@dataclass(frozen=True, eq=False)
class Snapshot:
    """Wing and wake at one instant, in the world frame.

    Attributes:
        time: [s].
        wing: points of the wing from leading to trailing edge [m]. Shape (3, k, 3).
        wake: vertices of the wake, the trailing edge first, then newest to oldest row [m].
            Shape (rows + 1, strips + 1, 3).
        circulation: of the wake's rings [m2/s]; the ring at the trailing edge, which the Kutta
            condition holds, is given the value of the newest free one. Shape (rows, strips).
    """

    time: float
    wing: Array
    wake: Array
    circulation: Array


def wing_points(wing: Wing, rotation: Array) -> Array:
    """Points of the wing in the world frame [m], its wing frame at the origin. Shape (3, k, 3)."""
    radius, chord, edge = wing.stations.T
    x = edge + np.linspace(0.0, 1.0, CHORDWISE + 1)[:, None] * chord
    points = np.stack([x, np.broadcast_to(radius, x.shape), np.zeros_like(x)], axis=-1)
    return points @ rotation.T


def snapshots(
    wing: Wing,
    stroke: Stroke,
    model: UVLM,
    instants: Array,
    fluid: Fluid = WATER,
    progress: Progress | None = None,
) -> Iterator[Snapshot]:
    """Wing and wake at increasing instants, counted in cycles from still fluid at 0.

    Each instant is moved to the nearest step of the model. The wake is the one the solver holds,
    shed up to the step before.
    """
    step = stroke.period / model.steps_per_cycle
    counts = np.rint(np.asarray(instants) * model.steps_per_cycle).astype(int)
    motion = RigidMotion.from_stroke(stroke.motion(np.arange(counts.max() + 1) * step))
    air = Air(wing, fluid, model, stroke.frequency, stroke.sweep_amplitude)
    done = 0
    for count in counts:
        if count + 1 > done:
            air.run(motion.part(slice(done, count + 1)), step)
            done = count + 1
        if progress is not None:
            progress(done / len(motion))
        points = wing_points(wing, motion.rotation[count])
        yield Snapshot(count * step, points, **joined(wing, motion.rotation[count], *air.wake()))


def joined(wing: Wing, rotation: Array, wake: Array, circulation: Array) -> dict[str, Array]:
    """The wake with a row of rings between the trailing edge and its newest vertices."""
    radius, chord, edge = wing.stations.T
    y = np.clip(wake[0] @ rotation[:, 1], radius[0], radius[-1])
    x = np.interp(y, radius, edge + chord)
    trailing = np.outer(x, rotation[:, 0]) + np.outer(y, rotation[:, 1])
    return {
        "wake": np.concatenate([trailing[None], wake]),
        "circulation": np.concatenate([circulation[:1], circulation]),
    }
