"""Times measured in turns: what is compared is run one after the other, over and over.

The machine may be shared: its speed drifts, and a ratio of two times is only worth something where
both were taken within seconds of each other.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Hashable, Mapping
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.air import Progress

Array = NDArray[np.float64]
Key = TypeVar("Key", bound=Hashable)
Work = Callable[[], object]


def seconds(work: Work) -> float:
    """Wall time of the work [s]."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def in_turn(
    works: Mapping[Key, Work], turns: int, progress: Progress | None = None
) -> dict[Key, Array]:
    """Wall time of each work [s], one after the other in every turn. Shape (turns,) each."""
    taken = {key: np.zeros(turns) for key in works}
    for turn in range(turns):
        for number, (key, work) in enumerate(works.items(), 1):
            taken[key][turn] = seconds(work)
            if progress is not None:
                progress((turn + number / len(works)) / turns)
    return taken


def repeated(
    measure: Callable[[], Mapping[Key, float]], turns: int, progress: Progress | None = None
) -> dict[Key, Array]:
    """Numbers measured anew in every turn. Shape (turns,) each."""
    found: list[Mapping[Key, float]] = []
    for turn in range(1, turns + 1):
        found.append(measure())
        if progress is not None:
            progress(turn / turns)
    return {key: np.array([each[key] for each in found]) for key in found[0]}


def calls_for(work: Work, duration: float) -> int:
    """How many calls take about that long [s], from one call after another that warms up."""
    work()
    return max(1, math.ceil(duration / max(seconds(work), 1e-7)))


def many(work: Work, calls: int) -> Work:
    """The work, so many times."""

    def all_of_them() -> None:
        for _ in range(calls):
            work()

    return all_of_them
