"""Gymnasium environments; importing this registers them.

flaprig/HoverKinematics-v0, flaprig/HoverRig-v0 and flaprig/Track-v0. Stable-Baselines3's vector
environment is training/vector.py.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

import gymnasium

if TYPE_CHECKING:
    from flaprig.envs.hover_kinematics import HoverKinematics
    from flaprig.envs.hover_rig import HoverRig
    from flaprig.envs.track import TrackStroke

__all__ = ["HoverKinematics", "HoverRig", "TrackStroke"]

# class and id, by module: MuJoCo and dm_control are imported by those that need them
_ROOMS = {
    "HoverKinematics": ("hover_kinematics", "flaprig/HoverKinematics-v0"),
    "HoverRig": ("hover_rig", "flaprig/HoverRig-v0"),
    "TrackStroke": ("track", "flaprig/Track-v0"),
}

for _name, (_room, _id) in _ROOMS.items():
    # they say themselves what is called too early or too late, and wrappers would share on a copy
    gymnasium.register(
        _id, f"flaprig.envs.{_room}:{_name}", order_enforce=False, disable_env_checker=True
    )


def __getattr__(name: str) -> Any:
    if name not in _ROOMS:
        raise AttributeError(f"module 'flaprig.envs' has no attribute {name!r}")
    return getattr(import_module(f"flaprig.envs.{_ROOMS[name][0]}"), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
