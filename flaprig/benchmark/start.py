"""What a process pays before and beside its work: the import, and memory."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.benchmark import fresh
from flaprig.benchmark.outcome import Outcome, row
from flaprig.benchmark.turns import in_turn

# what the project aims at [s], [MB]
IMPORT_AIM, MEMORY_AIM = 0.3, 150.0
# what flaprig leaves alone until it is asked for
LATE = ("mujoco", "matplotlib", "gymnasium", "dm_control", "numba", "torch")
LOADED = f"import sys, flaprig; print(*[m for m in {LATE!r} if m in sys.modules])"
IMPORT = "import flaprig"
# the rig case: the numbers of its lattice, and of its cycles, are filled in
CASE = """
import math, flaprig
model = flaprig.UVLM({grid}, suction_efficiency=0.0, wake_cycles={cycles}, wake_fade=0.0{more})
stroke = flaprig.SunTangStroke(0.2, math.pi / 3, math.pi / 4)
flaprig.simulate(flaprig.RIG_WING, stroke, model, cycles={cycles})
"""


@dataclass(frozen=True)
class Start:
    """Fresh processes: the time that `import flaprig` takes, and the rig case's peak memory.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: steps in a cycle of the rig case, whose whole wake is kept.
        cycles: of the rig case.
        turns: of the import, each beside a process that does nothing.
    """

    name: ClassVar[str] = "start"
    claim: ClassVar[str] = "time of the import and peak memory, in fresh processes"

    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 3
    turns: int = 9

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        for name, most in (("chordwise", 64), ("spanwise", 128), ("steps_per_cycle", 1000)):
            check.whole(self.name, name, getattr(self, name), 1, most)
        check.whole(self.name, "cycles", self.cycles, 1, 20)
        check.whole(self.name, "turns", self.turns, 1, 1000)
        # the files come into the system's memory
        loaded = fresh.said(LOADED) or "none of them"
        works = {code: partial(fresh.said, code) for code in ("pass", IMPORT)}
        found = in_turn(works, self.turns, progress)
        command = f"python -c '{IMPORT}', less python -c pass"
        case = "peak memory of the rig case"
        rows = (
            row(IMPORT, found[IMPORT] - found["pass"], "s", at_most=IMPORT_AIM, command=command),
            row(f"peak memory, {IMPORT}", fresh.peak_memory(IMPORT), "MB"),
            row(f"{case}, default dial", self._memory(""), "MB", at_most=MEMORY_AIM),
            row(f"{case}, brute force", self._memory(", wake_detail=0"), "MB", at_most=MEMORY_AIM),
        )
        note = f"The import loads, of {', '.join(LATE)}: {loaded}; nothing is compiled at run time."
        return Outcome(rows, notes=(note,))

    def _memory(self, more: str) -> float:
        """Peak memory [MB] of a process that runs the rig case."""
        grid = f"{self.chordwise}, {self.spanwise}, {self.steps_per_cycle}"
        return fresh.peak_memory(CASE.format(grid=grid, cycles=self.cycles, more=more))
