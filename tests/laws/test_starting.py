"""Sudden starts: Wagner's function, and Katz & Plotkin's own program on rectangular plates."""

import numpy as np
import pytest

from flaprig import theory
from tests.laws.motions import SECTION, lattice_air, section_air, steady, ticks

ALPHA = np.radians(1.0)
# semichords travelled
DISTANCE = np.array([1.0, 2.0, 4.0, 10.0])


def lift_from_circulation(bound, areas, step):
    """rho (U G + dG/dt) with the rate differenced backward at the tick itself. Shape (n,)."""
    rate = np.diff(bound, axis=0, prepend=0) / step
    return np.einsum("nij,ij->n", rate, areas)


def start(chordwise, fraction):
    """Share of the steady lift at DISTANCE: from loads, and from the ticks' circulation."""
    step = 1 / chordwise
    count = int(5.2 / step) + 2
    air = section_air(chordwise, step, count, shedding_fraction=fraction)
    loads, bound = ticks(air, steady(count, step, angle=ALPHA), step)
    areas = np.full((chordwise, 1), 1 / chordwise)
    areas[-1] *= 0.75  # the last ring ends at the trailing edge
    ticked = lift_from_circulation(bound, areas, step) + bound[:, -1, 0]
    scale = np.pi * np.sin(ALPHA) * np.cos(ALPHA)
    at = 2 * step * np.arange(count)
    return [np.interp(DISTANCE, at, x / scale) for x in (loads.base[:, 2] / SECTION, ticked)]


def test_wagner_from_circulation():
    # quarter rule: 0.057 above Jones at one semichord (8 panels), falling with refinement
    coarse, fine = (start(m, 0.25)[1] - theory.wagner(DISTANCE) for m in (8, 16))
    assert coarse[0] == pytest.approx(0.057, abs=0.002)
    assert np.all(fine[:3] < 0.7 * coarse[:3])
    # Jones is good to 1 %, so no smaller difference means anything
    assert np.all(np.abs(fine[2:]) < 0.01)


def test_shedding_at_a_fifth_is_the_most_accurate():
    errors = {f: np.abs(start(8, f)[1] - theory.wagner(DISTANCE))[:2] for f in (1 / 3, 0.25, 0.2)}
    assert np.all(errors[0.25] < 0.75 * errors[1 / 3])
    assert np.all(errors[0.2] < 0.75 * errors[0.25])


@pytest.mark.parametrize(
    ("fraction", "expected"),
    [(1 / 3, [0.7195, 0.7378, 0.7953, 0.8879]), (0.25, [0.6901, 0.7174, 0.7820, 0.8824])],
    ids=["third", "quarter"],
)
def test_wagner_from_loads(fraction, expected):
    # loads between ticks carry the wake's rate on from the last ticks and so lag: above Wagner
    loads = start(8, fraction)[0]
    error = loads - theory.wagner(DISTANCE)
    assert np.all(np.diff(error) < 0) and 0 < error[-1] < 0.012
    np.testing.assert_allclose(loads, expected, atol=2e-4)
    finer = start(16, fraction)[0] - theory.wagner(DISTANCE)
    assert np.all(finer[:3] < 0.7 * error[:3])


# Ut/c and C_L of Katz & Plotkin 2001, program 16, alpha 5 deg, 4 x 13 panels a semi-span
PASSED = np.array([0.25, 0.5, 1, 2, 3, 4])
PROGRAM_16 = {
    4: [0.2715, 0.2754, 0.2880, 0.3036, 0.3112, 0.3152],
    12: [0.3199, 0.3296, 0.3532, 0.3852, 0.4039, 0.4156],
}


@pytest.mark.parametrize("aspect_ratio", PROGRAM_16)
def test_sudden_acceleration_against_katz_and_plotkin(aspect_ratio):
    step, count, alpha = 1 / 16, 66, np.radians(5.0)
    # their first wake element is 0.3 U dt long, and their tips are blunt
    settings = {"tip_inset": 0.0, "shedding_fraction": 0.3 / 1.3}
    air = lattice_air(aspect_ratio, 4, 26, step, count, **settings)
    loads, bound = ticks(air, steady(count, step, angle=alpha), step)
    width = aspect_ratio / 26
    # they weigh dG/dt of a panel with the mean of its own and the ring ahead
    areas = np.full((4, 26), 0.25 * width)
    areas[-1] *= 0.5
    lift = lift_from_circulation(bound, areas, step) + width * bound[:, -1].sum(axis=1)
    scale, at = 0.5 * aspect_ratio / np.cos(alpha), step * np.arange(count)
    expected = np.array(PROGRAM_16[aspect_ratio])
    np.testing.assert_allclose(np.interp(PASSED, at, lift / scale), expected, rtol=0.0015)
    # our loads: ring areas instead of theirs, and the lag between ticks
    ours = np.interp(PASSED, at, loads.base[:, 2] / scale) / expected - 1
    assert np.all(np.abs(ours[3:]) < 0.01) and np.all((ours[:2] > 0) & (ours[:2] < 0.13))
