"""Many strokes at once: what all cores make of it beside one thread."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.benchmark.benchmark import STROKE, cores
from flaprig.benchmark.outcome import Outcome, row
from flaprig.benchmark.turns import Work, in_turn
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING

# "close to cores x the speed of one thread" [%]
AIM = 90.0


@dataclass(frozen=True)
class Batch:
    """`flaprig.simulate_batch` on all cores beside `flaprig.simulate` stroke by stroke.

    Attributes:
        strokes: how many, of different pitch.
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: wake steps in a cycle.
        cycles: of each stroke.
        turns: of everything.
    """

    name: ClassVar[str] = "batch"
    claim: ClassVar[str] = "many strokes on all cores beside one thread"

    strokes: int = 16
    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 2
    turns: int = 5

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        check.whole(self.name, "strokes", self.strokes, 1, 10_000)
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        check.whole(self.name, "turns", self.turns, 1, 1000)
        model = UVLM(self.chordwise, self.spanwise, self.steps_per_cycle)
        listed = pitches(self.strokes)
        batch = partial(simulate_batch, RIG_WING, listed, model, cycles=self.cycles)
        works: dict[str, Work] = {
            "one by one": partial(self._one_by_one, listed, model),
            "batch": batch,
        }
        # the threads wake up
        batch()
        found = in_turn(works, self.turns, progress)
        share = 100.0 * found["one by one"] / (cores() * found["batch"])
        words = f"{self.strokes} strokes of {self.cycles} cycles"
        rows = (
            row(f"{words}, one by one", found["one by one"], "s"),
            row(f"{words}, simulate_batch on {cores()} cores", found["batch"], "s"),
            row("strokes per second, simulate_batch", self.strokes / found["batch"], "1/s"),
            row("share of cores times one thread", share, "%", at_least=AIM),
        )
        return Outcome(rows)

    def _one_by_one(self, listed: list[SunTangStroke], model: UVLM) -> None:
        for stroke in listed:
            simulate(RIG_WING, stroke, model, cycles=self.cycles)


def pitches(count: int) -> list[SunTangStroke]:
    """The sinusoid with so many pitch amplitudes, 30 to 60 degrees."""
    amplitudes = np.radians(np.linspace(30.0, 60.0, count))
    sweep = STROKE.sweep_amplitude
    return [SunTangStroke(STROKE.frequency, sweep, float(pitch)) for pitch in amplitudes]
