"""Stable-Baselines3's vector environment over a batch of hovering episodes.

Here and not in flaprig/envs, since only training/ may import Stable-Baselines3. Row i of a batch
behaves as flaprig/HoverKinematics-v0, or flaprig/HoverRig-v0, seeded with seed + i, bit for bit.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from stable_baselines3.common.vec_env import VecEnv
from stable_baselines3.common.vec_env.base_vec_env import VecEnvIndices, VecEnvObs, VecEnvStepReturn

from flaprig import _checks as check
from flaprig.envs.spaces import action_space, observation_space
from flaprig.tasks.actions import checked_actions
from flaprig.tasks.copies import Copied
from flaprig.tasks.hover_batch import HoverBatch, Step
from flaprig.tasks.hover_settings import COEFFICIENTS, HoverSettings

if TYPE_CHECKING:
    from flaprig.tasks.hover_rig import HoverRigSettings


class HoverVecEnv(Copied, VecEnv):
    """Hovering episodes that begin anew by themselves; all are simulated in one call.

    An info holds what HoverKinematics' does; at an episode's end also `terminal_observation`,
    `TimeLimit.truncated` and `episode` (r, l, t), as SB3's Monitor adds them.

    Args:
        settings: the problem, flown with prescribed motion, or by the rig (HoverRigSettings).
        num_envs: number of episodes side by side, 1 to 100000.
        seed: of row 0; row i has seed + i. None: from the system.

    Raises:
        ValueError: a value out of its range.
    """

    def __init__(
        self,
        settings: HoverSettings | HoverRigSettings | None = None,
        num_envs: int = 16,
        seed: int | None = None,
    ) -> None:
        count = check.whole("HoverVecEnv", "num_envs", num_envs, 1, 100_000)
        # VecEnv asks for the attribute render_mode while it is made
        self.render_mode: str | None = None
        self.batch = HoverBatch(settings or HoverSettings(), count)
        super().__init__(count, observation_space(), action_space())
        self.generators = [np.random.default_rng() for _ in range(count)]
        self.returns: NDArray[np.float64] = np.zeros(count)
        self.started = time.time()
        self._actions: NDArray[np.float64] | None = None
        self._begun = False
        if seed is not None:
            self.seed(seed)

    @property
    def settings(self) -> HoverSettings:
        """The problem."""
        return self.batch.settings

    def reset(self) -> VecEnvObs:
        """Begin all episodes anew; seeds given by `seed` are used once."""
        for i, seed in enumerate(self._seeds):
            if seed is not None:
                self.generators[i] = np.random.default_rng(seed)
        self._reset_seeds()
        self._reset_options()
        self.returns[:] = 0.0
        self._begun = True
        self.reset_infos = [{} for _ in range(self.num_envs)]
        return self.batch.reset(np.arange(self.num_envs), self.generators).astype(np.float32)

    def step_async(self, actions: NDArray[Any]) -> None:
        """Keep the actions for `step_wait`. Shape (num_envs, 12).

        A row that is not finite ends its episode, with `failure` in its info.

        Raises:
            ValueError: actions of another shape.
            RuntimeError: reset was never called.
        """
        if not self._begun:
            raise RuntimeError(
                "HoverVecEnv.step: reset() must be called first, got step() before the first reset"
            )
        checked_actions("HoverVecEnv.step", actions, (self.num_envs, COEFFICIENTS))
        self._actions = np.asarray(actions)

    def step_wait(self) -> VecEnvStepReturn:
        """Fly the new strokes; finished episodes begin anew."""
        if self._actions is None:
            raise RuntimeError("HoverVecEnv.step_wait: step_async() must be called first")
        step, self._actions = self.batch.step(self._actions), None
        infos = step.infos()
        observation = step.observation.astype(np.float32)
        self.returns += step.reward
        done = step.terminated | step.truncated
        rows = np.flatnonzero(done)
        if rows.size:
            self._finish(rows, step, observation, infos)
        return observation, step.reward.astype(np.float32), done, infos

    def _finish(
        self,
        rows: NDArray[np.int64],
        step: Step,
        observation: NDArray[np.float32],
        infos: list[dict[str, Any]],
    ) -> None:
        """End episodes as SB3 expects it, and put the next ones' first observations in place."""
        seconds = round(time.time() - self.started, 6)
        for k in rows.tolist():
            infos[k]["terminal_observation"] = observation[k].copy()
            infos[k]["TimeLimit.truncated"] = bool(step.truncated[k])
            infos[k]["episode"] = {
                "r": round(float(self.returns[k]), 6),
                "l": int(self.batch.elapsed[k]),
                "t": seconds,
            }
        self.returns[rows] = 0.0
        observation[rows] = self.batch.reset(rows, [self.generators[k] for k in rows])

    def get_state(self) -> dict[str, Any]:
        """All that the episodes depend on, as arrays and plain types; for checkpoints."""
        return {
            "coefficients": self.batch.coefficients.copy(),
            "elapsed": self.batch.elapsed.copy(),
            "returns": self.returns.copy(),
            "generators": [generator.bit_generator.state for generator in self.generators],
        }

    def set_state(self, state: dict[str, Any]) -> None:
        """Go on from what `get_state` gave."""
        self.batch.coefficients = np.array(state["coefficients"], dtype=np.float64)
        self.batch.elapsed = np.array(state["elapsed"], dtype=np.int64)
        self.returns = np.array(state["returns"], dtype=np.float64)
        self._begun = True
        for generator, kept in zip(self.generators, state["generators"], strict=True):
            generator.bit_generator.state = kept

    def close(self) -> None:
        """Nothing is held open."""

    def get_attr(self, attr_name: str, indices: VecEnvIndices = None) -> list[Any]:
        """An attribute, once for each row: what all rows share is repeated."""
        return [getattr(self, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: VecEnvIndices = None) -> None:
        """Set an attribute of all rows.

        Raises:
            ValueError: only some of the rows are named; they share their attributes.
        """
        if len(list(self._get_indices(indices))) != self.num_envs:
            raise check.fail("HoverVecEnv.set_attr", "indices", "all rows", indices)
        setattr(self, attr_name, value)

    def env_method(
        self, method_name: str, *args: Any, indices: VecEnvIndices = None, **kwargs: Any
    ) -> list[Any]:
        """Call a method, once for each row named."""
        method = getattr(self, method_name)
        return [method(*args, **kwargs) for _ in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: type[Any], indices: VecEnvIndices = None) -> list[bool]:
        """True for SB3's Monitor, whose infos these are; no other wrapper is inside."""
        from stable_baselines3.common.monitor import Monitor

        wrapped = isinstance(wrapper_class, type) and issubclass(wrapper_class, Monitor)
        return [wrapped for _ in self._get_indices(indices)]

    def get_images(self) -> Sequence[Any]:
        """No pictures: the strokes are drawn by `flaprig view`."""
        return [None] * self.num_envs
