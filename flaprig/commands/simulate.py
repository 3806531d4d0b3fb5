"""`flaprig simulate`: a wing that follows a stroke exactly."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

from tyro.conf import arg

import flaprig
from flaprig.aero.models import UVLM
from flaprig.commands import options
from flaprig.commands.progress import progress
from flaprig.commands.rig_options import RigFile, rig_of, rig_summary
from flaprig.commands.run_output import (
    Case,
    tell,
    timed,
    write_forces,
    write_histories,
    write_wake,
)
from flaprig.report.folder import Folder


@dataclass(frozen=True)
class Simulate:
    """Loads on a wing that follows a stroke exactly.

    Prints mean coefficients with their spread from cycle to cycle. The defaults are the rig of the
    paper in water on its sinusoidal stroke.

    Attributes:
        rig: MJCF file of a rig: its wing, fluid, servos and model of the fluid count, but for what
            other options say.
        cycles: number of cycles; means are over the third to the last, at most three.
        json: print exactly one JSON object and nothing else.
        out: folder for histories.csv, histories.npz, summary.json, forces.png and wake.png.
    """

    stroke: options.StrokeOptions = field(default_factory=options.StrokeOptions)
    wing: options.WingOptions = field(default_factory=options.WingOptions)
    fluid: options.FluidOptions = field(default_factory=options.FluidOptions)
    model: options.ModelOptions = field(default_factory=options.ModelOptions)
    rig: RigFile = None
    cycles: int = 5
    json: bool = False
    out: Annotated[Path | None, arg(metavar="DIR", help_behavior_hint="(optional)")] = None


def run(args: Simulate, folder: Folder) -> None:
    """Simulate, write, tell.

    Raises:
        ValueError: bad input.
        ImportError: the plugin library is missing or does not fit MuJoCo.
        FloatingPointError: the loads are not finite.
        OSError: a file cannot be read or written.
    """
    asked = args.stroke.read()
    rig = rig_of(args.rig, asked.stroke, args.wing, args.fluid, args.model)
    case = Case.of(asked, rig, args.cycles)
    folder.create()
    with timed() as spent, progress("simulate") as told:
        result = flaprig.simulate(
            *(case.wing, case.stroke, case.model, case.fluid, case.cycles),
            progress=told,
            buoyancy=rig.buoyancy,
        )
    summary = {
        "command": "simulate",
        **rig_summary(rig),
        **case.summary(),
        **result.summary(),
        "notices": case.all_notices(*result.notices),
        **spent,
    }
    write_histories(folder, result.save, summary)
    if folder:
        write_forces(folder, case, result, case.title)
        if isinstance(case.model, UVLM):
            write_wake(folder, case)
    tell(args.json, case.title, summary, folder)
