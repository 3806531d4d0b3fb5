"""The wake's own clock: when rows are shed, and when the wake is dropped."""

from __future__ import annotations

import math

import mujoco
import numpy as np
import pytest

from tests.plugin.models import (
    FREE,
    LATTICE,
    Array,
    document,
    instance,
    load,
    reading,
    two_hinges,
    wake_of,
    wing,
)


@pytest.mark.parametrize(
    ("dt", "steps"), [(0.003, 17), (0.02, 2), (0.05, 1), (0.1, 1), (0.0125, 4), (0.0333, 2)]
)
def test_wake_counts_elapsed_steps(dt: float, steps: int) -> None:
    """Rows are shed when the clock of 50 ms is nearest, whatever a user does to time.

    Edge on in a stream, nothing is induced: a row drifts with the stream for the time elapsed.
    """
    stream = 0.2
    attributes = LATTICE | {"wake_step": "0.05", "wind": f"0 0 {-stream}"}
    model = load(document(instance(attributes), wing(), f'timestep="{dt}"'))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data)
    before = wake_of(model, data, attributes)
    for count in range(1, 6 * steps + 1):
        data.time = 1e6 * (count % 3)
        mujoco.mj_step(model, data)
        rows = wake_of(model, data, attributes)
        # vertex rows are one more than rings, and the first tick made the first row
        assert len(rows) == 1 + count // steps
        if count % steps == 0:
            drift = before - rows[1:]
            np.testing.assert_allclose(drift[..., 2], stream * dt * steps, rtol=1e-6)
            np.testing.assert_allclose(drift[..., :2], 0.0, atol=1e-9)
        before = rows


def test_step_longer_than_the_wakes_clock() -> None:
    """Then every step sheds a row, and the loads are those of the longer clock."""
    forces = []
    for clock in ("0.01", "0.05"):
        model = load(two_hinges(LATTICE | {"wake_step": clock}, 'timestep="0.05"'))
        data = mujoco.MjData(model)
        for i in range(20):
            data.qpos[:], data.qvel[:] = (0.02 * i, 0.5), (0.4, 0.0)
            mujoco.mj_step(model, data)
        forces.append(reading(data))
    assert np.abs(forces[1]).max() > 1e-3
    # only the very first row differs: it lies where a steady motion would have left it
    np.testing.assert_allclose(forces[0], forces[1], rtol=0, atol=0.02 * np.abs(forces[1]).max())


def stroked(first: int, jump: int, steps: int = 150) -> tuple[Array, list[int]]:
    """Normal force on a wing moved by hand, half a radian aside from step jump on, and rows."""
    attributes = LATTICE | {"wake_step": "0.05"}
    model = load(two_hinges(attributes, 'timestep="0.01"'))
    data, force, rows = mujoco.MjData(model), [], []
    for i in range(first, steps):
        data.qpos[:] = 0.6 * math.sin(0.02 * i) + (0.5 if i >= jump else 0.0), 0.6
        data.qvel[:] = 1.2 * math.cos(0.02 * i), 0.0
        mujoco.mj_step(model, data)
        force.append(reading(data)[2])
        rows.append(len(wake_of(model, data, attributes)))
    return np.array(force), rows


@pytest.mark.parametrize("jump", [100, 97, 99])
def test_moved_by_hand_drops_the_wake(jump: int) -> None:
    """Half a radian without a reset: at the next tick the wake begins anew, as after a reset."""
    moved, rows = stroked(0, jump)
    fresh, _ = stroked(100, jump)
    assert rows[99] == 20 and rows[100] == 1
    # the step of the tick itself still has the old wake's last loads
    np.testing.assert_allclose(moved[101:], fresh[1:], rtol=1e-9)
    # which do no harm: the trap's 20 times the normal load is far away
    assert np.abs(moved[50:101]).max() < 2 * np.abs(moved[50:97]).max()
    assert np.abs(fresh[1:]).max() > 0.01


def test_fast_motion_keeps_the_wake() -> None:
    """A trailing edge that is only fast has not jumped."""
    model = load(two_hinges(FREE, 'timestep="0.0125"'))
    data = mujoco.MjData(model)
    for i in range(60):
        data.qpos[:], data.qvel[:] = (0.125 * i, 0.3), (10.0, 0.0)
        mujoco.mj_step(model, data)
    assert len(wake_of(model, data, FREE)) == 30
