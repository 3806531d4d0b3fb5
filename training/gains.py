"""Rewards as gains: what a stroke is worth more than the one before it.

The discounted sum of R(k+1) - R(k) is (1 - gamma) times that of R(k+1), less R(0): the same goal
as with equation 12 itself (A. Ng, D. Harada & S. Russell 1999, shaping by a potential, here R). But
the critic has only the gain left to foresee and not the worth of every stroke, to a small share of
which it would have to be exact. A stroke beyond the bounds counts as one kept for ever.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnvWrapper
from stable_baselines3.common.vec_env.base_vec_env import VecEnvObs, VecEnvStepReturn

from training.vector import HoverVecEnv


class Gains(VecEnvWrapper):
    """A hovering environment whose rewards are differences.

    Attributes:
        raw: rewards of the latest step, equation 12 or 13. Shape (num_envs,).
        before: worth of the present strokes. Shape (num_envs,).
    """

    def __init__(self, venv: HoverVecEnv) -> None:
        super().__init__(venv)
        self.hover, self.batch = venv.batch.hover, venv.batch
        self.raw: NDArray[np.float64] = np.zeros(venv.num_envs)
        self.before = self._worth(np.arange(venv.num_envs))

    def reset(self) -> VecEnvObs:
        """Begin all episodes anew."""
        seen = self.venv.reset()
        self.before = self._worth(np.arange(self.num_envs))
        return seen

    def step_wait(self) -> VecEnvStepReturn:
        """One step; the worth is kept, the gain returned."""
        seen, rewards, done, infos = self.venv.step_wait()
        self.raw = np.asarray(rewards, np.float64)
        gains = self.raw - self.before
        self.before = self.raw.copy()
        rows = np.flatnonzero(done)
        if rows.size:
            self.before[rows] = self._worth(rows)
        return seen, gains.astype(np.float32), done, infos

    def get_state(self) -> dict[str, Any]:
        """All that the episodes depend on."""
        return {"env": self.venv.get_state(), "before": self.before.copy()}

    def set_state(self, state: dict[str, Any]) -> None:
        """Go on from what `get_state` gave."""
        self.venv.set_state(state["env"])
        self.before = np.array(state["before"], np.float64)

    def _worth(self, rows: NDArray[np.int64]) -> NDArray[np.float64]:
        """Of the strokes that episodes begin with; beyond the bounds it is minus the penalty."""
        if self.hover.settings.jitter == 0.0:
            return np.full(rows.size, float(self.hover.terms(self.hover.sinusoid).sum()))
        return self.hover.evaluate(self.batch.coefficients[rows]).reward
