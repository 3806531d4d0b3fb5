"""The rig in other hands: servos following a stroke, dm_control, pictures."""

from __future__ import annotations

import math
import os

import mujoco
import numpy as np
import pytest

from flaprig import rig as names
from flaprig.aero.models import QuasiSteady
from flaprig.rig import Rig, controls, weigh_stops


@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
def test_servos_follow_a_stroke_within_half_a_degree(step: float) -> None:
    """One cycle of the paper's sinusoid in water, no feedforward; lag of the first 0.1 s aside."""
    spec = Rig.load().with_(model=QuasiSteady()).spec()
    spec.option.timestep = step
    model = spec.compile()
    weigh_stops(model)
    data = mujoco.MjData(model)
    where = controls(model)
    omega, reach = 2.0 * math.pi * 0.2, np.radians([60.0, 45.0])
    mujoco.mj_resetDataKeyframe(model, data, model.key(names.START).id)
    worst = np.zeros(2)
    # from the reversal at -phi0: sweep is minus a cosine, pitch has the sign of the sweep rate
    for count in range(1, round(5.0 / step)):
        phase = omega * step * count
        target = reach * [-math.cos(phase), math.sin(phase)]
        data.ctrl[where.position] = target
        data.ctrl[where.velocity] = omega * reach * [math.sin(phase), math.cos(phase)]
        mujoco.mj_step(model, data)
        if step * count > 0.1:
            worst = np.maximum(worst, np.abs(data.qpos - target))
    assert np.degrees(worst).max() < 0.5


@pytest.mark.filterwarnings("ignore")
def test_dm_control_steps_the_file() -> None:
    from dm_control import mujoco as dm_mujoco

    physics = dm_mujoco.Physics.from_xml_path(str(names.RIG_XML))
    with physics.reset_context():
        physics.data.qpos[:] = physics.model.key_qpos[0]
        physics.data.ctrl[:] = physics.model.key_ctrl[0]
    physics.legacy_step = False
    physics.step(50)
    assert physics.data.time == pytest.approx(0.1)
    np.testing.assert_allclose(physics.data.qpos, [-math.pi / 3, 0.0], atol=0.01)


@pytest.mark.parametrize("camera", list(names.Camera))
def test_picture_shows_something(compiled: mujoco.MjModel, camera: names.Camera) -> None:
    if not os.environ.get("MUJOCO_GL") and not os.environ.get("DISPLAY"):
        pytest.skip("no display, and MUJOCO_GL names no headless GL library (egl or osmesa)")
    data = mujoco.MjData(compiled)
    data.qpos[:] = 0.6, 0.7
    mujoco.mj_forward(compiled, data)
    try:
        renderer = mujoco.Renderer(compiled, 90, 120)
    except Exception as error:  # every GL backend has its own kind of failure
        pytest.skip(f"no GL: {error}")
    with renderer:
        renderer.update_scene(data, camera=camera)
        picture = renderer.render().astype(float)
    assert picture.std() > 10.0
    assert _wing_pixels(compiled, data, camera) > 20


def _wing_pixels(model: mujoco.MjModel, data: mujoco.MjData, camera: names.Camera) -> int:
    """How many pixels the plate changes when it is taken out of the picture."""
    pictures = []
    alpha = model.geom("plate").matid[0]
    for opacity in (1.0, 0.0):
        model.mat_rgba[alpha, 3] = opacity
        with mujoco.Renderer(model, 90, 120) as renderer:
            renderer.update_scene(data, camera=camera)
            pictures.append(renderer.render().astype(float))
    model.mat_rgba[alpha, 3] = 1.0
    return int((np.abs(pictures[0] - pictures[1]).max(axis=-1) > 10.0).sum())
