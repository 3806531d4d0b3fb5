"""When a moving target can first be met: the earliest tick at which a stroke can be joined.

A motion of one given duration exists or not, and durations that serve may lie apart; so the search
walks forward, first in strides of a 256th of a cycle, then in ever finer ones through the last
stride. After some cycles the strides grow with the time gone by, so that the work is bounded
whatever the way is. What is found is the earliest tick, but for windows shorter than a stride. The
ticks that are tried do not depend on the limits: where looser limits meet the target at every tick
at which tighter ones do, they find no later one.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from flaprig.limits.reference import Reference, State

# strides in a cycle, and in each time again as long after the first cycles
STRIDES, LATE_STRIDES = 256, 1024


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
    tried, before, late = _coarse(stride, longest), 0, None
    while tried.size:
        found = _first(reference, tick, tried, meets)
        if found is None and late is None:
            return None
        if found is None:
            before = int(tried[-1])
        else:
            late = int(tried[found])
            before = int(tried[found - 1]) if found else before
        assert late is not None
        tried = _between(before, late)
    return late


def _between(before: int, late: int) -> NDArray[np.int64]:
    """Numbers of ticks between two in equal strides, all of them where they are few."""
    stride = max(1, (late - before) // STRIDES)
    return np.arange(before + stride, late, stride)


def _coarse(stride: int, longest: float) -> NDArray[np.int64]:
    """Numbers of ticks to try first: in strides, later in ones that grow with the number."""
    steady = stride * LATE_STRIDES
    early = np.arange(1, min(int(longest), steady) + stride + 1, stride)
    if longest <= steady:
        return early
    count = int(np.ceil(LATE_STRIDES * np.log(longest / steady))) + 1
    grown = early[-1] * np.exp(np.arange(1, count + 1) / LATE_STRIDES)
    return np.concatenate([early, np.unique(np.ceil(grown).astype(np.int64))])


def _first(
    reference: Reference,
    tick: int,
    lengths: NDArray[np.int64],
    meets: Callable[[State, int], bool],
) -> int | None:
    """The first place in some numbers of ticks after which the stroke can be met."""
    # a long search ends early as a rule: not all states at once
    for begin in range(0, lengths.size, STRIDES):
        part = lengths[begin : begin + STRIDES]
        states = reference.states(tick + part)
        for place, (length, state) in enumerate(zip(part.tolist(), states, strict=True), begin):
            if meets(state, length):
                return place
    return None
