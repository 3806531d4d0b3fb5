"""One judgement of a stroke on a rig: what it needs, what is allowed, and the margin between."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from typing import Any

from flaprig import _checks as check

# units as they stand in the names of files and summaries
_SUFFIX = {
    "": "",
    "rad": "_rad",
    "rad/s": "_rad_per_s",
    "rad/s2": "_rad_per_s2",
    "rad/s3": "_rad_per_s3",
    "N m": "_Nm",
    "A": "_A",
    "W": "_W",
    "degC": "_degC",
}
# share of its bound by which a value may be beyond it: rounding
ROUNDING = 1e-9


@dataclass(frozen=True)
class Verdict:
    """What a stroke needs of one limit.

    Attributes:
        joint: sweep or pitch; empty for the whole rig.
        name: of the quantity, in words joined by underscores.
        value: what the stroke needs, in the unit.
        bound: what is allowed, of the same sign; None: the quantity is told and not judged.
        unit: SI, degC for temperatures, empty for shares.
        zero: value of which the margin is whole: the ambient temperature, mid-range of an angle.
        nearest: the same of the nearest stroke that the rig can make, where the value is that of
            a stroke that it cannot; it is told and never judged.
    """

    joint: str
    name: str
    value: float
    bound: float | None
    unit: str
    zero: float = 0.0
    nearest: float | None = None

    @property
    def margin(self) -> float | None:
        """What is left, as a fraction of the bound: 1 unused, 0 at the bound, negative beyond."""
        if self.bound is None:
            return None
        room = self.bound - self.zero
        if room == 0.0:
            return 0.0 if self.value == self.zero else -math.inf
        return (self.bound - self.value) / room

    @property
    def holds(self) -> bool:
        """Whether the limit is kept; a value that is not a number does not keep it."""
        return self.margin is None or self.margin >= -ROUNDING

    @property
    def key(self) -> str:
        """Joint, name and unit in one word: sweep_peak_torque_Nm."""
        return "_".join(filter(None, (self.joint, self.name))) + _SUFFIX[self.unit]

    @property
    def words(self) -> str:
        """Joint and name as people say it: sweep peak torque."""
        return f"{self.joint} {self.name}".replace("_", " ").strip()

    def summary(self) -> dict[str, Any]:
        """Value, bound, margin and verdict; the key tells the unit."""
        return {
            "value": self.value,
            "bound": self.bound,
            "margin": self.margin,
            "holds": self.holds,
            **({} if self.nearest is None else {"nearest": self.nearest}),
        }


def narrowest(verdicts: Iterable[Verdict]) -> Verdict:
    """The judged verdict with the smallest margin; one that is not a number comes first.

    Raises:
        ValueError: none is judged.
    """
    margins = [(v.margin, v) for v in verdicts if v.margin is not None]
    return min(margins, key=lambda pair: -math.inf if math.isnan(pair[0]) else pair[0])[1]


def beside(asked: Iterable[Verdict], nearest: Iterable[Verdict]) -> list[Verdict]:
    """Verdicts on the stroke asked for, with the values of the nearest one beside them."""
    return [replace(a, nearest=n.value) for a, n in zip(asked, nearest, strict=True)]


@dataclass(frozen=True)
class Tolerances:
    """How far the rig may be from the stroke that was asked for.

    Attributes:
        resolution: distance in [rad] that the servo cannot tell: where a motion within the limits
            is so near at every instant, that motion is judged in the stroke's place.
        rms_tracking: root mean square of angle reached minus angle asked for in [rad].
        peak_tracking: largest size of it in [rad].
        coefficients: change of C_L and of L/D against the stroke made exactly, as a share.

    Raises:
        ValueError: a value that is not a positive number.
    """

    # one count of the rig's encoders, 4096 a turn: ROBOTIS e-Manual, XM430-W350, resolution
    resolution: float = 2.0 * math.pi / 4096.0
    # one degree: of pitch amplitude it moves L/D by 2.8 % (vortex lattice: 0.47, 0.76 and 1.10 at
    # 30, 45 and 60 degrees)
    rms_tracking: float = math.radians(1.0)
    # three times as much, as of a normal spread
    peak_tracking: float = math.radians(3.0)
    # the size of a learned gain is 20 %; a quarter of it would hide which stroke is better
    coefficients: float = 0.05

    def __post_init__(self) -> None:
        for field in fields(self):
            unit = "" if field.name == "coefficients" else "rad"
            value = check.positive("Tolerances", field.name, getattr(self, field.name), unit)
            object.__setattr__(self, field.name, value)
