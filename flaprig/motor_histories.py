"""What the two servos did during a run: commands, torques, currents and winding temperatures."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# units by the last words of a history's name, the longest first
_UNITS = {
    "rate_command": "rad_per_s",
    "rate_set_point": "rad_per_s",
    "feedforward": "Nm",
    "demand": "Nm",
    "voltage": "V",
    "motor_torque": "Nm",
    "motor_power": "W",
    "current": "A",
    "temperature": "degC",
    "set_point": "rad",
    "command": "rad",
    "time": "s",
    "sweep": "rad",
    "pitch": "rad",
}


@dataclass(frozen=True, eq=False)
class MotorHistories:
    """Both servos against time; all arrays of shape (n,). Row k is the step that begins at time[k].

    Attributes:
        time: beginning of the step [s].
        sweep: angle reached at that time [rad].
        pitch: the same [rad].
        sweep_command: angle that it should have at that time, within the limits [rad].
        pitch_command: the same [rad].
        sweep_rate_command: rate that it should have at the step's end [rad/s].
        pitch_rate_command: the same [rad/s].
        sweep_set_point: angle that the servo was told, late and rounded as its link is [rad].
        pitch_set_point: the same [rad].
        sweep_rate_set_point: rate that the servo was told [rad/s].
        pitch_rate_set_point: the same [rad/s].
        sweep_feedforward: torque that the servo was told [N m].
        pitch_feedforward: the same [N m].
        sweep_demand: torque that its controller asks for; beyond the servo's limits less comes
            of it [N m].
        pitch_demand: the same [N m].
        sweep_voltage: that its controller asks for, the supply's is the most there is [V].
        pitch_voltage: the same [V].
        sweep_motor_torque: of the motor on its rotor, seen at the horn, during the step [N m].
        pitch_motor_torque: the same [N m].
        sweep_motor_power: mechanical, torque times the step's mean rate [W].
        pitch_motor_power: the same [W].
        sweep_current: of the winding during the step [A].
        pitch_current: the same [A].
        sweep_temperature: of the winding at the step's end [degC]. MuJoCo heats it with the current
            that its explicit law gives: the rise is 1 % too large at 1 ms, 6 % at 5 ms.
        pitch_temperature: the same [degC].
    """

    time: Array
    sweep: Array
    pitch: Array
    sweep_command: Array
    pitch_command: Array
    sweep_rate_command: Array
    pitch_rate_command: Array
    sweep_set_point: Array
    pitch_set_point: Array
    sweep_rate_set_point: Array
    pitch_rate_set_point: Array
    sweep_feedforward: Array
    pitch_feedforward: Array
    sweep_demand: Array
    pitch_demand: Array
    sweep_voltage: Array
    pitch_voltage: Array
    sweep_motor_torque: Array
    pitch_motor_torque: Array
    sweep_motor_power: Array
    pitch_motor_power: Array
    sweep_current: Array
    pitch_current: Array
    sweep_temperature: Array
    pitch_temperature: Array

    def columns(self) -> dict[str, Array]:
        """Arrays by name with unit, for files: time_s, sweep_command_rad, sweep_current_A, ..."""
        return {f"{f.name}_{_unit(f.name)}": getattr(self, f.name) for f in fields(self)}


def _unit(name: str) -> str:
    return next(unit for ending, unit in _UNITS.items() if name.endswith(ending))
