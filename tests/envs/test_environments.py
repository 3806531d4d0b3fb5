"""The Gymnasium environments: the checkers of Gymnasium and SB3, and what the spec sheets say."""

from __future__ import annotations

import os
import re
import subprocess
import sys
import warnings
from dataclasses import replace
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import flaprig.envs
from flaprig import QuasiSteady
from flaprig.limits import SINUSOID
from flaprig.tasks import HoverSettings, TrackSettings
from flaprig.tasks.hover_rig import HoverRigSettings

QUICK = HoverSettings(model=QuasiSteady(strips=4, steps_per_cycle=50), horizon=6, jitter=0.02)
IDS: dict[str, dict[str, Any]] = {
    "flaprig/HoverKinematics-v0": {"settings": QUICK},
    "flaprig/HoverRig-v0": {"settings": HoverRigSettings(QUICK, time_step=0.02, limits=None)},
    "flaprig/Track-v0": {"settings": TrackSettings(cycles=0.06)},
}
every_id = pytest.mark.parametrize("name", IDS)


def made(name: str, **kwargs: Any) -> gymnasium.Env[Any, Any]:
    env: gymnasium.Env[Any, Any] = gymnasium.make(name, **(IDS[name] | kwargs)).unwrapped
    return env


@every_id
def test_gymnasium_has_nothing_to_say(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(made(name), skip_render_check=True)


@every_id
def test_sb3_has_nothing_to_say(name: str) -> None:
    checker = pytest.importorskip("stable_baselines3.common.env_checker")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        checker.check_env(made(name))


@every_id
def test_default_settings_make_an_environment(name: str) -> None:
    observation, _ = gymnasium.make(name).reset(seed=0)
    assert observation.dtype == np.float32


@every_id
def test_same_seed_same_bits(name: str) -> None:
    one, other = made(name), made(name)
    rng = np.random.default_rng(0)
    first = [env.reset(seed=4)[0] for env in (one, other)]
    np.testing.assert_array_equal(*first)
    for _ in range(5):
        action = rng.uniform(-0.3, 0.3, one.action_space.shape).astype(np.float32)
        a, b = one.step(action), other.step(action)
        np.testing.assert_array_equal(a[0], b[0])
        assert a[1:4] == b[1:4] and np.isfinite(a[1])


@every_id
def test_the_end_of_time_is_truncation(name: str) -> None:
    env = made(name)
    env.reset(seed=0)
    zero, count = np.zeros(env.action_space.shape, np.float32), 0
    terminated = truncated = False
    while not (terminated or truncated):
        observation, _, terminated, truncated, _ = env.step(zero)
        assert env.observation_space.contains(observation)
        count += 1
    assert truncated and not terminated
    assert count == (15 if "Track" in name else 6)


def test_a_bound_is_termination() -> None:
    env = flaprig.envs.HoverKinematics(replace(QUICK, bounds=SINUSOID, jitter=0.0, horizon=1))
    env.reset(seed=0)
    action = np.zeros(12, np.float32)
    action[2] = -1.0
    _, reward, terminated, truncated, info = env.step(action)
    assert terminated and not truncated and reward == -2.0 and info["bounds_exceeded"]


def test_nan_in_a_simulation_ends_that_episode_with_a_reason(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    env = flaprig.envs.HoverKinematics(QUICK)
    env.reset(seed=0)
    hover: Any = env.batch.hover
    with monkeypatch.context() as patch:
        patch.setattr(hover, "wrenches", lambda motion: np.full((1, 1, 50, 6), np.nan))
        observation, reward, terminated, _, info = env.step(np.zeros(12, np.float32))
    assert terminated and reward == -2.0 and info["failure"] == "the loads are not finite"
    assert np.isfinite(observation).all()
    env.reset()
    _, reward, terminated, _, info = env.step(np.zeros(12, np.float32))
    assert not terminated and "failure" not in info and reward != -2.0


@every_id
def test_spec_sheet_says_what_the_spaces_are(name: str) -> None:
    env = made(name)
    sheet = type(env).__doc__ or ""
    headings = re.findall(r"^ *## (.+)$", sheet, re.MULTILINE)
    assert headings == [
        *("Description", "Action Space", "Observation Space", "Rewards", "Starting State"),
        *("Episode End", "Arguments", "Version History"),
    ]
    boxes = re.findall(r"`(Box\(.*?float32\))`", sheet)
    assert boxes == [str(env.action_space), str(env.observation_space)]
    assert name in sheet


@every_id
def test_picture_is_not_black(name: str) -> None:
    if os.environ.get("MUJOCO_GL") not in ("egl", "osmesa") and not os.environ.get("DISPLAY"):
        pytest.skip("no OpenGL here")
    env = made(name, render_mode="rgb_array")
    env.reset(seed=0)
    try:
        frame = env.render()
    except (RuntimeError, ImportError, AttributeError) as error:
        pytest.skip(f"no OpenGL here: {error}")
    assert isinstance(frame, np.ndarray) and frame.dtype == np.uint8
    assert frame.mean() > 20 and frame.std() > 5
    env.close()


@every_id
def test_bad_render_mode(name: str) -> None:
    with pytest.raises(ValueError, match="render_mode must be"):
        type(made(name))(render_mode="human")  # type: ignore[call-arg]


def test_registering_imports_no_simulator() -> None:
    """Listing environments is cheap; MuJoCo comes with the ones that need it."""
    code = (
        "import sys, flaprig.envs; from flaprig.envs import HoverKinematics; HoverKinematics();"
        "print([m for m in ('mujoco', 'dm_control', 'torch') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
