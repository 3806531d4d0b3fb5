"""Speed of stage 1 beside what SB3 itself does with the same network where a step costs nothing.

Run: python benchmarks/bench_learning.py [--json]

Both learn in turns within one run, on the same settings: rollouts, minibatches, epochs, network.
"""

from __future__ import annotations

import json
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
import torch
from stable_baselines3.common.vec_env import VecEnv

from flaprig.envs.spaces import action_space, observation_space
from training.learner import Learner, build
from training.problem import Problem
from training.settings import QUASI_STEADY, Ppo
from training.vector import HoverVecEnv

# updates measured of each in one turn, and turns
UPDATES, TURNS = 6, 5


class Nothing(VecEnv):
    """An environment that costs nothing: the same numbers over and over."""

    def __init__(self, count: int) -> None:
        self.render_mode = None
        super().__init__(count, observation_space(), action_space())
        self.seen = np.zeros((count, 200), np.float32)
        self.rewards, self.done = np.zeros(count, np.float32), np.zeros(count, bool)

    def reset(self):
        return self.seen

    def step_async(self, actions):
        pass

    def step_wait(self):
        return self.seen, self.rewards, self.done, [{} for _ in range(self.num_envs)]

    def close(self):
        pass

    def get_attr(self, attr_name, indices=None):
        return [getattr(self, attr_name, None)] * self.num_envs

    def set_attr(self, attr_name, value, indices=None):
        pass

    def env_method(self, method_name, *args, indices=None, **kwargs):
        return [None] * self.num_envs

    def env_is_wrapped(self, wrapper_class, indices=None):
        return [True] * self.num_envs


def seconds(work) -> float:
    """Time of the work in [s]."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def measure() -> dict[str, Any]:
    """Steps per second of both, medians over the turns."""
    torch.set_num_threads(1)
    # no early end of an update: both do all their epochs
    ppo, steps = Ppo(target_kl=1e3), UPDATES * QUASI_STEADY.steps_per_update
    bare = build(Nothing(QUASI_STEADY.envs), QUASI_STEADY, ppo, 0)
    with tempfile.TemporaryDirectory() as folder:
        env = HoverVecEnv(Problem().quasi_steady(), QUASI_STEADY.envs)
        ours = Learner(env, QUASI_STEADY, ppo, 0, Path(folder))
        rates: dict[str, list[float]] = {"sb3": [], "stage_1": []}
        for _ in range(TURNS):
            rates["sb3"].append(steps / seconds(lambda: bare.learn(steps)))
            work = seconds(lambda: [ours.update() for _ in range(UPDATES)])
            rates["stage_1"].append(steps / work)
    shares = np.array(rates["stage_1"]) / np.array(rates["sb3"])
    return {
        "sb3_steps_per_s": float(np.median(rates["sb3"])),
        "stage_1_steps_per_s": float(np.median(rates["stage_1"])),
        "share": float(np.median(shares)),
        "share_of_each_turn": shares.round(3).tolist(),
    }


def main() -> None:
    """Measure and print."""
    found = measure()
    if "--json" in sys.argv[1:]:
        print(json.dumps(found))
        return
    print(f"SB3, an environment that costs nothing: {found['sb3_steps_per_s']:.0f} steps/s")
    print(f"stage 1: {found['stage_1_steps_per_s']:.0f} steps/s, {100 * found['share']:.0f} %")


if __name__ == "__main__":
    main()
