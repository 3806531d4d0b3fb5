"""What `simulate` and `twin` leave of a run: files in the folder, JSON or a table on stdout."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console

from flaprig.aero.models import UVLM, AirModel
from flaprig.aero.result import Result
from flaprig.commands.progress import progress
from flaprig.fluid import Fluid
from flaprig.report import style
from flaprig.report.folder import Folder
from flaprig.report.forces import Curve, draw_forces
from flaprig.report.numbers import as_json
from flaprig.report.snapshots import snapshots
from flaprig.report.table import print_run
from flaprig.report.wake import draw_wake
from flaprig.strokes import Stroke
from flaprig.wing import Wing

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
    """

    wing: Wing
    stroke: Stroke
    model: AirModel
    fluid: Fluid
    cycles: int

    @property
    def title(self) -> str:
        """One line that says what is in a picture."""
        sweep, pitch = (np.degrees(a) for a in self._amplitudes)
        motion = f"f = {self.stroke.frequency:.4g} Hz, sweep ±{sweep:.4g}°, pitch ±{pitch:.4g}°"
        return f"{self.model.label}, {motion}"

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
        }


@contextmanager
def timed() -> Iterator[dict[str, float]]:
    """Fills `wall_time_s` of the dictionary when the block is done."""
    start, spent = time.perf_counter(), {"wall_time_s": 0.0}
    yield spent
    spent["wall_time_s"] = round(time.perf_counter() - start, 3)


def write_pictures(folder: Folder, case: Case, result: Result) -> None:
    """forces.png, and wake.png where the model has a wake."""
    if not folder:
        return
    curve = Curve(case.model.label, result, style.VERMILION)
    folder.write("forces.png", lambda draft: draw_forces(draft, [curve], case.title))
    if isinstance(case.model, UVLM):
        write_wake(folder, case)


def write_wake(folder: Folder, case: Case) -> None:
    """wake.png: a run of its own to an instant of the third cycle."""
    assert isinstance(case.model, UVLM)
    instants = np.array([WAKE_INSTANT])
    with progress("wake") as told:
        shot = next(snapshots(case.wing, case.stroke, case.model, instants, case.fluid, told))
    title = f"Wing and wake at t/T = {WAKE_INSTANT}, rings coloured by circulation"
    amplitude = case.stroke.sweep_amplitude
    folder.write("wake.png", lambda draft: draw_wake(draft, shot, amplitude, title))


def tell(as_object: bool, title: str, summary: dict[str, Any], folder: Folder) -> None:
    """Complete summary.json; print one JSON object and nothing else, or a table and the files."""
    summary = folder.write_summary(summary)
    if as_object:
        print(as_json(summary))
        return
    console = Console()
    print_run(console, title, summary)
    if folder:
        console.print(folder.sentences(), highlight=False, markup=False)
