"""`flaprig check`: can the rig do this stroke, by what margin, and how far can it be scaled?"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from rich.console import Console
from tyro.conf import arg

from flaprig import _checks as check
from flaprig.commands import options
from flaprig.commands.progress import progress
from flaprig.commands.rig_options import RigFile, rig_of, rig_summary
from flaprig.commands.run_output import Case, timed
from flaprig.report.folder import Folder
from flaprig.report.numbers import as_json
from flaprig.report.table import print_notices
from flaprig.report.torque_speed import draw_torque_speed
from flaprig.report.verdicts import print_scale, print_verdicts

if TYPE_CHECKING:
    from flaprig.feasibility import FeasibilityReport
    from flaprig.limits import Limits
    from flaprig.motors import Motors
    from flaprig.rig import Rig
    from flaprig.scaling import FrequencyRange
    from flaprig.servo_choice import ServoChoice
    from flaprig.strokes import Stroke

# exit codes
FEASIBLE, INFEASIBLE = 0, 1


@dataclass(frozen=True)
class Check:
    """Can the rig do this stroke, and by what margin?

    Runs the stroke in the digital twin and judges torque, speed, current, heat, motion, tracking
    and the change of lift. Exit status: 0 feasible, 1 infeasible, 2 bad input, 3 the run failed.

    Attributes:
        rig: MJCF file of a rig: its wing, fluid, servos and model of the fluid count, but for what
            other options say.
        limits: the servos' own, or with the accelerations that the paper's kinematics reach.
        no_feedforward: do not tell the servos the torque that the motion needs.
        rms_tracking: allowed root mean square of angle reached minus angle asked for [degrees].
        peak_tracking: largest allowed size of it [degrees].
        cycles: number of cycles, at least 2; verdicts are on the third to the last, at most three.
        time_step: of MuJoCo [s].
        scale: also find the highest frequency and the smallest servo that hold (a minute).
        json: print exactly one JSON object and nothing else.
        out: folder for report.csv, summary.json and torque_speed.png, and, where the stroke is
            beyond the limits, nearest.csv.
    """

    stroke: options.StrokeOptions = field(default_factory=options.StrokeOptions)
    wing: options.WingOptions = field(default_factory=options.WingOptions)
    fluid: options.FluidOptions = field(default_factory=options.FluidOptions)
    model: options.ModelOptions = field(default_factory=options.ModelOptions)
    rig: RigFile = None
    limits: Literal["servo", "paper"] = "servo"
    no_feedforward: bool = False
    rms_tracking: float = 1.0
    peak_tracking: float = 3.0
    cycles: int = 3
    time_step: float = 0.002
    scale: bool = False
    json: bool = False
    out: Annotated[Path | None, arg(metavar="DIR", help_behavior_hint="(optional)")] = None


def run(args: Check, folder: Folder) -> int:
    """Judge, write, tell; the exit code.

    Raises:
        ValueError: bad input.
        FloatingPointError: MuJoCo or the wake gave up.
        ImportError: the plugin library is missing or does not fit MuJoCo.
        OSError: a file cannot be read or written.
    """
    asked = args.stroke.read()
    rig = rig_of(args.rig, asked.stroke, args.wing, args.fluid, args.model)
    case = Case.of(asked, rig, args.cycles)
    settings = _settings(args)
    folder.create()
    with timed() as spent:
        report = _judged(args, rig, case.stroke, settings)
        scaled = _scaled(args, rig, case.stroke, settings) if args.scale else None
    notices = case.all_notices(*report.notices)
    summary = {
        "command": "check",
        **rig_summary(rig),
        **case.summary(),
        **report.summary(),
        "notices": notices,
    }
    if scaled:
        summary |= {"scale": scaled[0].summary() | scaled[1].summary()}
    summary |= spent
    _write(folder, case, report, summary)
    summary = folder.write_summary(summary)
    if args.json:
        print(as_json(summary))
    else:
        _tell(case, report, scaled, folder, notices)
    return FEASIBLE if report.feasible else INFEASIBLE


def _settings(args: Check) -> dict[str, Any]:
    """What every judgement shares."""
    from flaprig.feasibility import Tolerances

    for name in ("rms_tracking", "peak_tracking"):
        flag = "--" + name.replace("_", "-")
        check.positive("check", flag, getattr(args, name), "degrees", most=180.0)
    tolerances = Tolerances(
        rms_tracking=math.radians(args.rms_tracking), peak_tracking=math.radians(args.peak_tracking)
    )
    return {
        "cycles": args.cycles,
        "tolerances": tolerances,
        "time_step": args.time_step,
        "feedforward": not args.no_feedforward,
    }


def _judged(args: Check, rig: Rig, stroke: Stroke, settings: dict[str, Any]) -> FeasibilityReport:
    from flaprig.feasibility import check_feasibility

    limits = _limits(args, rig, rig.motors)
    with progress("check") as told:
        return check_feasibility(rig, stroke, limits=limits, progress=told, **settings)


def _scaled(
    args: Check, rig: Rig, stroke: Stroke, settings: dict[str, Any]
) -> tuple[FrequencyRange, ServoChoice]:
    from flaprig.scaling import highest_frequency
    from flaprig.servo_choice import smallest_servo

    limits = _limits(args, rig, rig.motors)
    with progress("frequencies") as told:
        found = highest_frequency(rig, stroke, limits, told, **settings)
    with progress("servos") as told:
        choice = smallest_servo(
            rig, stroke, lambda motors: _limits(args, rig, motors), told, **settings
        )
    return found, choice


def _limits(args: Check, rig: Rig, motors: Motors) -> Limits | None:
    """None: the rig's own."""
    from flaprig.limits import PAPER_KINEMATICS
    from flaprig.set_points import own_limits

    if args.limits == "servo":
        return None
    own = own_limits(rig.with_(motors=motors), rig.spec().compile())
    return own.with_accelerations(PAPER_KINEMATICS)


def _write(folder: Folder, case: Case, report: FeasibilityReport, summary: dict[str, Any]) -> None:
    if not folder:
        return
    folder.write("report.csv", report.save)
    folder.write_summary(summary)
    if report.projection.changed:
        folder.write("nearest.csv", report.projection.stroke.save)
    title = f"Torque and speed of the servos, {_title(case, report)}"
    folder.write("torque_speed.png", lambda draft: draw_torque_speed(draft, report, title))


def _title(case: Case, report: FeasibilityReport) -> str:
    """What was flown, and what was asked for."""
    flown = report.run.flown_amplitude
    return case.title_of(flown("sweep"), flown("pitch"))


def _tell(
    case: Case,
    report: FeasibilityReport,
    scaled: tuple[FrequencyRange, ServoChoice] | None,
    folder: Folder,
    notices: list[str],
) -> None:
    console = Console()
    print_verdicts(console, f"check, {_title(case, report)}", report)
    print_notices(console, notices)
    if scaled:
        print_scale(console, *scaled)
    if folder:
        console.print(folder.sentences(), highlight=False, markup=False)
