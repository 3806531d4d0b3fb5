"""Copies of environments, tasks and physics step like the original, bit for bit, and alone."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest

import flaprig.envs  # noqa: F401 (registers)
from flaprig import UVLM, QuasiSteady
from flaprig.limits import SINUSOID
from flaprig.render import gl
from flaprig.rig import Rig
from flaprig.tasks import ALL_TASKS, HoverSettings, TrackSettings, load
from flaprig.tasks.hover_rig import HoverRigSettings

STEPS = 50
PROBLEM = HoverSettings(
    model=QuasiSteady(strips=2, steps_per_cycle=20),
    bounds=SINUSOID.times(50.0),
    horizon=1000,
    jitter=0.02,
)
SETTINGS: dict[str, Any] = {
    "HoverKinematics": PROBLEM,
    "HoverRig": HoverRigSettings(PROBLEM, time_step=0.02, limits=None),
    "Track": TrackSettings(rig=Rig(model=UVLM(2, 3, 16)), cycles=4.0),
}
TASK_SETTINGS = dict(zip(ALL_TASKS, SETTINGS.values(), strict=True))
IDS = [name for name in gymnasium.registry if name.startswith("flaprig/")]

WAYS: dict[str, Callable[[Any], Any]] = {
    "deepcopy": copy.deepcopy,
    "pickle": lambda made: pickle.loads(pickle.dumps(made)),
    "copy": copy.copy,
}
every_way = pytest.mark.parametrize("way", WAYS)
every_moment = pytest.mark.parametrize("moment", ["made", "reset", "mid-episode"])


def made(name: str, **kwargs: Any) -> Any:
    settings = SETTINGS[name.removeprefix("flaprig/").removesuffix("-v0")]
    return gymnasium.make(name, settings=settings, **kwargs)


def actions(shape: tuple[int, ...], seed: int = 0) -> np.ndarray:
    rng = np.random.default_rng(seed)
    return rng.uniform(-0.3, 0.3, (STEPS, *shape)).astype(np.float32)


def same(one: Any, other: Any) -> None:
    """Equal to the last bit, whatever is inside; NaN equals NaN."""
    assert type(one) is type(other)
    if isinstance(one, dict):
        assert one.keys() == other.keys()
        one, other = list(one.values()), list(other.values())
    if isinstance(one, list | tuple):
        assert len(one) == len(other)
        for a, b in zip(one, other, strict=True):
            same(a, b)
    else:
        np.testing.assert_array_equal(one, other)


def brought_to(moment: str, env: Any, begin: Callable[[], Any], shape: tuple[int, ...]) -> None:
    if moment != "made":
        begin()
    if moment == "mid-episode":
        for action in actions(shape, 1)[:7]:
            env.step(action)


@every_moment
@every_way
@pytest.mark.parametrize("name", IDS)
def test_environments(name: str, way: str, moment: str) -> None:
    env = made(name)
    shape = env.action_space.shape
    brought_to(moment, env, lambda: env.reset(seed=3), shape)
    other = WAYS[way](env)
    if moment == "made":
        same(env.reset(seed=4), other.reset(seed=4))
    # one after the other: what they shared would show
    expected = [env.step(action) for action in actions(shape)]
    found = [other.step(action) for action in actions(shape)]
    same(found, expected)
    same(other.reset(), env.reset())


@every_moment
@every_way
@pytest.mark.parametrize("name", ALL_TASKS, ids=" ".join)
def test_tasks(name: tuple[str, str], way: str, moment: str) -> None:
    env = load(*name, {"random": 5, "settings": TASK_SETTINGS[name]})
    shape = env.action_spec().shape
    brought_to(moment, env, env.reset, shape)
    other = WAYS[way](env)
    expected = [env.step(action) for action in actions(shape)]
    found = [other.step(action) for action in actions(shape)]
    for one, two in zip(found, expected, strict=True):
        same(tuple(one[:3]), tuple(two[:3]))
        same(dict(one.observation), dict(two.observation))


@pytest.mark.parametrize("way", [*WAYS, "physics.copy"])
@pytest.mark.parametrize("name", ALL_TASKS, ids=" ".join)
def test_physics(name: tuple[str, str], way: str) -> None:
    """Readings at once, not only after a step; and MuJoCo's own order of a step."""
    env = load(*name, {"random": 5, "settings": TASK_SETTINGS[name]})
    brought_to("mid-episode", env, env.reset, env.action_spec().shape)
    physics = env.physics
    physics.failure = "for a trial"
    other = physics.copy() if way == "physics.copy" else WAYS[way](physics)
    assert other.failure == physics.failure and other.legacy_step == physics.legacy_step
    for reading in ("angles", "rates", "torques", "lift", "drag", "power"):
        same(getattr(other, reading)(), getattr(physics, reading)())
    if name[0] == "track":
        for one in (physics, other):
            one.step(50)
        same(other.angles(), physics.angles())
        same(other.data.plugin_state, physics.data.plugin_state)
    else:
        other.batch.elapsed += 1
        assert other.batch.elapsed[0] != physics.batch.elapsed[0]


@every_moment
@every_way
@pytest.mark.parametrize("kind", ["HoverKinematics", "HoverRig"])
def test_vector_environment(kind: str, way: str, moment: str) -> None:
    pytest.importorskip("stable_baselines3")
    from training.vector import HoverVecEnv

    settings = SETTINGS[kind]
    short = replace(PROBLEM, horizon=9)
    short = short if kind == "HoverKinematics" else replace(settings, problem=short)
    env = HoverVecEnv(short, 2, seed=1)
    brought_to(moment, env, env.reset, (2, 12))
    other = WAYS[way](env)
    if moment == "made":
        same(other.reset(), env.reset())
    expected = [env.step(action) for action in actions((2, 12))]
    found = [other.step(action) for action in actions((2, 12))]
    for _, _, _, infos in [*expected, *found]:
        for info in infos:
            # of the wall
            info.get("episode", {}).pop("t", None)
    same(found, expected)
    same(other.get_state(), env.get_state())


@pytest.mark.parametrize("name", IDS)
def test_after_a_picture(name: str) -> None:
    """A drawing library's context stays with the original."""
    if gl.backend() is None:
        pytest.skip("no OpenGL library works here: " + gl.ADVICE)
    env = made(name, render_mode="rgb_array")
    env.reset(seed=3)
    env.render()
    for way in WAYS.values():
        other = way(env)
        action = actions(env.action_space.shape)[0]
        same(way(other).step(action), other.step(action))
        assert other.render().std() > 5.0
        other.close()
    env.close()


def test_pickles_are_read_in_another_process(tmp_path: Path) -> None:
    """Where nobody has told MuJoCo of the plugins yet."""
    expected = []
    for name in IDS:
        env = made(name)
        env.reset(seed=3)
        env.step(np.zeros(env.action_space.shape))
        (tmp_path / f"{len(expected)}.pkl").write_bytes(pickle.dumps(env))
        expected.append(env.step(np.zeros(env.action_space.shape))[1])
    code = (
        "import pickle, sys, pathlib, numpy\n"
        "for path in sys.argv[1:]:\n"
        "    env = pickle.loads(pathlib.Path(path).read_bytes())\n"
        "    print(env.step(numpy.zeros(env.action_space.shape))[1].hex())\n"
    )
    found = []
    for k in range(len(IDS)):
        command = [sys.executable, "-c", code, str(tmp_path / f"{k}.pkl")]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        found.append(float.fromhex(done.stdout.strip()))
    assert found == expected
