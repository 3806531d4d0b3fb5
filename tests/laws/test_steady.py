"""Steady flight: lift, centre of pressure, suction and lift slopes."""

import numpy as np
import pytest

from flaprig import theory
from tests.laws.motions import SECTION, lattice_air, section_air, steady

ALPHA = np.radians(5.0)
# long steps: steady flow does not care, and the starting vortex is left far behind
STEP = 50.0


def section(chordwise, **settings):
    air = section_air(chordwise, STEP, 40, **settings)
    loads = air.run(steady(40, STEP, angle=ALPHA), STEP)
    return air, loads


def test_lift_of_a_section():
    air, loads = section(8)
    circulation = air.native.bound_circulation(air.state)[-1, 0]
    # Kutta-Joukowski: lift coefficient 2 pi sin(alpha); the tips cost 2 / AR, the lattice nothing
    tips = 1 - 2 / SECTION
    assert 2 * circulation == pytest.approx(2 * np.pi * np.sin(ALPHA) * tips, rel=1e-3)
    assert 2 * circulation == pytest.approx(2 * np.pi * np.sin(ALPHA), rel=0.005)
    # without leading-edge suction what is left is normal to the plate
    normal = loads.base[-1, 2] / (0.5 * SECTION)
    assert normal == pytest.approx(2 * circulation * np.cos(ALPHA), rel=1e-5)
    assert loads.added_mass[-1].max() == 0


@pytest.mark.parametrize("chordwise", [2, 8])
def test_centre_of_pressure_of_a_section(chordwise):
    loads = section(chordwise)[1]
    # the origin lies at a quarter chord, and there is no moment about it
    assert -loads.base[-1, 4] / loads.base[-1, 2] == pytest.approx(0.0, abs=2e-5)


def test_suction_tends_to_a_quarter_pi():
    exact = SECTION * theory.flat_plate_suction_per_span(1.0, 1.0, 1.0, ALPHA)
    share = {}
    for chordwise in (4, 8, 16, 32):
        loads = section(chordwise, suction_efficiency=1.0)[1]
        share[chordwise] = loads.extra[-1, 2] / exact
    # the printed equation 6 returns these of the true suction
    assert share[4] == pytest.approx(0.738, rel=0.005)
    assert share[8] == pytest.approx(0.761, rel=0.005)
    assert 2 * share[32] - share[16] == pytest.approx(np.pi / 4, rel=0.005)


def test_suction_factor_makes_it_exact():
    exact = SECTION * theory.flat_plate_suction_per_span(1.0, 1.0, 1.0, ALPHA)
    factor = {"suction_efficiency": 1.0, "suction_factor": 4 / np.pi}
    coarse, fine = (section(m, **factor)[1].extra[-1, 2] / exact for m in (16, 32))
    assert 2 * fine - coarse == pytest.approx(1.0, rel=0.005)


def test_suction_is_linear_in_its_efficiency_and_not_fed_back():
    full, half = (section(4, suction_efficiency=e)[1] for e in (1.0, 0.5))
    np.testing.assert_array_equal(full.base, half.base)
    np.testing.assert_allclose(half.extra, 0.5 * full.extra, rtol=1e-14)


def slope(aspect_ratio, spanwise, inset):
    """Lift slope per radian of a rectangle, four chords of wake a step."""
    air, alpha = lattice_air(aspect_ratio, 4, spanwise, 4.0, 25, tip_inset=inset), np.radians(1.0)
    loads = air.run(steady(25, 4.0, angle=alpha), 4.0)
    return loads.base[-1, 2] / (0.5 * aspect_ratio * alpha)


@pytest.mark.parametrize(("aspect_ratio", "expected"), [(4, 3.60), (8, 4.56)])
def test_lift_slope_of_a_rectangle(aspect_ratio, expected):
    # with the inset the error is of second order in the strips, without it of first
    coarse, fine = (slope(aspect_ratio, n, 0.25) for n in (12, 24))
    assert (4 * fine - coarse) / 3 == pytest.approx(expected, rel=0.008)
    blunt_coarse, blunt_fine = (slope(aspect_ratio, n, 0.0) for n in (12, 24))
    assert 2 * blunt_fine - blunt_coarse == pytest.approx(expected, rel=0.011)
    assert blunt_fine > fine
    assert theory.helmbold_lift_slope(aspect_ratio) > fine
