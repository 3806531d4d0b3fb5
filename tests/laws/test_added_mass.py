"""The fluid that moves with the plate: two-dimensional limit, rectangles, symmetry."""

import numpy as np
import pytest

from flaprig import theory
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import WATER
from flaprig.native import _native
from flaprig.wing import RIG_WING, Wing
from tests.laws.motions import SECTION, lattice_air, section_air

# rectangular plates, over pi/4 rho c^2 b: Meyerhoff 1970, as tabulated in DNV-RP-H103, table A-2
RECTANGLES = {4: 0.872, 8: 0.934}


def added_mass(wing, model=None):
    model = UVLM() if model is None else model
    return _native.Air(model.plugin, model.attributes(wing, WATER, 0.2)).added_mass


def section(chordwise):
    """Heave mass, pitch inertia about quarter chord and their coupling, per span."""
    a = section_air(chordwise, 1.0, 1).native.added_mass / SECTION
    return a[0, 0], a[2, 2], a[0, 2]


def test_heave_of_a_section():
    heave, _, _ = section(8)
    assert heave == pytest.approx(theory.added_mass_per_span(1.0, 1.0), rel=0.005)
    # ring areas make it exact for any number of panels; tips take 2.5e-7 at this aspect ratio
    assert section(2)[0] == pytest.approx(np.pi / 4, rel=1e-6)
    assert heave == pytest.approx(np.pi / 4 * (1 - 2.5e-7), rel=1e-8)


def test_pitch_of_a_section_is_second_order():
    # about quarter chord: own inertia and the mass a quarter chord aft; w_y lifts the nose
    mass, own = theory.added_mass_per_span(1.0, 1.0), theory.added_inertia_per_span(1.0, 1.0)
    exact = own + mass / 16
    for chordwise in (2, 4, 8, 16):
        _, inertia, coupling = section(chordwise)
        assert inertia / exact - 1 == pytest.approx(1 / chordwise**2, rel=2e-3)
        assert coupling / (-mass / 4) - 1 == pytest.approx(0.75 / chordwise**2, rel=2e-3)


def test_inertia_about_mid_chord():
    mass, inertia, coupling = section(8)
    about_middle = inertia - coupling**2 / mass
    assert about_middle == pytest.approx(theory.added_inertia_per_span(1.0, 1.0), rel=0.0005)


@pytest.mark.parametrize("aspect_ratio", RECTANGLES)
def test_rectangles_against_meyerhoff(aspect_ratio):
    def ratio(spanwise):
        air = lattice_air(aspect_ratio, 8, spanwise, 1.0, 1)
        return air.native.added_mass[0, 0] / (np.pi / 4 * aspect_ratio)

    coarse, fine = ratio(12), ratio(24)
    assert coarse == pytest.approx(RECTANGLES[aspect_ratio], rel=0.02)
    assert (4 * fine - coarse) / 3 == pytest.approx(RECTANGLES[aspect_ratio], rel=0.002)
    assert coarse == pytest.approx({4: 0.865312, 8: 0.922742}[aspect_ratio], rel=2e-6)


def test_tip_inset_makes_the_span_second_order():
    exact = 0.8718  # AR 4, the extrapolation of the test above

    def errors(inset):
        airs = (lattice_air(4, 4, n, 1.0, 1, tip_inset=inset) for n in (6, 12, 24))
        return [abs(a.native.added_mass[0, 0] / np.pi - exact) for a in airs]

    blunt, hough = errors(0.0), errors(0.25)
    assert blunt[1] / blunt[2] < 2.2
    assert hough[1] / hough[2] > 3.0
    assert hough[1] < 0.4 * blunt[1]


@pytest.mark.parametrize("model", [UVLM(), QuasiSteady()], ids=["uvlm", "quasi_steady"])
@pytest.mark.parametrize(
    "wing",
    [RIG_WING, Wing.beta(0.24, 0.06, 0.5), Wing.from_table([0, 1, 3], [1, 1, 0], [0, 0.5, 2])],
    ids=["rig", "beta", "swept"],
)
def test_symmetric_and_positive_definite(wing, model):
    a = added_mass(wing, model)
    np.testing.assert_array_equal(a, a.T)
    assert np.linalg.eigvalsh(a).min() > 0


def test_of_the_rig():
    # sweep 1.87e-2 and pitch 2.67e-4 kg m2 in a prototype with blunt tips and whole panel areas
    a, strips = added_mass(RIG_WING), added_mass(RIG_WING, QuasiSteady())
    assert a[1, 1] == pytest.approx(1.87e-2, rel=0.07)
    assert a[2, 2] == pytest.approx(2.67e-4, rel=0.04)
    fine = added_mass(RIG_WING, UVLM(chordwise=12, spanwise=24))
    np.testing.assert_allclose(np.diag(a), np.diag(fine), rtol=0.02)
    expected = [0.663677962, 0.0175806252, 2.56997354e-4]
    np.testing.assert_allclose(np.diag(a), expected, rtol=1e-6)
    assert strips[0, 0] == pytest.approx(1000 * np.pi / 4 * 0.0625**2 * 0.25, rel=1e-12)
    assert np.all(np.diag(strips) > np.diag(a))


def test_no_added_mass_when_switched_off():
    assert not added_mass(RIG_WING, QuasiSteady(added_mass=False)).any()
