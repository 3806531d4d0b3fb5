"""Bounds of the servos' controls, as dm_control and Gymnasium's MujocoEnv read them."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from flaprig._paths import RIG_XML
from flaprig.motors import RIG_MOTORS
from flaprig.native import library
from flaprig.rig import Rig


def models() -> list[mujoco.MjModel]:
    library.load()
    return [mujoco.MjModel.from_xml_path(str(RIG_XML)), Rig.load().compile()]


@pytest.mark.parametrize("number", [0, 1], ids=["file", "Rig"])
def test_every_control_is_bounded_and_none_is_clipped(number: int) -> None:
    """MJCF has one range for the three controls of a motor: it covers each of them."""
    model = models()[number]
    assert model.actuator_ctrllimited.all()
    low, high = model.actuator_ctrlrange.T
    np.testing.assert_array_equal(low, -high)
    motor = RIG_MOTORS.sweep
    widest = max(motor.no_load_speed, motor.stall_torque, float(model.jnt_range.max()))
    np.testing.assert_allclose(high, widest, rtol=1e-12)


def test_beyond_the_bounds_is_as_at_the_bounds() -> None:
    (model, _) = models()
    states = []
    for factor in (1.0, 3.0):
        data = mujoco.MjData(model)
        data.ctrl[:] = factor * model.actuator_ctrlrange[:, 1]
        mujoco.mj_step(model, data, nstep=50)
        states.append(data.qpos.copy())
    np.testing.assert_array_equal(*states)


def test_dm_control_and_gymnasium_read_them() -> None:
    control = pytest.importorskip("dm_control.mujoco")
    (model, _) = models()
    spec = control.engine.action_spec(control.Physics.from_xml_path(str(RIG_XML)))
    np.testing.assert_array_equal(spec.maximum, model.actuator_ctrlrange[:, 1])
    spaces = pytest.importorskip("gymnasium.spaces")
    low, high = model.actuator_ctrlrange.astype(np.float32).T
    box = spaces.Box(low=low, high=high, dtype=np.float32)
    assert box.is_bounded() and np.ptp(np.stack([box.sample() for _ in range(20)])) > 1
