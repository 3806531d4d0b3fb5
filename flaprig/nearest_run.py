"""The twin's run of the stroke nearest to the one asked for."""

from __future__ import annotations

import math
from dataclasses import replace

from flaprig.aero.air import Progress
from flaprig.aero.simulate import reference_force
from flaprig.limits import Projection
from flaprig.strokes.stroke import Stroke
from flaprig.twin import Twin
from flaprig.twin_run import TwinRun


def nearest_run(
    twin: Twin, stroke: Stroke, projection: Projection, cycles: int, progress: Progress | None
) -> TwinRun:
    """The twin on the stroke, or on the nearest one within its limits."""
    try:
        run = twin.run(stroke, cycles, progress)
        started = math.ceil(run.joined_at * stroke.frequency)
        if started >= run.result.averaged_cycles[0]:
            # means are over the last three at most
            run = twin.run(stroke, started + 3, progress)
        return run
    except RuntimeError:
        # no start from rest leads onto a stroke without room: begin at full rate
        run = replace(twin, limits=None).run(projection.stroke, cycles, progress)
    force = reference_force(twin.rig.wing, stroke, twin.rig.fluid)
    result = replace(run.result, reference_force=force, notices=()).doubted(stroke)
    return replace(run, result=result, projection=projection, asked=stroke)
