"""What `simulate` and `twin` leave of a run: files in the folder, JSON or a table on stdout."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from rich.console import Console

from flaprig.aero.models import UVLM, AirModel
from flaprig.aero.result import Result
from flaprig.commands.progress import progress
from flaprig.commands.stroke_options import AskedStroke
from flaprig.fluid import Fluid
from flaprig.report import style
from flaprig.report.folder import Folder
from flaprig.report.forces import Curve, draw_forces
from flaprig.report.numbers import as_json
from flaprig.report.snapshots import Snapshot, snapshots
from flaprig.report.table import print_notices, print_run
from flaprig.report.wake import draw_wake
from flaprig.strokes import Stroke
from flaprig.wing import Wing

if TYPE_CHECKING:
    from flaprig.rig import Rig

# amplitudes are the same within this share, and within this angle [rad]
SAME, SAME_ANGLE = 0.005, 2.0 * np.pi / 4096.0
# the instant of the wake's picture [cycles]: late in the first half of the third cycle, when the
# wing stands free of what it shed before
WAKE_INSTANT = 2.33


def write_histories(
    folder: Folder, save: Callable[[Path], object], summary: dict[str, Any]
) -> None:
    """histories.csv, histories.npz and summary.json."""
    folder.write("histories.csv", save)
    folder.write("histories.npz", save)
    folder.write_summary(summary)


@dataclass(frozen=True)
class Case:
    """What is being run.

    Attributes:
        wing: the wing.
        stroke: the stroke.
        model: the model of the fluid.
        fluid: the fluid.
        cycles: number of cycles.
        notices: what the files of rig and stroke made doubtful.
        numbers: what a log was, for the summary.
    """

    wing: Wing
    stroke: Stroke
    model: AirModel
    fluid: Fluid
    cycles: int
    notices: tuple[str, ...] = ()
    numbers: dict[str, Any] = field(default_factory=dict)

    @classmethod
    def of(cls, asked: AskedStroke, rig: Rig, cycles: int) -> Case:
        """The case of a stroke on a rig, with what both files made doubtful."""
        notices = (*rig.notices, *asked.notices)
        return cls(rig.wing, asked.stroke, rig.model, rig.fluid, cycles, notices, asked.numbers)

    @property
    def title(self) -> str:
        """One line that says what is in a picture of the motion asked for."""
        return self.title_of(*self._amplitudes)

    def title_of(self, sweep: float, pitch: float) -> str:
        """One line that says what was flown, and what was asked for where that is another motion.

        Args:
            sweep: half of the peak-to-peak sweep that was flown in [rad].
            pitch: the same of the pitch.
        """
        flown = [
            f"{name} ±{np.degrees(made):.4g}°" + _asked_beside(made, asked)
            for name, made, asked in zip(
                ("sweep", "pitch"), (sweep, pitch), self._amplitudes, strict=True
            )
        ]
        return f"{self.model.label}, f = {self.stroke.frequency:.4g} Hz, {', '.join(flown)}"

    def all_notices(self, *more: str) -> list[str]:
        """Notices of the stroke's file and of the run, each once."""
        return list(dict.fromkeys([*self.notices, *more]))

    @property
    def _amplitudes(self) -> tuple[float, float]:
        return self.stroke.sweep_amplitude, self.stroke.pitch_amplitude

    def summary(self) -> dict[str, Any]:
        """What identifies the run in a summary, SI units and radians."""
        sweep, pitch = self._amplitudes
        return {
            "model": self.model.label,
            "cycles": self.cycles,
            "steps_per_cycle": self.model.steps_per_cycle,
            "frequency_Hz": self.stroke.frequency,
            "sweep_amplitude_rad": sweep,
            "pitch_amplitude_rad": pitch,
            **self.numbers,
        }


def _asked_beside(made: float, asked: float) -> str:
    """The amplitude asked for, in brackets, where another one was flown; both in [rad]."""
    same = abs(made - asked) <= max(SAME * asked, SAME_ANGLE)
    return "" if same else f" (asked ±{np.degrees(asked):.4g}°)"


@contextmanager
def timed() -> Iterator[dict[str, float]]:
    """Fills `wall_time_s` of the dictionary when the block is done."""
    start, spent = time.perf_counter(), {"wall_time_s": 0.0}
    yield spent
    spent["wall_time_s"] = round(time.perf_counter() - start, 3)


def write_forces(folder: Folder, case: Case, result: Result, title: str) -> None:
    """forces.png, with the stroke asked for in grey behind the angles."""
    curve = Curve(case.model.label, result, style.VERMILION)
    folder.write("forces.png", lambda draft: draw_forces(draft, [curve], title, case.stroke))


def write_wake(folder: Folder, case: Case) -> None:
    """wake.png of the prescribed motion: a run of its own to an instant of the third cycle."""
    assert isinstance(case.model, UVLM)
    instants = np.array([WAKE_INSTANT])
    with progress("wake") as told:
        shot = next(snapshots(case.wing, case.stroke, case.model, instants, case.fluid, told))
    draw_wake_of(folder, shot, case.stroke.sweep_amplitude, f"prescribed, {case.title}")


def draw_wake_of(folder: Folder, shot: Snapshot, sweep_amplitude: float, words: str) -> None:
    """wake.png of a snapshot, with words on the motion that made it."""
    title = f"Wing and wake at t/T = {WAKE_INSTANT:g}, rings coloured by circulation\n{words}"
    folder.write("wake.png", lambda draft: draw_wake(draft, shot, sweep_amplitude, title))


def tell(as_object: bool, title: str, summary: dict[str, Any], folder: Folder) -> None:
    """Complete summary.json; print one JSON object and nothing else, or a table and the files."""
    summary = folder.write_summary(summary)
    if as_object:
        print(as_json(summary))
        return
    console = Console()
    print_run(console, title, summary)
    print_notices(console, summary["notices"])
    if folder:
        console.print(folder.sentences(), highlight=False, markup=False)
