"""Buoyancy of the plate: Archimedes in closed form, in `simulate` and nowhere in lift or power."""

from __future__ import annotations

import math

import numpy as np
import pytest

from flaprig import RIG_WING, WATER, Fluid, QuasiSteady, SunTangStroke, Wing, simulate
from flaprig.aero.batch import simulate_batch
from flaprig.aero.buoyancy import buoyant_energy, buoyant_force, buoyant_torque

SINUSOID = SunTangStroke(0.2, math.radians(60.0), math.radians(45.0))
STEADY = QuasiSteady(steps_per_cycle=40)


def test_force_is_the_weight_of_the_displaced_fluid() -> None:
    # 250 x 62.5 x 3 mm of water at 9.81 m/s2
    assert buoyant_force(RIG_WING, WATER) == pytest.approx(
        0.25 * 0.0625 * 0.003 * 9810.0, rel=1e-12
    )
    assert buoyant_force(RIG_WING, WATER, 0.0) == 0.0


@pytest.mark.parametrize("axis", [0.0, 0.25, 0.5, 0.9])
def test_torque_is_force_times_arm_and_the_slope_of_the_energy(axis: float) -> None:
    wing = Wing.rectangular(0.3, 0.08, 0.01, axis)
    pitch = np.linspace(-3.0, 3.0, 7)
    force = 1.3 * 9.81 * 0.3 * 0.08 * wing.thickness
    arm = (0.5 - axis) * 0.08
    torque = buoyant_torque(wing, Fluid(1.3, 1e-5), pitch)
    np.testing.assert_allclose(torque, force * arm * np.sin(pitch), atol=1e-15)
    h = 1e-5
    above, below = (buoyant_energy(wing, Fluid(1.3, 1e-5), pitch + s) for s in (h, -h))
    np.testing.assert_allclose(-(above - below) / (2.0 * h), torque, atol=1e-10)


def test_simulate_has_it_in_the_pitch_torque_alone() -> None:
    dry, wet = (
        simulate(RIG_WING, SINUSOID, STEADY, cycles=2, buoyancy=b).histories for b in (False, True)
    )
    assert dry.pitch_torque_buoyancy is None and "pitch_torque_buoyancy_Nm" not in dry.columns()
    share = wet.columns()["pitch_torque_buoyancy_Nm"]
    # the displaced fluid lifts the plate's centre, a quarter chord behind the pitch axis
    closed = 1000.0 * RIG_WING.volume * 9.81 * 0.015625 * np.sin(wet.pitch)
    np.testing.assert_allclose(share, closed, rtol=1e-12, atol=1e-17)
    np.testing.assert_allclose(wet.pitch_torque - dry.pitch_torque, closed, atol=1e-15)
    for name in ("lift", "drag", "power", "sweep_torque", "lift_extra", "drag_added_mass"):
        np.testing.assert_array_equal(getattr(wet, name), getattr(dry, name))


def test_a_batch_is_the_same() -> None:
    one = simulate(RIG_WING, SINUSOID, STEADY, cycles=1, buoyancy=True)
    (many,) = simulate_batch(RIG_WING, [SINUSOID], STEADY, cycles=1, buoyancy=True)
    np.testing.assert_array_equal(one.pitch_torque, many.pitch_torque)


@pytest.mark.parametrize("bad", [1, "true", None])
def test_only_true_or_false(bad: object) -> None:
    with pytest.raises(ValueError, match="simulate: buoyancy must be True or False"):
        simulate(RIG_WING, SINUSOID, STEADY, buoyancy=bad)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="simulate_batch: buoyancy must be True or False"):
        simulate_batch(RIG_WING, [SINUSOID], STEADY, buoyancy=bad)  # type: ignore[arg-type]
