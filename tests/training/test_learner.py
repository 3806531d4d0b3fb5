"""A learner's failures and its state."""

from __future__ import annotations

import copy

import numpy as np

from flaprig.tasks.hover_settings import HoverSettings
from training.learner import Learner
from training.settings import Pace, Ppo
from training.vector import HoverVecEnv

PACE = Pace(steps=256, envs=8, rollout=8, batch=64, epochs=2, learning_rate=1e-3)


def learner(tmp_path, seed=0):
    return Learner(HoverVecEnv(HoverSettings(threads=1), 8), PACE, Ppo(), seed, tmp_path)


def test_not_a_number_ends_that_episode_only(tmp_path, monkeypatch):
    made = learner(tmp_path)
    hover, calls = made.gains.hover, []
    wrenches = hover.wrenches

    def broken(motion):
        load = wrenches(motion)
        calls.append(len(load))
        if len(calls) == 3:
            load[2] = np.nan
        return load

    monkeypatch.setattr(hover, "wrenches", broken)
    row = made.update()
    assert row["failures"] == 1.0 and len(made.watcher.failures) == 1
    assert "not finite" in made.watcher.failures[0]
    assert np.isfinite(row["reward_mean"])
    assert all(p.isfinite().all() for p in made.model.policy.parameters())
    monkeypatch.setattr(hover, "wrenches", wrenches)
    assert made.update()["failures"] == 0.0


def test_state_put_back_continues_bit_for_bit(tmp_path):
    one = learner(tmp_path / "a")
    one.update()
    state = copy.deepcopy(one.state())
    expected = one.update()
    other = learner(tmp_path / "b", seed=99)
    other.restore(state)
    assert other.update() == expected


def test_exploration_is_capped_at_the_end(tmp_path):
    made = learner(tmp_path)
    for _ in range(PACE.updates):
        row = made.update()
    assert row["std"] <= np.exp(Ppo().last_log_std) * (1 + 1e-6)
