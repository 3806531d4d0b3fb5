"""One stage of learning: SB3's PPO on a vector environment, stoppable between any two updates."""

from __future__ import annotations

from collections import deque
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np
import torch
from stable_baselines3 import PPO
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import configure
from stable_baselines3.common.vec_env import VecEnv, VecNormalize

from flaprig.tasks.hover import Hover
from training import checkpoint, export
from training.candidate import Candidate
from training.evaluation import better, episode
from training.gains import Gains
from training.settings import Pace, Ppo
from training.vector import HoverVecEnv

# share of a stage's learning rate that is left at its end
LAST_RATE = 0.1
# largest normalised reward
MOST_REWARD = 20.0


class Watcher(BaseCallback):
    """Keeps the best stroke of a stage, the raw rewards of a rollout, and the failures."""

    def __init__(self, gains: Gains) -> None:
        super().__init__()
        self.gains = gains
        self.best: Candidate | None = None
        self.failures: list[str] = []
        self.total, self.count, self.ended = 0.0, 0, 0

    def _on_rollout_start(self) -> None:
        self.total, self.count, self.ended, self.failures = 0.0, 0, 0, []

    def _on_step(self) -> bool:
        rewards, infos = self.gains.raw, self.locals["infos"]
        self.total += float(rewards.sum())
        self.count += rewards.size
        for k in np.flatnonzero(self.locals["dones"]):
            self.ended += not infos[k].get("TimeLimit.truncated", False)
            if infos[k].get("failure"):
                self.failures.append(str(infos[k]["failure"]))
        k = int(rewards.argmax())
        if self.best is None or rewards[k] > self.best.reward:
            found = Candidate.of(float(rewards[k]), infos[k])
            self.best = found or self.best
        return True


class Learner:
    """PPO on one environment, whose whole state can be taken and put back."""

    def __init__(self, env: HoverVecEnv, pace: Pace, ppo: Ppo, seed: int, board: Path) -> None:
        self.pace, self.ppo, self.done = pace, ppo.begun(trained=False), 0
        # networks this small gain nothing from threads, and lose much where cores are shared
        torch.set_num_threads(1)
        self.gains = Gains(env)
        self.env = VecNormalize(
            self.gains, norm_obs=False, clip_reward=MOST_REWARD, gamma=ppo.gamma
        )
        self.model = build(self.env, pace, ppo, seed)
        self.watcher = Watcher(self.gains)
        self.watcher.init_callback(self.model)
        self.model.set_logger(configure(str(board), ["tensorboard"]))
        # what SB3's learn() prepares
        self.model._last_obs = self.env.reset()
        self.model._last_episode_starts = np.ones(pace.envs, bool)
        self.model.ep_info_buffer = deque(maxlen=100)
        self.model.ep_success_buffer = deque(maxlen=100)

    def update(self) -> dict[str, float]:
        """One rollout and one update; what is worth a row of the metrics."""
        model = self.model
        model.collect_rollouts(self.env, self.watcher, model.rollout_buffer, model.n_steps)
        self.done += 1
        model._current_progress_remaining = 1.0 - self.done / self.pace.updates
        model.train()
        self._calm(self.done / self.pace.updates)
        values = model.logger.name_to_value
        row = {
            "reward_mean": self.watcher.total / self.watcher.count,
            "ended": self.watcher.ended / self.watcher.count,
            "failures": float(len(self.watcher.failures)),
            "std": float(torch.exp(model.policy.log_std.detach()).mean()),
            "approx_kl": float(values.get("train/approx_kl", np.nan)),
            "explained_variance": float(values.get("train/explained_variance", np.nan)),
        }
        return row | (self.watcher.best.row("best") if self.watcher.best else {})

    def _calm(self, share: float) -> None:
        """Cap the exploration: the optimum lies on the bounds, where noise only costs."""
        cap = self.ppo.log_std + share * (self.ppo.last_log_std - self.ppo.log_std)
        self.model.policy.log_std.data.clamp_(max=cap)

    def evaluate(self, hover: Hover) -> dict[str, float]:
        """An episode without noise; its best stroke counts like those of training."""
        found, mean = episode(hover, self.policy(), hover.settings.horizon)
        self.watcher.best = better(self.watcher.best, found)
        row = {"evaluation_mean": mean} | (found.row("evaluation") if found else {})
        return row | (self.watcher.best.row("best") if self.watcher.best else {})

    def board(self, row: dict[str, float], step: int) -> None:
        """Write a row to TensorBoard beside SB3's own numbers."""
        for name, value in row.items():
            self.model.logger.record(f"hover/{name}", value)
        self.model.logger.dump(step)

    def state(self) -> dict[str, Any]:
        """Everything that the next update depends on."""
        model, normaliser = self.model, self.env.ret_rms
        return {
            "done": self.done,
            "policy": model.policy.state_dict(),
            "optimiser": model.policy.optimizer.state_dict(),
            "updates": model._n_updates,
            "timesteps": model.num_timesteps,
            "observation": model._last_obs,
            "starts": np.asarray(model._last_episode_starts),
            "reward_scale": [normaliser.mean, normaliser.var, normaliser.count],
            "returns": self.env.returns,
            "env": self.gains.get_state(),
            "random": checkpoint.random_state(),
            "best": asdict(self.watcher.best) if self.watcher.best else None,
        }

    def restore(self, state: dict[str, Any]) -> None:
        """Continue where `state` was taken, as if nothing had happened in between."""
        model = self.model
        self.begin_with(state)
        self.done = state["done"]
        model._n_updates, model.num_timesteps = state["updates"], state["timesteps"]
        model._last_obs, model._last_episode_starts = state["observation"], state["starts"]
        self.env.returns = state["returns"]
        self.gains.set_state(state["env"])
        self.watcher.best = Candidate(**state["best"]) if state["best"] else None
        checkpoint.set_random_state(state["random"])

    def begin_with(self, state: dict[str, Any]) -> None:
        """Transfer: policy, optimiser and reward scale of another stage."""
        self.model.policy.load_state_dict(state["policy"])
        self.model.policy.optimizer.load_state_dict(state["optimiser"])
        rms = self.env.ret_rms
        rms.mean, rms.var, rms.count = (np.float64(x) for x in state["reward_scale"])

    def policy(self) -> export.Policy:
        """The mean action of the policy as it is now."""
        return export.policy_of(
            {k: v.detach().numpy().copy() for k, v in self.model.policy.state_dict().items()}
        )


def build(env: VecEnv, pace: Pace, ppo: Ppo, seed: int) -> PPO:
    """SB3's PPO with its default network of 64 and 64."""
    return PPO(
        "MlpPolicy",
        env,
        learning_rate=lambda left: pace.learning_rate * (LAST_RATE + (1.0 - LAST_RATE) * left),
        n_steps=pace.rollout,
        batch_size=pace.batch,
        n_epochs=pace.epochs,
        gamma=ppo.gamma,
        gae_lambda=ppo.gae_lambda,
        clip_range=ppo.clip_range,
        target_kl=ppo.target_kl,
        ent_coef=ppo.entropy,
        policy_kwargs={"log_std_init": ppo.begun(trained=False).log_std},
        seed=seed,
        device="cpu",
    )
