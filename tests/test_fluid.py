import numpy as np
import pytest

from flaprig.fluid import AIR, WATER, Fluid


def test_water_gives_the_printed_reynolds_number():
    # equation 7 of the paper: Re = 4 f phi0 R c / nu, about 1.4e4
    reynolds = 4 * 0.2 * np.pi / 3 * 0.275 * 0.0625 / WATER.kinematic_viscosity
    assert reynolds == pytest.approx(1.4e4, rel=0.03)
    assert WATER.density == 1000.0


def test_air_is_the_standard_atmosphere():
    # ISO 2533 at sea level prints the dynamic viscosity as 1.7894e-5 Pa s
    assert AIR.dynamic_viscosity == pytest.approx(1.7894e-5, rel=1e-3)


def test_value_semantics():
    assert Fluid(1000, 1e-6) == WATER and hash(Fluid(np.float64(1000), 1e-6)) == hash(WATER)


@pytest.mark.parametrize("bad", [0, -1.0, np.nan, np.inf, 1e300, 1e-300, None, "1", True, [1], 1j])
@pytest.mark.parametrize("name", ["density", "kinematic_viscosity"])
def test_bad_fields_give_one_sentence(name, bad):
    fields = {"density": 1.0, "kinematic_viscosity": 1.0} | {name: bad}
    with pytest.raises(ValueError, match=f"^Fluid: {name} must be a .*number.*, got "):
        Fluid(**fields)


def test_wind_is_part_of_the_value():
    assert Fluid(1000, 1e-6, (0, 0, 0)) == WATER != Fluid(1000, 1e-6, (0.1, 0, 0))


@pytest.mark.parametrize("bad", [(0, 0), (0, 0, np.nan), (0, 0, 1e9), 1.0, None, "abc"])
def test_bad_wind_gives_one_sentence(bad):
    with pytest.raises(ValueError, match=r"^Fluid: wind.* must be .*, got "):
        Fluid(1000, 1e-6, bad)
