"""Time histories of a run: every column is named with its unit, and every row is one instant."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Histories:
    """Motion and loads against time; all arrays of shape (n,).

    The shares of lift and drag are None where nobody can tell them apart, as in the twin.

    Attributes:
        time: [s].
        sweep: [rad].
        pitch: [rad].
        sweep_rate: [rad/s].
        pitch_rate: [rad/s].
        lift: upward force [N].
        drag: force against the sweep, positive when it opposes the motion; at a reversal weighed by
            the parts of the sample's interval before and after it (aero/loads.py) [N].
        sweep_torque: of the fluid on the wing about the sweep axis [N m].
        pitch_torque: of the fluid on the wing about the pitch axis, along +pitch [N m]; buoyancy is
            in it where pitch_torque_buoyancy says how much.
        power: given to the moving fluid, minus the torques without buoyancy times the rates [W].
        lift_extra: share of the suction (UVLM) or of the rotation (quasi-steady) in lift [N].
        drag_extra: the same in drag [N].
        lift_added_mass: share of the added mass in lift [N].
        drag_added_mass: the same in drag [N].
        pitch_torque_buoyancy: share of the displaced fluid in pitch_torque [N m]; None where
            buoyancy was left out.
    """

    time: Array
    sweep: Array
    pitch: Array
    sweep_rate: Array
    pitch_rate: Array
    lift: Array
    drag: Array
    sweep_torque: Array
    pitch_torque: Array
    power: Array
    lift_extra: Array | None = None
    drag_extra: Array | None = None
    lift_added_mass: Array | None = None
    drag_added_mass: Array | None = None
    pitch_torque_buoyancy: Array | None = None

    def with_buoyancy(self, torque: Array) -> Histories:
        """The same with the displaced fluid's torque in the pitch torque. Shape (n,)."""
        total = self.pitch_torque + torque
        return replace(self, pitch_torque=total, pitch_torque_buoyancy=torque)

    def columns(self) -> dict[str, Array]:
        """Arrays by name with unit, for files: time_s, sweep_rad, lift_N, ..."""
        present = (f.name for f in fields(self) if getattr(self, f.name) is not None)
        return {f"{name}_{_unit(name)}": getattr(self, name) for name in present}


def _unit(name: str) -> str:
    """SI unit of a history, as it stands in a file's header."""
    if name == "time":
        return "s"
    if name in ("sweep", "pitch"):
        return "rad"
    if name.endswith("_rate"):
        return "rad_per_s"
    if "_torque" in name:
        return "Nm"
    return "W" if name == "power" else "N"
