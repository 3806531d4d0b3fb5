"""Where the time goes: roll-up, wing solve, loads, MuJoCo and Python, for three uses of the air."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from flaprig import _checks as check
from flaprig.aero.air import Progress
from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.benchmark.batch import pitches
from flaprig.benchmark.benchmark import STROKE, cores
from flaprig.benchmark.outcome import Outcome, row
from flaprig.benchmark.turns import Work, many, repeated, seconds
from flaprig.native import _native
from flaprig.report import style
from flaprig.wing import RIG_WING

# MuJoCo steps in a cycle: the twin's usual 2 ms
STEPS = 2500
# clocks of the native air, by what they measure
CLOCKS = {"roll-up": "roll_up", "wing solve": "wing", "loads": "loads"}
COUPLING, MUJOCO, REST = "coupling", "MuJoCo", "Python and the rest"
PARTS = (*CLOCKS, COUPLING, MUJOCO, REST)
NOTE = (
    "Shares of the wall time, in the batch of all its threads. Roll-up: the wake moves itself. "
    "Wing solve: the wake's velocities at the wing, and the circulation there. Coupling: the "
    "plugin's own work, added mass, Jacobians, sensors and the copies of the wake. MuJoCo: as many "
    "steps of the bare rig. The rest: Python, copies at its border, and threads that wait."
)


@dataclass(frozen=True)
class Shares:
    """Shares of the time in the paper's window, the twin and a batch of strokes.

    Attributes:
        chordwise: panels along the chord.
        spanwise: panels along the span.
        steps_per_cycle: wake steps in a cycle.
        cycles: of the paper's window.
        twin_cycles: of `flaprig.Twin`.
        strokes: of `flaprig.simulate_batch`, two cycles each, on all cores.
        turns: of everything.
    """

    name: ClassVar[str] = "shares"
    claim: ClassVar[str] = "where the time goes"

    chordwise: int = 6
    spanwise: int = 12
    steps_per_cycle: int = 100
    cycles: int = 5
    twin_cycles: int = 2
    strokes: int = 16
    turns: int = 3

    def run(self, progress: Progress | None = None) -> Outcome:
        """Measure. ValueError for a parameter out of range."""
        check.whole(self.name, "steps_per_cycle", self.steps_per_cycle, 4, STEPS)
        check.whole(self.name, "cycles", self.cycles, 1, 100)
        check.whole(self.name, "twin_cycles", self.twin_cycles, 1, 100)
        check.whole(self.name, "strokes", self.strokes, 1, 10_000)
        check.whole(self.name, "turns", self.turns, 1, 1000)
        tell = {"window": self._window, "twin": self._twin, "batch": self._batch}
        found = repeated(
            lambda: {(case, part): x for case, of in tell.items() for part, x in of().items()},
            self.turns,
            progress,
        )
        rows = [row(f"{case}, {part}", values, "%") for (case, part), values in found.items()]
        medians = {key: float(np.median(values)) for key, values in found.items()}
        return Outcome(tuple(rows), {}, lambda path: _draw(path, medians), (NOTE,))

    @property
    def model(self) -> UVLM:
        """The air."""
        return UVLM(self.chordwise, self.spanwise, self.steps_per_cycle)

    def _window(self) -> dict[str, float]:
        work = partial(simulate, RIG_WING, STROKE, self.model, cycles=self.cycles)
        wall, spent = clocked(work)
        return _shares(wall, spent)

    def _batch(self) -> dict[str, float]:
        listed = pitches(self.strokes)
        wall, spent = clocked(partial(simulate_batch, RIG_WING, listed, self.model, cycles=2))
        # the clocks add up what each thread spends
        return _shares(cores() * wall, spent)

    def _twin(self) -> dict[str, float]:
        from flaprig.benchmark.rigs import Driven, bare
        from flaprig.native import plugin_clocks
        from flaprig.rig import Rig
        from flaprig.twin import Twin

        cycles = self.twin_cycles
        twin, dry = Twin(Rig.load().with_(model=self.model)), Driven.of(bare(STEPS))
        mujoco = seconds(many(dry.cycle, cycles))
        wall, spent = clocked(partial(twin.run, STROKE, cycles), plugin_clocks)
        own = plugin_clocks.clocks()["plugin"] - sum(spent.values())
        return _shares(wall, spent | {COUPLING: own, MUJOCO: mujoco})


def clocked(work: Work, of: Any = _native) -> tuple[float, dict[str, float]]:
    """Wall time of the work [s], and what the clocks of the air say, by part [s].

    Args:
        work: what is done.
        of: whose clocks: the module's, or the plugin's.
    """
    of.reset_clocks()
    wall = seconds(work)
    clocks = of.clocks()
    return wall, {part: clocks[key] for part, key in CLOCKS.items()}


def _shares(wall: float, spent: dict[str, float]) -> dict[str, float]:
    """Percent by part, the rest included."""
    whole = spent | {REST: wall - sum(spent.values())}
    return {part: 100.0 * taken / wall for part, taken in whole.items()}


def _draw(path: Path, medians: dict[tuple[str, str], float]) -> None:
    """One bar a case, its parts side by side."""
    cases = list(dict.fromkeys(case for case, _ in medians))
    colours = (style.VERMILION, style.BLUE, style.SKY, style.PURPLE, style.GREEN, style.PALE)
    with style.figure(6.2, 2.8) as drawing:
        axes, start = drawing.subplots(), np.zeros(len(cases))
        for part, colour in zip(PARTS, colours, strict=True):
            width = np.array([medians.get((case, part), 0.0) for case in cases])
            axes.barh(cases, width, left=start, color=colour, label=part)
            start += width
        axes.set(xlabel="share of the time [%]", xlim=(0.0, 100.0), title="Where the time goes")
        axes.invert_yaxis()
        axes.grid(axis="y", visible=False)
        axes.set_axisbelow(True)
        axes.legend(loc="upper center", bbox_to_anchor=(0.45, -0.28), ncols=3, fontsize=8)
        style.save(drawing, path)
