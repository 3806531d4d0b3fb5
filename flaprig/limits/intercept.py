"""When a moving target can first be met: the earliest tick at which a stroke can be joined.

A motion of one given duration exists or not, and durations that serve may lie apart; so the search
walks forward, first in strides of a 256th of a cycle, then tick by tick through the last stride.
What is found is the earliest tick, but for windows shorter than a stride.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from flaprig.limits.reference import Reference, State

# strides in a cycle
STRIDES = 256


def earliest(
    reference: Reference, tick: int, longest: float, meets: Callable[[State, int], bool]
) -> int | None:
    """Ticks until the stroke can be met, at least one; None when not within the longest.

    Args:
        reference: the stroke on the controller's clock.
        tick: the present tick.
        longest: end of the search, in ticks from now.
        meets: whether a state can be reached in exactly so many ticks.
    """
    stride = max(1, int(reference.stroke.period / reference.interval / STRIDES))
    late = _first(reference, tick, np.arange(1, int(longest) + stride + 1, stride), meets)
    if late is None:
        return None
    before = _first(reference, tick, np.arange(max(1, late - stride + 1), late), meets)
    return late if before is None else before


def _first(
    reference: Reference, tick: int, lengths: np.ndarray, meets: Callable[[State, int], bool]
) -> int | None:
    """The first of some numbers of ticks after which the stroke can be met."""
    # a long search ends early as a rule: not all states at once
    for part in np.array_split(lengths, 1 + lengths.size // STRIDES):
        states = reference.states(tick + part)
        for length, state in zip(part.tolist(), states, strict=True):
            if meets(state, length):
                return int(length)
    return None
