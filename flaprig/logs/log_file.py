"""Reads what a rig logged: times, angles and, where there are any, forces; checks their units.

CSV with one line of names: time_s, then sweep and pitch each with its unit, _rad or _deg, then any
other columns of numbers, for instance lift_N. Lines that begin with # are left out.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import make_interp_spline

from flaprig import _checks as check
from flaprig.strokes.sampled import LEAST_SAMPLES, MOST_SAMPLES, SampledStroke

Array = NDArray[np.float64]

# largest angle of a column in radians [rad]: half a turn; more is an angle in degrees
MOST_ANGLE = np.pi
# largest angle of a column in degrees [deg]
MOST_DEGREES = 360.0
# a cycle is whole when the way back to its first sample is no longer than so many steps
STEPS_BACK = 3.0
# least way back that is asked about [rad]: encoders and noise
LEAST_BACK = 0.02
# names of columns by quantity, in the order in which they are looked for
TIME = "time_s"
ANGLES = {"sweep": ("sweep_rad", "sweep_deg"), "pitch": ("pitch_rad", "pitch_deg")}


@dataclass(frozen=True, eq=False)
class RigLog:
    """One cycle of a rig's log.

    Attributes:
        stroke: the motion that was measured.
        columns: all other columns by their name, at the stroke's samples. Arrays of shape (n,).
        cycles: whole cycles of the log that the samples are means of.
    """

    stroke: SampledStroke
    columns: dict[str, Array] = field(default_factory=dict)
    cycles: int = 1


def read_log(path: str | os.PathLike[str], frequency: float | None = None) -> RigLog:
    """The motion in a rig's log as a stroke.

    Args:
        path: of the CSV file.
        frequency: strokes per second in [Hz]. Given, the log may hold many cycles, which are
            averaged phase by phase; None: it holds exactly one, its last sample one step before
            the first comes again, or the first again.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: one sentence: missing columns, a cell that is not a finite number, time that
            does not increase, degrees given for radians, less than a cycle.
    """
    file = Path(path)
    try:
        text = file.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(f"{file}: a log must be UTF-8 text") from None
    try:
        table = _table(text)
        angles = _angles(table)
        others = {name: values for name, values in table.items() if name not in _used(table)}
        if frequency is None:
            return _one_cycle(table[TIME], angles, others)
        frequency = check.positive("read_log", "frequency", frequency, "Hz")
        return _averaged(table[TIME], angles, others, 1.0 / frequency)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None


def _table(text: str) -> dict[str, Array]:
    """Columns of numbers by name; time increases."""
    lines = [
        (number, line)
        for number, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise ValueError("a log must have a line of names, got an empty file")
    names = [name.strip() for name in lines[0][1].split(",")]
    needed = [(TIME,), *ANGLES.values()]
    missing = [" or ".join(either) for either in needed if not set(either) & set(names)]
    if missing:
        raise ValueError(f"columns missing: {', '.join(missing)}; got {', '.join(names)[:120]}")
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ValueError(f"columns must be named once, got {', '.join(twice)} again")
    rows = [_row(number, line, names) for number, line in lines[1:]]
    if not LEAST_SAMPLES <= len(rows) <= MOST_SAMPLES:
        raise ValueError(f"a log must have {LEAST_SAMPLES} to {MOST_SAMPLES} rows, got {len(rows)}")
    columns = dict(zip(names, np.array(rows).T, strict=True))
    late = np.flatnonzero(np.diff(columns[TIME]) <= 0.0)
    if late.size:
        raise ValueError(
            f"line {lines[int(late[0]) + 2][0]}: {TIME} must increase, got "
            f"{columns[TIME][late[0] + 1]:.10g} after {columns[TIME][late[0]]:.10g}"
        )
    return columns


def _row(number: int, line: str, names: list[str]) -> list[float]:
    cells = line.split(",")
    if len(cells) != len(names):
        raise ValueError(f"line {number} must have {len(names)} cells, got {len(cells)}")
    values = []
    for name, cell in zip(names, cells, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = np.nan
        if not abs(value) <= check.MOST_TIME:
            raise ValueError(
                f"line {number}: {name} must be a finite number, got {cell.strip()[:40]!r}"
            )
        values.append(value)
    return values


def _used(table: dict[str, Array]) -> set[str]:
    return {TIME, *(name for either in ANGLES.values() for name in either)} & set(table)


def _angles(table: dict[str, Array]) -> dict[str, Array]:
    """Both angles in [rad]."""
    found = {}
    for angle, (radians, degrees) in ANGLES.items():
        if radians in table and degrees in table:
            raise ValueError(f"{angle} must be given once, got {radians} and {degrees}")
        name, most = (radians, MOST_ANGLE) if radians in table else (degrees, MOST_DEGREES)
        largest = float(np.abs(table[name]).max())
        if largest > most:
            hint = f" (degrees? then name the column {degrees})" if name == radians else ""
            raise ValueError(f"{name} must be within {most:.6g}, got {largest:.6g}{hint}")
        found[angle] = table[name] if name == radians else np.radians(table[name])
    return found


def _one_cycle(time: Array, angles: dict[str, Array], others: dict[str, Array]) -> RigLog:
    for name, angle in angles.items():
        back = abs(angle[0] - angle[-1])
        if back > max(STEPS_BACK * np.abs(np.diff(angle)).max(), LEAST_BACK):
            raise ValueError(
                f"a log must cover one whole cycle, but {name} ends {back:.4g} rad from where it "
                "begins (half a cycle? several, then give the frequency)"
            )
    stroke = SampledStroke(time, angles["sweep"], angles["pitch"])  # type: ignore[arg-type]
    return RigLog(stroke, others)


def _averaged(
    time: Array, angles: dict[str, Array], others: dict[str, Array], period: float
) -> RigLog:
    """Mean over all whole cycles, at equal phases."""
    step = float(np.median(np.diff(time)))
    # the last sample may lie one step before the end of a cycle
    cycles = int((time[-1] - time[0] + step) / period + 1e-6)
    if cycles < 1:
        raise ValueError(
            f"a log must cover one whole cycle of {period:.6g} s, got {time[-1] - time[0]:.6g} s"
        )
    count = int(np.clip(round(period / step), LEAST_SAMPLES, MOST_SAMPLES))
    if period / step < LEAST_SAMPLES:
        raise ValueError(
            f"a log must have {LEAST_SAMPLES} samples in a cycle, got {period / step:.3g}"
        )
    phases = np.arange(count) * period / count
    instants = time[0] + phases + period * np.arange(cycles)[:, None]

    def mean(values: Array) -> Array:
        return np.asarray(make_interp_spline(time, values, k=3)(instants).mean(axis=0))

    sweep, pitch = (mean(angle) for angle in angles.values())
    stroke = SampledStroke(time[0] + phases, sweep, pitch)  # type: ignore[arg-type]
    return RigLog(stroke, {name: mean(values) for name, values in others.items()}, cycles)
