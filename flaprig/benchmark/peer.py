"""The rig's sinusoid by Ptera Software and by flaprig, in turns of one run.

Both have the same wing, panels, steps and motion, and a free wake of which nothing is ever dropped;
ours has no suction, since the peer has none. A time goes from wing and stroke to the loads. What
drives the peer is in `flaprig.validation.peer_code`.
"""

from __future__ import annotations

import math
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from importlib import import_module
from typing import Any, ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM
from flaprig.aero.result import Result
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.aero.simulate import prescribed, simulate
from flaprig.benchmark.benchmark import STROKE, left_out, usable
from flaprig.benchmark.growth import exponent
from flaprig.benchmark.outcome import Outcome, Row, row
from flaprig.benchmark.peer_times import AIMS, BRUTE, DIAL, THEIRS, Times, draw, time_rows
from flaprig.benchmark.turns import in_turn, seconds
from flaprig.fluid import WATER
from flaprig.validation import peer_code
from flaprig.validation.peer import MISSING
from flaprig.wing import RIG_WING

WARMED = (
    "The peer's just-in-time compiler was warmed with a wing of four panels first: its seconds of "
    "compilation are in no number. It uses at most three quarters of numba's threads, one of two; "
    "the pool is made wide enough that it gets as many as ours. Its time holds less than 1 % that "
    "is ours, the comparison of its panels with our motion."
)
# panels, steps per cycle and cycles that warm the peer's compiler
SMALL = (2, 2), 8, 1


@dataclass(frozen=True)
class Peer:
    """The rig in hover with a full free wake: Ptera Software beside flaprig.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: steps in a cycle.
        cycles: of hover.
        threads: numbers of threads; those that the machine has no cores for are left out.
        repeats: runs of ours before and after each of the peer's.
        peer_repeats: runs of the peer on each number of threads, most of a minute each.
        peer_cycles: lengths at which the peer runs once more, on the first number of threads, to
            tell how its cost grows; none leaves it out.
    """

    name: ClassVar[str] = "peer"
    claim: ClassVar[str] = "the rig case beside Ptera Software"

    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 3
    threads: tuple[int, ...] = (1, 2)
    repeats: int = 3
    peer_repeats: int = 3
    peer_cycles: tuple[int, ...] = (1, 2)

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        self._check()
        most = max(self._threads)
        _widen(most)
        there = peer_code.installed()
        self.simulate(DIAL, most)
        if there:
            _warm(most)
        told = progress or (lambda fraction: None)
        times = {}
        for number, threads in enumerate(self._threads, 1):
            times[threads] = self._turns(threads, there)
            told(number / (len(self._threads) + 1))
        growth = self._growth(times[self._threads[0]].peer) if there else []
        rows = [*time_rows(times), *growth, self._accuracy()]
        told(1.0)
        notes = (WARMED if there else MISSING, *left_out(self.threads))
        title = f"The rig case, {self.cycles} x {self.steps_per_cycle} steps, full free wake"
        return Outcome(tuple(rows), {}, lambda path: draw(path, times, title), notes)

    def _check(self) -> None:
        check.whole(self.name, "chordwise", self.chordwise, 1, 16)
        check.whole(self.name, "spanwise", self.spanwise, 1, 64)
        check.whole(self.name, "steps_per_cycle", self.steps_per_cycle, 8, 500)
        check.whole(self.name, "cycles", self.cycles, 1, 10)
        if not self.threads:
            raise check.fail(self.name, "threads", "at least one number", self.threads)
        for number in self.threads:
            check.whole(self.name, "threads", number, 1, 64)
        check.whole(self.name, "repeats", self.repeats, 1, 100)
        check.whole(self.name, "peer_repeats", self.peer_repeats, 1, 100)
        for number in self.peer_cycles:
            check.whole(self.name, "peer_cycles", number, 1, 10)

    @property
    def _threads(self) -> tuple[int, ...]:
        return usable(self.threads) or (1,)

    def _turns(self, threads: int, there: bool) -> Times:
        """Ours, the peer, ours, over and over."""
        times = Times()
        ours = {kind: partial(self.simulate, kind, threads) for kind in AIMS}
        for _ in range(self.peer_repeats):
            before = in_turn(ours, self.repeats)
            peer = [self._theirs(threads, self.cycles)] if there else []
            after = in_turn(ours, self.repeats)
            times.add(peer, {kind: [*before[kind], *after[kind]] for kind in AIMS})
        return times

    def simulate(self, kind: str, threads: int = 1) -> Result:
        """Our run of the case."""
        grid = (self.chordwise, self.spanwise, self.steps_per_cycle)
        more: dict[str, Any] = {"wake_detail": 0} if kind == BRUTE else {}
        more |= {"wake_cycles": float(self.cycles), "wake_fade": 0.0, "threads": threads}
        model = UVLM(*grid, suction_efficiency=0.0, **more)
        return simulate(RIG_WING, STROKE, model, WATER, self.cycles)

    def _theirs(self, threads: int, cycles: int) -> tuple[float, float]:
        """Seconds of the peer, and how many cores it kept busy."""
        mesh, start = (self.chordwise, self.spanwise), time.process_time()
        with _peer_threads(threads):
            wall = seconds(partial(_hover, mesh, self.steps_per_cycle, cycles))
        return wall, (time.process_time() - start) / wall

    def _growth(self, whole: list[float]) -> list[Row]:
        """How the peer's cost grows with the steps."""
        shorter = [c for c in self.peer_cycles if c != self.cycles]
        if not shorter:
            return []
        steps = [self.steps_per_cycle * cycles for cycles in (*shorter, self.cycles)]
        first = self._threads[0]
        taken = [*(self._theirs(first, cycles)[0] for cycles in shorter), float(np.median(whole))]
        name = f"{THEIRS}, growth over {min(steps)} to {max(steps)} steps"
        return [row(name, exponent(steps, taken), "exponent")]

    def _accuracy(self) -> Row:
        """What the dial costs in loads: the first cycle's means beside those of brute force."""
        first = slice(self.steps_per_cycle)
        runs = (self.simulate(kind) for kind in (BRUTE, DIAL))
        exact, ours = (np.array([run.lift[first], run.drag[first]]).mean(axis=1) for run in runs)
        change = np.abs(100.0 * (ours / exact - 1.0))
        name = f"{DIAL}, lift and drag of the first cycle beside {BRUTE}"
        return row(name, max(change), "%", at_most=0.3)


def _hover(mesh: tuple[int, int], steps: int, cycles: int) -> None:
    rigid = RigidMotion.from_stroke(prescribed(STROKE, cycles, steps))
    peer_code.hover(RIG_WING, mesh, WATER, STROKE, steps, rigid)


def _warm(threads: int) -> None:
    """Let the peer's functions be compiled."""
    with _peer_threads(threads):
        _hover(*SMALL)


def _widen(threads: int) -> None:
    """Make numba's pool so wide that three quarters of it are that many threads.

    Numba is told by its variable before it is there, or never.
    """
    if "numba" not in sys.modules:
        os.environ.setdefault("NUMBA_NUM_THREADS", str(math.ceil(4 * threads / 3)))


@contextmanager
def _peer_threads(threads: int) -> Iterator[None]:
    """So many of numba's threads, which the peer uses, or as many as there are."""
    numba = import_module("numba")
    before = numba.get_num_threads()
    numba.set_num_threads(min(threads, numba.config.NUMBA_NUM_THREADS))
    try:
        yield
    finally:
        numba.set_num_threads(before)
