"""Turns: who runs when, and what comes back."""

import numpy as np
import pytest

from flaprig.benchmark.growth import exponent
from flaprig.benchmark.turns import calls_for, in_turn, many, repeated


def test_one_after_the_other_in_every_turn():
    order, told = [], []
    works = {name: lambda name=name: order.append(name) for name in "AB"}
    taken = in_turn(works, 3, told.append)
    assert order == list("ABABAB")
    assert all(len(times) == 3 and (times >= 0.0).all() for times in taken.values())
    assert told == pytest.approx([1 / 6, 2 / 6, 3 / 6, 4 / 6, 5 / 6, 1.0])


def test_numbers_of_each_turn():
    numbers, told = iter(range(3)), []
    found = repeated(lambda: {"n": next(numbers)}, 3, told.append)
    np.testing.assert_array_equal(found["n"], [0, 1, 2])
    assert told[-1] == 1.0


def test_calls_fill_a_duration():
    calls = []
    # a call that takes no time is repeated many times, and one that takes long never less than once
    assert calls_for(lambda: calls.append(1), 1e-3) > 10 and len(calls) == 2
    assert calls_for(lambda: sum(range(10_000)), 1e-9) == 1
    many(lambda: calls.append(1), 5)()
    assert len(calls) == 7


def test_exponent_of_a_power():
    sizes = np.array([50.0, 100.0, 200.0, 500.0])
    assert exponent(sizes, 3.0 * sizes**2.2) == pytest.approx(2.2)
    both = exponent(sizes, np.column_stack([sizes, sizes**3]))
    np.testing.assert_allclose(both, [1.0, 3.0])
