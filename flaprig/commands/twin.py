"""`flaprig twin`: the motors of the rig follow a stroke, and the fluid answers."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from tyro.conf import arg

from flaprig.aero.models import UVLM
from flaprig.commands import options
from flaprig.commands.progress import progress
from flaprig.commands.rig_options import RigFile, rig_of, rig_summary
from flaprig.commands.run_output import (
    WAKE_INSTANT,
    Case,
    draw_wake_of,
    tell,
    timed,
    write_forces,
    write_histories,
)
from flaprig.commands.servo_options import ServoOptions
from flaprig.report.folder import Folder
from flaprig.report.motors import draw_motors

if TYPE_CHECKING:
    from flaprig.aero.air import Progress
    from flaprig.rig import Rig
    from flaprig.twin import Twin as Machine
    from flaprig.twin import TwinRun


@dataclass(frozen=True)
class Twin:
    """The rig in MuJoCo: its servos follow a stroke in the fluid.

    Prints mean coefficients of the motion really made, with their spread from cycle to cycle.

    Attributes:
        rig: MJCF file of a rig: its wing, fluid, servos and model of the fluid count, but for what
            other options say.
        cycles: number of cycles; means are over the third to the last, at most three.
        time_step: of MuJoCo [s].
        json: print exactly one JSON object and nothing else.
        out: folder for histories.csv, histories.npz, summary.json, motors.png, forces.png and
            wake.png.
    """

    stroke: options.StrokeOptions = field(default_factory=options.StrokeOptions)
    wing: options.WingOptions = field(default_factory=options.WingOptions)
    fluid: options.FluidOptions = field(default_factory=options.FluidOptions)
    model: options.ModelOptions = field(default_factory=options.ModelOptions)
    servo: ServoOptions = field(default_factory=ServoOptions)
    rig: RigFile = None
    cycles: int = 3
    time_step: float = 0.002
    json: bool = False
    out: Annotated[Path | None, arg(metavar="DIR", help_behavior_hint="(optional)")] = None


def run(args: Twin, folder: Folder) -> None:
    """Run the rig, write, tell.

    Raises:
        ValueError: bad input.
        ImportError: the plugin library is missing or does not fit MuJoCo.
        OSError: a file cannot be read or written.
    """
    asked = args.stroke.read()
    rig = rig_of(args.rig, asked.stroke, args.wing, args.fluid, args.model)
    case = Case.of(asked, rig, args.cycles)
    folder.create()
    with timed() as spent, progress("twin") as told:
        done = fly(rig, case, args.time_step, told, args.servo)
    summary = {
        "command": "twin",
        **rig_summary(rig),
        **case.summary(),
        **done.summary(),
        "notices": case.all_notices(*done.notices),
        **spent,
    }
    title = f"twin, {flown_title(case, done)}"
    write_histories(folder, done.save, summary)
    if folder:
        write_motors(folder, done, case)
        write_forces(folder, case, done.result, title)
        if isinstance(case.model, UVLM):
            write_flown_wake(folder, case, args.servo.twin(rig, args.time_step))
    tell(args.json, title, summary, folder)


def flown_title(case: Case, done: TwinRun) -> str:
    """One line that says what was flown, and what was asked for."""
    return case.title_of(done.flown_amplitude("sweep"), done.flown_amplitude("pitch"))


def fly(
    rig: Rig,
    case: Case,
    time_step: float,
    told: Progress | None,
    servo: ServoOptions | None = None,
) -> TwinRun:
    """The rig's run of a case."""
    machine = (servo or ServoOptions()).twin(rig, time_step)
    return machine.run(case.stroke, case.cycles, told)


def write_motors(folder: Folder, done: TwinRun, case: Case) -> None:
    """motors.png, with the stroke asked for in grey."""
    title = f"Servos, {flown_title(case, done)}"
    folder.write("motors.png", lambda draft: draw_motors(draft, done.motors, case.stroke, title))


def write_flown_wake(folder: Folder, case: Case, machine: Machine) -> None:
    """wake.png: the twin's own wake, from the plugin's state in the third cycle."""
    from flaprig.report.flown import flown_snapshot

    with progress("wake"):
        shot, amplitudes = flown_snapshot(machine, case.stroke, WAKE_INSTANT)
    draw_wake_of(folder, shot, amplitudes[0], f"twin, {case.title_of(*amplitudes)}")
