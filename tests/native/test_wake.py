"""The wake as memory: size, beginning, shedding, convection, jumps, and broken numbers."""

from dataclasses import replace

import numpy as np
import pytest

from flaprig.aero.air import Air
from flaprig.aero.models import UVLM
from flaprig.fluid import WATER
from flaprig.native import _native
from flaprig.wing import Wing
from tests.laws.motions import flight, lattice_air, steady

STEP = 0.25
ANGLE = 0.1


def flown(count, rows=10, **settings):
    air = lattice_air(4, 3, 4, STEP, rows, **settings)
    motion = steady(count, STEP, angle=ANGLE)
    if count:
        air.run(motion, STEP)
    return air, motion


def trailing_edge(air, motion, i):
    return motion.position[i] + air.lattice[-1] @ motion.rotation[i].T


def test_state_size_is_what_the_check_says():
    for rows in (1, 10):
        air, _ = flown(0, rows)
        attributes = {"span": "4", "chord": "1", "chordwise": "3", "spanwise": "4"}
        attributes |= {"wake_rows": str(rows)}
        assert air.state.size == _native.check_attributes("flaprig.uvlm", attributes)
    assert flown(0, 11)[0].state.size - flown(0, 10)[0].state.size == 3 * 5 + 4 + 1


def test_zeros_are_no_wake():
    air, _ = flown(0)
    vertices, strengths = air.wake()
    assert vertices.shape == (0, 5, 3) and strengths.shape == (0, 4)
    air, _ = flown(1)
    vertices, strengths = air.wake()
    assert vertices.shape == (1, 5, 3) and strengths.shape == (0, 4)


@pytest.mark.parametrize("fraction", [1 / 3, 0.25, 0.2])
def test_steady_rows_lie_a_step_apart(fraction):
    # first row at f / (1 - f) of a step behind the edge, as if motion had always been steady
    air, motion = flown(6, shedding_fraction=fraction, core=2.0)
    rows = air.wake()[0]
    edge = trailing_edge(air, motion, 5)
    reach = STEP * (fraction / (1 - fraction) + np.arange(6))
    behind = rows[:, 2, 0] - edge[2, 0]
    # free convection moves rows a little, the newest least
    np.testing.assert_allclose(behind, reach, atol=0.02)
    assert behind[0] == pytest.approx(reach[0], abs=0.002)


def test_first_row_is_the_steady_one():
    air, motion = flown(1, shedding_fraction=0.25)
    expected = trailing_edge(air, motion, 0) + np.array([STEP / 3, 0, 0])
    np.testing.assert_allclose(air.wake()[0][0], expected, atol=1e-14)


def test_wind_carries_the_wake():
    wing, model = Wing.rectangular(4.0, 1.0), UVLM(chordwise=3, spanwise=4, core=2.0)
    air = Air(wing, WATER, model, 1.0, wake_step=repr(STEP), wind="1 0 0.1")
    air.run(flight(STEP * np.arange(6), 0.0), STEP)
    # the wing stands still and all rows drift away
    behind = air.wake()[0][:, 2] - air.lattice[-1, 2]
    drift = STEP * (0.5 + np.arange(6))
    np.testing.assert_allclose(behind[:, 0], drift, atol=0.02)
    np.testing.assert_allclose(behind[:, 2], 0.1 * drift, atol=0.03)


def test_without_wind_or_motion_the_wake_stays():
    air = lattice_air(4, 3, 4, STEP, 10)
    air.run(flight(STEP * np.arange(6), 0.0), STEP)
    vertices, strengths = air.wake()
    np.testing.assert_array_equal(vertices, np.broadcast_to(air.lattice[-1], (6, 5, 3)))
    assert not strengths.any()


def test_full_wake_keeps_its_length():
    air, motion = flown(25, rows=10)
    vertices, strengths = air.wake()
    assert vertices.shape == (11, 5, 3) and strengths.shape == (10, 4)
    # no row older than ten steps
    oldest = vertices[-1, 2, 0] - trailing_edge(air, motion, 24)[2, 0]
    assert oldest == pytest.approx(STEP * 10.5, abs=0.2)


def test_truncated_wake_is_the_young_part_of_a_longer_one_for_a_while():
    short, long = flown(12, rows=10)[0].wake(), flown(12, rows=20)[0].wake()
    # one step after the first row fell off only its own vortices are missed
    np.testing.assert_allclose(short[1], long[1][:10], rtol=2e-3)
    np.testing.assert_allclose(short[0][:9], long[0][:9], atol=2e-3)


def test_body_that_jumps_loses_its_wake():
    air, motion = flown(8)
    beyond = replace(motion, position=motion.position + np.array([0.0, 0.0, 3.0]))
    air.run(beyond.part(slice(7, 8)), STEP)
    assert air.wake()[1].shape == (0, 4)
    # and flies on as if it had just started
    fresh = flown(0)[0]
    fresh.run(beyond.part(slice(7, 8)), STEP)
    np.testing.assert_array_equal(air.state, fresh.state)


def test_body_that_moves_on_keeps_its_wake():
    air, motion = flown(8)
    later = replace(motion, position=motion.position - [STEP * 8, 0, 0])
    air.run(later.part(slice(0, 1)), STEP)
    assert air.wake()[1].shape == (8, 4)


@pytest.mark.parametrize("substeps", [2, 3, 7])
def test_ticks_keep_their_clock(substeps):
    # the wake step is no multiple of anything: rows follow elapsed time
    air = lattice_air(4, 3, 4, STEP, 50)
    count = 8 * substeps + 1
    air.run(steady(count, STEP / substeps, angle=ANGLE), STEP / substeps)
    assert air.wake()[1].shape == (8, 4)


def test_nan_is_told_and_does_not_crash():
    air, motion = flown(5)
    broken = replace(motion, twist=motion.twist * np.nan)
    loads = air.run(broken, STEP)
    assert np.isnan(loads.total[-1]).any()


def test_circulation_between_ticks_is_that_of_the_tick_at_the_tick():
    air, motion = flown(6)
    m = motion.part(slice(5, 6))
    at_tick = air.native.bound_circulation(air.state)
    # age one step after advance: rewind to the tick itself
    state = air.state.copy()
    state[1] = 0.0
    now = air.native.circulation(state, m.position, m.rotation, m.twist, m.twist_rate)
    np.testing.assert_allclose(now, at_tick, rtol=1e-12)


def test_wrong_shapes_are_refused():
    air, motion = flown(3)
    m = motion
    with pytest.raises(ValueError, match="state has the wrong length"):
        air.native.run(np.zeros(3), STEP, m.position, m.rotation, m.twist, m.twist_rate)
    with pytest.raises(ValueError, match="must agree in n"):
        air.native.run(air.state, STEP, m.position[:2], m.rotation, m.twist, m.twist_rate)
    with pytest.raises(ValueError, match="circulation takes one motion"):
        air.native.circulation(air.state, m.position, m.rotation, m.twist, m.twist_rate)
