"""Make a stroke feasible, run it in the twin, and save what a real rig would play.

Stroke -> nearest stroke within the limits -> set points from rest to rest -> CSV with torques.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import tyro

from flaprig import UVLM, QuasiSteady, Rig, SunTangStroke, Twin
from flaprig.feedforward import needed_torques
from flaprig.limits import SINUSOID, filtered, rig_limits
from flaprig.logs import XM430_RIG


def main(
    out: Path = Path("feasible_stroke"),
    acceleration: float = 0.8,
    cycles: int = 3,
    interval: float = 0.02,
    quasi_steady: bool = False,
) -> None:
    """Bring a 0.2 Hz sinusoid within its accelerations times a factor.

    Args:
        out: folder for trajectory.csv, counts.csv and twin.npz.
        acceleration: what the joints can do, over what the sinusoid needs.
        cycles: that are followed.
        interval: between the servos' set points [s].
        quasi_steady: blade elements in place of the vortex lattice.
    """
    rig = Rig.load().with_(model=QuasiSteady() if quasi_steady else UVLM())
    stroke = SunTangStroke(0.2, np.radians(60.0), np.radians(45.0))
    limits = rig_limits(rig.motors).with_accelerations(SINUSOID.times(acceleration))
    # project, start from rest, follow, stop
    trajectory = filtered(stroke, limits, cycles, interval)
    projection = trajectory.projection
    for name in ("sweep", "pitch"):
        part = getattr(projection, name)
        rms, kept = np.degrees(part.distance_rms), part.amplitude_ratio
        print(f"{name}: nearest stroke {rms:.3f} deg rms away, {kept:.4f} of the amplitude")
    print(f"set points: {trajectory.motion.time.size}, on the stroke at {trajectory.joined_at} s")
    # the twin does the same by itself, at MuJoCo's step
    run = Twin(rig, limits=limits).run(stroke, cycles)
    error = np.degrees(np.abs(run.tracking_error("sweep")).max())
    print(f"twin: C_L {run.result.cl:.3f}, L/D {run.result.lift_to_drag:.3f}", end=", ")
    print(f"sweep {error:.3f} deg off at most")
    # torque of each interval; none is needed after the last
    torque = np.vstack([needed_torques(rig, trajectory.motion), np.zeros(2)])
    out.mkdir(parents=True, exist_ok=True)
    trajectory.save(out / "trajectory.csv", torque)
    XM430_RIG.save(out / "counts.csv", trajectory.motion)
    run.save(out / "twin.npz")
    print(f"{out}: trajectory.csv, counts.csv, twin.npz")


if __name__ == "__main__":
    tyro.cli(main)
