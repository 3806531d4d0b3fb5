"""The Biot-Savart kernel against a plain sum over segments, in both precisions."""

from itertools import pairwise

import numpy as np
import pytest

from flaprig.aero.models import UVLM
from flaprig.aero.simulate import simulate
from flaprig.native import _native
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING


def segment(a, b, points, core):
    """Velocity of a segment of unit circulation, core smoothed as h^2 / (h^2 + core^2)."""
    r1, r2, edge = points - a, points - b, b - a
    normal = np.cross(r1, r2)
    l1, l2 = np.linalg.norm(r1, axis=1), np.linalg.norm(r2, axis=1)
    smooth = (normal**2).sum(axis=1) + core**2 * edge @ edge
    along = (l1 + l2) * (1 - (r1 * r2).sum(axis=1) / (l1 * l2))
    return (along / smooth / (4 * np.pi))[:, None] * normal


def plain_sum(vertices, circulation, core, points):
    """Ring by ring, four segments each."""
    velocity = np.zeros_like(points)
    for i, j in np.ndindex(circulation.shape):
        corners = ((i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j), (i, j))
        for start, end in pairwise(corners):
            velocity += circulation[i, j] * segment(vertices[start], vertices[end], points, core)
    return velocity


@pytest.fixture(params=_native.kernel_names())
def kernel(request):
    """Every instruction set that this processor has."""
    before = _native.kernel_name()
    _native.use_kernel(request.param)
    yield request.param
    _native.use_kernel(before)


@pytest.fixture
def sheet(kernel):
    rng = np.random.default_rng(1)
    grid = np.stack(np.meshgrid(np.arange(8.0), np.arange(5.0), [0.0], indexing="ij"), -1)[:, :, 0]
    vertices = grid + 0.3 * rng.standard_normal(grid.shape)
    return vertices, rng.standard_normal((7, 4)), rng.uniform(-3, 9, (131, 3))


@pytest.mark.parametrize("core", [1e-6, 0.2])
def test_double_against_a_plain_sum(sheet, core):
    vertices, circulation, points = sheet
    expected = plain_sum(vertices, circulation, core, points)
    ours = _native.sheet_velocity(vertices, circulation, core, points)
    np.testing.assert_allclose(ours, expected, atol=1e-12 * np.abs(expected).max())


def test_single_against_double(sheet):
    vertices, circulation, points = sheet
    double = _native.sheet_velocity(vertices, circulation, 0.15, points)
    single = _native.sheet_velocity(vertices, circulation, 0.15, points, single=True)
    error = np.abs(single - double).max() / np.abs(double).max()
    assert 0 < error < 1e-5


def test_single_is_good_far_away_and_far_out(sheet):
    vertices, circulation, points = sheet
    # a far field is a small difference of edges: relative to what single edges give
    far = 30.0 * points
    double = _native.sheet_velocity(vertices, circulation, 0.15, far)
    single = _native.sheet_velocity(vertices, circulation, 0.15, far, single=True)
    near = np.abs(_native.sheet_velocity(vertices, circulation, 0.15, points)).max()
    assert np.abs(single - double).max() < 1e-6 * near


def test_single_is_good_on_the_edges_themselves(kernel):
    """A vertex of the wake may lie on any edge but for rounding: nothing is flung away there."""
    rng = np.random.default_rng(3)
    for _ in range(200):
        vertices, along = rng.uniform(-2, 2, (2, 2, 3)), rng.uniform(0, 1, (2000, 1))
        points = vertices[0, 0] + along * (vertices[0, 1] - vertices[0, 0])
        double, single = (
            _native.sheet_velocity(vertices, np.ones((1, 1)), 0.15, points, s)
            for s in (False, True)
        )
        np.testing.assert_allclose(single, double, atol=1e-3)


@pytest.mark.parametrize("single", [False, True])
def test_threads_are_bit_identical(sheet, single):
    vertices, circulation, _ = sheet
    points = np.random.default_rng(2).uniform(-3, 9, (1000, 3))
    one, four = (
        _native.sheet_velocity(vertices, circulation, 0.2, points, single, n) for n in (1, 4)
    )
    np.testing.assert_array_equal(one, four)


@pytest.mark.parametrize("count", [0, 1, 63, 64, 65, 128])
def test_any_number_of_points(sheet, count):
    vertices, circulation, points = sheet
    all_of_them = _native.sheet_velocity(vertices, circulation, 0.2, points)
    part = _native.sheet_velocity(vertices, circulation, 0.2, points[:count])
    np.testing.assert_array_equal(part, all_of_them[:count])


@pytest.mark.parametrize("single", [False, True])
def test_on_vertices_and_edges_it_is_finite(sheet, single):
    vertices, circulation, _ = sheet
    middles = 0.5 * (vertices[1:] + vertices[:-1])
    points = np.concatenate([vertices.reshape(-1, 3), middles.reshape(-1, 3)])
    velocity = _native.sheet_velocity(vertices, circulation, 0.2, points, single)
    assert np.isfinite(velocity).all()


def test_own_edges_induce_nothing(kernel):
    square = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    # beyond the end of an edge, on its line: only the other three edges are felt
    point = np.array([[0.0, 2.0, 0.0]])
    ours = _native.sheet_velocity(square, np.ones((1, 1)), 1e-6, point)
    corners = square[[0, 1, 1], [1, 1, 0]], square[[1, 1, 0], [1, 0, 0]]
    expected = sum(segment(a, b, point, 1e-6) for a, b in zip(*corners, strict=True))
    np.testing.assert_allclose(ours, expected, rtol=1e-9)


def test_unit_ring_at_its_centre(kernel):
    # a square of side 1: 2 sqrt(2) / pi at the centre, along -z for corners a b c d
    square = np.array([[[0.0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]])
    velocity = _native.sheet_velocity(square, np.ones((1, 1)), 1e-9, np.array([[0.5, 0.5, 0]]))
    np.testing.assert_allclose(velocity, [[0, 0, -2 * np.sqrt(2) / np.pi]], rtol=1e-12)


def test_wide_sheets_fling_nothing_away_at_their_own_vertices(kernel):
    """Edges a thousand lengths long: at an edge's end its direction is lost to rounding."""
    x, y = np.meshgrid(50.0 * np.arange(12), [0.0, 1000.0], indexing="ij")
    rng = np.random.default_rng(4)
    vertices = np.stack([x, y, rng.uniform(0, 5, x.shape)], -1)
    double, single = (
        _native.sheet_velocity(vertices, np.ones((11, 1)), 0.15, vertices.reshape(-1, 3), s)
        for s in (False, True)
    )
    np.testing.assert_allclose(single, double, atol=1e-3)


def test_widest_kernel_is_the_one_in_use():
    assert _native.kernel_name() == _native.kernel_names()[0]
    assert _native.kernel_names()[-1] == "128 bits"


def test_unknown_kernel_is_refused():
    with pytest.raises(ValueError, match="no kernel here is called AVX-1024"):
        _native.use_kernel("AVX-1024")


def test_peak_is_a_processors():
    """Which precision is faster is for `flaprig bench kernel`: other programs may be at work."""
    for single in (False, True):
        assert 0 < _native.fma_peak(single) < 1e14


def test_clocks_count_what_the_solver_does():
    _native.reset_clocks()
    assert not any(_native.clocks().values())
    simulate(RIG_WING, SunTangStroke(0.2, 1.0, 0.8), UVLM(2, 4, 40), cycles=1)
    found = _native.clocks()
    # nobody called the plugin
    assert found.pop("plugin") == 0.0
    assert all(seconds > 0 for seconds in found.values())


def test_empty_sheet():
    velocity = _native.sheet_velocity(np.zeros((1, 3, 3)), np.zeros((0, 2)), 0.2, np.ones((4, 3)))
    assert not velocity.any()


@pytest.mark.parametrize(
    ("vertices", "circulation", "points"),
    [((3, 3, 3), (2, 3), (1, 3)), ((3, 3, 2), (2, 2), (1, 3)), ((3, 3, 3), (2, 2), (1, 2))],
)
def test_shapes_that_disagree_are_refused(vertices, circulation, points):
    shapes = [np.zeros(s) for s in (vertices, circulation)]
    with pytest.raises(ValueError, match="vertices"):
        _native.sheet_velocity(*shapes, 0.2, np.zeros(points))
