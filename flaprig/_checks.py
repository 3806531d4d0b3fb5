"""Input checks shared by all rooms: each returns a clean value or raises one ValueError sentence.

Every sentence reads «owner: name must be ..., got value», so a user can find the field at once.
"""

from __future__ import annotations

import math
import numbers
import reprlib
from enum import Enum
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

# smallest and largest magnitude accepted where no narrower bound is given [any SI unit];
# far outside anything that flaps, and far inside what squares and cubes of doubles can hold
LEAST, MOST = 1e-12, 1e9
# largest time accepted [s]: seconds of the calendar still fit
MOST_TIME = 1e10

Choice = TypeVar("Choice", bound=Enum)


def fail(owner: str, name: str, allowed: str, value: Any) -> ValueError:
    """The error «owner: name must be allowed, got value», to be raised by the caller."""
    return ValueError(f"{owner}: {name} must be {allowed}, got {reprlib.repr(value)}")


def instance(owner: str, name: str, value: Any, kind: type, words: str) -> None:
    """A value of a class or a protocol, described in words; the class itself is none."""
    if isinstance(value, type) or not isinstance(value, kind):
        raise fail(owner, name, words, value)


def callback(owner: str, name: str, value: Any) -> None:
    """A function to be called with one number, or None."""
    if value is not None and (isinstance(value, type) or not callable(value)):
        raise fail(owner, name, "a function of the fraction done, or None", value)


def _real(value: Any) -> float:
    """The value as a float, or NaN when it is not one real number (a bool or a text is not)."""
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, bool | np.bool_) or not isinstance(value, numbers.Real):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.inf


def in_range(owner: str, name: str, value: Any, least: float, most: float, unit: str = "") -> float:
    """A finite number from least to most, both included, in the unit named."""
    number = _real(value)
    if not least <= number <= most:
        allowed = f"a number from {least:.6g} to {most:.6g} {unit}".rstrip()
        raise fail(owner, name, allowed, value)
    return number


def positive(owner: str, name: str, value: Any, unit: str = "", most: float = MOST) -> float:
    """A finite number above zero (and from LEAST to most), in the unit named."""
    if not _real(value) > 0.0:
        allowed = "a positive number" + (f" in {unit}" if unit else "")
        raise fail(owner, name, allowed, value)
    return in_range(owner, name, value, LEAST, most, unit)


def finite(owner: str, name: str, value: Any, unit: str = "", most: float = MOST) -> float:
    """A finite number of either sign, at most `most` in size, in the unit named."""
    return in_range(owner, name, value, -most, most, unit)


def whole(owner: str, name: str, value: Any, least: int, most: int) -> int:
    """A whole number from least to most, both included."""
    number = _real(value)
    if not (least <= number <= most and number == int(number)):
        raise fail(owner, name, f"a whole number from {least} to {most}", value)
    return int(number)


def flag(owner: str, name: str, value: Any) -> bool:
    """True or False, not a number or a text that could mean either."""
    if not isinstance(value, bool):
        raise fail(owner, name, "True or False", value)
    return value


def one_of(owner: str, name: str, value: Any, choices: type[Choice]) -> Choice:
    """A member of the enumeration, given as such or by its value."""
    try:
        return choices(value)
    except ValueError:
        allowed = "one of " + ", ".join(str(choice.value) for choice in choices)
        raise fail(owner, name, allowed, value) from None


def array(
    owner: str,
    name: str,
    value: ArrayLike,
    unit: str = "",
    least_length: int = 1,
    most_length: int = 100_000,
    length: int | None = None,
    most: float = MOST,
) -> NDArray[np.float64]:
    """A one-dimensional array of finite numbers, none larger in size than most. Shape (n,)."""
    values = _numeric(owner, name, value, unit)
    if values.ndim != 1:
        raise fail(owner, name, "a one-dimensional list, of shape (n,)", values.shape)
    size = values.size
    if length is not None and size != length:
        raise fail(owner, name, f"a list of {length} numbers", size)
    if not least_length <= size <= most_length:
        raise fail(owner, name, f"a list of {least_length} to {most_length} numbers", size)
    _all_in_range(owner, name, values, unit, most)
    return values


def times(owner: str, value: ArrayLike) -> NDArray[np.float64]:
    """Instants of any shape, all finite [s]."""
    instants = _numeric(owner, "time", value, "s")
    _all_in_range(owner, "time", instants, "s", MOST_TIME)
    return instants


def _numeric(owner: str, name: str, value: ArrayLike, unit: str) -> NDArray[np.float64]:
    """The value as float64; a text, a bool, None, a complex or a ragged list is refused."""
    allowed = "a list of numbers" + (f" in {unit}" if unit else "")
    try:
        raw = np.asarray(value)
    except (TypeError, ValueError):
        raise fail(owner, name, allowed, value) from None
    if raw.size and raw.dtype.kind not in "iuf":
        raise fail(owner, name, allowed, value)
    with np.errstate(over="ignore"):
        # a copy, so that the caller's later edits cannot reach us
        return np.array(raw, dtype=np.float64)


def _all_in_range(
    owner: str, name: str, values: NDArray[np.float64], unit: str, most: float
) -> None:
    # written so that NaN counts as outside
    outside = np.flatnonzero(~(np.abs(values) <= most))
    if outside.size:
        first = int(outside[0])
        allowed = f"a finite number of size at most {most:.6g} {unit}".rstrip()
        raise fail(owner, f"{name}[{first}]", allowed, float(values.flat[first]))
