"""One reader of a rig's records: what was logged becomes a stroke, and what was doubted a sentence.

A measured angle is never differentiated as if it were exact: the stroke is the least-squares fit of
few harmonics to all samples at their own times (harmonics.py). Only samples that hold more than
harmonics and no noise, as flaprig writes them itself, stay what they are.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.logs.arrays import read_arrays
from flaprig.logs.counts import XM430_RIG, PositionCounts
from flaprig.logs.harmonics import Fit, fit
from flaprig.logs.making import Made, make_stroke
from flaprig.logs.record import Record, record_of
from flaprig.logs.table import read_table
from flaprig.logs.text import read_text
from flaprig.strokes.fourier import FourierStroke
from flaprig.strokes.sampled import SampledStroke

Array = NDArray[np.float64]

_OWNER = "read_log"


@dataclass(frozen=True, eq=False)
class RigLog:
    """A periodic motion that a rig logged.

    Attributes:
        stroke: the motion, on the clock of the file.
        time: of the samples that it was made from, on the clock of the file, in [s]. Shape (n,).
        sweep: these samples in [rad]. Shape (n,).
        pitch: these samples in [rad]. Shape (n,).
        columns: all other columns of numbers by their name, at the same rows. Shape (n,) each.
        cycles: that the samples cover.
        harmonics: of the fits of sweep and pitch; (0, 0) where the samples are exact.
        residual_rms: root mean square of samples minus stroke, sweep and pitch, in [rad].
        fitted: how the stroke was fitted, as a sentence; empty where the samples are exact.
        doubts: what was changed, guessed, left out or doubted in the file; sentences.
    """

    stroke: FourierStroke | SampledStroke
    time: Array
    sweep: Array
    pitch: Array
    columns: dict[str, Array] = field(default_factory=dict)
    cycles: float = 1.0
    harmonics: tuple[int, int] = (0, 0)
    residual_rms: tuple[float, float] = (0.0, 0.0)
    fitted: str = ""
    doubts: tuple[str, ...] = ()

    @property
    def notices(self) -> tuple[str, ...]:
        """All that was changed, guessed, left out or doubted, the fit included; sentences."""
        return (*self.doubts, self.fitted) if self.fitted else self.doubts

    def course(self, name: str) -> Fit:
        """The periodic course of another column, fitted as the angles are.

        Args:
            name: of the column; the values are called at instants of the file's clock in [s].

        Raises:
            KeyError: there is no such column; names those that there are.
        """
        if name not in self.columns:
            raise KeyError(f"no column {name}; there are {', '.join(self.columns)}")
        values = self.columns[name]
        known = np.isfinite(values)
        return fit(self.time[known], values[known], self.stroke.frequency)

    def summary(self) -> dict[str, Any]:
        """What the log was, with SI units in the names."""
        return {
            "log_samples": int(self.time.size),
            "log_cycles": self.cycles,
            "log_frequency_Hz": self.stroke.frequency,
            "log_sweep_harmonics": self.harmonics[0],
            "log_pitch_harmonics": self.harmonics[1],
            "log_sweep_residual_rms_rad": self.residual_rms[0],
            "log_pitch_residual_rms_rad": self.residual_rms[1],
        }


def read_log(
    path: str | os.PathLike[str],
    frequency: float | None = None,
    counts: PositionCounts = XM430_RIG,
    center: bool = False,
    flip_pitch: bool = False,
    names: Sequence[str] | None = None,
) -> RigLog:
    """The motion in a rig's log as a stroke.

    The file is a table of text with one line of names, or an NPZ of named arrays. It needs time,
    sweep and pitch; units are in the names (`time_ms`, `sweep [deg]`, `pitch_count`) or in a line
    below them. Commas, semicolons, tabs or blanks stand between the cells.

    Args:
        path: of the file.
        frequency: strokes per second in [Hz]; None: found from the samples. It is checked against
            them.
        counts: how the servos count, for columns of counts.
        center: shift both angles so that the middle of their range is zero.
        flip_pitch: turn the sign of the pitch.
        names: of the columns, where the file has none or others.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: one sentence: no such table, missing columns, a motion that is not periodic,
            less than a cycle, or a frequency that the samples do not have.
    """
    if frequency is not None:
        frequency = check.positive(_OWNER, "frequency", frequency, "Hz")
    if not isinstance(counts, PositionCounts):
        raise check.fail(_OWNER, "counts", "a PositionCounts", counts)
    for name, value in (("center", center), ("flip_pitch", flip_pitch)):
        if not isinstance(value, bool):
            raise check.fail(_OWNER, name, "True or False", value)
    file = Path(path)
    try:
        record = _read(file, counts, names)
        made = make_stroke(_turned(record, flip_pitch), frequency, center)
    except ValueError as error:
        raise ValueError(f"{file}: {error}") from None
    return _log_of(made)


def _read(file: Path, counts: PositionCounts, names: Sequence[str] | None) -> Record:
    if file.suffix.lower() == ".npz":
        if not file.is_file():
            raise FileNotFoundError(2, os.strerror(2), str(file))
        return record_of(read_arrays(file, names), counts)
    text, said = read_text(file)
    record = record_of(read_table(text, names), counts)
    return Record(
        record.time,
        record.sweep,
        record.pitch,
        record.lines,
        record.columns,
        (*said, *record.notices),
    )


def _turned(record: Record, flip_pitch: bool) -> Record:
    if not flip_pitch:
        return record
    notices = (*record.notices, "the sign of the pitch was turned (flip_pitch)")
    parts = (record.time, record.sweep, -record.pitch, record.lines, record.columns, notices)
    return Record(*parts)


def _log_of(made: Made) -> RigLog:
    record = made.record
    return RigLog(
        stroke=made.stroke,
        time=record.time,
        sweep=record.sweep,
        pitch=record.pitch,
        columns=record.columns,
        cycles=made.cycles,
        harmonics=made.harmonics,
        residual_rms=made.residual_rms,
        fitted=made.words,
        doubts=record.notices,
    )
