"""The rig at work in MuJoCo, one instant after the other, for whoever wants to look at it."""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np
from numpy.typing import NDArray

from flaprig.rig import controls, coordinates
from flaprig.strokes.stroke import Stroke
from flaprig.twin import Twin


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
        """
        self.model = twin.compile(stroke)
        self.data = mujoco.MjData(self.model)
        self._stroke = stroke
        self._controls = controls(self.model)
        start = stroke.motion(0.0)
        self.data.qpos[coordinates(self.model)[0]] = start.sweep, start.pitch

    def step(self) -> None:
        """One MuJoCo step, with the position of its beginning and the rate of its end.

        Raises:
            FloatingPointError: the state went wrong, and MuJoCo has reset it.
        """
        time = self.data.time
        now, then = (self._stroke.motion(t) for t in (time, time + self.model.opt.timestep))
        self.data.ctrl[self._controls.position] = now.sweep, now.pitch
        self.data.ctrl[self._controls.velocity] = then.sweep_rate, then.pitch_rate
        mujoco.mj_step(self.model, self.data)
        if self.data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            raise FloatingPointError(f"the rig's acceleration is not finite at t = {time:.6g} s")

    def at(self, instants: NDArray[np.float64]) -> Iterator[mujoco.MjData]:
        """The state at increasing instants in [s]."""
        for instant in instants:
            while self.data.time < instant - 0.5 * self.model.opt.timestep:
                self.step()
            yield self.data
