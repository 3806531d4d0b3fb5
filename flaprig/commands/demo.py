"""`flaprig demo`: the paper's sinusoidal case by both models, prescribed and in the twin."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from rich.console import Console
from tyro.conf import arg

import flaprig
from flaprig.aero.models import UVLM, AirModel, QuasiSteady
from flaprig.aero.result import Result
from flaprig.commands.options import StrokeOptions
from flaprig.commands.progress import progress
from flaprig.commands.run_output import Case, timed, write_wake
from flaprig.commands.twin import fly, write_motors
from flaprig.report import style
from flaprig.report.folder import Folder
from flaprig.report.forces import Curve, draw_forces
from flaprig.report.table import (
    averaging,
    difference,
    named_notices,
    print_comparison,
    print_notices,
)

# measured in the paper on this stroke: mean C_L and L/D (table 1, sinusoidal row)
PUBLISHED = {"cl": 1.94, "lift_to_drag": 0.74}
# cycles of each run: means over the third to the fifth, as in the paper
CYCLES = 5
# the models, the one with a wake first
MODELS: tuple[UVLM, QuasiSteady] = (UVLM(), QuasiSteady())
# MuJoCo's step in the twin [s]
TIME_STEP = 0.002
# the cycle that is filmed, counted from still water
FILMED = (2.0, 3.0)
# lines of the picture: colour by model, dashes in the twin
COLOURS = {"UVLM": style.VERMILION, "quasi-steady": style.BLUE}
LINES = {"prescribed": "-", "twin": "--"}


@dataclass(frozen=True)
class Demo:
    """The paper's sinusoidal stroke by both models, prescribed and in the twin.

    Prints one table beside the measured values, and leaves pictures and a video.

    Attributes:
        out: folder for forces.png, wake.png, motors.png, summary.json and the video.
        cycles: cycles of each run; means are over the third to the last, at most three.
    """

    out: Annotated[Path, arg(metavar="DIR")] = field(default_factory=lambda: Path("demo_output"))
    cycles: int = CYCLES


def run(args: Demo, folder: Folder) -> None:
    """Run the four cases, print the table, write the files.

    Raises:
        ImportError: the plugin library is missing or does not fit MuJoCo.
        OSError: a file cannot be written.
        ValueError: the folder is a file, or the number of cycles is out of range.
    """
    folder.create()
    console = Console()
    with timed() as spent:
        results, summaries = _run_all(args.cycles, folder)
    summary: dict[str, Any] = {
        "command": "demo",
        "published": PUBLISHED,
        "runs": summaries,
        "difference_percent": _differences(summaries),
        "notices": named_notices(summaries),
        **spent,
    }
    folder.write_summary(summary)
    title = "The rig's sinusoidal stroke in water: 0.2 Hz, sweep ±60°, pitch ±45°"
    print_comparison(console, title, summaries, PUBLISHED, "paper, measured")
    console.print(
        f"{averaging(summaries['UVLM, prescribed'])} Differences are from the paper. "
        "The UVLM's suction is calibrated on this C_L: it is no prediction."
    )
    print_notices(console, summary["notices"])
    curves = [Curve(name, result, *_look(name)) for name, result in results.items()]
    folder.write("forces.png", lambda draft: draw_forces(draft, curves, title))
    write_wake(folder, _case(MODELS[0], args.cycles))
    words = _film(folder)
    folder.write_summary(summary)
    for path in folder.written:
        console.print(str(path), highlight=False, markup=False, soft_wrap=True)
    console.print(words, highlight=False, markup=False)


def _case(model: AirModel, cycles: int) -> Case:
    return Case(flaprig.RIG_WING, StrokeOptions().build(), model, flaprig.WATER, cycles)


def _run_all(cycles: int, folder: Folder) -> tuple[dict[str, Result], dict[str, dict[str, Any]]]:
    """Results and summaries by name, both models, prescribed and in the twin."""
    # mujoco takes half a second to import: not for --help
    from flaprig.rig import Rig

    results: dict[str, Result] = {}
    summaries: dict[str, dict[str, Any]] = {}
    for model in MODELS:
        case, name = _case(model, cycles), model.label
        rig = Rig.load().with_(model=model)
        with progress(f"{name}, prescribed") as told:
            result = flaprig.simulate(
                *(case.wing, case.stroke, model, case.fluid, cycles),
                progress=told,
                buoyancy=rig.buoyancy,
            )
        with progress(f"{name}, twin") as told:
            done = fly(rig, case, TIME_STEP, told)
        results |= {f"{name}, prescribed": result, f"{name}, twin": done.result}
        summaries |= {f"{name}, prescribed": result.summary(), f"{name}, twin": done.summary()}
        if isinstance(model, UVLM):
            write_motors(folder, done, case)
    return results, summaries


def _differences(summaries: dict[str, dict[str, Any]]) -> dict[str, dict[str, float]]:
    return {
        name: {key: difference(summary[key], value) for key, value in PUBLISHED.items()}
        for name, summary in summaries.items()
    }


def _look(name: str) -> tuple[str, str]:
    """Colour and line of a run."""
    model, motion = name.split(", ")
    return COLOURS[model], LINES[motion]


def _film(folder: Folder) -> str:
    """Write the video; say how it was made."""
    from flaprig.commands.rig_film import film_rig
    from flaprig.report.film import Format
    from flaprig.rig import Rig

    stroke = StrokeOptions().build()
    done = film_rig(folder, "flapping", Rig.load(), stroke, FILMED, Format())
    return f"The video was {done.words}."
