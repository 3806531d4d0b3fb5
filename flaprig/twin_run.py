"""What a run of the twin returns: the fluid's loads, the servos' work, how well they followed."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.result import Result
from flaprig.energy import EnergyBalance
from flaprig.files import plain, write_table
from flaprig.limits import JointProjection, Projection
from flaprig.limits.projection import in_words
from flaprig.motor_histories import MotorHistories
from flaprig.motors import Motors
from flaprig.rig import Axis
from flaprig.strokes.stroke import Motion, Stroke

Array = NDArray[np.float64]

# difference of amplitudes that is told at least [rad]: a count of the encoders
LEAST_TOLD = 2.0 * np.pi / 4096.0
# a commanded first harmonic below this [rad] has no lag
LEAST_SWING = 1e-9

# shares by which a number may differ from what was asked for without a word
TOLD = 0.01
# parts of a six-axis wrench, with their units
_PARTS = ("force_x_N", "force_y_N", "force_z_N", "torque_x_Nm", "torque_y_Nm", "torque_z_Nm")


@dataclass(frozen=True, eq=False)
class TwinRun:
    """A run of the rig. Row k of every history is the step that begins at time[k].

    Attributes:
        result: loads and coefficients of the motion really made; the coefficients divide by the
            reference force of the stroke asked for.
        motors: commands, torques, currents and temperatures of the servos.
        servos: the two servos themselves.
        commanded: motion that the servos were to make, within the limits. Arrays of shape (n + 1,).
        asked: the stroke that was asked for.
        projection: what the limits changed of the stroke asked for; None: run without limits.
        joined_at: when the start from rest had caught up with the stroke in [s].
        energy: balance of every cycle.
        fluid_wrench: of the moving fluid on the wing, without buoyancy, wing frame, about its
            origin [N, N m]. Shape (n, 6).
        load_cell: of the wing on its mount, weight and buoyancy in it, in the cell's frame
            [N, N m]. Shape (n, 6).
        time_step: of MuJoCo in [s]: the one asked for, made to divide the cycle.
        told: sentences on what else was changed: time step, delay, update interval.
    """

    result: Result
    motors: MotorHistories
    servos: Motors
    commanded: Motion
    asked: Stroke
    projection: Projection | None
    joined_at: float
    energy: EnergyBalance
    fluid_wrench: Array
    load_cell: Array
    time_step: float
    told: tuple[str, ...] = ()

    @property
    def notices(self) -> tuple[str, ...]:
        """What was changed of the request, and what is doubtful about the answer; sentences."""
        changed = self.projection.notices if self.projection else ()
        return (*changed, *self.told, *self._shortfalls(), *self.result.notices)

    def flown_amplitude(self, axis: Axis | str) -> float:
        """Half of the peak-to-peak angle reached in the averaged cycles in [rad]."""
        return 0.5 * float(np.ptp(self.result.averaged(getattr(self.motors, Axis(axis).value))))

    @property
    def flown_reference_force(self) -> float:
        """0.5 rho U^2 S in [N] with U the mean speed at R2 of the sweep that was really made."""
        share = self.flown_amplitude(Axis.SWEEP) / self.asked.sweep_amplitude
        return float(self.result.reference_force * share**2)

    def _shortfalls(self) -> list[str]:
        """Sentences on servos that did not do what they were told."""
        found = []
        for axis in Axis:
            told = self.result.averaged(getattr(self.motors, f"{axis}_command"))
            wanted, reached = 0.5 * float(np.ptp(told)), self.flown_amplitude(axis)
            if abs(reached - wanted) > max(TOLD * wanted, LEAST_TOLD):
                found.append(
                    f"{axis} reached an amplitude of {in_words(reached)} where "
                    f"{in_words(wanted)} was commanded"
                )
            part = float(self.result.averaged(self.saturated(axis).astype(np.float64)).mean())
            if part > 0.0:
                found.append(
                    f"the {axis} servo was at the limit of its torque or supply in "
                    f"{100.0 * part:.3g} % of the time"
                )
        return found

    def tracking_error(self, axis: Axis | str) -> Array:
        """Angle reached minus angle commanded, in [rad], over the averaged cycles. Shape (m,)."""
        name = Axis(axis).value
        asked, reached = getattr(self.motors, f"{name}_command"), getattr(self.motors, name)
        return self.result.averaged(reached - asked)

    def lag(self, axis: Axis | str) -> float:
        """Time by which the reached angle's first harmonic is behind the commanded one's in [s].

        Over the averaged cycles; 0 where nothing is commanded.
        """
        name = Axis(axis).value
        first, last = self.result.averaged_cycles
        asked, reached = (
            np.fft.rfft(self.result.averaged(getattr(self.motors, full)))[last - first + 1]
            for full in (f"{name}_command", name)
        )
        if abs(asked) < LEAST_SWING * self.result.steps_per_cycle:
            return 0.0
        period = self.result.steps_per_cycle * self.time_step
        return float(-np.angle(reached / asked) / (2.0 * np.pi) * period)

    def saturated(self, axis: Axis | str) -> NDArray[np.bool_]:
        """Steps in which a servo's torque, current or voltage was at its limit. Shape (n,).

        The controller asked for more than its torque limit, which stands for the current's, or
        for more volts than the supply has at that speed.
        """
        name = Axis(axis).value
        motor = getattr(self.servos, name)
        voltage, demand = (getattr(self.motors, f"{name}_{part}") for part in ("voltage", "demand"))
        return np.asarray((np.abs(voltage) > motor.voltage) | (np.abs(demand) > motor.peak_torque))

    def columns(self) -> dict[str, Array]:
        """All histories by name with unit: those of result and motors, both wrenches."""
        wrenches = {
            f"{name}_{part}": values[:, i]
            for name, values in (("fluid", self.fluid_wrench), ("load_cell", self.load_cell))
            for i, part in enumerate(_PARTS)
        }
        return self.result.histories.columns() | self.motors.columns() | wrenches

    def summary(self) -> dict[str, Any]:
        """The result's summary, the servos' and the balance, with SI units in the names.

        What is not finite is None, as JSON has it.
        """
        servos: dict[str, float | list[int] | list[float]] = {}
        for axis in Axis:
            servos |= self._servo_summary(axis)
        balance: dict[str, float | list[int] | list[float]] = {
            "motor_work_J": self.energy.motor_work.tolist(),
            "fluid_work_J": self.energy.fluid_work.tolist(),
            "energy_residual_relative": self.energy.relative_residual.tolist(),
            "time_step_s": self.time_step,
            "joined_at_s": self.joined_at,
        }
        scale = self.result.reference_force / max(self.flown_reference_force, 1e-300)
        flown: dict[str, float | list[int] | list[float]] = {
            **{f"flown_{axis}_amplitude_rad": self.flown_amplitude(axis) for axis in Axis},
            # by the speed that was really made
            "flown_cl": self.result.cl * scale,
            "flown_cd": self.result.cd * scale,
        }
        whole = {**self.result.summary(), **flown, **servos, **balance}
        whole["notices"] = list(self.notices)
        return {name: plain(value) for name, value in whole.items()}

    def _servo_summary(self, axis: Axis) -> dict[str, float]:
        error = self.tracking_error(axis)

        def averaged(name: str) -> Array:
            return np.asarray(self.result.averaged(getattr(self.motors, f"{axis}_{name}")))

        torque, power = averaged("motor_torque"), averaged("motor_power")
        changed = getattr(self.projection, axis) if self.projection else JointProjection()
        numbers = {
            f"rms_{axis}_projection_rad": changed.distance_rms,
            f"max_{axis}_projection_rad": changed.distance_max,
            f"{axis}_lag_s": self.lag(axis),
            f"{axis}_saturated_fraction": self.saturated(axis).mean(),
            f"rms_{axis}_tracking_error_rad": np.sqrt(np.mean(error**2)),
            f"peak_{axis}_tracking_error_rad": np.abs(error).max(),
            f"peak_{axis}_motor_torque_Nm": np.abs(torque).max(),
            f"p99_{axis}_motor_torque_Nm": np.percentile(np.abs(torque), 99),
            f"rms_{axis}_motor_torque_Nm": np.sqrt(np.mean(torque**2)),
            f"mean_{axis}_motor_power_W": power.mean(),
            f"peak_{axis}_motor_power_W": np.abs(power).max(),
            f"peak_{axis}_current_A": np.abs(averaged("current")).max(),
            f"peak_{axis}_temperature_degC": averaged("temperature").max(),
        }
        return {name: float(value) for name, value in numbers.items()}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all histories: CSV or NPZ by the path's ending, units in the header.

        The NPZ also holds the summary as JSON text. Written to a temporary file, then renamed.

        Raises:
            ValueError: an ending that is neither .csv nor .npz.
            OSError: the folder does not exist or cannot be written.
        """
        write_table("TwinRun.save", path, self.columns(), self.summary())
