"""What the air costs a step of MuJoCo, and how much faster than the rig its twin is."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.benchmark.benchmark import STROKE
from flaprig.benchmark.outcome import Outcome, Row, row
from flaprig.benchmark.turns import Work, in_turn, many

Array = NDArray[np.float64]

# what the project aims at: a step with the quasi-steady air over the bare one, and real time
STEP_AIM, REAL_TIME_AIM = 1.5, 20.0
# MuJoCo steps in a cycle: the usual 2 ms
STEPS = 2500
# cycles of a light rig in one measurement, which then takes some hundredths of a second
LIGHT = 5
MICRO = 1e6
BARE, QUASI, LATTICE, RUN = "bare", "quasi-steady", "vortex lattice", "Twin.run"
NOTE = (
    "Steps are MuJoCo's own loop of 2 ms, the servos told the sinusoid; the bare rig has neither "
    "plugin nor its sensors. Twin.run adds limits, Ruckig, feedforward and the record of every "
    "step, in Python."
)


@dataclass(frozen=True)
class TwinSpeed:
    """Time of a MuJoCo step of the rig with each air beside the bare step, and of a whole run.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: wake steps in a cycle.
        cycles: of the whole run by `flaprig.Twin`.
        turns: of everything.
    """

    name: ClassVar[str] = "twin"
    claim: ClassVar[str] = "a MuJoCo step with each air, and the twin beside real time"

    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 3
    turns: int = 9

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        check.whole(self.name, "steps_per_cycle", self.steps_per_cycle, 4, STEPS)
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        check.whole(self.name, "turns", self.turns, 1, 1000)
        # the lattice's own numbers are checked there
        model = UVLM(self.chordwise, self.spanwise, self.steps_per_cycle)
        found = in_turn(self._works(model), self.turns, progress)
        return Outcome(tuple(self._rows(found)), notes=(NOTE,))

    def _works(self, model: UVLM) -> dict[str, Work]:
        from flaprig.benchmark.rigs import Driven, bare, wet
        from flaprig.rig import Rig
        from flaprig.twin import Twin

        light = {BARE: Driven.of(bare(STEPS)), QUASI: Driven.of(wet(QuasiSteady(), STEPS))}
        lattice = Driven.of(wet(model, STEPS))
        for rig in (*light.values(), lattice):
            # from here on the wake is as long as it gets
            rig.cycle()
        twin = Twin(Rig.load().with_(model=model))
        return {
            **{name: many(rig.cycle, LIGHT) for name, rig in light.items()},
            LATTICE: lattice.cycle,
            RUN: partial(twin.run, STROKE, self.cycles),
        }

    def _rows(self, found: dict[str, Array]) -> list[Row]:
        steps = {BARE: LIGHT * STEPS, QUASI: LIGHT * STEPS, LATTICE: STEPS}
        step = {name: found[name] / count for name, count in steps.items()}
        rows = [row(f"MuJoCo step, {name}", MICRO * s, "us") for name, s in step.items()]
        over = {name: step[name] / step[BARE] for name in (QUASI, LATTICE)}
        real, run = STROKE.period / found[LATTICE], self.cycles * STROKE.period / found[RUN]
        return [
            *rows,
            row(f"step, {QUASI} over {BARE}", over[QUASI], "x", at_most=STEP_AIM),
            row(f"step, {LATTICE} over {BARE}", over[LATTICE], "x"),
            row(f"steps, {LATTICE}, faster than real time", real, "x", at_least=REAL_TIME_AIM),
            row(f"{RUN}, {LATTICE}, faster than real time", run, "x", at_least=REAL_TIME_AIM),
        ]
