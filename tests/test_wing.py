import json
import pickle

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from numpy.polynomial.legendre import leggauss

from flaprig.wing import RIG_WING, Wing

lengths = st.floats(1e-3, 10.0)
fractions = st.floats(0.0, 1.0)


@st.composite
def tables(draw):
    """A planform of 2 to 6 stations with any leading edge."""
    size = draw(st.integers(2, 6))
    numbers = st.lists(lengths, min_size=size, max_size=size)
    radius = draw(st.floats(0.0, 2.0)) + np.cumsum(draw(numbers))
    chord, edge = draw(numbers), draw(numbers)
    return Wing.from_table(radius, chord, 0.5 - np.array(edge))


def by_quadrature(wing, function):
    """Integral of function(x, y) over the planform by Gauss points, piece by piece."""
    points, weights = leggauss(4)
    total = 0.0
    for low, high in zip(wing.stations[:-1], wing.stations[1:], strict=True):
        for p, wp in zip(points, weights, strict=True):
            y, chord, edge = low + (high - low) * (p + 1) / 2
            x = edge + chord * (points + 1) / 2
            total += (high - low)[0] / 2 * wp * chord / 2 * weights @ function(x, y)
    return total


@given(span=lengths, chord=lengths, root=st.floats(0, 1), axis=fractions)
def test_rectangle_against_closed_forms(span, chord, root, axis):
    wing = Wing.rectangular(span, chord, root, axis, 0.002, 900.0)
    tip = root + span
    mass = 900.0 * 0.002 * span * chord
    assert wing.area == pytest.approx(span * chord, rel=1e-9)
    assert wing.mass == pytest.approx(mass, rel=1e-9)
    assert wing.volume == pytest.approx(mass / 900.0, rel=1e-9)
    assert wing.aspect_ratio == pytest.approx(span / chord, rel=1e-9)
    assert wing.pitch_axis == pytest.approx(axis, abs=1e-9)
    second = (tip**3 - root**3) / (3 * span)
    assert wing.radius_of_second_moment**2 == pytest.approx(second, rel=1e-6)
    assert wing.r1hat == pytest.approx(0.5, rel=1e-6)
    assert wing.r2hat == pytest.approx(np.sqrt(1 / 3), rel=1e-6)
    x, y = (0.5 - axis) * chord, 0.5 * (root + tip)
    np.testing.assert_allclose(wing.centroid, [x, y, 0.0], rtol=1e-9, atol=1e-12)
    xx, yy = x**2 + chord**2 / 12, y**2 + span**2 / 12
    zz = 0.002**2 / 12
    expected = mass * np.array([[yy + zz, -x * y, 0], [-x * y, xx + zz, 0], [0, 0, xx + yy]])
    np.testing.assert_allclose(wing.inertia, expected, rtol=1e-9, atol=1e-12 * expected.max())


@given(wing=tables())
def test_integrals_of_any_table_against_quadrature(wing):
    moments = {
        "area": by_quadrature(wing, lambda x, y: 1.0 + 0 * x),
        "xx": by_quadrature(wing, lambda x, y: x * x),
        "xy": by_quadrature(wing, lambda x, y: x * y),
        "yy": by_quadrature(wing, lambda x, y: y * y + 0 * x),
        "x": by_quadrature(wing, lambda x, y: x),
        "y": by_quadrature(wing, lambda x, y: y + 0 * x),
    }
    area = moments["area"]
    assert wing.area == pytest.approx(area, rel=1e-12)
    scale = wing.density * wing.thickness
    zz = area * wing.thickness**2 / 12
    expected = scale * np.array(
        [
            [moments["yy"] + zz, -moments["xy"], 0],
            [-moments["xy"], moments["xx"] + zz, 0],
            [0, 0, moments["xx"] + moments["yy"]],
        ]
    )
    np.testing.assert_allclose(wing.inertia, expected, rtol=1e-10, atol=1e-12 * expected.max())
    np.testing.assert_allclose(
        wing.centroid, [moments["x"] / area, moments["y"] / area, 0], rtol=1e-10, atol=1e-12
    )
    assert wing.radius_of_second_moment == pytest.approx(np.sqrt(moments["yy"] / area), rel=1e-12)


@given(wing=tables())
def test_inertia_is_that_of_a_body(wing):
    # positive, and each principal moment at most the sum of the other two
    principal = np.linalg.eigvalsh(wing.inertia)
    assert principal[0] > 0 and principal[2] <= (principal[0] + principal[1]) * (1 + 1e-12)


def test_rig_wing_is_the_papers():
    assert RIG_WING.span == pytest.approx(0.25) and RIG_WING.aspect_ratio == pytest.approx(4.0)
    assert RIG_WING.tip_radius == pytest.approx(0.275)
    # printed: R2 = 0.605 R
    assert RIG_WING.radius_of_second_moment / 0.275 == pytest.approx(0.605, abs=5e-4)
    assert RIG_WING.radius_of_second_moment / 0.275 == pytest.approx(0.60530256, abs=1e-8)
    # plate inertia in sweep (about x, theta = 0) and pitch (about y)
    assert RIG_WING.inertia[0, 0] == pytest.approx(1.53e-3, rel=3e-3)
    assert RIG_WING.inertia[1, 1] == pytest.approx(3.16e-5, rel=3e-3)
    assert RIG_WING.mass == pytest.approx(0.0553125, rel=1e-12)
    assert RIG_WING.pitch_axis == 0.25
    np.testing.assert_allclose(
        RIG_WING.stations, [[0.025, 0.0625, -0.015625], [0.275, 0.0625, -0.015625]], atol=1e-16
    )


def test_delta_wing_from_table():
    # right triangle: root chord 1, straight trailing edge, leading edge swept to the tip
    wing = Wing.from_table([0.0, 2.0], [1.0, 0.0], [-0.6, 0.4])
    assert wing.area == pytest.approx(1.0)
    np.testing.assert_allclose(wing.centroid, [0.4 - 1 / 3, 2 / 3, 0.0], rtol=1e-12)
    # triangle about its base: height^2 / 6
    assert wing.radius_of_second_moment == pytest.approx(2 / np.sqrt(6), rel=1e-12)
    np.testing.assert_allclose(wing.stations[1], [2.0, 0.0, 0.4])


@given(r1=st.floats(0.15, 0.85), blend=st.floats(0.001, 0.999), root=st.floats(0.0, 0.5))
def test_beta_reproduces_area_and_radii(r1, blend, root):
    fullest, slimmest = 1 / min(r1, 1 - r1), 6 / max(r1, 1 - r1)
    assume(fullest < slimmest)
    k = fullest + blend * (slimmest - fullest)
    r2 = np.sqrt(r1**2 + r1 * (1 - r1) / (k + 1))
    wing = Wing.beta(0.24, 0.06, r1, r2, root)
    assert wing.mean_chord == pytest.approx(0.06, rel=1e-12)
    assert wing.r1hat == pytest.approx(r1, rel=1e-10)
    assert wing.r2hat == pytest.approx(r2, rel=1e-10)
    assert wing.span == pytest.approx(0.24, rel=1e-12) and wing.root_offset == root
    assert wing.pitch_axis == pytest.approx(0.25, rel=1e-12)
    assert min(wing.chord) >= 0.0


def test_beta_chord_is_ellingtons_formula():
    # p = q = 3/2 is half an ellipse: c / mean = 8 / pi sqrt(x (1 - x)), r1 = 1/2, r2^2 = 5/16
    wing = Wing.beta(1.0, 1.0, 0.5, np.sqrt(5 / 16))
    x = np.array(wing.radius)
    ellipse = 8 / np.pi * np.sqrt(x * (1 - x))
    np.testing.assert_allclose(wing.chord, ellipse, rtol=1e-3)
    assert len(x) == 101
    # default r2: Ellington's correlation, here almost the same number
    assert Wing.beta(1.0, 1.0, 0.5).r2hat == pytest.approx(0.929 * 0.5**0.732, rel=1e-10)


def test_beta_of_measured_wings(shared):
    cases = json.loads((shared / "validation" / "measured_hover.json").read_text())["cases"]
    for case in cases:
        wing = Wing.beta(case["span_m"], case["mean_chord_m"], case["r1hat"], case["r2hat"])
        assert wing.aspect_ratio == pytest.approx(case["aspect_ratio"], rel=1e-9)
        assert Wing.beta(0.2, 0.06, case["r1hat"]).r2hat == pytest.approx(case["r2hat"], abs=1e-4)


def test_values_compare_hash_pickle_and_print():
    same = Wing.rectangular(np.float32(0.25), 0.0625, 0.025)
    assert same == RIG_WING and hash(same) == hash(RIG_WING)
    assert Wing.rectangular(0.25, 0.0625, 0.02) != RIG_WING
    assert pickle.loads(pickle.dumps(RIG_WING)) == RIG_WING
    assert repr(RIG_WING) == (
        "Wing(span=0.25 m, mean_chord=0.0625 m, root_offset=0.025 m, 2 stations)"
    )


def test_stations_are_fresh_contiguous_doubles():
    stations = RIG_WING.stations
    assert stations.flags.c_contiguous and stations.dtype == np.float64
    stations[:] = 0.0
    assert RIG_WING.stations[0, 1] == 0.0625


GOOD = {"radius": [0.0, 1.0, 2.0], "chord": [1.0, 1.0, 0.0]}


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"radius": []}, "Wing: radius must be a list of 2 to 10000 numbers, got 0"),
        ({"radius": [0.0, 2.0, 1.0]}, "Wing: radius must be in increasing order"),
        ({"radius": [0.0, 1.0, 1.0]}, "Wing: radius must be in increasing order"),
        ({"radius": [-1.0, 0.0, 1.0]}, r"Wing: radius\[0\] must be zero or positive, in m, got -1"),
        ({"radius": [0.0, np.nan, 1.0]}, r"Wing: radius\[1\] must be a finite number"),
        ({"radius": "abc"}, "Wing: radius must be a list of numbers in m, got 'abc'"),
        ({"radius": [[0.0, 1.0, 2.0]]}, r"Wing: radius must be a one-dimensional list.*\(1, 3\)"),
        ({"chord": [1.0, 1.0]}, "Wing: chord must be a list of 3 numbers, got 2"),
        ({"chord": [1.0, 0.0, 1.0]}, r"Wing: chord\[1\] must be positive in m"),
        ({"chord": [1.0, 1.0, -1.0]}, r"Wing: chord\[2\] must be positive in m"),
        ({"chord": [0.0, 0.0, 0.0]}, "Wing: chord must be at least 1e-12 m at one"),
        ({"chord": [1.0, 1e200, 1.0]}, r"Wing.from_table: chord\[1\] must be a finite number"),
        ({"chord": [1.0, None, 1.0]}, "Wing.from_table: chord must be a list of numbers"),
        ({"leading_edge": [0.0, np.inf, 0.0]}, r"Wing: leading_edge\[1\] must be a finite"),
        ({"leading_edge": [0, 0, 0], "pitch_axis": 0.25}, "pitch_axis must be left out when"),
        ({"pitch_axis": 1.5}, "Wing.from_table: pitch_axis must be a number from 0 to 1"),
        ({"thickness": 0.0}, "Wing: thickness must be a positive number in m, got 0.0"),
        ({"density": np.nan}, "Wing: density must be a positive number in kg/m3, got nan"),
    ],
)
def test_bad_table_gives_one_sentence(changes, sentence):
    with pytest.raises(ValueError, match=sentence):
        Wing.from_table(**(GOOD | changes))


@pytest.mark.parametrize("bad", [-1.0, 0.0, np.nan, np.inf, 1e300, "1", None, True, [1.0]])
@pytest.mark.parametrize("name", ["span", "chord"])
def test_bad_rectangle_gives_one_sentence(name, bad):
    with pytest.raises(ValueError, match=f"^Wing.rectangular: {name} must be a .* m, got"):
        Wing.rectangular(**({"span": 1.0, "chord": 0.1} | {name: bad}))


def test_sentence_of_the_house():
    with pytest.raises(ValueError) as caught:
        Wing.rectangular(-1.0, 0.1)
    expected = "Wing.rectangular: span must be a positive number in m, got -1.0"
    assert str(caught.value) == expected


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"r1": 0.05}, "r1 must be a number from 0.142857 to 0.857143 spans, got 0.05"),
        ({"r1": 0.3}, "r2 .by Ellington's correlation 0.929 r1.0.732. must be"),
        ({"r2": 0.5}, "r2 must be a number from 0.518875 to 0.57735 spans for r1 = 0.5"),
        ({"r2": 0.6}, "r2 must be a number from"),
        ({"r2": np.nan}, "r2 must be a number from"),
        ({"mean_chord": 0.0}, "mean_chord must be a positive number in m, got 0.0"),
        ({"root_offset": -0.1}, "root_offset must be a number from 0 to 10000 m, got -0.1"),
    ],
)
def test_bad_beta_gives_one_sentence(changes, sentence):
    with pytest.raises(ValueError, match=f"^Wing.beta: {sentence}"):
        Wing.beta(**({"span": 0.24, "mean_chord": 0.06, "r1": 0.5} | changes))


@given(
    radius=st.lists(st.floats(), max_size=4) | st.floats() | st.none() | st.text(max_size=3),
    chord=st.lists(st.floats(), max_size=4) | st.lists(st.none(), max_size=3),
    rest=st.lists(st.floats() | st.none() | st.booleans() | st.integers(), min_size=2, max_size=2),
)
def test_nothing_but_a_wing_or_a_sentence(radius, chord, rest):
    complaint = ""
    try:
        wing = Wing.from_table(radius, chord, None, 0.25, *rest)
        numbers = [*wing.inertia.ravel(), wing.mass, wing.r2hat, wing.aspect_ratio]
    except ValueError as error:
        numbers, complaint = [], str(error)
    assert np.isfinite(numbers).all()
    assert numbers or (complaint.startswith("Wing") and "\n" not in complaint)
