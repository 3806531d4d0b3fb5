"""Options of the motion: a formula, a stroke file, or a rig's log."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Annotated, Any

from tyro.conf import arg

from flaprig import _checks as check
from flaprig.strokes import Stroke, SunTangStroke

# options that say how a log is read, with what they are when they are left out
_LOG = ("log_frequency", "log_counts", "log_zero", "log_columns", "center", "flip_pitch")
_FORMULA = ("frequency", "sweep_amplitude", "pitch_amplitude", "sweep_duration", "pitch_duration")


@dataclass(frozen=True)
class AskedStroke:
    """The stroke of the options.

    Attributes:
        stroke: the motion.
        notices: what its file made doubtful.
        numbers: what a log was, for the summary.
    """

    stroke: Stroke
    notices: tuple[str, ...] = ()
    numbers: dict[str, Any] = field(default_factory=dict)


@dataclass(frozen=True)
class StrokeOptions:
    """The motion: constant rates with smooth reversals, or what a stroke file or a log says.

    Attributes:
        frequency: strokes per second [Hz].
        sweep_amplitude: half of the peak-to-peak sweep [degrees].
        pitch_amplitude: half of the peak-to-peak pitch, from the vertical [degrees].
        sweep_duration: length of a sweep reversal [cycles]; 0.5 makes the sweep sinusoidal.
        pitch_duration: length of a pitch flip [cycles]; 0.5 makes the pitch sinusoidal.
        file: a stroke's JSON, or a table of measured angles with the columns time_s, sweep_deg
            and pitch_deg (or _rad, _count), instead of the five options above.
        log_frequency: strokes per second in the table [Hz]; found from it when left out.
        log_counts: of one turn, for columns of counts; 4096 when left out.
        log_zero: counts of sweep and pitch at the rig's zero; the middle of a turn when left out.
        log_columns: names of the table's columns, with commas, where it has none or others.
        center: shift both angles of the table so that their range is about zero.
        flip_pitch: turn the sign of the table's pitch.
    """

    frequency: float = 0.2
    sweep_amplitude: float = 60.0
    pitch_amplitude: float = 45.0
    sweep_duration: float = 0.5
    pitch_duration: float = 0.5
    file: Annotated[
        Path | None, arg(name="stroke", metavar="FILE", help_behavior_hint="(optional)")
    ] = None
    log_frequency: Annotated[
        float | None, arg(metavar="FLOAT", help_behavior_hint="(optional)")
    ] = None
    log_counts: Annotated[int | None, arg(metavar="INT", help_behavior_hint="(optional)")] = None
    log_zero: Annotated[
        tuple[int, int] | None, arg(metavar="INT INT", help_behavior_hint="(optional)")
    ] = None
    log_columns: Annotated[str | None, arg(metavar="NAMES", help_behavior_hint="(optional)")] = None
    center: bool = False
    flip_pitch: bool = False

    def build(self) -> Stroke:
        """The stroke alone; `read` also tells what its file made doubtful.

        Raises:
            ValueError: a value out of range, a wrong file, or a file and a formula together.
            OSError: the file cannot be read.
        """
        return self.read().stroke

    def read(self) -> AskedStroke:
        """The stroke and its notices.

        Raises:
            ValueError: a value out of range, a wrong file, or a file and a formula together.
            OSError: the file cannot be read.
        """
        if self.file is not None:
            self._refuse(_FORMULA, "with --stroke FILE")
            return self._of_file(self.file)
        self._refuse(_LOG, "unless --stroke FILE is a table of angles")
        for name in ("sweep_amplitude", "pitch_amplitude"):
            check.in_range("stroke", flag(name), getattr(self, name), 0.0, 180.0, "degrees")
        return AskedStroke(
            SunTangStroke(
                self.frequency,
                math.radians(self.sweep_amplitude),
                math.radians(self.pitch_amplitude),
                self.sweep_duration,
                self.pitch_duration,
            )
        )

    def _of_file(self, file: Path) -> AskedStroke:
        # scipy comes with it: not for --help
        from flaprig.logs import read_log
        from flaprig.strokes.formulas import is_formula, load_formula

        if is_formula(file):
            self._refuse(_LOG, "unless --stroke FILE is a table of angles")
            return AskedStroke(load_formula(file))
        names = None if self.log_columns is None else self.log_columns.split(",")
        log = read_log(
            file,
            self.log_frequency,
            counts=self._counts(),
            center=self.center,
            flip_pitch=self.flip_pitch,
            names=names,
        )
        return AskedStroke(log.stroke, log.notices, log.summary())

    def _counts(self) -> Any:
        """How the servos of the log count."""
        from flaprig.logs import XM430_RIG, JointCounts, PositionCounts

        if self.log_counts is None and self.log_zero is None:
            return XM430_RIG
        turn = XM430_RIG.sweep.per_turn if self.log_counts is None else self.log_counts
        check.whole("options", "--log-counts", turn, 4, 2**31 - 1)
        zeros = (turn // 2, turn // 2) if self.log_zero is None else self.log_zero
        # a register that counts more than one turn may have its zero anywhere
        sweep, pitch = (
            JointCounts(turn, zero, 1, min(0, zero), max(turn - 1, zero)) for zero in zeros
        )
        return PositionCounts(sweep, pitch)

    def _refuse(self, names: tuple[str, ...], when: str) -> None:
        """An option that would be ignored is an error, not a surprise."""
        for each in fields(self):
            value = getattr(self, each.name)
            if each.name in names and value != each.default:
                raise check.fail("options", flag(each.name), f"left out {when}", value)


def flag(name: str) -> str:
    """The option of a field."""
    return "--" + name.replace("_", "-")
