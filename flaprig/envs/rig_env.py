"""What all environments of the rig share: when they may be stepped, and how they are copied."""

from __future__ import annotations

from typing import Any

import gymnasium
from gymnasium.error import ResetNeeded

from flaprig import _checks as check
from flaprig.envs.spaces import Numbers
from flaprig.tasks.copies import Copied

# pictures: height and width in pixels
PICTURE = (480, 640)


class NoEpisodeError(ResetNeeded, RuntimeError):
    """An environment is stepped or drawn while no episode is under way."""


class RigEnv(Copied, gymnasium.Env[Numbers, Numbers]):
    """An environment that knows whether an episode is under way.

    `copy.copy`, `copy.deepcopy` and `pickle` make environments that go on like this one, bit for
    bit, and share nothing with it.

    Attributes:
        render_mode: None or rgb_array.
    """

    # gymnasium declares it for instances
    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}  # noqa: RUF012

    def __init__(self, render_mode: str | None) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise check.fail(type(self).__name__, "render_mode", "None or rgb_array", render_mode)
        self.render_mode = render_mode
        self._begun, self._ended = False, False

    def _begin(self) -> None:
        self._begun, self._ended = True, False

    def _require_episode(self, call: str, ended_too: bool = True) -> None:
        """Refuse a call before the first reset and, for a step, after an episode's end.

        Raises:
            NoEpisodeError: one sentence.
        """
        if not self._begun or (ended_too and self._ended):
            when = "after the episode's end" if self._begun else "before the first reset"
            raise NoEpisodeError(
                f"{type(self).__name__}.{call}: reset() must be called first, got {call}() {when}"
            )
