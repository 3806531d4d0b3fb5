"""The hovering problem for Gymnasium, one episode at a time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from flaprig.envs.rig_env import PICTURE, RigEnv
from flaprig.envs.spaces import Numbers, action_space, observation_space
from flaprig.strokes.fourier import FourierStroke
from flaprig.tasks.actions import checked_actions
from flaprig.tasks.hover_batch import HoverBatch
from flaprig.tasks.hover_settings import COEFFICIENTS, HoverSettings

if TYPE_CHECKING:
    from flaprig.tasks.hover_rig import HoverRigSettings
    from flaprig.tasks.hover_task import HoverPhysics


class HoverEnv(RigEnv):
    """What HoverKinematics and HoverRig share."""

    def __init__(
        self, settings: HoverSettings | HoverRigSettings, render_mode: str | None = None
    ) -> None:
        super().__init__(render_mode)
        self.action_space = action_space()
        self.observation_space = observation_space()
        self.batch = HoverBatch(settings, 1)
        self._physics: HoverPhysics | None = None

    @property
    def settings(self) -> HoverSettings:
        """The problem."""
        return self.batch.settings

    @property
    def stroke(self) -> FourierStroke:
        """The present stroke."""
        return self.settings.stroke(self.batch.coefficients[0])

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Numbers, dict[str, Any]]:
        """Begin a new episode; no options are known."""
        super().reset(seed=seed)
        observation = self.batch.reset([0], [self.np_random])
        self._begin()
        info = {"coefficients": self.batch.coefficients[0].copy()}
        return observation[0].astype(np.float32), info

    def step(self, action: Numbers) -> tuple[Numbers, float, bool, bool, dict[str, Any]]:
        """Change the stroke and judge it; an action that is not finite ends the episode.

        Raises:
            ValueError: an action of another shape.
            NoEpisodeError: before reset, or after the episode's end.
        """
        self._require_episode("step")
        checked_actions(f"{type(self).__name__}.step", action, (COEFFICIENTS,))
        step = self.batch.step(np.asarray(action)[None])
        self._ended = bool(step.terminated[0] or step.truncated[0])
        return (
            step.observation[0].astype(np.float32),
            float(step.reward[0]),
            bool(step.terminated[0]),
            bool(step.truncated[0]),
            step.infos()[0],
        )

    def render(self) -> NDArray[np.uint8] | None:
        """A picture of the rig in the middle of the stroke, or where the motors left it.

        Raises:
            NoEpisodeError: before reset.
            RuntimeError: no OpenGL library works here; the sentence says what to install.
        """
        if self.render_mode is None:
            return None
        self._require_episode("render", ended_too=False)
        if self._physics is None:
            # MuJoCo and OpenGL only for those who look
            from flaprig.tasks.hover_task import HoverPhysics

            self._physics = HoverPhysics.of_batch(self.batch)
        self._physics.show()
        return np.array(self._physics.render(*PICTURE, camera_id="iso"))

    def close(self) -> None:
        """Free what pictures were made with."""
        if self._physics is not None:
            self._physics.free()
            self._physics = None
