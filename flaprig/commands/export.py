"""`flaprig export`: set points of a stroke for the real rig, within the servos' limits."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
from rich.console import Console
from tyro.conf import arg

from flaprig.aero.models import QuasiSteady
from flaprig.commands import options
from flaprig.commands.rig_options import RigFile, rig_of, rig_summary
from flaprig.commands.run_output import Case
from flaprig.report.folder import Folder
from flaprig.report.numbers import as_json
from flaprig.report.table import print_notices

if TYPE_CHECKING:
    from flaprig.limits import Projection

# exit codes
WRITTEN, NOT_WRITTEN = 0, 1


@dataclass(frozen=True)
class Export:
    """Set points for the real rig: from rest, within the servos' limits, along a stroke, to a stop.

    Leaves trajectory.csv (angles, rates, accelerations and the torque that quasi-steady fluid
    asks for) and counts.csv (the servos' position counts), one row a control interval. A stroke
    that the servos cannot follow is not written: exit status 1.

    Attributes:
        rig: MJCF file of a rig: its wing, fluid and servos count, but for what other options say.
        cycles: that are followed between start and stop.
        interval: of the servos' control [s].
        allow_nearest: write the nearest stroke within the limits, where the one asked for is beyond
            them.
        json: print exactly one JSON object and nothing else.
        out: folder for the two files.
    """

    stroke: options.StrokeOptions = field(default_factory=options.StrokeOptions)
    wing: options.WingOptions = field(default_factory=options.WingOptions)
    fluid: options.FluidOptions = field(default_factory=options.FluidOptions)
    rig: RigFile = None
    cycles: int = 5
    interval: float = 0.01
    allow_nearest: bool = False
    json: bool = False
    out: Annotated[Path, arg(metavar="DIR")] = Path("export")


def run(args: Export, folder: Folder) -> int:
    """Project, filter, write, tell; the exit code.

    Raises:
        ValueError: bad input.
        RuntimeError: no way onto the stroke was found.
        OSError: a file cannot be read or written.
    """
    from flaprig.feedforward import needed_torques
    from flaprig.limits import filtered, project
    from flaprig.limits.projection import TOLD
    from flaprig.logs import XM430_RIG
    from flaprig.set_points import own_limits

    asked = args.stroke.read()
    rig = rig_of(args.rig, asked.stroke, args.wing, args.fluid, QuasiSteady())
    case = Case.of(asked, rig, args.cycles)
    limits = own_limits(rig, rig.compile())
    nearest = project(case.stroke, limits)
    if nearest.distance_max > TOLD and not args.allow_nearest:
        return _refused(args, case, nearest)
    played = filtered(case.stroke, limits, args.cycles, args.interval)
    torque = needed_torques(rig, played.motion)
    # a row a set point: the last one stands still
    torque = np.vstack([torque, torque[-1:]])
    folder.create()
    folder.write("trajectory.csv", lambda draft: played.save(draft, torque))
    folder.write("counts.csv", lambda draft: XM430_RIG.save(draft, played.motion))
    notices = case.all_notices(*played.notices)
    summary = {
        "command": "export",
        **rig_summary(rig),
        "interval_s": played.interval,
        "set_points": len(played.motion.time),
        "joined_at_s": played.joined_at,
        "left_at_s": played.left_at,
        "projection_rms_rad": played.projection.distance_rms,
        "peak_sweep_torque_Nm": float(np.abs(torque[:, 0]).max()),
        "peak_pitch_torque_Nm": float(np.abs(torque[:, 1]).max()),
        "written": True,
        "notices": notices,
    }
    if args.json:
        print(as_json(summary))
        return WRITTEN
    for name in ("trajectory.csv", "counts.csv"):
        print(folder.path / name if folder.path else name)
    print_notices(Console(), notices)
    return WRITTEN


def _refused(args: Export, case: Case, nearest: Projection) -> int:
    """Say why nothing is written."""
    notices = case.all_notices(
        *nearest.notices,
        "nothing was written: the servos cannot follow this stroke (--allow-nearest writes the "
        "nearest one within their limits)",
    )
    if args.json:
        summary = {
            "command": "export",
            **case.summary(),
            "projection_rms_rad": nearest.distance_rms,
            "written": False,
            "notices": notices,
        }
        print(as_json(summary))
    else:
        print_notices(Console(stderr=True), notices)
    return NOT_WRITTEN
