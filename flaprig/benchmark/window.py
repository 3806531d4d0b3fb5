"""The paper's window: five cycles of the rig's sinusoid with a wake of one cycle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.benchmark.benchmark import STROKE
from flaprig.benchmark.outcome import Outcome, row
from flaprig.benchmark.turns import in_turn
from flaprig.wing import RIG_WING

# what the project aims at [s]
AIM = 1.0


@dataclass(frozen=True)
class Window:
    """`flaprig.simulate` with its defaults on one thread, as the paper ran it.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: wake steps in a cycle.
        cycles: of the sinusoid.
        turns: of everything.
    """

    name: ClassVar[str] = "window"
    claim: ClassVar[str] = "the paper's window, 5 cycles on one thread"

    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 5
    turns: int = 7

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        check.whole(self.name, "turns", self.turns, 1, 1000)
        grid = (self.chordwise, self.spanwise, self.steps_per_cycle)
        models = {"dial": UVLM(*grid), "brute": UVLM(*grid, wake_detail=0)}
        works = {
            key: partial(simulate, RIG_WING, STROKE, model, cycles=self.cycles)
            for key, model in models.items()
        }
        # wakes up what sleeps
        simulate(RIG_WING, STROKE, models["dial"], cycles=1)
        found = in_turn(works, self.turns, progress)
        span, words = self.cycles * STROKE.period, f"{self.cycles} cycles"
        rows = (
            row(f"{words}, default dial", found["dial"], "s", at_most=AIM),
            row(f"{words}, brute force", found["brute"], "s"),
            row("brute force over default dial", found["brute"] / found["dial"], "x"),
            row("faster than the rig itself, default dial", span / found["dial"], "x"),
        )
        return Outcome(rows)
