"""The hovering problem flown by the rig: an action is a stroke that the motors follow in MuJoCo.

Each stroke begins at rest in still water, goes through the twin's limits, Ruckig and link to the
servos, and is judged by the fluid's forces after the skipped cycles, divided by the reference force
of the stroke asked for. All strokes of a batch run on mujoco.batch.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.loads import sweep_direction
from flaprig.aero.result import Result
from flaprig.limits import Limits
from flaprig.motors import RIG_MOTORS, Motors
from flaprig.rig import Rig, Sensor, coordinates, readings
from flaprig.servo_link import PERFECT, ServoLink
from flaprig.strokes.fourier import FourierStroke
from flaprig.tasks.copies import packed, unpacked
from flaprig.tasks.hover import LOADS_FAILED, Coefficients, Evaluator
from flaprig.tasks.hover_motion import Shapes
from flaprig.tasks.hover_settings import HARMONICS, SINUSOID_COEFFICIENTS, HoverSettings
from flaprig.twin import Own, Twin

Array = NDArray[np.float64]

# what a twin raises for a stroke that it cannot run
_REFUSALS = (ValueError, RuntimeError, FloatingPointError)


@dataclass(frozen=True)
class HoverRigSettings:
    """The hovering problem, and the rig that flies it.

    Attributes:
        problem: bounds, reward, episode, wing, fluid and air; its cycles count for both airs, since
            the rig starts from rest.
        motors: the two servos.
        time_step: of MuJoCo in [s], as Twin's.
        feedforward: whether the servos are told the torque that the stroke needs.
        limits: as Twin's. None is eight times as fast with the quasi-steady air.
        link: what the servos hear of their set points.

    Raises:
        ValueError: a setting of the wrong type or out of its range.
    """

    problem: HoverSettings = field(default_factory=HoverSettings)
    motors: Motors = RIG_MOTORS
    time_step: float = 0.01
    feedforward: bool = False
    limits: Limits | Own | None = Own.RIG
    link: ServoLink = PERFECT

    def __post_init__(self) -> None:
        owner = "HoverRigSettings"
        if not isinstance(self.problem, HoverSettings):
            raise check.fail(owner, "problem", "a HoverSettings", self.problem)
        steps = self.twin().steps_per_cycle(self.problem.stroke(SINUSOID_COEFFICIENTS))
        if steps % 2:
            allowed = "one that divides the half stroke into whole steps"
            raise check.fail(owner, "time_step", allowed, self.time_step)

    def twin(self) -> Twin:
        """The twin that flies the strokes."""
        p = self.problem
        rig = Rig(
            wing=p.wing, fluid=p.fluid, motors=self.motors, model=p.model, frequency=p.frequency
        )
        return Twin(rig, self.time_step, self.feedforward, self.limits, self.link)


class RigHover(Evaluator):
    """Strokes flown by the rig's motors, side by side.

    Attributes:
        twin: the rig and how it is driven.
        model: compiled for strokes of the problem's frequency.
        states: MuJoCo's integration states where the strokes of the last call ended, by row.
    """

    def __init__(self, settings: HoverRigSettings) -> None:
        self.twin = settings.twin()
        self.model = self.twin.compile(settings.problem.stroke(SINUSOID_COEFFICIENTS))
        self.states: dict[int, Array] = {}
        self._sensors = readings(self.model)
        super().__init__(settings.problem)

    def __getstate__(self) -> dict[str, Any]:
        return vars(self) | {"model": packed(self.model)}

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state | {"model": unpacked(state["model"])})

    def fly(self, coefficients: Array) -> Result:
        """One stroke with all its histories, by flaprig.Twin."""
        return self.twin.run(self.settings.stroke(coefficients), self.settings.cycles).result

    def simulate(
        self, shape: Shapes, rows: NDArray[np.int64]
    ) -> tuple[Coefficients, dict[int, str]]:
        """Mean coefficients of the rows asked for, NaN in the others; and failures by row."""
        table = np.full((4, len(shape.series)), np.nan)
        self.states, failures, starts, controls, flown = {}, {}, [], [], []
        for k in rows.tolist():
            try:
                start, control = self._commands(shape, k)
            except _REFUSALS as error:
                failures[k] = str(error)
                continue
            starts.append(start)
            controls.append(control)
            flown.append(k)
        if flown:
            table[:, flown] = self._run(flown, np.array(starts), np.array(controls), failures)
        return Coefficients(*table), failures

    def _commands(self, shape: Shapes, k: int) -> tuple[Array, Array]:
        """First posture, shape (2,), and inputs of every step, shape (n, nu)."""
        stroke = stroke_of(self.settings.frequency, shape, k)
        points, control = self.twin.commands(self.model, stroke, self.settings.cycles)
        return np.array([points.motion.sweep[0], points.motion.pitch[0]]), control

    def _run(
        self, rows: list[int], starts: Array, controls: Array, failures: dict[int, str]
    ) -> Array:
        """Fly the rows; means as rows of Coefficients. Shape (4, len(rows))."""
        count, steps = controls.shape[:2]
        batch = Batch(self.model, nsim=count, nthread=min(count, self.settings.workers))
        batch.qpos[:, coordinates(self.model)[0]] = starts
        sensors = batch.rollout(steps, controls, record=("sensordata",))["sensordata"]
        for k, state, warned in zip(rows, batch.state, batch.warning.any(axis=(1, 2)), strict=True):
            self.states[k] = state.copy()
            if warned:
                failures[k] = LOADS_FAILED
        found = {name: sensors[..., part] for name, part in self._sensors.items()}
        rate, step = found[Sensor.SWEEP_VELOCITY][..., 0], self.model.opt.timestep
        # sensors are those of a step's beginning
        last = batch.qvel[:, coordinates(self.model)[1][:1]]
        direction = sweep_direction(rate, np.diff(rate, append=last) / step, step)

        def averaged(values: Array) -> Array:
            cycles = self.settings.cycles
            parts = values.reshape(count, cycles, steps // cycles, *values.shape[2:])
            return np.asarray(parts[:, self.settings.skipped_cycles :])

        force, pitch = found[Sensor.AERO][..., :3], found[Sensor.PITCH_ENCODER][..., 0]
        return self.means(averaged(force), averaged(pitch), averaged(direction))


def stroke_of(frequency: float, shape: Shapes, row: int) -> FourierStroke:
    """One of the shapes as a stroke."""
    sweep, pitch = shape.series[row]
    return FourierStroke(
        frequency=frequency,
        sweep_cos=tuple(sweep[:HARMONICS].tolist()),
        sweep_sin=tuple(sweep[HARMONICS:].tolist()),
        pitch_cos=tuple(pitch[:HARMONICS].tolist()),
        pitch_sin=tuple(pitch[HARMONICS:].tolist()),
        sweep_mean=float(shape.mean[row, 0]),
        pitch_mean=float(shape.mean[row, 1]),
    )
