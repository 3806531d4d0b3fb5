"""SB3's vector environment: the single environments, bit for bit, and what SB3's users expect."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from flaprig import UVLM, QuasiSteady
from flaprig.envs import HoverKinematics, HoverRig
from flaprig.limits import SINUSOID
from flaprig.tasks import HoverSettings
from flaprig.tasks.hover_rig import HoverRigSettings

pytest.importorskip("stable_baselines3")

from stable_baselines3 import PPO
from stable_baselines3.common.evaluation import evaluate_policy
from stable_baselines3.common.monitor import Monitor

from training.vector import HoverVecEnv

STEADY = HoverSettings(
    model=QuasiSteady(strips=4, steps_per_cycle=50),
    bounds=SINUSOID.times(1.4),
    horizon=7,
    jitter=0.02,
)
LATTICE = replace(STEADY, model=UVLM(chordwise=2, spanwise=4, steps_per_cycle=20), horizon=4)
RIG = HoverRigSettings(replace(STEADY, horizon=4), time_step=0.02, limits=None)


def actions(steps: int, count: int) -> np.ndarray:
    rng = np.random.default_rng(0)
    return rng.uniform(-1.0, 1.0, (steps, count, 12)).astype(np.float32)


@pytest.mark.parametrize(
    ("settings", "single", "steps", "kinds"),
    [(STEADY, HoverKinematics, 30, 2), (LATTICE, HoverKinematics, 9, 1), (RIG, HoverRig, 9, 1)],
    ids=["quasi_steady", "uvlm", "rig"],
)
def test_rows_are_the_single_environments(
    settings: Any, single: Any, steps: int, kinds: int
) -> None:
    """Bit for bit, over ends of both kinds."""
    count, seed = 4, 11
    together = HoverVecEnv(settings, count, seed)
    alone = [single(settings) for _ in range(count)]
    observed = together.reset()
    for i, env in enumerate(alone):
        np.testing.assert_array_equal(observed[i], env.reset(seed=seed + i)[0])
    ends = []
    for action in actions(steps, count):
        observed, rewards, dones, infos = together.step(action)
        for i, env in enumerate(alone):
            last, reward, terminated, truncated, info = env.step(action[i])
            assert np.float32(reward) == rewards[i] and (terminated or truncated) == dones[i]
            assert infos[i]["bounds_exceeded"] == info["bounds_exceeded"]
            np.testing.assert_array_equal(infos[i]["coefficients"], info["coefficients"])
            if dones[i]:
                np.testing.assert_array_equal(infos[i]["terminal_observation"], last)
                assert infos[i]["TimeLimit.truncated"] == truncated
                ends.append(truncated)
                last = env.reset()[0]
            np.testing.assert_array_equal(observed[i], last)
    assert len(set(ends)) >= kinds


def test_episode_is_what_monitor_would_say() -> None:
    env = HoverVecEnv(STEADY, 3, seed=0)
    env.reset()
    total, length, seen = np.zeros(3), np.zeros(3, int), 0
    for action in 0.3 * actions(15, 3):
        _, rewards, dones, infos = env.step(action)
        total, length = total + rewards, length + 1
        for k in range(3):
            assert ("episode" in infos[k]) == dones[k]
            assert ("terminal_observation" in infos[k]) == dones[k]
            if dones[k]:
                episode, seen = infos[k]["episode"], seen + 1
                assert episode["r"] == pytest.approx(total[k], abs=1e-5)
                assert episode["l"] == length[k] and episode["t"] >= 0.0
                total[k], length[k] = 0.0, 0
    assert seen >= 6


def test_seed_and_reset_begin_again() -> None:
    env = HoverVecEnv(STEADY, 2, seed=5)
    first = env.reset()
    assert not np.array_equal(env.reset(), first)
    assert env.seed(5) == [5, 6]
    np.testing.assert_array_equal(env.reset(), first)
    np.testing.assert_array_equal(HoverVecEnv(STEADY, 3, seed=5).reset()[:2], first)


def test_attributes_and_methods() -> None:
    env = HoverVecEnv(STEADY, 3)
    assert env.get_attr("settings") == [STEADY] * 3
    assert env.get_attr("settings", [0, 2]) == [STEADY] * 2 and env.has_attr("settings")
    assert not env.has_attr("nothing")
    env.set_attr("render_mode", None)
    with pytest.raises(ValueError, match="indices must be all rows"):
        env.set_attr("render_mode", None, 1)
    assert [len(x["elapsed"]) for x in env.env_method("get_state", indices=0)] == [3]
    assert env.env_is_wrapped(Monitor) == [True] * 3
    env.close()


def test_state_can_be_taken_and_put_back() -> None:
    """What follows is the same, bit for bit, in another environment too."""
    env, other = HoverVecEnv(STEADY, 3, seed=1), HoverVecEnv(STEADY, 3, seed=77)
    env.reset()
    for action in actions(4, 3):
        env.step(action)
    state = env.get_state()
    expected = [env.step(action) for action in actions(10, 3)]
    other.reset()
    other.set_state(state)
    for action, (observed, rewards, dones, _) in zip(actions(10, 3), expected, strict=True):
        found = other.step(action)
        np.testing.assert_array_equal(found[0], observed)
        np.testing.assert_array_equal(found[1], rewards)
        np.testing.assert_array_equal(found[2], dones)


def test_nan_in_one_row_ends_that_episode_only(monkeypatch: pytest.MonkeyPatch) -> None:
    env = HoverVecEnv(replace(STEADY, bounds=SINUSOID.times(100.0)), 3, seed=0)
    env.reset()
    hover: Any = env.batch.hover
    wrenches = hover.wrenches

    def broken(motion: Any) -> np.ndarray:
        load = wrenches(motion)
        load[1] = np.nan
        return np.asarray(load)

    with monkeypatch.context() as patch:
        patch.setattr(hover, "wrenches", broken)
        observed, rewards, dones, infos = env.step(np.zeros((3, 12), np.float32))
    assert dones.tolist() == [False, True, False] and rewards[1] == -2.0
    assert infos[1]["failure"] == "the loads are not finite" and "failure" not in infos[0]
    assert np.isfinite(observed).all() and np.isfinite(rewards).all()
    assert not env.step(np.zeros((3, 12), np.float32))[2].any()


def test_ppo_takes_it() -> None:
    env = HoverVecEnv(STEADY, 4, seed=0)
    model = PPO("MlpPolicy", env, n_steps=16, batch_size=32, n_epochs=1, device="cpu", seed=0)
    model.learn(128)
    assert len(model.ep_info_buffer or []) >= 4
    mean, _ = evaluate_policy(model, env, n_eval_episodes=4, warn=True)
    assert np.isfinite(mean)


@pytest.mark.parametrize("count", [0, -1, 1.5, "many"])
def test_bad_number_of_episodes(count: Any) -> None:
    with pytest.raises(ValueError, match="HoverVecEnv: num_envs must be a whole number"):
        HoverVecEnv(STEADY, count)
