"""The rig in dm_control, and the wake in what MuJoCo draws."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
import pytest

from flaprig._paths import RIG_XML
from flaprig.rig import Rig
from tests.plugin.models import Array, integration_state

control = pytest.importorskip("dm_control.mujoco")


def physics(legacy: bool) -> control.Physics:
    """The rig at the start of a stroke, its servos told to go."""
    rig = control.Physics.from_xml_path(str(RIG_XML))
    rig.legacy_step = legacy
    with rig.reset_context():
        mujoco.mj_resetDataKeyframe(rig.model.ptr, rig.data.ptr, 0)
        rig.data.ctrl[:] = [0.2, 0, 0, 0.7, 0, 0]
    return rig


def state(rig: control.Physics) -> Array:
    return integration_state(rig.model.ptr, rig.data.ptr)


@pytest.mark.parametrize("legacy", [False, True])
def test_rig_steps(legacy: bool) -> None:
    """As MuJoCo alone, from the same beginning."""
    rig = physics(legacy)
    model = mujoco.MjModel.from_xml_path(str(RIG_XML))
    data = mujoco.MjData(model)
    mujoco.mj_setState(model, data, state(rig), mujoco.mjtState.mjSTATE_INTEGRATION)
    steps = 200
    for _ in range(steps // 10):
        rig.step(10)
    if legacy:
        # the servo's command was not there yet when the first half step was done
        mujoco.mj_step1(model, data)
        mujoco.mj_step2(model, data)
        mujoco.mj_step(model, data, nstep=steps - 1)
    else:
        mujoco.mj_step(model, data, nstep=steps)
    assert abs(data.qpos[0] - 0.2) < 0.2 and abs(data.qpos[1] - 0.7) < 0.2
    np.testing.assert_allclose(rig.data.qpos, data.qpos, rtol=1e-9)
    np.testing.assert_allclose(rig.data.plugin_state, data.plugin_state, rtol=0, atol=1e-6)
    assert np.isfinite(rig.data.sensordata).all()


@pytest.mark.parametrize("legacy", [False, True])
def test_copy_of_physics_goes_its_own_way(legacy: bool) -> None:
    rig = physics(legacy)
    rig.step(120)
    twin = rig.copy(share_model=True)
    twin.legacy_step = legacy
    for each in (rig, twin):
        if legacy:
            # dm_control copies the physics but not the servos' velocities of the half step done
            mujoco.mj_forward(each.model.ptr, each.data.ptr)
        each.step(60)
    np.testing.assert_array_equal(state(twin), state(rig))
    kept = state(rig)
    twin.step(30)
    np.testing.assert_array_equal(state(rig), kept)
    assert not np.array_equal(state(twin), kept)


@pytest.mark.parametrize("way", [copy.deepcopy, lambda rig: pickle.loads(pickle.dumps(rig))])
def test_deep_copy_and_pickle_of_physics(way: Callable[[Any], Any]) -> None:
    rig = physics(False)
    rig.step(120)
    twin = way(rig)
    twin.legacy_step = False
    for each in (rig, twin):
        each.step(60)
    np.testing.assert_array_equal(state(twin), state(rig))


def flapped() -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The rig after some wake rows."""
    model = Rig.load().compile()
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    data.ctrl[:] = [-0.5, 0, 0, 0.7, 0, 0]
    mujoco.mj_step(model, data, nstep=300)
    return model, data


def drawn(model: mujoco.MjModel, data: mujoco.MjData, room: int) -> Array:
    """Where the geoms are that the plugin adds to a scene [m]. Shape (n, 3)."""
    scene = mujoco.MjvScene(model, maxgeom=room)
    mujoco.mjv_updateScene(
        model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(),
        int(mujoco.mjtCatBit.mjCAT_ALL), scene,
    )  # fmt: skip
    assert scene.ngeom <= room
    # nothing else in this scene is of these kinds
    kinds = (mujoco.mjtGeom.mjGEOM_LINE, mujoco.mjtGeom.mjGEOM_TRIANGLE)
    added = [geom for geom in scene.geoms[: scene.ngeom] if geom.type in kinds]
    assert all(np.isfinite(geom.mat).all() for geom in added)
    return np.array([geom.pos for geom in added]).reshape(-1, 3)


def test_wake_is_drawn() -> None:
    """Something for each of the wake's rings, where the wing has been."""
    model, data = flapped()
    rings = 12 * (round(300 * model.opt.timestep / 0.05) - 1)
    places = drawn(model, data, 10_000)
    assert rings <= len(places) <= 4 * rings
    assert np.abs(places).max() < 0.5
    assert places[:, 0].min() < 0.05 and places[:, 0].max() > 0.1
    mujoco.mj_resetData(model, data)
    assert len(drawn(model, data, 10_000)) == 0


@pytest.mark.parametrize("room", [150, 100, 60])
def test_small_scene_is_not_overrun(room: int) -> None:
    """Fewer faces then, if there is room for any."""
    model, data = flapped()
    assert (room < 80) or 0 < len(drawn(model, data, room)) < room


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_broken_wake_is_not_drawn(value: float) -> None:
    """Drawing happens before MuJoCo's reset: it must not crash on what is no number."""
    model, data = flapped()
    data.plugin_state[32:] = value
    assert len(drawn(model, data, 10_000)) == 0


def test_wake_is_in_the_picture() -> None:
    """The same view with and without the wake differs where the wake is; neither is black."""
    rig = physics(False)
    rig.step(300)
    try:
        wet = rig.render(height=120, width=160, camera_id="iso")
    except (RuntimeError, ImportError, AttributeError, mujoco.FatalError) as error:
        pytest.skip(f"no OpenGL here: {error}")
    mujoco.mj_resetDataKeyframe(rig.model.ptr, rig.data.ptr, 0)
    mujoco.mj_forward(rig.model.ptr, rig.data.ptr)
    dry = rig.render(height=120, width=160, camera_id="iso")
    assert wet.mean() > 20 and wet.std() > 5
    assert (np.abs(wet.astype(int) - dry).max(axis=-1) > 20).sum() > 100


@pytest.mark.parametrize(("azimuth", "elevation"), [(140, -20), (90, -5), (180, -12), (270, -30)])
def test_wake_is_seen_through_the_tank(azimuth: float, elevation: float) -> None:
    """From outside: nearly as much of it as without glass and water."""
    rig = physics(False)
    rig.step(300)
    try:
        camera = control.MovableCamera(rig, height=120, width=160)
    except (RuntimeError, ImportError, AttributeError, mujoco.FatalError) as error:
        pytest.skip(f"no OpenGL here: {error}")
    camera.set_pose([0.05, 0, -0.05], 1.1, azimuth, elevation)
    option, seen, wake = control.wrapper.MjvOption(), [], rig.data.plugin_state.copy()
    for tank in (1, 0):
        option.geomgroup[2] = tank
        pictures = []
        for wet in (1, 0):
            rig.data.plugin_state[:] = wet * wake
            pictures.append(camera.render(scene_option=option).astype(int))
        seen.append((np.abs(pictures[0] - pictures[1]).max(axis=-1) > 10).sum())
    through, free = seen
    assert free > 50 and through > 0.8 * free
