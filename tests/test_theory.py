import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from flaprig import theory

RHO, C, U = 1000.0, 0.0625, 0.14


def test_wagner_against_printed_values():
    expected = [0.594, 0.666, 0.762, 0.879, 0.933]
    np.testing.assert_allclose(theory.wagner([1, 2, 4, 10, 20]), expected, atol=5e-4)
    assert theory.wagner(0.0) == pytest.approx(0.5, abs=1e-15)
    assert theory.wagner(1e4) == pytest.approx(1.0, abs=1e-15)


def test_theodorsen_against_printed_values():
    expected = [0.8319 - 0.1723j, 0.7276 - 0.1886j, 0.5979 - 0.1507j, 0.5394 - 0.1003j]
    np.testing.assert_allclose(theory.theodorsen([0.1, 0.2, 0.5, 1.0]), expected, atol=6e-5)
    assert theory.theodorsen(0.0) == 1.0
    assert theory.theodorsen(1e4) == pytest.approx(0.5, abs=1e-4)
    assert theory.theodorsen(1e-9) == pytest.approx(1.0, abs=1e-7)
    # no pole and no lost phase at the ends of the doubles
    np.testing.assert_allclose(
        theory.theodorsen([5e-324, 1e-300, 1e20, 1e300]), [1, 1, 0.5, 0.5], atol=1e-7
    )


def test_theodorsen_is_the_spectrum_of_wagner():
    # Garrick 1938: C(k) = 1/2 + integral of wagner'(s) e^(-iks); Jones' fit is good to about 1 %
    def rate(s):
        return (theory.wagner(s + 1e-5) - theory.wagner(s)) / 1e-5

    for k in (0.1, 0.3, 1.0):
        parts = [
            quad(lambda s, f=f, k=k: rate(s) * f(k * s), 0, 300, limit=400)[0]
            for f in (np.cos, np.sin)
        ]
        assert abs(0.5 + parts[0] - 1j * parts[1] - theory.theodorsen(k)) < 0.015


def test_added_mass_and_inertia_against_energy_of_the_potential_flow():
    # normal motion: potential jump 2 V sqrt(b^2 - x^2); turning: W x sqrt(b^2 - x^2);
    # energy = rho / 2 * integral of jump * normal velocity
    b = 0.5 * C
    mass = quad(lambda x: RHO * 2 * np.sqrt(b**2 - x**2), -b, b)[0]
    inertia = quad(lambda x: RHO * x * np.sqrt(b**2 - x**2) * x, -b, b)[0]
    assert theory.added_mass_per_span(RHO, C) == pytest.approx(mass, rel=1e-9)
    assert theory.added_inertia_per_span(RHO, C) == pytest.approx(inertia, rel=1e-9)
    np.testing.assert_allclose(
        theory.added_mass_per_span(RHO, [1.0, 2.0]), [250 * np.pi, 1000 * np.pi]
    )


def test_added_mass_of_the_rig():
    # strips of the plate: sweep inertia about 12 times the plate's 1.53e-3 kg m2 with end effects
    strips = theory.added_mass_per_span(RHO, C) * (0.275**3 - 0.025**3) / 3
    assert strips == pytest.approx(2.13e-2, rel=0.01)
    assert 0.85 < 1.87e-2 / strips < 0.95


@given(alpha=st.floats(-1.5, 1.5), speed=st.floats(0.1, 10))
def test_suction_turns_the_normal_force_into_pure_lift(alpha, speed):
    # no drag in steady plane flow: normal force sin a = suction cos a, Kutta-Joukowski lift
    lift = np.pi * RHO * C * speed**2 * np.sin(alpha)
    suction = theory.flat_plate_suction_per_span(RHO, C, speed, alpha)
    assert suction == pytest.approx(lift * np.sin(alpha), rel=1e-12, abs=1e-12)


def test_helmbold_between_its_limits():
    np.testing.assert_allclose(theory.helmbold_lift_slope([4, 8]), [3.88, 4.91], atol=6e-3)
    assert theory.helmbold_lift_slope(1e6) == pytest.approx(2 * np.pi, rel=1e-5)
    # slender wing: Jones' pi AR / 2
    assert theory.helmbold_lift_slope(1e-6) == pytest.approx(np.pi / 2 * 1e-6, rel=1e-5)


def oscillating(w, heave, pitch, axis=0.25, speed=U):
    return theory.oscillating_aerofoil(RHO, C, speed, w, heave, pitch, axis)


def test_slow_oscillation_is_steady_lift_at_quarter_chord():
    lift, moment = oscillating(1e-9, 0.0, 0.1, axis=0.5)
    steady = np.pi * RHO * C * U**2 * 0.1
    assert lift == pytest.approx(steady, rel=1e-6)
    assert moment == pytest.approx(0.25 * C * steady, rel=1e-6)


def test_still_fluid_leaves_added_mass_and_inertia():
    w, slow = 7.0, 1e-9
    lift, moment = oscillating(w, 1.0, 0.0, axis=0.5, speed=slow)
    # heave down: lift opposes the acceleration (-w^2 down), at mid-chord
    assert lift == pytest.approx(-theory.added_mass_per_span(RHO, C) * w**2, rel=1e-6)
    assert abs(moment) < 1e-6 * abs(lift) * C
    lift, moment = oscillating(w, 0.0, 1.0, axis=0.5, speed=slow)
    assert moment == pytest.approx(theory.added_inertia_per_span(RHO, C) * w**2, rel=1e-6)
    assert abs(lift) < 1e-6 * abs(moment) / C


@given(
    w=st.floats(0, 50),
    heave=st.floats(-0.1, 0.1),
    pitch=st.floats(-0.3, 0.3),
    one=st.floats(0, 1),
    two=st.floats(0, 1),
)
def test_one_motion_seen_from_two_axes(w, heave, pitch, one, two):
    # the same plate: heave differs by the lever, lift agrees, moment shifts by lift times lever
    lever = (two - one) * C
    lift_1, moment_1 = oscillating(w, heave, pitch, one)
    lift_2, moment_2 = oscillating(w, heave + lever * pitch, pitch, two)
    scale = abs(lift_1) + 1e-6 * (1 + w**2)
    assert abs(lift_1 - lift_2) < 1e-9 * scale
    assert abs(moment_1 + lever * lift_1 - moment_2) < 1e-9 * scale


def test_pinned_oscillation():
    lift, moment = oscillating(2.0, 0.01, 0.1 + 0.05j)
    assert lift == pytest.approx(0.1424880839081 + 0.5876448053459j, rel=1e-10)
    assert moment == pytest.approx(0.003709117608208 - 0.002459762161824j, rel=1e-10)


@pytest.mark.parametrize("function", [theory.wagner, theory.theodorsen, theory.helmbold_lift_slope])
@pytest.mark.parametrize("bad", [-1.0, np.nan, np.inf, [1.0, -2.0]])
def test_bad_argument_gives_one_sentence(function, bad):
    with pytest.raises(ValueError, match=f"^{function.__name__}: .* finite and not negative"):
        function(bad)


def test_bad_oscillation_gives_one_sentence():
    with pytest.raises(ValueError, match="oscillating_aerofoil: speed must be a positive number"):
        oscillating(1.0, 0.0, 0.1, speed=0.0)
