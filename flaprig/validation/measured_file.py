"""Measured strokes from a file: wing, motion, fluid, and what the balance read.

The motion of a case is two Fourier series, `phi` and `theta`, or a `log`: the name of a rig's table
beside the file, which is read as every log. Its columns lift_N and drag_N stand for CL and CD.
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig._paths import assets_dir
from flaprig.fluid import Fluid
from flaprig.logs import RigLog, read_log
from flaprig.strokes import FourierStroke, Stroke
from flaprig.wing import Wing

Array = NDArray[np.float64]

# the 26 strokes that come with flaprig
FILE = "validation/li_nabawy_2022.json"
_OWNER = "measured"
# columns of a log that stand for coefficients
_COLUMNS = {"CL": "lift_N", "CD": "drag_N"}


@dataclass(frozen=True, eq=False)
class Measured:
    """One measured stroke.

    Attributes:
        name: in the file.
        wing: a beta planform.
        stroke: the measured motion.
        fluid: the tank's.
        reynolds: nominal, mean speed at R2 times the mean chord over the viscosity.
        reference_force: 0.5 rho U^2 S in [N], U from the nominal sweep.
        lift: coefficient over t/T as Fourier coefficients a0, a1, b1, ...
        drag: the same, positive against the sweep.
        mean_lift: over the cycle.
        mean_drag: over the cycle.
        notices: how a log was read; sentences.
    """

    name: str
    wing: Wing
    stroke: Stroke
    fluid: Fluid
    reynolds: float
    reference_force: float
    lift: Array
    drag: Array
    mean_lift: float
    mean_drag: float
    notices: tuple[str, ...] = ()

    @property
    def lift_to_drag(self) -> float:
        """Mean lift over mean drag."""
        return self.mean_lift / self.mean_drag


def read(path: Path | None = None) -> list[Measured]:
    """The strokes of a file; of the one that comes with flaprig when None.

    Raises:
        ValueError: a file that is no such list; names the case, the key and what is allowed.
        OSError: a file that cannot be read.
    """
    path = assets_dir() / FILE if path is None else path
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except (json.JSONDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{_OWNER}: {path} is not JSON: {error}") from None
    cases = content.get("cases") if isinstance(content, dict) else None
    if not isinstance(cases, list) or not cases:
        raise ValueError(f'{_OWNER}: {path} must hold an object with a list "cases"')
    return [_stroke(number, case, path.parent) for number, case in enumerate(cases)]


def _stroke(number: int, case: Any, folder: Path) -> Measured:
    owner = f"{_OWNER}: case {number}"
    if not isinstance(case, dict):
        raise check.fail(owner, "entry", "an object", case)
    get = _Reader(owner, case)
    span, chord, r2 = get.size("span_m"), get.size("mean_chord_m"), get.size("r2hat")
    frequency, fluid = get.size("frequency_Hz"), Fluid(get.size("rho"), get.size("nu"))
    sweep = math.radians(get.size("stroke_pp_deg"))
    root, axis = get.number("root_offset_m"), get.number("pitch_axis_chord")
    # as the source: R2 is counted from the root
    speed = 2.0 * sweep * frequency * r2 * span
    force = 0.5 * fluid.density * speed**2 * span * chord
    log = read_log(folder / str(case["log"]), frequency) if "log" in case else None
    lift, drag = (_forces(get, key, log, force) for key in ("CL", "CD"))
    means = [
        get.size(f"{key}_mean") if f"{key}_mean" in case or log is None else float(series[0])
        for key, series in (("CL", lift), ("CD", drag))
    ]
    return Measured(
        name=str(case.get("id", number)),
        wing=Wing.beta(span, chord, get.size("r1hat"), r2, root, axis),
        stroke=log.stroke if log else _motion(frequency, get.series("phi"), get.series("theta")),
        fluid=fluid,
        reynolds=get.size("Re"),
        reference_force=force,
        lift=lift,
        drag=drag,
        mean_lift=means[0],
        mean_drag=means[1],
        notices=log.notices if log else (),
    )


def _forces(get: _Reader, key: str, log: RigLog | None, force: float) -> Array:
    """A coefficient's Fourier series: of the file, or of a log's column in [N]."""
    name = _COLUMNS[key]
    if key in get.case or log is None:
        return get.series(key)
    if name not in log.columns:
        raise ValueError(f"{get.owner}: {key} must be given, or a column {name} in the log")
    course = log.course(name)
    pairs = np.stack([course.cos, course.sin], axis=1).ravel()
    return np.asarray(np.concatenate([[course.mean], pairs]) / force)


@dataclass(frozen=True)
class _Reader:
    owner: str
    case: dict[str, Any]

    def _value(self, key: str) -> Any:
        if key not in self.case:
            raise ValueError(f"{self.owner}: {key} must be given")
        return self.case[key]

    def number(self, key: str) -> float:
        return check.finite(self.owner, key, self._value(key))

    def size(self, key: str) -> float:
        return check.positive(self.owner, key, self._value(key))

    def series(self, key: str) -> Array:
        """a0, a1, b1, ...: an odd number of them."""
        values = check.array(self.owner, key, self._value(key), most_length=401)
        if values.size % 2 == 0:
            raise check.fail(self.owner, key, "a0 and then pairs a, b: an odd number", values.size)
        return values


def _motion(frequency: float, sweep: Array, pitch: Array) -> FourierStroke:
    size = max(sweep.size, pitch.size)
    phi, theta = (np.radians(np.pad(x, (0, size - x.size))) for x in (sweep, pitch))
    cos = [tuple(x[1::2].tolist()) for x in (phi, theta)]
    sin = [tuple(x[2::2].tolist()) for x in (phi, theta)]
    return FourierStroke(
        frequency, cos[0], sin[0], cos[1], sin[1], sweep_mean=phi[0], pitch_mean=theta[0]
    )


def history(coefficients: Array, phase: Array) -> Array:
    """The Fourier series a0, a1, b1, ... at phases t/T."""
    order = np.arange(1, coefficients.size // 2 + 1)
    angle = 2.0 * np.pi * np.outer(phase, order)
    waves = np.cos(angle) @ coefficients[1::2] + np.sin(angle) @ coefficients[2::2]
    return np.asarray(coefficients[0] + waves)
