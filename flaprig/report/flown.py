"""Wing and wake of the twin at one instant: the plugin's own wake, out of MuJoCo's state."""

from __future__ import annotations

import mujoco
import numpy as np

from flaprig.native import _native
from flaprig.report.flight import Flight
from flaprig.report.snapshots import Snapshot, joined, wing_points
from flaprig.rig import AIR, Site, coordinates
from flaprig.strokes.stroke import Stroke
from flaprig.twin import Twin

# numbers of the last step's loads ahead of the wake in the plugin's state: plugin/memory.hpp
LOADS = 16


def flown_snapshot(
    twin: Twin, stroke: Stroke, instant: float
) -> tuple[Snapshot, tuple[float, float]]:
    """Wing and wake of the twin, and half the peak-to-peak angles of the cycle before, in [rad].

    Args:
        twin: the rig with its vortex lattice, and how it is driven.
        stroke: that it follows from rest.
        instant: in cycles from still fluid.

    Raises:
        FloatingPointError: the state went wrong.
    """
    flight = Flight(twin, stroke)
    place, _ = coordinates(flight.model)
    steps = twin.steps_per_cycle(stroke)
    angles = []
    for data in flight.at(np.arange(1, round(instant * steps) + 1) * flight.model.opt.timestep):
        angles.append(data.qpos[place].copy())
    reached = np.ptp(np.array(angles[-steps:]), axis=0) / 2.0

    rig = twin.rig.running(stroke)
    settings = rig.model.attributes(rig.wing, rig.fluid, rig.frequency, rig.sweep_amplitude)
    number = mujoco.mj_name2id(flight.model, mujoco.mjtObj.mjOBJ_PLUGIN, AIR)
    start = int(flight.model.plugin_stateadr[number])
    length = int(flight.model.plugin_statenum[number])
    state = flight.data.plugin_state[start + LOADS : start + length].copy()
    wake = _native.Air(rig.model.plugin, settings).wake(state)

    rotation = flight.data.site(Site.WING_FRAME).xmat.reshape(3, 3)
    shot = Snapshot(
        time=float(flight.data.time),
        wing=wing_points(rig.wing, rotation),
        **joined(rig.wing, rotation, *wake),
    )
    return shot, (float(reached[0]), float(reached[1]))
