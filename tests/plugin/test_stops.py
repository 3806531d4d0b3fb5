"""Joint stops in water: MuJoCo weighs them with the rigid inertia alone, `weigh_stops` with all."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from flaprig.rig import weigh_stops
from tests.plugin.models import (
    ONLY_ADDED_MASS,
    Array,
    added_mass,
    document,
    instance,
    load,
    two_hinges,
    wing,
)

# torque that leans on the stop [N m], and the stop's place [rad]
TORQUE, STOP = 0.02, 0.3


def one_hinge(water: bool, armature: float = 0.0) -> mujoco.MjModel:
    hinge = f'<joint name="pitch" axis="0 -1 0" range="-1 {STOP}" armature="{armature!r}"/>'
    extension = instance(ONLY_ADDED_MASS) if water else ""
    return load(document(extension, wing(hinge, air="air" if water else "")))


def penetration(model: mujoco.MjModel) -> Array:
    """How far the torque presses each joint beyond its stop in the end [rad]."""
    data = mujoco.MjData(model)
    data.qpos[:] = STOP
    data.qfrc_applied[:] = TORQUE
    mujoco.mj_step(model, data, nstep=3000)
    assert np.abs(data.qvel).max() < 1e-6
    return data.qpos - STOP


def test_stop_in_water_is_as_stiff_as_with_armature() -> None:
    """Against an inertia that MuJoCo knows from the beginning."""
    water = one_hinge(True)
    raw = penetration(water)[0]
    weigh_stops(water)
    weighed = penetration(water)[0]
    known = penetration(one_hinge(False, float(added_mass(ONLY_ADDED_MASS)[2, 2])))[0]
    assert weighed == pytest.approx(known, rel=1e-9)
    # the water's inertia is about nine times the plate's, and so is the error
    inertia = 1.0 + added_mass(ONLY_ADDED_MASS)[2, 2] * one_hinge(False).dof_invweight0[0]
    assert inertia > 8.0
    assert raw / weighed == pytest.approx(inertia, rel=0.1)


def test_both_stops_of_the_rig() -> None:
    model = load(two_hinges(ONLY_ADDED_MASS, limits=f'range="-1 {STOP}"'))
    raw = penetration(model)
    weigh_stops(model)
    weighed = penetration(model)
    assert (weighed > 0).all()
    assert raw[0] > 3 * weighed[0] and raw[1] > 5 * weighed[1]
