"""What learning gets: strokes and rig steps per second from the batch below its environments."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM
from flaprig.benchmark.outcome import Outcome, Row, row
from flaprig.benchmark.turns import Work, in_turn, many
from flaprig.limits import SINUSOID
from flaprig.tasks.hover_batch import HoverBatch
from flaprig.tasks.hover_settings import COEFFICIENTS, SINUSOID_COEFFICIENTS, HoverSettings

if TYPE_CHECKING:
    from flaprig.tasks.hover_rig import HoverRigSettings

# the lattice of learning's second stage
LATTICE = UVLM(4, 6, 40)
# strokes that differ a little from the sinusoid, none of them beyond its bounds
PROBLEM = HoverSettings(jitter=0.02, bounds=SINUSOID.times(100.0))
NOTE = (
    "An action is a new stroke for every episode, with observation and reward; rigs x steps counts "
    f"MuJoCo's. The lattice is that of learning, {LATTICE.chordwise} x {LATTICE.spanwise} panels "
    f"and {LATTICE.steps_per_cycle} steps. In limits: each stroke goes through Ruckig, in Python. "
    "`python benchmarks/bench_vector.py` holds Stable-Baselines3's environment against this batch."
)


@dataclass(frozen=True)
class Setup:
    """Episodes to be measured.

    Attributes:
        name: what flies, in which air.
        settings: the problem.
        count: episodes side by side.
        actions: in one measurement.
    """

    name: str
    settings: HoverSettings | HoverRigSettings
    count: int
    actions: int = 1

    @property
    def steps(self) -> int:
        """MuJoCo steps in a stroke; 0 where the motion is prescribed."""
        if isinstance(self.settings, HoverSettings):
            return 0
        problem = self.settings.problem
        sinusoid = problem.stroke(SINUSOID_COEFFICIENTS)
        return self.settings.twin().steps_per_cycle(sinusoid) * problem.cycles

    @property
    def still(self) -> NDArray[np.float64]:
        """Actions that leave each stroke as it is. Shape (count, 12)."""
        return np.zeros((self.count, COEFFICIENTS))

    def rows(self, taken: NDArray[np.float64], words: str = "") -> list[Row]:
        """Strokes and, with the rig, its steps per second, from the seconds of each turn."""
        rate = self.count * self.actions / taken
        rows = [row(f"strokes, {self.name}{words}", rate, "1/s")]
        if self.steps:
            rows.append(row(f"rigs x steps, {self.name}{words}", self.steps * rate, "1/s"))
        return rows


def setups(envs: int, rigs: int, actions: int) -> list[Setup]:
    """Prescribed motion and the rig, each in the quasi-steady air and in the lattice.

    Args:
        envs: episodes of the cheapest.
        rigs: episodes of all others.
        actions: in a measurement of the cheapest.
    """
    from flaprig.tasks.hover_rig import HoverRigSettings

    lattice = replace(PROBLEM, model=LATTICE)
    return [
        Setup("prescribed, quasi-steady", PROBLEM, envs, actions),
        Setup("prescribed, lattice", lattice, rigs),
        Setup("rig, quasi-steady", HoverRigSettings(PROBLEM, limits=None), rigs),
        Setup("rig, lattice", HoverRigSettings(lattice, limits=None), rigs),
        Setup("rig in limits, quasi-steady", HoverRigSettings(PROBLEM), rigs),
    ]


def begun(setup: Setup) -> Work:
    """One measurement of the batch: its actions, in episodes that have begun.

    Raises:
        RuntimeError: a stroke is not flown; it would be counted without having been simulated.
    """
    batch = HoverBatch(setup.settings, setup.count)
    batch.reset(range(setup.count), [np.random.default_rng(k) for k in range(setup.count)])
    # wakes up the threads, too
    step = batch.step(setup.still)
    if step.terminated.any():
        raise RuntimeError(f"learning: strokes of «{setup.name}» are not flown: {step.failures}")
    return many(partial(batch.step, setup.still), setup.actions)


@dataclass(frozen=True)
class Learning:
    """Actions in a batch of hovering episodes, with prescribed motion and flown by the rig.

    Attributes:
        envs: episodes side by side, prescribed in the quasi-steady air.
        rigs: episodes side by side where the lattice or the rig is in them.
        actions: in a measurement of the quasi-steady air; elsewhere one.
        turns: of everything.
    """

    name: ClassVar[str] = "learning"
    claim: ClassVar[str] = "strokes and rig steps per second of a batch of episodes"

    envs: int = 64
    rigs: int = 16
    actions: int = 8
    turns: int = 5

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        for name, most in (("envs", 100_000), ("rigs", 10_000), ("actions", 10_000)):
            check.whole(self.name, name, getattr(self, name), 1, most)
        check.whole(self.name, "turns", self.turns, 1, 1000)
        listed = setups(self.envs, self.rigs, self.actions)
        works = {setup.name: begun(setup) for setup in listed}
        taken = in_turn(works, self.turns, progress)
        rows = [each for setup in listed for each in setup.rows(taken[setup.name])]
        return Outcome(tuple(rows), notes=(NOTE,))
