"""From a table to a record: times and both angles in SI units, and what else the rows hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import degrees
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from flaprig.logs import angles, clock
from flaprig.logs.counts import JointCounts, PositionCounts
from flaprig.logs.numbers import lines_named
from flaprig.logs.units import ANGLE_UNITS, Column, Quantity, column_of
from flaprig.strokes.sampled import EXACT

Array = NDArray[np.float64]
Index = NDArray[np.int64]

# rows of a log
LEAST_ROWS, MOST_ROWS = 8, 2_000_000
# share of the rows that may be unusable before the file is refused
_MOST_BAD = 0.5
# a deviation of less than this is a wing that stays in its plane [rad]
_LEAST_DEVIATION = 0.005
# column of flaprig's own set points: 1 while the stroke is followed, 0 during start and stop
FOLLOWING = "following"
_SHOWN = 120


class Rows(Protocol):
    """Columns by number, whatever the file's form."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""
        ...

    @property
    def units(self) -> tuple[str, ...]:
        """Units from a line of their own, empty where there is none."""
        ...

    @property
    def lines(self) -> list[int]:
        """Number of each row in the file."""
        ...

    def numbers(self, index: int) -> Array:
        """A column, NaN where there is no number."""
        ...

    def cell(self, row: int, index: int) -> str:
        """What stands in the file."""
        ...

    def is_cut_off(self, row: int) -> bool:
        """Whether a row is shorter than the names."""
        ...


@dataclass(frozen=True, eq=False)
class Record:
    """What a rig logged, in the order of time.

    Attributes:
        time: in [s], rising. Shape (n,).
        sweep: as measured in [rad]. Shape (n,).
        pitch: as measured in [rad]. Shape (n,).
        lines: of the rows in the file. Shape (n,).
        columns: everything else that is a number, by name. Shape (n,) each.
        notices: what was changed, guessed, left out or doubted.
    """

    time: Array
    sweep: Array
    pitch: Array
    lines: Index
    columns: dict[str, Array]
    notices: tuple[str, ...]

    @property
    def exact(self) -> bool:
        """Whether the file says that its samples are exact and cover one period."""
        flags = self.columns.get(EXACT)
        return flags is not None and bool(np.all(flags == 1.0))

    def part(self, rows: slice | Index | NDArray[np.bool_]) -> Record:
        """Some of the rows."""
        return Record(
            self.time[rows],
            self.sweep[rows],
            self.pitch[rows],
            self.lines[rows],
            {name: values[rows] for name, values in self.columns.items()},
            self.notices,
        )


def record_of(table: Rows, counts: PositionCounts) -> Record:
    """The record in a table.

    Raises:
        ValueError: a column is missing or there twice, or nothing in it can be used.
    """
    columns = [column_of(*pair) for pair in zip(table.names, table.units, strict=True)]
    places = _places(table.names, columns)
    values = {quantity: table.numbers(place) for quantity, place in places.items()}
    usable, notices = _usable(table, places, values)
    others = {
        name: table.numbers(i)[usable]
        for i, name in enumerate(table.names)
        if i not in places.values() and name
    }
    lines = np.array(table.lines)[usable]

    time_column = columns[places[Quantity.TIME]]
    time, said = clock.in_seconds(
        values[Quantity.TIME][usable], time_column.unit, time_column.name, int(lines[0])
    )
    notices += said
    joints: list[Array] = []
    for joint in (Quantity.SWEEP, Quantity.PITCH):
        column = columns[places[joint]]
        own = getattr(counts, joint.value)
        angle, guessed = angles.in_radians(values[joint][usable], column, joint.value, own)
        notices += (guessed,) if guessed else ()
        joints.append(angle)
    notices += _deviations(columns, table, usable)
    raw = Record(time, joints[0], joints[1], lines, _numeric(others), tuple(notices))
    if raw.exact:
        return raw
    pair = (columns[places[Quantity.SWEEP]], columns[places[Quantity.PITCH]])
    return _cleaned(_followed(raw), time_column.name, pair, counts)


def _places(names: Sequence[str], columns: Sequence[Column]) -> dict[Quantity, int]:
    """Which column holds which quantity."""
    twice = sorted({name for name in names if name and list(names).count(name) > 1})
    if twice:
        raise ValueError(f"columns must be named once, got {', '.join(twice)} again")
    found: dict[Quantity, int] = {}
    for quantity in (Quantity.TIME, Quantity.SWEEP, Quantity.PITCH):
        fitting = [i for i, column in enumerate(columns) if column.quantity is quantity]
        if len(fitting) > 1:
            both = " and ".join(names[i] for i in fitting)
            raise ValueError(f"{quantity} must be given once, got {both}")
        if fitting:
            found[quantity] = fitting[0]
    wanted = {
        Quantity.TIME: "time_s",
        Quantity.SWEEP: "sweep_rad, sweep_deg or sweep_count",
        Quantity.PITCH: "pitch_rad, pitch_deg or pitch_count",
    }
    missing = [words for quantity, words in wanted.items() if quantity not in found]
    if missing:
        shown = ", ".join(names)[:_SHOWN]
        raise ValueError(f"columns missing: {'; '.join(missing)}; this file has {shown}")
    return found


def _usable(
    table: Rows, places: dict[Quantity, int], values: dict[Quantity, Array]
) -> tuple[NDArray[np.bool_], tuple[str, ...]]:
    """Rows in which all three are numbers, and a sentence on the others."""
    count = len(table.lines)
    if not LEAST_ROWS <= count <= MOST_ROWS:
        raise ValueError(f"a log must have {LEAST_ROWS} to {MOST_ROWS} rows, got {count}")
    good = np.all([np.isfinite(column) for column in values.values()], axis=0)
    bad = np.flatnonzero(~good)
    if not bad.size:
        return good, ()
    row = int(bad[0])
    quantity = next(q for q in values if not np.isfinite(values[q][row]))
    name, cell = table.names[places[quantity]], table.cell(row, places[quantity])
    if good.sum() < LEAST_ROWS or bad.size > _MOST_BAD * count:
        raise ValueError(
            f"line {table.lines[row]}: {name} must be a finite number, got {cell[:40]!r} "
            f"({bad.size} of {count} rows cannot be used)"
        )
    notices = []
    if bad[-1] == count - 1 and table.is_cut_off(count - 1):
        notices.append(f"line {table.lines[-1]} is cut off: it was left out")
        bad = bad[:-1]
    if bad.size:
        where = lines_named(table.lines[k] for k in bad.tolist())
        notices.append(f"{where}: {name} is no number (first {cell[:40]!r}); left out")
    return good, tuple(notices)


def _deviations(
    columns: Sequence[Column], table: Rows, usable: NDArray[np.bool_]
) -> tuple[str, ...]:
    """A third angle cannot be flown: say that it is left out."""
    said = []
    for i, column in enumerate(columns):
        if column.quantity is not Quantity.DEVIATION:
            continue
        values = table.numbers(i)[usable] * ANGLE_UNITS.get(column.unit, 1.0)
        values = values[np.isfinite(values)]
        half = 0.5 * float(np.ptp(values)) if values.size else 0.0
        if half > _LEAST_DEVIATION:
            said.append(
                f"{column.name} (amplitude {degrees(half):.3g} deg) is left out: the wing has "
                "sweep and pitch only"
            )
    return tuple(said)


def _numeric(columns: dict[str, Array]) -> dict[str, Array]:
    """Without the columns that hold no numbers at all."""
    return {name: values for name, values in columns.items() if np.isfinite(values).any()}


def _followed(record: Record) -> Record:
    """Without start and stop, where the file tells them apart itself."""
    flags = record.columns.get(FOLLOWING)
    if flags is None or not np.isin(flags, (0.0, 1.0)).all() or flags.sum() < LEAST_ROWS:
        return record
    return record.part(flags == 1.0)


def _cleaned(
    record: Record, time_name: str, columns: tuple[Column, Column], counts: PositionCounts
) -> Record:
    """In the order of time, without numbers that are no angles and without turns of an encoder."""
    notices = list(record.notices)
    good = np.ones(record.time.size, dtype=bool)
    for joint in ("sweep", "pitch"):
        kept = angles.without_strays(getattr(record, joint))
        if not kept.all():
            where = lines_named(record.lines[~kept].tolist())
            values = getattr(record, joint)
            notices.append(
                f"{where}: {joint} is far from all other angles (first "
                f"{degrees(values[~kept][0]):.4g} deg); left out as strays"
            )
        good &= kept
    record = record.part(good)
    found = clock.rising(record.time, time_name, record.lines)
    record = record.part(found.rows)
    notices += found.notices

    joints = []
    for joint, column in zip(("sweep", "pitch"), columns, strict=True):
        turn = _turn(column, getattr(counts, joint))
        angle, said = angles.unwrapped(getattr(record, joint), turn, joint, record.lines)
        notices += [said] if said else []
        notices += angles.doubts(angle, column, joint)
        joints.append(angle)
    return Record(found.time, joints[0], joints[1], record.lines, record.columns, tuple(notices))


def _turn(column: Column, counts: JointCounts) -> float:
    """What the encoder jumps by when it begins anew in [rad]."""
    if column.counts:
        return 2.0 * np.pi * (counts.highest - counts.lowest + 1) / counts.per_turn
    return 2.0 * np.pi
