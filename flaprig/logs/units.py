"""Names and units of columns, as labs write them: time_s, Time [ms], phi (deg), sweep_count."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import StrEnum
from math import pi

# seconds by unit
TIME_UNITS = {
    **dict.fromkeys(("s", "sec", "secs", "second", "seconds"), 1.0),
    **dict.fromkeys(("ms", "msec", "msecs", "millis", "millisecond", "milliseconds"), 1e-3),
    **dict.fromkeys(("us", "usec", "usecs", "micros", "microsecond", "microseconds"), 1e-6),
    **dict.fromkeys(("ns", "nsec", "nsecs", "nanos", "nanosecond", "nanoseconds"), 1e-9),
    **dict.fromkeys(("min", "minute", "minutes"), 60.0),
}
# radians by unit
ANGLE_UNITS = {
    **dict.fromkeys(("rad", "rads", "radian", "radians"), 1.0),
    **dict.fromkeys(("mrad", "milliradian", "milliradians"), 1e-3),
    **dict.fromkeys(("deg", "degs", "degree", "degrees", "°"), pi / 180.0),
    **dict.fromkeys(("rev", "revs", "turn", "turns", "revolution", "revolutions"), 2.0 * pi),
}
# units that mean the counts of a servo's position register
COUNT_UNITS = ("count", "counts", "tick", "ticks", "pulse", "pulses", "lsb", "unit", "units")
# what else stands in a line of units
_OTHER_UNITS = re.compile(
    r"^(-|1|%|v|a|ma|w|n|mn|nm|n m|n\*m|mnm|degc|°c|c|k|hz|kg|m|mm|m/s|rpm|text|bool)?$"
)
# letters of the symbols, and of the micro sign
_LETTERS = str.maketrans({"φ": "phi", "ϕ": "phi", "θ": "theta", "ϑ": "theta", "µ": "u", "μ": "u"})
# a unit in brackets at the end of a name
_BRACKETS = re.compile(r"^(?P<name>.*?)[\s_]*[\[({<](?P<unit>[^\])}>]*)[\])}>]\s*$")


class Quantity(StrEnum):
    """What a column holds, as far as a stroke is concerned."""

    TIME = "time"
    SWEEP = "sweep"
    PITCH = "pitch"
    DEVIATION = "deviation"


# words that name a quantity
_WORDS = {
    Quantity.TIME: {"time", "t", "timestamp", "timestamps", "stamp", "elapsed", "epoch", "zeit"},
    Quantity.SWEEP: {"sweep", "phi", "flap", "flapping", "stroke"},
    Quantity.PITCH: {"pitch", "theta", "feather", "feathering"},
    Quantity.DEVIATION: {"deviation", "dev", "elevation", "heave", "plunge"},
}
# words that may stand beside them and change nothing
_BESIDE = {
    Quantity.TIME: {"system", "unix", "ros", "log", "header", "since", "start", "host", "rel"},
    Quantity.SWEEP: {
        *("angle", "pos", "position", "actual", "act", "measured", "meas", "present"),
        *("encoder", "enc", "joint", "motor", "servo", "axis", "raw", "wing"),
    },
}


@dataclass(frozen=True)
class Column:
    """What a column's name says.

    Attributes:
        name: as the file has it.
        quantity: that it holds; None: something that a stroke does not need.
        unit: in small letters; empty where none is given.
    """

    name: str
    quantity: Quantity | None
    unit: str

    @property
    def counts(self) -> bool:
        """Whether it holds counts of a servo."""
        return self.unit in COUNT_UNITS


def column_of(name: str, unit: str = "") -> Column:
    """What a name and, where the file has one, its cell in the line of units say."""
    words, said = _split(name)
    said = said or _plain(unit).strip(" []()<>{}")
    quantity = next((q for q in Quantity if _means(words, q)), None)
    return Column(name, quantity, said)


def is_unit(cell: str) -> bool:
    """Whether a cell is a unit, as in the line s,deg,deg below the names."""
    word = _plain(cell).strip(" []()<>{}")
    return _known(word) or bool(_OTHER_UNITS.match(word))


def _known(word: str) -> bool:
    return word in TIME_UNITS or word in ANGLE_UNITS or word in COUNT_UNITS


def _plain(text: str) -> str:
    return text.strip().lower().translate(_LETTERS)


def _split(name: str) -> tuple[set[str], str]:
    """Words of a name, and its unit."""
    # sweepDeg is two words
    text, unit = _plain(re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name)), ""
    found = _BRACKETS.match(text)
    if found:
        text, unit = found["name"], found["unit"].strip()
    words = [word for word in re.split(r"[^a-z0-9°]+", text) if word]
    if not unit and len(words) > 1 and _known(words[-1]):
        unit = words.pop()
    return set(words), unit


def _means(words: set[str], quantity: Quantity) -> bool:
    """Whether the words name the quantity and nothing made of it, as a rate or a command."""
    beside = _BESIDE.get(quantity, _BESIDE[Quantity.SWEEP])
    return bool(words & _WORDS[quantity]) and not words - _WORDS[quantity] - beside
