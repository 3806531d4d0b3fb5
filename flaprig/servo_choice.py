"""The smallest servo of the catalogue with which a rig can do a stroke."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flaprig.aero.air import Progress
from flaprig.catalogue import CATALOGUE
from flaprig.feasibility import FeasibilityReport, check_feasibility
from flaprig.limits import Limits
from flaprig.motors import Motors
from flaprig.rig import Axis, Rig
from flaprig.strokes.stroke import Stroke


@dataclass(frozen=True)
class ServoTrial:
    """One servo of the catalogue on both joints.

    Attributes:
        name: of the servo.
        mass: in [kg].
        sweep: whether it keeps the limits of the sweep.
        pitch: whether it keeps those of the pitch.
        report: all verdicts.
    """

    name: str
    mass: float
    sweep: bool
    pitch: bool
    report: FeasibilityReport


@dataclass(frozen=True)
class ServoChoice:
    """The smallest servos of the catalogue for a stroke.

    Attributes:
        both: smallest one that is feasible on both joints; None: none is.
        sweep: smallest one that keeps the limits of the sweep.
        pitch: smallest one that keeps those of the pitch.
        pair: whether these two hold together; None: they are one, or one is missing.
        trials: every servo, the smallest first.
    """

    both: str | None
    sweep: str | None
    pitch: str | None
    pair: bool | None
    trials: tuple[ServoTrial, ...]

    def summary(self) -> dict[str, Any]:
        """Numbers for a JSON object."""
        return {
            "smallest_servo": self.both,
            "smallest_sweep_servo": self.sweep,
            "smallest_pitch_servo": self.pitch,
            "pair_feasible": self.pair,
            "servos": {
                trial.name: {
                    "mass_kg": trial.mass,
                    "feasible": trial.report.feasible,
                    "broken": [verdict.key for verdict in trial.report.broken],
                }
                for trial in self.trials
            },
        }


def smallest_servo(
    rig: Rig,
    stroke: Stroke,
    limits_of: Callable[[Motors], Limits | None] = lambda motors: None,
    progress: Progress | None = None,
    **settings: Any,
) -> ServoChoice:
    """Put every servo of the catalogue on both joints and see which ones hold.

    Args:
        rig: the rig.
        stroke: what is asked for.
        limits_of: limits of the joints with other motors; None: the rig's own with these motors.
        progress: called with the fraction done.
        settings: passed on to `check_feasibility`.

    Raises:
        ValueError: a bad argument; the sentence names it.
    """

    def judged(motors: Motors) -> FeasibilityReport:
        changed = rig.with_(motors=motors)
        return check_feasibility(changed, stroke, limits=limits_of(motors), **settings)

    trials: list[ServoTrial] = []
    for name, motor in CATALOGUE.items():
        report = judged(Motors(motor, motor))
        sweep, pitch = (report.feasible_joint(axis) for axis in Axis)
        trials.append(ServoTrial(name, motor.mass, sweep, pitch, report))
        if progress is not None:
            progress(len(trials) / (len(CATALOGUE) + 1))
    smallest = [_first(trials, lambda t: t.sweep), _first(trials, lambda t: t.pitch)]
    pair = None
    if None not in smallest and smallest[0] != smallest[1]:
        pair = judged(Motors(*(CATALOGUE[str(name)] for name in smallest))).feasible
    both = _first(trials, lambda trial: trial.report.feasible)
    return ServoChoice(both, smallest[0], smallest[1], pair, tuple(trials))


def _first(trials: list[ServoTrial], holds: Callable[[ServoTrial], bool]) -> str | None:
    return next((trial.name for trial in trials if holds(trial)), None)
