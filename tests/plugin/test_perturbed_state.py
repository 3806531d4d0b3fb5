"""Numbers that no run leaves in the plugin's state clear that wake, with a warning, everywhere."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
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
    load,
    native,
    random_state,
    two_hinges,
    wake_of,
)

# merges rows and finds old rows' velocities within some tens of rows
MERGING = FREE | {"wake_detail": "3", "wake_rows": "40"}
BRUTE = FREE | {"wake_detail": "0", "wake_rows": "20"}
AIRS = {"merging": MERGING, "brute force": BRUTE, "of the instant": LAGGING | {"wake_detail": "3"}}
# places in the wake's memory, as wake.hpp has them
STARTED, AGE, INTERVAL, ROWS = range(4)
NO_NUMBERS = (np.nan, np.inf, -np.inf, -1.0, 1e300, -1e300)
# (what of the wake, values that no run leaves there)
FAULTS: dict[str, tuple[int, tuple[float, ...]]] = {
    "started": (STARTED, (*NO_NUMBERS, 0.5, 2.0, 1e9)),
    "age": (AGE, (*NO_NUMBERS, 1e7)),
    "interval": (INTERVAL, (*NO_NUMBERS, 0.0, 1e-13, 5e-324)),
    "rows": (ROWS, (*NO_NUMBERS, 0.5, 6.5, 41.0, 100.0, 1e3, 1e5, 2.0**31, 2.0**32, 2.0**63)),
}


def flown(air: dict[str, str], steps: int = 250) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A wing that has swung for some tens of wake rows."""
    model = load(two_hinges(air, 'gravity="0 0 -9.81" timestep="0.004"', 'damping="1e-3"'))
    data = random_state(model, 0, 1.0)
    mujoco.mj_step(model, data, nstep=steps)
    assert not data.warning.number.any()
    return model, data


def ticks_of(air: dict[str, str], data: mujoco.MjData) -> tuple[slice, slice]:
    """Where the ticks of the rows stand, and those since old rows' velocities were found."""
    state = data.plugin_state[OWN_MEMORY:]
    rows, n = int(state[ROWS]), 4
    # whole numbers, newest first: ones, then powers of two; nothing else in the state looks like it
    lags = 2 * 12 if "circulation_lag" in air and float(air["circulation_lag"]) > 0 else 0
    detail = int(air["wake_detail"])
    capacity = max(
        c
        for c in range(rows, 500)
        if 16 + 8 * 12 + lags + (c + 1) * 15 + c * 5 + (c + 1 - detail) * (detail > 0) * 31
        == len(state)
    )
    first = 16 + 8 * 12 + (capacity + 1) * 15 + capacity * n
    old = capacity + 1 - detail if detail > 0 else 0
    found = len(state) - old
    return slice(first, first + rows), slice(found, found + (rows + 1 - detail if old else 0))


@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
@pytest.mark.parametrize("name", FAULTS)
def test_step_clears_what_is_no_wake(name: str, air: dict[str, str], told: list[str]) -> None:
    model, data = flown(air)
    sound = data.plugin_state.copy()
    place, values = FAULTS[name]
    for value in values:
        data.plugin_state[:] = sound
        data.plugin_state[OWN_MEMORY + place] = value
        data.warning.number[:] = 0
        told.clear()
        mujoco.mj_step(model, data)
        assert data.warning.number.tolist() == [0, 0, 0, 0, 0, 1, 0]
        assert len(told) == 1 and f"{name} is " in told[0] and "the wake is cleared" in told[0]
        # it began anew in this step
        assert len(wake_of(model, data, air)) <= 1
        assert np.isfinite(data.plugin_state).all() and np.isfinite(data.qpos).all()
        mujoco.mj_step(model, data, nstep=30)
        assert len(told) == 1 and len(wake_of(model, data, air)) > 1


@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
def test_counts_of_rows_are_checked(air: dict[str, str], told: list[str]) -> None:
    """Of each row: those it was shed in, and those since its velocity was found."""
    model, data = flown(air)
    sound = data.plugin_state.copy()
    ticks, found = ticks_of(air, data)
    values = sound[OWN_MEMORY:][ticks]
    assert len(values) > 10 and np.array_equal(values, 2.0 ** np.round(np.log2(values)))
    assert (values.max() > 1) == (air["wake_detail"] != "0")
    for where, odd in ((ticks, 0.0), (ticks, 3.0), (ticks, 1e9), (found, 5.0), (found, 0.5)):
        for value in (*NO_NUMBERS, odd):
            for place in range(where.start, where.stop, 3):
                data.plugin_state[:] = sound
                data.plugin_state[OWN_MEMORY + place] = value
                told.clear()
                data.warning.number[:] = 0
                mujoco.mj_forward(model, data)
                assert len(told) == 1 and "ticks" in told[0], (place, value)


@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS)
def test_rows_of_another_wake_are_seen(air: dict[str, str], told: list[str]) -> None:
    """Rows of one length before rows of another, and more of them than a wake is long."""
    model, data = flown(air)
    ticks, _ = ticks_of(air, data)
    state = data.plugin_state[OWN_MEMORY:]
    state[ticks] = 2.0 ** np.arange(ticks.stop - ticks.start)
    mujoco.mj_forward(model, data)
    assert len(told) == 1 and "ticks" in told[0]


def test_number_that_is_none_is_seen_when_a_row_is_due(told: list[str]) -> None:
    """A wing that nothing moves has no acceleration in which MuJoCo would see it."""
    joints = (
        two_hinges(FREE, 'timestep="0.004"')
        .replace("<joint", "<!--joint")
        .replace('axis="0 -1 0" />', 'axis="0 -1 0" /-->')
        .replace('axis="0 0 1" />', 'axis="0 0 1" /-->')
    )
    model = load(joints)
    data = mujoco.MjData(model)
    assert model.nv == 0
    mujoco.mj_step(model, data, nstep=200)
    assert data.plugin_state[OWN_MEMORY + ROWS] > 3
    data.plugin_state[-1] = np.nan
    mujoco.mj_step(model, data, nstep=20)
    assert len(told) == 1 and "not finite" in told[0]
    assert np.isfinite(data.plugin_state).all()


def test_blade_elements_remember_nothing_that_could_be_wrong() -> None:
    model, data = flown(BLADES)
    data.plugin_state[:] = np.nan
    mujoco.mj_step(model, data)
    # the last of these numbers is a spare
    assert np.isfinite(data.plugin_state[:-1]).all() and np.isfinite(data.qpos).all()
    assert not data.warning.number.any()


def test_warning_is_counted_at_every_step_and_told_once(told: list[str]) -> None:
    model, data = flown(FREE)
    for count in range(1, 4):
        data.plugin_state[OWN_MEMORY + ROWS] = -1
        mujoco.mj_step(model, data)
        assert data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number == count
    assert len(told) == 1


def still(count: int) -> tuple[Array, ...]:
    return (
        np.zeros((count, 3)),
        np.tile(np.eye(3), (count, 1, 1)),
        np.zeros((count, 6)),
        np.zeros((count, 6)),
    )


READERS: dict[str, Callable[..., object]] = {
    "run": lambda air, state: air.run(state, 0.004, *still(3)),
    "run_batch": lambda air, state: air.run_batch(np.tile(state, 2), 2, 0.004, *still(4)),
    "wake": lambda air, state: air.wake(state),
    "bound_circulation": lambda air, state: air.bound_circulation(state),
    "circulation": lambda air, state: air.circulation(state, *still(1)),
}


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("name", FAULTS)
def test_python_reads_no_broken_state(name: str, reader: str) -> None:
    _, data = flown(MERGING)
    state, air = data.plugin_state[OWN_MEMORY:].copy(), native(MERGING)
    place, values = FAULTS[name]
    for value in values:
        broken = state.copy()
        broken[place] = value
        with pytest.warns(RuntimeWarning, match=f"{name} is .*; its wake is cleared"):
            found = READERS[reader](air, broken)
        parts = found if isinstance(found, tuple) else (found,)
        assert all(np.isfinite(part).all() for part in parts)
    # a sound one is read as it is, without a word
    READERS[reader](air, state)


def test_state_stays_when_the_warning_is_an_error() -> None:
    _, data = flown(MERGING)
    broken, air = data.plugin_state[OWN_MEMORY:].copy(), native(MERGING)
    broken[ROWS] = 1e9
    kept = broken.copy()
    with pytest.raises(RuntimeWarning, match=r"rows is 1e\+09, must be a whole number from 0 to"):
        air.run(broken, 0.004, *still(3))
    np.testing.assert_array_equal(broken, kept)


@pytest.mark.parametrize("dt", [0.0, -0.01, np.nan, np.inf])
def test_step_is_a_time(dt: float) -> None:
    air = native(MERGING)
    with pytest.raises(ValueError, match="dt must be a finite number of seconds above 0"):
        air.run(np.zeros(air.state_size), dt, *still(3))


def test_warning_of_a_batch_is_in_its_counters() -> None:
    batch = pytest.importorskip("mujoco.batch")
    model, data = flown(FREE)
    many = batch.Batch(model, nsim=3, nthread=2)
    state = np.empty(mujoco.mj_stateSize(model, mujoco.mjtState.mjSTATE_INTEGRATION))
    mujoco.mj_getState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
    (rows,) = np.flatnonzero(state == data.plugin_state[OWN_MEMORY + ROWS])[:1]
    many.state[:, : len(state)] = state
    many.state[1, rows] = 1e9
    many.step(nstep=5)
    assert many.warning.any(axis=(1, 2)).tolist() == [False, True, False]


def test_thousands_of_perturbed_states(root: Path) -> None:
    """In a process of their own, whose death would be seen; a hundred thousand by hand."""
    script = root / "tests" / "plugin" / "perturb.py"
    done = subprocess.run(
        [sys.executable, str(script), "2000"], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr[-2000:]
    assert "'went on'" in done.stdout and "'warned'" in done.stdout
