"""The rig at work in MuJoCo, one instant after the other, for whoever wants to look at it."""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.strokes.stroke import Stroke
from flaprig.twin import Twin, at_rest

# cycles of commands; the last one, long after the start, is repeated
CYCLES = 5


class Flight:
    """The servos follow a stroke as in `Twin.run`, without a log, as long as one likes.

    Attributes:
        model: the compiled rig.
        data: its state, the wake included.
    """

    def __init__(self, twin: Twin, stroke: Stroke) -> None:
        """The rig at rest in the stroke's first posture, in still fluid.

        Raises:
            ImportError: the plugin library is missing or does not fit MuJoCo.
            ValueError: the rig refuses a number.
            RuntimeError: the limits leave no way onto the stroke.
        """
        self.model = twin.compile(stroke)
        points, self._commands = twin.commands(self.model, stroke, CYCLES)
        self.data = at_rest(self.model, points.motion)

    def step(self) -> None:
        """One MuJoCo step.

        Raises:
            FloatingPointError: the state went wrong, and MuJoCo has reset it.
        """
        time, count = self.data.time, len(self._commands)
        row, cycle = round(time / self.model.opt.timestep), count // CYCLES
        # the last cycle again and again
        row = row if row < count else count - cycle + (row - count) % cycle
        self.data.ctrl[:] = self._commands[row]
        mujoco.mj_step(self.model, self.data)
        if self.data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            raise FloatingPointError(f"the rig's acceleration is not finite at t = {time:.6g} s")

    def at(self, instants: NDArray[np.float64]) -> Iterator[mujoco.MjData]:
        """The state at increasing instants in [s]."""
        for instant in instants:
            while self.data.time < instant - 0.5 * self.model.opt.timestep:
                self.step()
            yield self.data
