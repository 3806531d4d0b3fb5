"""The named settings of the lattice, the law of its suction, and the coefficients of the tank."""

import math

import numpy as np
import pytest

from flaprig import HOVER_TANK, RIG_WING, UVLM, WATER, Fluid, QuasiSteady, SuctionLaw
from flaprig.aero.air_model import reynolds_number
from flaprig.native import _native


def suction_of(model, fluid=WATER, frequency=0.2, amplitude=math.pi / 3):
    return float(model.attributes(RIG_WING, fluid, frequency, amplitude)["suction_efficiency"])


def test_the_law_follows_the_reynolds_number():
    law = SuctionLaw(slope=0.5, onset=4000.0)
    assert law.efficiency(4000.0 * math.e) == pytest.approx(0.5)
    assert law.efficiency(3999.0) == law.efficiency(0.0) == 0.0
    assert law.efficiency(1e12) == 1.0
    reynolds = reynolds_number(RIG_WING, WATER, 0.2, math.pi / 3)
    # 4 f phi0 R2 c / nu: the paper's 1.4e4 is at the tip
    assert reynolds == pytest.approx(0.605 * 1.4e4, rel=0.03)
    assert suction_of(UVLM(suction_efficiency=law)) == pytest.approx(law.efficiency(reynolds))
    thick = Fluid(WATER.density, 2 * WATER.kinematic_viscosity)
    assert suction_of(UVLM(suction_efficiency=law), thick) < suction_of(
        UVLM(suction_efficiency=law)
    )


@pytest.mark.parametrize(
    ("field", "value"), [("slope", -0.1), ("slope", math.nan), ("onset", 0.0), ("onset", None)]
)
def test_a_bad_law_is_refused_by_name(field, value):
    with pytest.raises(ValueError, match=f"SuctionLaw: {field} must be"):
        SuctionLaw(**{"slope": 0.4, "onset": 4000.0, field: value})


def test_the_papers_model_is_the_default_and_has_no_additions():
    assert UVLM().circulation_lag == UVLM().side_suction_efficiency == 0.0
    assert UVLM().rate == "ramped" and UVLM().label == "UVLM"


def test_named_settings_take_changes():
    for make, label in ((UVLM.extended, "extended UVLM"), (UVLM.accurate, "accurate UVLM")):
        model = make(chordwise=5, core=0.2)
        assert (model.chordwise, model.core, model.label) == (5, 0.2, label)
        _native.check_attributes(model.plugin, model.attributes(RIG_WING, WATER, 0.2))
        with pytest.raises(ValueError, match="UVLM: chordwise must be"):
            make(chordwise=0)
    assert UVLM.extended(circulation_lag=0.3).circulation_lag == 0.3


def test_coefficients_of_the_tank_are_their_formula():
    model = QuasiSteady(HOVER_TANK)
    air = _native.Air(model.plugin, model.attributes(RIG_WING, WATER, 0.2))
    for alpha in np.radians([0.0, 10.5, 45.25, 90.0, 133.3, 180.0]):
        expected = 1.54 * np.sin(2 * alpha), 0.05 + 1.34 * (1 - np.cos(2 * alpha))
        np.testing.assert_allclose(air.coefficients(alpha), expected, atol=4e-4)
