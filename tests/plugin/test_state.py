"""The wake is MuJoCo's state: saved, copied, pickled, reset with it, bit for bit."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    BLADES,
    FREE,
    LAGGING,
    OWN_MEMORY,
    Array,
    integration_state,
    load,
    random_state,
    two_hinges,
    wake_of,
)

SPECS = {
    "integration": mujoco.mjtState.mjSTATE_INTEGRATION,
    "full physics": mujoco.mjtState.mjSTATE_FULLPHYSICS,
}
# steps of 4 ms, six of them for a row of the wake: one is half done when the state is taken
BEFORE, AFTER = 105, 81


def model(air: dict[str, str] = FREE) -> mujoco.MjModel:
    """The two hinges in a small lattice's water, swinging under gravity."""
    return load(two_hinges(air, 'gravity="0 0 -9.81" timestep="0.004"'))


def swinging(m: mujoco.MjModel, steps: int) -> mujoco.MjData:
    data = random_state(m, 0, 1.5)
    mujoco.mj_step(m, data, nstep=steps)
    return data


def saved(m: mujoco.MjModel, data: mujoco.MjData, spec: mujoco.mjtState) -> Array:
    state = np.empty(mujoco.mj_stateSize(m, spec))
    mujoco.mj_getState(m, data, state, spec)
    return state


@pytest.mark.parametrize("air", [FREE, LAGGING | {"wake_step": "0.025"}], ids=["plain", "lagging"])
@pytest.mark.parametrize("name", SPECS)
def test_restored_run_continues_bit_for_bit(name: str, air: dict[str, str]) -> None:
    m, spec = model(air), SPECS[name]
    data = swinging(m, BEFORE)
    state = saved(m, data, spec)
    mujoco.mj_step(m, data, nstep=AFTER)
    expected = integration_state(m, data)
    # into the same data, which has gone on, and into a fresh one
    for other in (data, mujoco.MjData(m)):
        mujoco.mj_setState(m, other, state, spec)
        mujoco.mj_step(m, other, nstep=AFTER)
        np.testing.assert_array_equal(integration_state(m, other), expected)
    assert len(wake_of(m, data, air)) > 20
    assert not data.warning.number.any()


# what another process does with the files it is given
CONTINUE = """
import pickle, sys
import mujoco, numpy as np
from tests.plugin import test_state as here
m = here.model()
data = mujoco.MjData(m)
mujoco.mj_setState(m, data, np.load(sys.argv[1])["state"], here.SPECS["integration"])
m2, pickled = pickle.load(open(sys.argv[2], "rb"))
for each, at in ((m, data), (m2, pickled)):
    mujoco.mj_step(each, at, nstep=here.AFTER)
np.savez(sys.argv[3], here.integration_state(m, data), here.integration_state(m2, pickled))
"""


def test_another_process_continues_bit_for_bit(root: Path, tmp_path: Path) -> None:
    """From a saved state, and from a pickle of model and data."""
    m = model()
    data = swinging(m, BEFORE)
    np.savez(tmp_path / "state.npz", state=saved(m, data, SPECS["integration"]))
    (tmp_path / "run.pickle").write_bytes(pickle.dumps((m, data)))
    files = [str(tmp_path / name) for name in ("state.npz", "run.pickle", "end.npz")]
    subprocess.run([sys.executable, "-c", CONTINUE, *files], cwd=root, check=True, timeout=60)
    mujoco.mj_step(m, data, nstep=AFTER)
    with np.load(files[2]) as ends:
        for end in ends.values():
            np.testing.assert_array_equal(end, integration_state(m, data))


def test_pickle_in_one_process() -> None:
    """The number that MuJoCo keeps for a plugin is pickled too: it must not be a pointer."""
    m = model()
    data = swinging(m, BEFORE)
    for _ in range(3):
        other = pickle.loads(pickle.dumps(data))
        mujoco.mj_step(m, other, nstep=AFTER)
        again = swinging(m, BEFORE + AFTER)
        np.testing.assert_array_equal(integration_state(m, other), integration_state(m, again))
        del other
    mujoco.mj_step(m, data, nstep=AFTER)
    np.testing.assert_array_equal(integration_state(m, data), integration_state(m, again))


def copied(m: mujoco.MjModel, data: mujoco.MjData) -> mujoco.MjData:
    other = mujoco.MjData(m)
    mujoco.mj_copyData(other, m, data)
    return other


def test_copy_continues_bit_for_bit() -> None:
    m = model()
    data = swinging(m, BEFORE)
    other = copied(m, data)
    for each in (data, other):
        mujoco.mj_step(m, each, nstep=AFTER)
    np.testing.assert_array_equal(integration_state(m, data), integration_state(m, other))


@pytest.mark.parametrize("steps", range(13))
def test_copy_in_the_middle_of_a_step(steps: int) -> None:
    """Between mj_step1 and mj_step2, as dm_control does; one of the steps ends a wake row."""
    m = model()
    data = swinging(m, BEFORE + steps)
    mujoco.mj_step1(m, data)
    other, pickled = copied(m, data), pickle.loads(pickle.dumps(data))
    for each in (data, other, pickled):
        mujoco.mj_step2(m, each)
    np.testing.assert_array_equal(integration_state(m, data), integration_state(m, other))
    np.testing.assert_array_equal(data.sensordata, other.sensordata)
    # a pickle has lost the step's own velocities: the wake finds them again but for roundoff
    np.testing.assert_array_equal(data.qvel, pickled.qvel)
    np.testing.assert_allclose(
        pickled.plugin_state[OWN_MEMORY:], data.plugin_state[OWN_MEMORY:], rtol=0, atol=1e-12
    )
    np.testing.assert_allclose(pickled.sensordata, data.sensordata, rtol=0, atol=0.01)


@pytest.mark.parametrize("air", [FREE, BLADES], ids=["uvlm", "quasi_steady"])
def test_reset_forgets_everything(air: dict[str, str]) -> None:
    m = load(two_hinges(air, 'gravity="0 0 -9.81" timestep="0.004"'))
    data = swinging(m, BEFORE)
    assert data.plugin_state.any()
    mujoco.mj_resetData(m, data)
    assert not data.plugin_state.any()
    assert not data.sensordata.any()
    again, fresh = data, mujoco.MjData(m)
    for each in (again, fresh):
        each.qpos[:], each.qvel[:] = 0.5, 1.0
        mujoco.mj_step(m, each, nstep=AFTER)
    np.testing.assert_array_equal(integration_state(m, again), integration_state(m, fresh))
    assert fresh.sensor("aero").data.any()


def test_keyframe_starts_without_a_wake() -> None:
    m = model()
    data = swinging(m, BEFORE)
    assert len(wake_of(m, data, FREE)) > 5
    mujoco.mj_resetDataKeyframe(m, data, -1)
    assert len(wake_of(m, data, FREE)) == 0


def test_data_outlives_other_data() -> None:
    """Freed and new mjData may share an address; each still has its own air."""
    m = model()
    for i in range(50):
        data = [swinging(m, 3) for _ in range(3)]
        del data[i % 3]
        for each in data:
            mujoco.mj_step(m, each, nstep=2)
            assert np.isfinite(each.qpos).all()
