"""flaprig/Track-v0: motor commands at control rate, following a stroke against disturbances."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.envs.keywords import changed
from flaprig.envs.rig_env import PICTURE, RigEnv
from flaprig.envs.spaces import Numbers
from flaprig.tasks.actions import checked_actions
from flaprig.tasks.suite import load
from flaprig.tasks.track import ACTIONS, Track
from flaprig.tasks.track_settings import TrackSettings

# numbers in an observation, and the size that they are clipped to
_SIZE, _MOST = 27, 100.0
# most actions in an episode
MOST_HORIZON = 1_000_000


class TrackStroke(RigEnv):
    """
    ## Description

    Keep the rig's wing on a stroke while random torques push both joints. The servos' own
    controllers get the stroke's angle and rate; an action corrects the angles and adds torques, so
    zeros are the servos' own tracking.

    ## Action Space

    `Box(-1.0, 1.0, (4,), float32)`

    | Num | Action                                          | Min | Max | Unit            |
    |-----|-------------------------------------------------|-----|-----|-----------------|
    | 0   | correction of the sweep's position set point    | -1  | 1   | `angle_range`   |
    | 1   | correction of the pitch's position set point    | -1  | 1   | `angle_range`   |
    | 2   | torque feedforward of the sweep servo           | -1  | 1   | `torque_range`  |
    | 3   | torque feedforward of the pitch servo           | -1  | 1   | `torque_range`  |

    ## Observation Space

    `Box(-100.0, 100.0, (27,), float32)`, clipped; two numbers are sweep, then pitch.

    | Num   | Observation                                                   | Unit    |
    |-------|---------------------------------------------------------------|---------|
    | 0-1   | angle reached minus angle of the stroke                       | 10 mrad |
    | 2-3   | angles                                                        | rad     |
    | 4-5   | rates                                                         | rad/s   |
    | 6-13  | angles of the stroke now and after 1, 2, 3 control intervals  | rad     |
    | 14-21 | rates of the stroke at the same instants                      | rad/s   |
    | 22-23 | torques of the servos                                         | N m     |
    | 24-26 | lift, drag, power given to the fluid                          | N, N, W |

    ## Rewards

    From 0 to 1: the product of both joints' `dm_control` tolerance, 1 for an error below `close`
    (1 mrad), a tenth at `margin` (20 mrad) beyond it. 0 when MuJoCo gives up, and for an action
    that is NaN or infinite.

    `info` holds `sweep_error` and `pitch_error` in rad, `lift` and `drag` in N, `power` in W, and
    `failure` (a sentence) when MuJoCo gave up or the action was not finite.

    ## Starting State

    On the stroke, moving with it, in still fluid, at a random phase (`random_phase`).

    ## Episode End

    - Termination: an error exceeds `lost` (0.5 rad), MuJoCo gave up, or the action was not finite.
    - Truncation: `cycles` cycles of the stroke, 2 by default: 500 actions.

    ## Arguments

    `settings`: a `flaprig.tasks.TrackSettings`: the rig, the stroke, the control interval, ranges,
    disturbance and margins. Each setting is also a keyword of its own, which overrides `settings`;
    `horizon`, the number of actions, sets `cycles`.

    ```python
    import gymnasium, flaprig.envs
    env = gymnasium.make("flaprig/Track-v0", horizon=100, disturbance=(0.1, 0.05))
    ```

    ## Version History

    - v0: first version.
    """

    # gymnasium declares it for instances
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 50}  # noqa: RUF012

    def __init__(
        self,
        settings: TrackSettings | None = None,
        render_mode: str | None = None,
        **changes: Any,
    ) -> None:
        super().__init__(render_mode)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (ACTIONS,), np.float32)
        self.observation_space = gymnasium.spaces.Box(-_MOST, _MOST, (_SIZE,), np.float32)
        kwargs = {"settings": _settings(settings, changes)}
        self._environment = load("track", "stroke", kwargs, {"flat_observation": True})

    @property
    def _task(self) -> Track:
        task = self._environment.task
        assert isinstance(task, Track)
        return task

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Numbers, dict[str, Any]]:
        """Begin a new episode; no options are known."""
        super().reset(seed=seed)
        self._task.random = self.np_random
        self._begin()
        return _flat(self._environment.reset()), self._info()

    def step(self, action: Numbers) -> tuple[Numbers, float, bool, bool, dict[str, Any]]:
        """One control interval; an action that is not finite ends the episode.

        Raises:
            ValueError: an action of another shape.
            NoEpisodeError: before reset, or after the episode's end.
        """
        self._require_episode("step")
        checked_actions("TrackStroke.step", action, (ACTIONS,))
        step = self._environment.step(action)
        terminated = step.last() and step.discount == 0.0
        truncated = step.last() and not terminated
        self._ended = step.last()
        return _flat(step), float(step.reward), terminated, truncated, self._info()

    def render(self) -> NDArray[np.uint8] | None:
        """A picture of the rig.

        Raises:
            NoEpisodeError: before reset.
            RuntimeError: no OpenGL library works here; the sentence says what to install.
        """
        if self.render_mode is None:
            return None
        self._require_episode("render", ended_too=False)
        return np.array(self._environment.physics.render(*PICTURE, camera_id="iso"))

    def close(self) -> None:
        """Free what pictures were made with."""
        self._environment.close()

    def _info(self) -> dict[str, Any]:
        physics = self._environment.physics
        sweep, pitch = self._task.error(physics).tolist()
        info: dict[str, Any] = {
            "sweep_error": sweep,
            "pitch_error": pitch,
            "lift": physics.lift(),
            "drag": physics.drag(),
            "power": physics.power(),
        }
        if physics.failure is not None:
            info["failure"] = physics.failure
        return info


def _flat(step: Any) -> NDArray[np.float32]:
    # dm_control's name for its one flat observation
    values = np.clip(step.observation["observations"], -_MOST, _MOST)
    return np.asarray(values, dtype=np.float32)


def _settings(settings: TrackSettings | None, changes: dict[str, Any]) -> TrackSettings:
    """Settings with changes by name, where `horizon` stands for the cycles that it takes."""
    rest = {name: value for name, value in changes.items() if name != "horizon"}
    found = changed("TrackStroke", TrackSettings, settings, rest, more=("horizon",))
    if "horizon" not in changes:
        return found

    if "cycles" in rest:
        allowed = "given without cycles, which say the same"
        raise check.fail("TrackStroke", "horizon", allowed, changes["horizon"])
    horizon = check.whole("TrackStroke", "horizon", changes["horizon"], 1, MOST_HORIZON)
    return replace(found, cycles=horizon * found.stroke.frequency * found.control_interval)
