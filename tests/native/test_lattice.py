"""Where the bound rings lie, and that the matrix behind them does what it says."""

import numpy as np
import pytest

from flaprig.aero.air import Air
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.fluid import WATER
from flaprig.native import _native
from flaprig.wing import RIG_WING, Wing

SWEPT = Wing.from_table([0.0, 1.0], [1.0, 0.5], [-0.2, 0.4])


def air_of(wing, **settings):
    return Air(wing, WATER, UVLM(**settings), 1.0)


def test_rectangle_with_blunt_tips():
    corners = air_of(RIG_WING, chordwise=3, spanwise=5, tip_inset=0.0).lattice
    assert corners.shape == (4, 6, 3)
    # a quarter panel aft of the panels, the last row on the trailing edge
    along = 0.0625 * (np.array([0.25, 1.25, 2.25, 3.0]) / 3 - 0.25)
    np.testing.assert_allclose(corners[:, 0, 0], along, atol=1e-15)
    np.testing.assert_allclose(corners[0, :, 1], np.linspace(0.025, 0.275, 6), atol=1e-15)
    assert not corners[:, :, 2].any()


def test_inset_draws_in_both_tips():
    corners = air_of(RIG_WING, chordwise=2, spanwise=4, tip_inset=0.25).lattice
    width = 0.25 / 4.5
    np.testing.assert_allclose(corners[0, :, 1], 0.025 + width * (0.25 + np.arange(5)), atol=1e-15)


def test_swept_and_tapered_wing_follows_its_edges():
    corners = air_of(SWEPT, chordwise=4, spanwise=6).lattice
    r = corners[0, :, 1]
    edge, chord = -0.2 + 0.6 * r, 1 - 0.5 * r
    np.testing.assert_allclose(corners[-1, :, 0], edge + chord, atol=1e-15)
    np.testing.assert_allclose(corners[0, :, 0], edge + chord / 16, atol=1e-15)


@pytest.mark.parametrize("wing", [RIG_WING, SWEPT], ids=["rectangle", "swept"])
def test_bound_rings_cancel_the_normal_velocity(wing):
    """Without a wake the flow through every collocation point vanishes (paper, eq. 3)."""
    air = air_of(wing, chordwise=4, spanwise=5, tip_inset=0.0)
    twist = np.array([[0.3, -0.2, 0.7, 0.4, -1.1, 0.6]])
    motion = (np.zeros((1, 3)), np.eye(3)[None], twist, np.zeros((1, 6)))
    # a state of zeros: no wake yet, all circulation is from motion
    circulation = air.native.circulation(air.state, *motion)
    stations = wing.stations
    y = np.linspace(stations[0, 0], stations[-1, 0], 6)
    edge, chord = (np.interp(y, stations[:, 0], stations[:, n]) for n in (2, 1))
    middle = lambda x: 0.5 * (x[1:] + x[:-1])  # noqa: E731
    along = (np.arange(4) + 0.75) / 4
    x = middle(edge) + along[:, None] * middle(chord)
    points = np.stack([x, np.broadcast_to(middle(y), x.shape), 0 * x], -1).reshape(-1, 3)
    # the kernel wants lengths of order one: in chords, and circulation over chord alike
    c = wing.mean_chord
    induced = _native.sheet_velocity(air.lattice / c, circulation / c, 1e-9, points / c)
    normal = twist[0, 2] + twist[0, 3] * points[:, 1] - twist[0, 4] * points[:, 0]
    np.testing.assert_allclose(induced[:, 2], normal, atol=1e-10)


def test_reference_radius_is_the_wings():
    for model in (UVLM(), QuasiSteady()):
        native = Air(SWEPT, WATER, model, 1.0).native
        expected = SWEPT.radius_of_second_moment
        assert native.reference_radius == pytest.approx(expected, rel=1e-12)


def test_quasi_steady_has_no_lattice():
    air = Air(RIG_WING, WATER, QuasiSteady(), 1.0)
    for ask in (lambda: air.lattice, air.wake):
        with pytest.raises(ValueError, match="only flaprig.uvlm has a wake"):
            ask()
    with pytest.raises(ValueError, match="coefficients belong to flaprig.quasi_steady"):
        air_of(RIG_WING).native.coefficients(0.1)


def test_pointed_tip_is_fine():
    triangle = Wing.from_table([0.0, 1.0], [1.0, 0.0], [0.0, 1.0])
    for inset in (0.0, 0.25):
        mass = air_of(triangle, chordwise=3, spanwise=6, tip_inset=inset).native.added_mass
        assert np.isfinite(mass).all() and np.linalg.eigvalsh(mass).min() > 0
