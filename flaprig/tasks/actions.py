"""What every environment and task does with an action, once: its shape, its numbers, its range."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check

# why an episode ends whose action is NaN or infinite
ACTION_FAILED = "the action is not finite"


def checked_actions(
    owner: str, actions: Any, shape: tuple[int, ...]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Actions clipped to [-1, 1], and the rows of them that are not finite, which become zeros.

    A wrong shape is the program's mistake and raises. A number that is not finite is the policy's:
    it ends that episode with `failure` and without reward, and the others go on.

    Args:
        owner: whose action it is, for the sentence.
        actions: one action, or one a row.
        shape: that they must have; the last axis is that of one action.

    Raises:
        ValueError: another shape, or no numbers.
    """
    allowed = f"numbers of shape {shape}"
    try:
        raw = np.asarray(actions)
    except (TypeError, ValueError):
        raise check.fail(owner, "action", allowed, actions) from None
    if raw.dtype.kind not in "iuf":
        raise check.fail(owner, "action", allowed, actions)
    if raw.shape != shape:
        raise ValueError(f"{owner}: action must be {allowed}, got shape {raw.shape}")

    values = np.array(raw, dtype=np.float64)
    broken = np.asarray(~np.isfinite(values).all(axis=-1))
    values[broken] = 0.0
    return np.clip(values, -1.0, 1.0), broken
