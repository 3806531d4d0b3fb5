"""The air models as frozen settings: what they refuse, and what they tell the plugins."""

import math

import numpy as np
import pytest

from flaprig.aero.coefficients import DICKINSON_1999, LEE_2016, Coefficients
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import WATER
from flaprig.native import _native
from flaprig.wing import RIG_WING

BAD_UVLM = {
    "chordwise": [0, 65, 2.5, math.nan, None],
    "spanwise": [0, 129, "8"],
    "steps_per_cycle": [3, 100_001, 10.5],
    "suction_efficiency": [-0.1, 11, math.nan],
    "suction_factor": [-1, 2.5],
    "wake_cycles": [0, -1, 101, math.inf],
    "wake_detail": [-0.1, 101, math.nan],
    "wake_fade": [-0.1, 1.1, math.nan],
    "core": [0, -0.1, 2.1, "a"],
    "shedding_fraction": [0, 1, math.nan],
    "tip_inset": [-0.1, 0.6],
    "side_suction_efficiency": [-0.1, 11, math.nan],
    "circulation_lag": [-0.1, 11, math.inf],
    "rate": ["late", None, 1],
    "precision": ["half", None, 2],
    "threads": [0, 65, 1.5],
}
BAD_QUASI_STEADY = {
    "coefficients": ["dickinson1999", None],
    "strips": [0, 1001, 1.5],
    "steps_per_cycle": [3, 100_001],
    "rotation": [1, "true", None],
    "added_mass": [0, "no"],
}


@pytest.mark.parametrize(
    ("model", "name", "value"),
    [(UVLM, n, v) for n, values in BAD_UVLM.items() for v in values]
    + [(QuasiSteady, n, v) for n, values in BAD_QUASI_STEADY.items() for v in values],
)
def test_bad_settings_are_refused_by_name(model, name, value):
    with pytest.raises(ValueError, match=f"{model.__name__}: {name} must be"):
        model(**{name: value})


def test_too_many_panels():
    with pytest.raises(ValueError, match=r"UVLM: chordwise \* spanwise must be at most 1024"):
        UVLM(chordwise=64, spanwise=17)


@pytest.mark.parametrize("model", [UVLM(), QuasiSteady(), QuasiSteady(LEE_2016)])
def test_attributes_are_the_plugins(model):
    attributes = model.attributes(RIG_WING, WATER, 0.2)
    assert set(attributes) <= set(_native.attribute_names(model.plugin))
    size = _native.check_attributes(model.plugin, attributes)
    assert (size > 0) == (model.plugin == "flaprig.uvlm")


@pytest.mark.parametrize("model", [UVLM(), QuasiSteady()])
def test_frequency_is_checked(model):
    for bad in (0.0, -1.0, math.nan):
        with pytest.raises(ValueError, match="frequency must be"):
            model.attributes(RIG_WING, WATER, bad)


def test_wake_clock_follows_the_frequency():
    attributes = UVLM(steps_per_cycle=80, wake_cycles=1.5).attributes(RIG_WING, WATER, 0.25)
    assert float(attributes["wake_step"]) == 0.05
    assert attributes["wake_rows"] == "120"


@pytest.mark.parametrize(
    "name", ["core", "wake_fade", "suction_efficiency", "shedding_fraction", "tip_inset"]
)
def test_settings_pass_to_the_last_bit(name):
    value = 0.1 + 0.2
    assert float(UVLM(**{name: value}).attributes(RIG_WING, WATER, 0.2)[name]) == value


def test_settings_of_numpy_pass_as_numbers():
    lattice = UVLM(core=np.float64(0.1), suction_efficiency=np.float32(0.5), chordwise=np.int64(3))
    for model in (lattice, QuasiSteady(LEE_2016, strips=np.int64(7))):
        attributes = model.attributes(RIG_WING, WATER, np.float64(0.2), np.float64(1.0))
        _native.check_attributes(model.plugin, attributes)


@pytest.mark.parametrize(
    ("alpha", "lift", "drag", "field"),
    [
        ([0], [1], [1], "alpha"),
        ([0, 1], [1], [1, 1], "lift"),
        ([0, 1], [1, 1], [1, math.nan], "drag"),
        ([1, 0], [1, 1], [1, 1], "alpha"),
        ([0, 0], [1, 1], [1, 1], "alpha"),
        ([-0.1, 1], [1, 1], [1, 1], "alpha"),
        ([0, 90], [1, 1], [1, 1], "alpha"),
        ([0, 1], [1, 101], [1, 1], "lift"),
    ],
)
def test_bad_tables_are_refused(alpha, lift, drag, field):
    with pytest.raises(ValueError, match=rf"Coefficients.from_table: {field}"):
        Coefficients.from_table(alpha, lift, drag)


def test_models_are_values():
    assert UVLM() == UVLM() and hash(UVLM()) == hash(UVLM())
    assert QuasiSteady(DICKINSON_1999) == QuasiSteady()
    table = Coefficients.from_table([0, 1], [1, 2], [3, 4])
    assert table == Coefficients.from_table(np.array([0, 1]), (1, 2), [3.0, 4.0])


@pytest.mark.parametrize(("chordwise", "spanwise"), [(60, 60), (64, 17), (9, 128), (33, 32)])
def test_too_many_panels_are_counted(chordwise, spanwise):
    with pytest.raises(ValueError, match=f"at most 1024, got {chordwise * spanwise}$"):
        UVLM(chordwise=chordwise, spanwise=spanwise)
