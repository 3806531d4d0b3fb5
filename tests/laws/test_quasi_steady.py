"""The quasi-steady model: reference numbers, zero means, and forces computed by hand."""

import math

import numpy as np
import pytest

from flaprig.aero.air import Air
from flaprig.aero.coefficients import DICKINSON_1999, LEE_2016, Coefficients
from flaprig.aero.models import QuasiSteady
from flaprig.aero.simulate import simulate
from flaprig.fluid import WATER
from flaprig.native import _native
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING, Wing
from tests.laws.motions import FLUID, flight

# sweep and pitch durations: C_L and L/D of a prototype with the same formulas
REFERENCE = {
    (0.5, 0.5): (2.14, 0.823),
    (0.16, 0.16): (2.03, 0.985),
    (0.16, 0.5): (1.71, 0.669),
    (0.5, 0.16): (2.33, 1.025),
}
# the same today
TODAY = {
    (0.5, 0.5): (2.13741213512, 0.82326585747),
    (0.16, 0.16): (2.03085335135, 0.98492658358),
    (0.16, 0.5): (1.70852217938, 0.66932789430),
    (0.5, 0.16): (2.33201382082, 1.02487892822),
}


def stroke(sweep_duration=0.5, pitch_duration=0.5):
    return SunTangStroke(0.2, np.pi / 3, np.pi / 4, sweep_duration, pitch_duration)


def strip(motion, coefficients=DICKINSON_1999, wing=None, **settings):
    """Loads on one strip of unit chord and span, quarter-chord axis, in unit density."""
    wing = Wing.rectangular(1.0, 1.0) if wing is None else wing
    model = QuasiSteady(coefficients, strips=1, **settings)
    return Air(wing, FLUID, model, 1.0).run(motion, 0.1)


@pytest.mark.parametrize("durations", REFERENCE)
def test_reference_strokes(durations):
    result = simulate(RIG_WING, stroke(*durations), QuasiSteady(), cycles=1)
    lift, ratio = REFERENCE[durations]
    assert result.cl == pytest.approx(lift, rel=0.02)
    assert result.lift_to_drag == pytest.approx(ratio, rel=0.02)
    assert (result.cl, result.lift_to_drag) == pytest.approx(TODAY[durations], rel=1e-9)


def test_every_cycle_is_the_same():
    result = simulate(RIG_WING, stroke(), QuasiSteady(), cycles=3)
    cycles = result.lift.reshape(3, -1)
    np.testing.assert_allclose(cycles[1:], cycles[:2], atol=1e-12)


def test_rotation_and_added_mass_lift_nothing_on_average():
    # a pitch axis at mid-chord: ahead of it the added mass has a small mean, below
    wing = Wing.rectangular(0.25, 0.0625, 0.025, pitch_axis=0.5)
    h = simulate(wing, stroke(), QuasiSteady(), cycles=1).histories
    for part in (h.lift_extra, h.lift_added_mass):
        assert np.abs(part).max() > 0.02
        assert abs(part.mean()) < 1e-12


def test_mean_lift_of_added_mass_ahead_of_mid_chord():
    # normal force only: mean of -m w' sin(theta), w = -x theta_rate at mid-chord: by parts
    h = simulate(RIG_WING, stroke(), QuasiSteady(), cycles=1).histories
    assert abs(h.lift_extra.mean()) < 1e-12
    mass = np.pi / 4 * WATER.density * RIG_WING.chord[0] ** 2 * RIG_WING.span
    behind = 0.25 * RIG_WING.chord[0]
    expected = mass * behind * np.mean(h.pitch_rate**2 * np.cos(h.pitch))
    assert abs(h.lift_added_mass.mean()) == pytest.approx(expected, rel=1e-6)
    assert abs(h.lift_added_mass.mean()) < 0.02 * h.lift.mean()


@pytest.mark.parametrize("degrees", [5.0, 30.0, 90.0, 150.0])
def test_one_strip_by_hand(degrees):
    alpha = math.radians(degrees)
    load = strip(flight(np.zeros(1), 2.0, pitch=(alpha, 0, 0))).total[0]
    lift = 0.225 + 1.58 * math.sin(math.radians(2.13 * degrees - 7.20))
    drag = 1.92 - 1.55 * math.cos(math.radians(2.04 * degrees - 9.82))
    # 1/2 rho U^2 S = 2; onto the chord and the normal
    normal = 2 * (lift * math.cos(alpha) + drag * math.sin(alpha))
    chord = 2 * (drag * math.cos(alpha) - lift * math.sin(alpha))
    # centre of pressure from the leading edge, the axis a quarter chord behind that
    arm = 0.82 * alpha / math.pi + 0.05 - 0.25
    expected = [chord, 0, normal, 0.5 * normal, -arm * normal, -0.5 * chord]
    np.testing.assert_allclose(load, expected, atol=1e-12)


def test_rotation_by_hand():
    # nose up at 0.3 rad/s in flight at 2 m/s: rho pi (3/4 - x0) U w c^2 per span, at mid-chord
    motion = flight(np.zeros(1), 2.0, pitch=(0.2, 0.3, 0.0))
    load = strip(motion).extra[0]
    force = math.pi * 0.5 * 2.0 * 0.3
    np.testing.assert_allclose(load, [0, 0, force, 0.5 * force, -0.25 * force, 0], atol=1e-12)
    assert not strip(motion, rotation=False).extra.any()


def test_added_mass_by_hand():
    # heave acceleration 2, pitch acceleration 3: normal acceleration at mid-chord 2 - 3 / 4
    load = strip(flight(np.zeros(1), 0.0, (0, 0, 2.0), (0, 0, 3.0))).added_mass[0]
    mass, inertia = math.pi / 4, math.pi / 128
    force = -mass * (2.0 - 0.25 * 3.0)
    moment = -0.25 * force - inertia * 3.0
    np.testing.assert_allclose(load, [0, 0, force, 0.5 * force, moment, 0], atol=1e-12)


def test_lee_2016_by_hand():
    attributes = QuasiSteady(LEE_2016).attributes(RIG_WING, WATER, 0.2)
    reynolds = 4 * 0.2 * (math.pi / 3) * RIG_WING.radius_of_second_moment * 0.0625 / 1e-6
    assert float(attributes["reynolds"]) == pytest.approx(reynolds, rel=1e-12)
    air = _native.Air("flaprig.quasi_steady", attributes | {"reynolds": "8000"})
    rossby = RIG_WING.radius_of_second_moment / 0.0625
    scale = -0.205 * math.atan(0.587 * (rossby - 3.105)) + 0.870
    scale *= 32.9 - 32.0 * 4**-0.00361
    for alpha in (0.1, 0.785, 1.4):
        lift = (1.966 - 3.94 * 8000**-0.429) * math.sin(2 * alpha) * scale
        bracket = (1.873 - 3.14 * 8000**-0.369) * (1 - math.cos(2 * alpha))
        drag = (0.031 + 10.48 * 8000**-0.764 + bracket) * scale
        assert air.coefficients(alpha) == pytest.approx((lift, drag), rel=1e-12)


def test_fine_table_of_dickinson_is_dickinson():
    alpha = np.linspace(0, np.pi, 1000)
    lift = 0.225 + 1.58 * np.sin(np.radians(2.13 * np.degrees(alpha) - 7.20))
    drag = 1.92 - 1.55 * np.cos(np.radians(2.04 * np.degrees(alpha) - 9.82))
    table = Coefficients.from_table(alpha, lift, drag)
    ours, theirs = (
        simulate(RIG_WING, stroke(0.3, 0.3), QuasiSteady(c), cycles=1)
        for c in (table, DICKINSON_1999)
    )
    for name in ("lift", "drag", "sweep_torque", "pitch_torque"):
        expected = getattr(theirs, name)
        bound = 1e-5 * np.abs(expected).max()
        np.testing.assert_allclose(getattr(ours, name), expected, atol=bound)


def test_table_is_linear_in_between_and_held_outside():
    table = Coefficients.from_table([0.5, 1.0], [1.0, 2.0], [3.0, 5.0])
    attributes = QuasiSteady(table).attributes(RIG_WING, WATER, 0.2)
    air = _native.Air("flaprig.quasi_steady", attributes)
    for alpha, expected in ((0.1, (1, 3)), (0.5, (1, 3)), (0.75, (1.5, 4)), (2.0, (2, 5))):
        assert air.coefficients(alpha) == pytest.approx(expected, abs=1e-12)


def test_strips_converge_to_the_second_moment():
    # translation of a sweeping rectangle goes with r^2, mid-strip radii miss only width^2 / 12
    fine = simulate(RIG_WING, stroke(), QuasiSteady(strips=1000), cycles=1).cl
    for strips in (6, 24):
        coarse = simulate(RIG_WING, stroke(), QuasiSteady(strips=strips), cycles=1).cl
        missed = (RIG_WING.span / strips / RIG_WING.radius_of_second_moment) ** 2 / 12
        assert 1 - coarse / fine == pytest.approx(missed, rel=0.05)
