"""Many rigs at once: mujoco.batch and mujoco.rollout against a plain loop, bit for bit."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from mujoco import rollout
from mujoco.batch import Batch, SimulationError

from tests.plugin.models import BLADES, FREE, Array, integration_state, load, two_hinges

RIGS, STEPS = 5, 60
AIRS = {"uvlm": FREE, "quasi_steady": BLADES}


def model(name: str) -> mujoco.MjModel:
    return load(two_hinges(AIRS[name], 'gravity="0 0 -9.81" timestep="0.005"'))


def starts(m: mujoco.MjModel) -> list[mujoco.MjData]:
    """One rig each, all started differently."""
    rigs = []
    for seed in range(RIGS):
        data = mujoco.MjData(m)
        rng = np.random.default_rng(seed)
        data.qpos[:], data.qvel[:] = rng.uniform(-1, 1, 2), rng.uniform(-2, 2, 2)
        rigs.append(data)
    return rigs


def looped(m: mujoco.MjModel) -> tuple[Array, Array]:
    """States and sensors at the end of a plain loop."""
    rigs = starts(m)
    for data in rigs:
        mujoco.mj_step(m, data, nstep=STEPS)
        assert not data.warning.number.any()
    states = np.array([integration_state(m, data) for data in rigs])
    return states, np.array([data.sensordata for data in rigs])


@pytest.mark.parametrize("persistent", [False, True])
@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", AIRS)
def test_batch_is_a_loop(name: str, threads: int, persistent: bool) -> None:
    m = model(name)
    batch = Batch(m, nsim=RIGS, nthread=threads, persistent=persistent)
    sensors, qpos, qvel = (batch.bind(field) for field in ("sensordata", "qpos", "qvel"))
    for i, data in enumerate(starts(m)):
        qpos[i], qvel[i] = data.qpos, data.qvel
    for _ in range(STEPS // 4):
        batch.step(nstep=4)
    expected, read = looped(m)
    states = [integration_state(m, batch.get_data(i)) for i in range(RIGS)]
    np.testing.assert_array_equal(states, expected)
    np.testing.assert_array_equal(sensors, read)
    assert np.abs(read).max() > 0


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", AIRS)
def test_rollout_is_a_loop(name: str, threads: int) -> None:
    m, full = model(name), mujoco.mjtState.mjSTATE_FULLPHYSICS
    initial = np.empty((RIGS, mujoco.mj_stateSize(m, full)))
    for row, data in zip(initial, starts(m), strict=True):
        mujoco.mj_getState(m, data, row, full)
    workers = [mujoco.MjData(m) for _ in range(threads)]
    states, read = rollout.rollout(m, workers, initial, nstep=STEPS)
    loop = starts(m)
    for data in loop:
        mujoco.mj_step(m, data, nstep=STEPS)
    expected = np.empty_like(initial)
    for row, data in zip(expected, loop, strict=True):
        mujoco.mj_getState(m, data, row, full)
    np.testing.assert_array_equal(states[:, -1], expected)
    np.testing.assert_array_equal(read[:, -1], [data.sensordata for data in loop])


def test_one_refusal_leaves_the_other_rigs_alone() -> None:
    """A bad option in one row becomes that row's error, in words."""
    m = model("uvlm")
    batch = Batch(m, nsim=3, nthread=2)
    batch.expand("opt.integrator")[1] = int(mujoco.mjtIntegrator.mjINT_RK4)
    with pytest.raises(SimulationError, match="simulation 1: flaprig.uvlm .*integrator RK4"):
        batch.step()
    times = batch.bind("time")[:].ravel()
    np.testing.assert_allclose(times, [0.005, 0.0, 0.005])
