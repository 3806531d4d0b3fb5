"""One battery over every dm_control task, as dm_control's own suite has it."""

from __future__ import annotations

import os
from typing import Any

import mujoco
import numpy as np
import pytest
from dm_control.rl import control
from dm_env import StepType, TimeStep

from flaprig import QuasiSteady
from flaprig.tasks import ALL_TASKS, HoverSettings, TrackSettings, load
from flaprig.tasks.hover_rig import HoverRigSettings

STEPS = 12
QUICK = HoverSettings(model=QuasiSteady(strips=4, steps_per_cycle=50), horizon=8, jitter=0.02)
SETTINGS: dict[tuple[str, str], Any] = {
    ("hover", "kinematics"): QUICK,
    ("hover", "rig"): HoverRigSettings(QUICK, time_step=0.02, limits=None),
    ("track", "stroke"): TrackSettings(cycles=0.1),
}
every_task = pytest.mark.parametrize("name", ALL_TASKS, ids=" ".join)


def environment(name: tuple[str, str], seed: int = 0) -> control.Environment:
    return load(*name, {"random": seed, "settings": SETTINGS[name]})


def actions(env: control.Environment, seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return rng.uniform(-0.3, 0.3, (STEPS, *env.action_spec().shape))


def played(env: control.Environment, steps: np.ndarray) -> list[TimeStep]:
    return [env.reset(), *(env.step(action) for action in steps)]


def test_every_task_has_settings_here() -> None:
    assert set(SETTINGS) == set(ALL_TASKS)


@every_task
def test_loads_with_its_defaults(name: tuple[str, str]) -> None:
    step = load(*name).reset()
    assert step.first()


@every_task
def test_conforms_to_its_specs(name: tuple[str, str]) -> None:
    env = environment(name)
    action = env.action_spec()
    assert np.isfinite(action.minimum).all() and np.isfinite(action.maximum).all()
    for step in played(env, actions(env)):
        for key, spec in env.observation_spec().items():
            spec.validate(step.observation[key])
        assert set(step.observation) == set(env.observation_spec())
        if step.first():
            assert step.reward is None and step.discount is None
        else:
            env.reward_spec().validate(np.asarray(step.reward))
            env.discount_spec().validate(np.asarray(step.discount))
            assert np.isfinite(step.reward)


@every_task
def test_same_seed_same_bits(name: tuple[str, str]) -> None:
    runs = [played(env, actions(env)) for env in (environment(name), environment(name))]
    for one, other in zip(*runs, strict=True):
        assert (one.step_type, one.reward, one.discount) == (
            other.step_type,
            other.reward,
            other.discount,
        )
        for key in one.observation:
            np.testing.assert_array_equal(one.observation[key], other.observation[key])


@every_task
def test_other_seed_other_start(name: tuple[str, str]) -> None:
    one, other = (environment(name, seed).reset().observation for seed in (0, 1))
    assert any(not np.array_equal(one[key], other[key]) for key in one)


@every_task
def test_observations_share_no_memory(name: tuple[str, str]) -> None:
    env = environment(name)
    steps = played(env, actions(env)[:3])
    for one in steps:
        for other in steps:
            for key in one.observation:
                if one is not other:
                    assert not np.shares_memory(one.observation[key], other.observation[key])
    kept = {key: value.copy() for key, value in steps[0].observation.items()}
    for value in steps[-1].observation.values():
        value[...] = 7.0
    env.step(actions(env)[3])
    for key, value in kept.items():
        np.testing.assert_array_equal(steps[0].observation[key], value)


@every_task
def test_horizon_ends_with_discount_one(name: tuple[str, str]) -> None:
    env = environment(name)
    env.reset()
    zero = np.zeros(env.action_spec().shape)
    steps = []
    while not steps or not steps[-1].last():
        steps.append(env.step(zero))
        assert len(steps) <= 100
    horizon = SETTINGS[name].horizon if name != ("hover", "rig") else QUICK.horizon
    assert len(steps) == horizon and steps[-1].discount == 1.0
    assert env.step(zero).step_type == StepType.FIRST


@every_task
def test_readings_are_finite_and_the_callers_own(name: tuple[str, str]) -> None:
    env = environment(name)
    played(env, actions(env)[:3])
    physics = env.physics
    for reading in (physics.angles, physics.rates, physics.torques):
        values = reading()
        assert values.shape == (2,) and np.isfinite(values).all() and np.abs(values).max() > 0
        assert reading() is not values
    for number in (physics.lift, physics.drag, physics.power):
        assert isinstance(number(), float) and np.isfinite(number()) and number() != 0.0


@every_task
def test_picture_is_not_black(name: tuple[str, str]) -> None:
    if os.environ.get("MUJOCO_GL") not in ("egl", "osmesa") and not os.environ.get("DISPLAY"):
        pytest.skip("no OpenGL here")
    env = environment(name)
    env.reset()
    try:
        frame = env.physics.render(height=60, width=80, camera_id="iso")
    except (RuntimeError, ImportError, AttributeError, mujoco.FatalError) as error:
        pytest.skip(f"no OpenGL here: {error}")
    assert frame.shape == (60, 80, 3) and frame.mean() > 20 and frame.std() > 5


@pytest.mark.parametrize("name", [("hover", "kinematic"), ("", ""), ("track", "rig")])
def test_unknown_task_is_one_sentence(name: tuple[str, str]) -> None:
    with pytest.raises(ValueError, match="one of hover kinematics, hover rig, track stroke, got"):
        load(*name)


def test_rig_ends_where_the_motors_left_it() -> None:
    """Physics shows the state after the flight; prescribed motion shows the middle of a stroke."""
    env = environment(("hover", "rig"))
    env.reset()
    env.step(np.zeros(12))
    assert env.physics.time() == pytest.approx(2 / 0.2)
    assert env.physics.angles()[0] == pytest.approx(-np.pi / 3, abs=0.05)
    flown = env.physics.flight
    assert env.physics.lift() == pytest.approx(flown.cl * flown.reference_force)
    calm = environment(("hover", "kinematics"))
    calm.reset()
    assert calm.physics.rates()[0] > 0.5


def test_bound_ends_with_discount_zero() -> None:
    env = environment(("hover", "kinematics"))
    env.reset()
    action = np.zeros(12)
    action[[2, 11]] = -1.0, 1.0
    steps = [env.step(action)]
    while not steps[-1].last():
        steps.append(env.step(action))
    assert steps[-1].discount == 0.0 and steps[-1].reward == -2.0
