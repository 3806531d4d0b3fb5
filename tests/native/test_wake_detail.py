"""The wake's dial: young rows are exact, old ones are moved by parts and merge, nothing is lost."""

import math

import numpy as np
import pytest

from tests.laws.motions import lattice_air, steady

STEP = 0.25
LONG = 10_000


def flown(count, detail, rows=LONG, **settings):
    """A start from rest into steady flight: loads and air."""
    air = lattice_air(4, 3, 4, STEP, rows, wake_detail=detail / 100, **settings)
    return air.run(steady(count, STEP, angle=0.1), STEP).total, air


def impulse(air):
    """Sum of circulation times area vector of the frozen rings. Shape (3,)."""
    v, g = air.wake()
    first, second = v[1:, 1:] - v[:-1, :-1], v[1:, :-1] - v[:-1, 1:]
    return 0.5 * np.einsum("ij,ijk->k", g, np.cross(first, second))


def test_what_is_young_is_brute_force():
    ours, exact = flown(30, 12)[0], flown(30, 0)[0]
    np.testing.assert_array_equal(ours[:12], exact[:12])
    assert np.any(ours[20:] != exact[20:])
    np.testing.assert_allclose(ours, exact, atol=1e-3 * np.abs(exact).max())


@pytest.mark.parametrize("detail", [20, 21, 100])
def test_a_wake_that_is_dropped_young_is_brute_force(detail):
    (ours, air), (exact, brute) = flown(40, detail, rows=20), flown(40, 0, rows=20)
    np.testing.assert_array_equal(ours, exact)
    assert air.state.size == brute.state.size


@pytest.mark.parametrize("detail", [1, 3, 8])
def test_rows_grow_with_the_logarithm_of_the_steps(detail):
    for count in (2 * detail + 1, 40, 200, 400):
        rows = len(flown(count, detail)[1].wake()[1])
        kinds = max(0, math.ceil(math.log2(count / detail)) - 1)
        assert rows <= detail * (2 + kinds) + 2
        assert rows >= min(count - 1, 2 * detail)


def test_steady_flight_keeps_its_lift_and_its_sheet():
    # rows of a steady wake are alike: joining them changes nothing but the sheet's slow roll-up
    (ours, air), (exact, brute) = flown(200, 6), flown(200, 0)
    assert ours[-1, 2] == pytest.approx(exact[-1, 2], rel=1e-4)
    np.testing.assert_allclose(ours[:, 2], exact[:, 2], atol=3e-4 * exact[-1, 2])
    length = [np.linalg.norm(a.wake()[0][-1, 2] - a.wake()[0][0, 2]) for a in (air, brute)]
    assert length[0] == pytest.approx(length[1], rel=1e-2)
    assert len(air.wake()[1]) < len(brute.wake()[1]) / 5


def test_merged_rings_keep_the_impulse_of_the_wake():
    # but for the bend of the sheet at the vertices that go
    ours, exact = (impulse(flown(200, detail)[1])[2] for detail in (6, 0))
    assert ours == pytest.approx(exact, rel=5e-3)


def test_full_wake_drops_what_is_too_old():
    air = flown(300, 5, rows=60)[1]
    v, g = air.wake()
    assert len(v) == len(g) + 1 < 45
    # the last row began to be shed less than sixty steps ago, or the row it merged into did
    behind = np.linalg.norm(v[-1, 2] - v[0, 2])
    assert 0.9 * 60 * STEP < behind < 1.1 * (60 + 8) * STEP


def test_memory_goes_on_from_where_it_was_saved():
    motion = steady(120, STEP, angle=0.1)
    whole = lattice_air(4, 3, 4, STEP, LONG, wake_detail=0.06)
    parts = lattice_air(4, 3, 4, STEP, LONG, wake_detail=0.06)
    whole.run(motion, STEP)
    parts.run(motion.part(slice(0, 77)), STEP)
    saved = parts.state.copy()
    other = lattice_air(4, 3, 4, STEP, LONG, wake_detail=0.06)
    other.state[:] = saved
    other.run(motion.part(slice(77, 120)), STEP)
    np.testing.assert_array_equal(other.state, whole.state)


def test_threads_change_nothing():
    one, four = (flown(150, 8, threads=n)[1].state for n in (1, 4))
    np.testing.assert_array_equal(one, four)
