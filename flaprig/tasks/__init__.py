"""Tasks: the hovering problem of the paper, and the rig's tasks in dm_control's shape."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from flaprig.tasks.hover import Evaluation, Hover
from flaprig.tasks.hover_batch import HoverBatch
from flaprig.tasks.hover_settings import (
    SINUSOID_COEFFICIENTS,
    HoverReward,
    HoverSettings,
)

if TYPE_CHECKING:
    from flaprig.tasks.hover_rig import HoverRigSettings
    from flaprig.tasks.suite import ALL_TASKS, load
    from flaprig.tasks.track_settings import TrackSettings

__all__ = [
    "ALL_TASKS",
    "Evaluation",
    "Hover",
    "HoverBatch",
    "HoverReward",
    "HoverRigSettings",
    "HoverSettings",
    "SINUSOID_COEFFICIENTS",
    "TrackSettings",
    "load",
]

# what needs MuJoCo or dm_control: imported when it is asked for
_LATE = {
    "ALL_TASKS": "suite",
    "HoverRigSettings": "hover_rig",
    "TrackSettings": "track_settings",
    "load": "suite",
}


def __getattr__(name: str) -> Any:
    if name not in _LATE:
        raise AttributeError(f"module 'flaprig.tasks' has no attribute {name!r}")
    return getattr(import_module(f"flaprig.tasks.{_LATE[name]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
