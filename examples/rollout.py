"""Roll out one stroke in dm_control, without a display, and save what the rig's sensors say.

A loop as any dm_control user writes it: load, reset, set the controls, step, observe.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

# dm_control looks for a display when it is imported; this script draws nothing
os.environ.setdefault("MUJOCO_GL", "disable")

import numpy as np
import tyro
from dm_control.mujoco import Physics

from flaprig import SunTangStroke
from flaprig._paths import RIG_XML
from flaprig.native import library
from flaprig.rig import START, controls, readings


def main(out: Path = Path("rollout.npz"), cycles: float = 2.0, every: int = 5) -> None:
    """Roll out the paper's sinusoid.

    Args:
        out: NPZ file: time, qpos, qvel, ctrl and an array for each sensor.
        cycles: how long.
        every: steps from one observation to the next; the controls change in every step.
    """
    # the fluid is a plugin: MuJoCo must know it before it reads the file
    library.load()
    physics = Physics.from_xml_path(str(RIG_XML))
    physics.legacy_step = False
    # the wake of rig.xml keeps the time of a 0.2 Hz stroke; flaprig.Rig sets it for others
    stroke = SunTangStroke(0.2, np.radians(60.0), np.radians(45.0))
    # each servo has three inputs, and named.data.ctrl labels them wrongly
    where, sensors = controls(physics.model.ptr), readings(physics.model.ptr)
    with physics.reset_context():
        physics.reset(physics.model.ptr.key(START).id)
    step = physics.timestep()
    rows: list[dict[str, Any]] = []
    for k in range(round(cycles * stroke.period / step)):
        # the angle of the step's beginning and the rate of its end
        now, then = stroke.motion(k * step), stroke.motion((k + 1) * step)
        physics.data.ctrl[where.position] = now.sweep, now.pitch
        physics.data.ctrl[where.velocity] = then.sweep_rate, then.pitch_rate
        # raises PhysicsError when the state is not finite
        physics.step()
        if (k + 1) % every == 0:
            data = physics.data
            row = {"time": data.time, "qpos": data.qpos, "qvel": data.qvel, "ctrl": data.ctrl}
            row |= {str(name): data.sensordata[part] for name, part in sensors.items()}
            # copies: the next step writes to the same memory
            rows.append({name: np.array(value) for name, value in row.items()})
    table: dict[str, Any] = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    np.savez(out, **table)
    lift = table["aero"][len(rows) // 2 :, 6].mean()
    print(f"{out}: {len(rows)} observations, mean lift {lift:.4f} N in the second half")


if __name__ == "__main__":
    tyro.cli(main)
