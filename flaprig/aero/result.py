"""What a simulation returns: histories, cycle means, and how much the cycles differ."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig.aero.histories import Histories
from flaprig.aero.notices import doubts_of_loads
from flaprig.files import plain, write_table
from flaprig.strokes.stroke import Stroke

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Result:
    """Loads of a wing over some cycles.

    Coefficients divide by 0.5 rho U^2 S, U the mean speed at R2. Means are over the averaged
    cycles; the spread is the standard deviation from cycle to cycle (a free wake is chaotic), NaN
    when only one cycle is averaged.

    Attributes:
        histories: the arrays, also readable on the result itself (result.lift, ...).
        reference_force: 0.5 rho U^2 S in [N].
        steps_per_cycle: instants in one cycle.
        averaged_cycles: first and last cycle in the means, counted from 1.
        notices: what was changed or is doubtful; sentences.
    """

    histories: Histories
    reference_force: float
    steps_per_cycle: int
    averaged_cycles: tuple[int, int]
    notices: tuple[str, ...] = ()

    @property
    def time(self) -> Array:
        """[s], shape (n,)."""
        return self.histories.time

    @property
    def lift(self) -> Array:
        """[N], shape (n,)."""
        return self.histories.lift

    @property
    def drag(self) -> Array:
        """[N], positive against the sweep, shape (n,)."""
        return self.histories.drag

    @property
    def sweep_torque(self) -> Array:
        """Of the fluid about the sweep axis [N m], shape (n,)."""
        return self.histories.sweep_torque

    @property
    def pitch_torque(self) -> Array:
        """Of the fluid about the pitch axis [N m], buoyancy in it where asked for. Shape (n,)."""
        return self.histories.pitch_torque

    @property
    def power(self) -> Array:
        """Given to the fluid [W], shape (n,)."""
        return self.histories.power

    def doubted(self, stroke: Stroke) -> Result:
        """The same result with the notices on its stroke and its means."""
        return replace(self, notices=(*self.notices, *doubts_of_loads(stroke, self.cl, self.cd)))

    @property
    def cl(self) -> float:
        """Mean lift coefficient."""
        return float(np.mean(self.cycle_means(self.lift))) / self.reference_force

    @property
    def cd(self) -> float:
        """Mean drag coefficient."""
        return float(np.mean(self.cycle_means(self.drag))) / self.reference_force

    @property
    def lift_to_drag(self) -> float:
        """Mean lift over mean drag."""
        return self.cl / self.cd

    @property
    def cl_spread(self) -> float:
        """Standard deviation of C_L from cycle to cycle."""
        return _spread(self.cycle_means(self.lift)) / self.reference_force

    @property
    def cd_spread(self) -> float:
        """Standard deviation of C_D from cycle to cycle."""
        return _spread(self.cycle_means(self.drag)) / self.reference_force

    @property
    def lift_to_drag_spread(self) -> float:
        """Standard deviation of the cycles' own L/D."""
        return _spread(self.cycle_means(self.lift) / self.cycle_means(self.drag))

    def cycle_means(self, history: Array) -> Array:
        """Mean of a history in each averaged cycle. Shape (cycles,)."""
        first, last = self.averaged_cycles
        return history.reshape(-1, self.steps_per_cycle)[first - 1 : last].mean(axis=1)

    def averaged(self, history: Array) -> Array:
        """The part of a history that the means are taken over. Shape (m,)."""
        first, last = self.averaged_cycles
        return history[(first - 1) * self.steps_per_cycle : last * self.steps_per_cycle]

    def summary(self) -> dict[str, Any]:
        """Means and peaks with SI units in the names, as the command line prints them; notices.

        The spread of a single cycle is None, so that the summary is valid JSON.
        """
        h = self.histories
        peaks = {
            "peak_sweep_torque_Nm": np.abs(self.averaged(h.sweep_torque)).max(),
            "p99_sweep_torque_Nm": np.percentile(np.abs(self.averaged(h.sweep_torque)), 99),
            "peak_pitch_torque_Nm": np.abs(self.averaged(h.pitch_torque)).max(),
            "p99_pitch_torque_Nm": np.percentile(np.abs(self.averaged(h.pitch_torque)), 99),
            "peak_power_W": self.averaged(h.power).max(),
            "mean_power_W": self.averaged(h.power).mean(),
            "mean_lift_N": self.averaged(h.lift).mean(),
            "mean_drag_N": self.averaged(h.drag).mean(),
        }
        coefficients: dict[str, Any] = {
            "cl": self.cl,
            "cl_spread": self.cl_spread,
            "cd": self.cd,
            "cd_spread": self.cd_spread,
            "lift_to_drag": self.lift_to_drag,
            "lift_to_drag_spread": self.lift_to_drag_spread,
            "averaged_cycles": list(self.averaged_cycles),
        }
        numbers = {name: plain(value) for name, value in (coefficients | peaks).items()}
        return numbers | {"notices": list(self.notices)}

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the histories: CSV or NPZ by the path's ending, units in the header.

        The NPZ also holds the summary as JSON text. Written to a temporary file, then renamed.

        Raises:
            ValueError: an ending that is neither .csv nor .npz.
            OSError: the folder does not exist or cannot be written.
        """
        write_table("Result.save", path, self.histories.columns(), self.summary())


def _spread(means: Array) -> float:
    return float(np.std(means, ddof=1)) if means.size > 1 else float("nan")


def averaged_cycles(cycles: int) -> tuple[int, int]:
    """Cycles that means are taken over: 3 to 5 of five, as the paper; the last three of more, and
    what is left after two of fewer."""
    return max(min(3, cycles), cycles - 2), cycles
