"""Measured angles in radians: units and counts, turns of an encoder, numbers that are none."""

from __future__ import annotations

from math import degrees, pi

import numpy as np
from numpy.typing import NDArray

from flaprig.logs.counts import JointCounts
from flaprig.logs.numbers import lines_named
from flaprig.logs.units import ANGLE_UNITS, Column

Array = NDArray[np.float64]
Index = NDArray[np.int64]

# half ranges of an angle [rad] that no flapping joint has: degrees or counts were meant
_MOST_IN_RADIANS, _MOST = pi, 2.0 * pi
# a joint whose half range in degrees is below this was probably meant in radians [deg]
_LEAST_DEGREES = 2.0
# and one that moves by less than this stands still [deg]
_STILL_DEGREES = 0.3
# a number so many times the usual range away from the middle is no angle
_FAR = 4.0
# shares of the samples between which the usual range lies
_USUAL = (2.0, 98.0)
# a step of more than this share of a turn is a turn of the encoder
_TURN = 0.75


def in_radians(values: Array, column: Column, joint: str, counts: JointCounts) -> tuple[Array, str]:
    """Angles of a joint in [rad], and what was guessed about their unit.

    Args:
        values: numbers of the column. Shape (n,).
        column: what its name says.
        joint: sweep or pitch, for the words.
        counts: how the servo counts, for a column of counts.

    Raises:
        ValueError: a unit that is none of an angle.
    """
    if column.counts:
        return counts.angles(values), (
            f"{column.name} was read as counts of {counts.per_turn} a turn with the zero at "
            f"{counts.zero}"
        )
    if column.unit:
        if column.unit not in ANGLE_UNITS:
            allowed = "rad, mrad, deg, turns or counts"
            raise ValueError(f"{column.name}: the unit of {joint} must be {allowed}")
        return values * ANGLE_UNITS[column.unit], ""
    # without a unit the size decides: no joint flaps by more than a turn
    span = float(np.nanpercentile(values, 98.0) - np.nanpercentile(values, 2.0))
    if span <= 2.0 * pi:
        return values, f"{column.name} has no unit: it was read as radians"
    return np.radians(values), f"{column.name} has no unit: it was read as degrees"


def without_strays(angle: Array) -> NDArray[np.bool_]:
    """Which samples can be angles of this joint at all. Shape (n,)."""
    low, middle, high = np.percentile(angle, (_USUAL[0], 50.0, _USUAL[1]))
    room = max(_FAR * (high - low), 1e-6)
    return np.asarray(np.abs(angle - middle) <= room)


def unwrapped(angle: Array, turn: float, joint: str, lines: Index) -> tuple[Array, str]:
    """The angle without the jumps of an encoder that begins anew after a turn.

    Args:
        angle: in [rad]. Shape (n,).
        turn: what the encoder jumps by in [rad].
        joint: sweep or pitch, for the words.
        lines: of the rows in the file. Shape (n,).
    """
    jumps = np.flatnonzero(np.abs(np.diff(angle)) > _TURN * turn) + 1
    if not jumps.size:
        return angle, ""
    whole = np.unwrap(angle, period=turn)
    if np.ptp(whole) >= np.ptp(angle):
        return angle, ""
    # most samples keep the angle that the file has
    whole -= turn * np.round(np.median(whole - angle) / turn)
    return whole, (
        f"{lines_named(lines[jumps])}: {joint} jumps by a turn of the encoder; the jumps were "
        "undone"
    )


def doubts(angle: Array, column: Column, joint: str) -> tuple[str, ...]:
    """Sentences on an angle that is probably not what its header says.

    Raises:
        ValueError: an angle that can only be degrees or counts.
    """
    half = 0.5 * float(np.percentile(angle, 99.0) - np.percentile(angle, 1.0))
    if column.unit.startswith("rad") and half > _MOST_IN_RADIANS:
        raise ValueError(
            f"{column.name} must be within {pi:.6g} of its middle, got {half:.6g} (degrees? then "
            f"name the column {joint}_deg)"
        )
    if half > _MOST:
        raise ValueError(
            f"{column.name} must be within one turn of its middle, got {degrees(half):.6g} deg "
            f"(counts? then name the column {joint}_count)"
        )
    if column.unit.startswith("deg") and _STILL_DEGREES < degrees(half) < _LEAST_DEGREES:
        return (
            f"{column.name} has an amplitude of {degrees(half):.3g} deg only: radians? (then name "
            f"the column {joint}_rad)",
        )
    return ()
