"""Roll out several strokes at once on two threads with mujoco.batch, as learning does.

One model, one row of state for each rig; the wakes live in the states.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import tyro
from mujoco.batch import Batch

from flaprig import UVLM, QuasiSteady, Rig, SunTangStroke, Twin
from flaprig.rig import Sensor, coordinates, readings


def main(
    out: Path = Path("batch.npz"),
    pitch: tuple[float, ...] = (30.0, 40.0, 50.0, 60.0),
    cycles: int = 2,
    threads: int = 2,
    every: int = 5,
    quasi_steady: bool = False,
) -> None:
    """Roll out sinusoids of several pitch amplitudes.

    Args:
        out: NPZ file: time, pitch amplitudes, and qpos, qvel, aero with a row for each stroke.
        pitch: amplitudes [deg], a rig each.
        cycles: how many, at 0.2 Hz.
        threads: of the pool.
        every: steps from one observation to the next; the controls change in every step.
        quasi_steady: blade elements in place of the vortex lattice.
    """
    strokes = [SunTangStroke(0.2, np.radians(60.0), np.radians(angle)) for angle in pitch]
    twin = Twin(Rig.load().with_(model=QuasiSteady() if quasi_steady else UVLM()))
    # all strokes have one frequency, so one model with one wake clock serves them all
    model = twin.compile(strokes[0])
    # limits, start from rest and feedforward as in the twin. Shape (steps, rigs, controls)
    plans = [twin.commands(model, stroke, cycles) for stroke in strokes]
    table = np.stack([control for _, control in plans], axis=1)
    batch = Batch(model, nsim=len(strokes), nthread=threads)
    qpos, qvel, ctrl, sensed = map(batch.bind, ("qpos", "qvel", "ctrl", "sensordata"))
    first = [(points.motion.sweep[0], points.motion.pitch[0]) for points, _ in plans]
    qpos[:, coordinates(model)[0]] = first
    aero = readings(model)[Sensor.AERO]
    rows: list[tuple[np.ndarray, ...]] = []
    for k, control in enumerate(table):
        ctrl[:] = control
        batch.step()
        if (k + 1) % every == 0:
            # copies: the next step writes to the same memory
            rows.append((qpos.copy(), qvel.copy(), sensed[:, aero].copy()))
    time = np.arange(1, len(rows) + 1) * every * model.opt.timestep
    # the stroke first, then time
    series = [np.stack(values, axis=1) for values in zip(*rows, strict=True)]
    named: dict[str, Any] = dict(zip(("qpos", "qvel", "aero"), series, strict=True))
    np.savez(out, time=time, pitch_deg=np.array(pitch), **named)
    for angle, loads in zip(pitch, named["aero"], strict=True):
        lift, drag = loads[-(len(rows) // cycles) :, 6:8].mean(axis=0)
        print(f"pitch {angle:4.1f} deg: lift {lift:.4f} N, drag {drag:.4f} N in the last cycle")


if __name__ == "__main__":
    tyro.cli(main)
