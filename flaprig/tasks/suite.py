"""The tasks by name, as dm_control's suite loads its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from dm_control.rl import control

from flaprig import _checks as check
from flaprig.tasks.copies import Copied
from flaprig.tasks.hover_rig import HoverRigSettings
from flaprig.tasks.hover_settings import HoverSettings
from flaprig.tasks.hover_task import HoverPhysics, HoverTask
from flaprig.tasks.track import Track, track_physics
from flaprig.tasks.track_settings import TrackSettings

Random = int | np.random.Generator | None


class RigEnvironment(Copied, control.Environment):
    """dm_control's Environment, whose copies share nothing with it."""


def hover_kinematics(
    random: Random = None, settings: HoverSettings | None = None, **environment: Any
) -> control.Environment:
    """A stroke an action, with prescribed motion."""
    physics = HoverPhysics.make(settings or HoverSettings())
    return RigEnvironment(physics, HoverTask(random), **environment)


def hover_rig(
    random: Random = None, settings: HoverRigSettings | None = None, **environment: Any
) -> control.Environment:
    """A stroke an action, flown by the motors."""
    physics = HoverPhysics.make(settings or HoverRigSettings())
    return RigEnvironment(physics, HoverTask(random), **environment)


def track(
    random: Random = None, settings: TrackSettings | None = None, **environment: Any
) -> control.Environment:
    """A motor command an action."""
    task = Track(settings, random)
    steps = {"n_sub_steps": task.settings.substeps, "legacy_step": False}
    return RigEnvironment(track_physics(task.settings), task, **(steps | environment))


TASKS: dict[tuple[str, str], Callable[..., control.Environment]] = {
    ("hover", "kinematics"): hover_kinematics,
    ("hover", "rig"): hover_rig,
    ("track", "stroke"): track,
}
# (domain, task) of every task
ALL_TASKS = tuple(TASKS)


def load(
    domain_name: str,
    task_name: str,
    task_kwargs: dict[str, Any] | None = None,
    environment_kwargs: dict[str, Any] | None = None,
) -> control.Environment:
    """One of ALL_TASKS as an environment.

    Args:
        domain_name: hover or track.
        task_name: kinematics or rig; stroke.
        task_kwargs: random (seed, generator or None) and settings.
        environment_kwargs: of dm_control's Environment, flat_observation for instance.

    Raises:
        ValueError: there is no such task.
    """
    make = TASKS.get((domain_name, task_name))
    if make is None:
        allowed = "one of " + ", ".join(f"{domain} {task}" for domain, task in ALL_TASKS)
        raise check.fail("tasks.load", "domain and task", allowed, f"{domain_name} {task_name}")
    return make(**(task_kwargs or {}), **(environment_kwargs or {}))
