"""The plugin on a wing moved by hand against the same solver without MuJoCo."""

from __future__ import annotations

import math
from functools import cache

import mujoco
import numpy as np
import pytest

from flaprig.aero.models import QuasiSteady
from flaprig.aero.result import Result
from flaprig.aero.simulate import simulate
from flaprig.strokes.sun_tang import SunTangStroke
from flaprig.wing import RIG_WING
from tests.plugin.models import (
    BLADES,
    EXTENDED,
    FREQUENCY,
    LAGGING,
    LATTICE,
    SMALL,
    Array,
    document,
    instance,
    load,
    two_hinges,
    wing,
)

STROKE = SunTangStroke(
    frequency=FREQUENCY,
    sweep_amplitude=math.radians(60.0),
    pitch_amplitude=math.radians(45.0),
    sweep_duration=0.5,
    pitch_duration=0.5,
)
CYCLES = 5
AIRS = {
    "uvlm": (SMALL, LATTICE),
    "extended": (EXTENDED, LAGGING),
    "quasi_steady": (QuasiSteady(steps_per_cycle=40), BLADES),
}


@cache
def plugin_torques(name: str, substeps: int) -> Array:
    """Torques of the air about the sweep and the pitch axis, wing moved along the stroke.

    `mj_inverse` finds the joint torques that the motion needs, d->M containing the added mass;
    what the same model needs without air is taken off. `mj_step` then moves the wake on.
    """
    air, attributes = AIRS[name]
    wet, dry = load(two_hinges(attributes)), load(two_hinges(None))
    wet.opt.timestep = 1.0 / (FREQUENCY * air.steps_per_cycle * substeps)
    motion = STROKE.motion(np.arange(CYCLES * air.steps_per_cycle * substeps) * wet.opt.timestep)
    joints = [(m, mujoco.MjData(m)) for m in (wet, dry)]
    torques = np.zeros((motion.time.size, 2))
    for i in range(motion.time.size):
        needed = []
        for model, data in joints:
            data.qpos[:] = motion.sweep[i], motion.pitch[i]
            data.qvel[:] = motion.sweep_rate[i], motion.pitch_rate[i]
            data.qacc[:] = motion.sweep_acceleration[i], motion.pitch_acceleration[i]
            mujoco.mj_inverse(model, data)
            needed.append(data.qfrc_inverse.copy())
        torques[i] = needed[1] - needed[0]
        mujoco.mj_step(*joints[0])
    return torques


@cache
def prescribed(name: str, substeps: int) -> Result:
    return simulate(RIG_WING, STROKE, AIRS[name][0], cycles=CYCLES, substeps=substeps)


@pytest.mark.parametrize("substeps", [1, 2])
@pytest.mark.parametrize("name", AIRS)
def test_plugin_gives_the_loads_of_simulate(name: str, substeps: int) -> None:
    """In every cycle, chaotic or not: the same solver and the same arithmetic."""
    expected = prescribed(name, substeps).histories
    for ours, theirs in zip(
        plugin_torques(name, substeps).T,
        (expected.sweep_torque, expected.pitch_torque),
        strict=True,
    ):
        assert np.abs(theirs).max() > 1e-3
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-9 * np.abs(theirs).max())


@pytest.mark.parametrize("name", AIRS)
def test_half_the_time_step_changes_no_mean(name: str) -> None:
    """Between wake ticks the bound circulation follows the motion at every step."""
    for cycle in range(CYCLES):
        means = []
        for substeps in (1, 2):
            n = AIRS[name][0].steps_per_cycle * substeps
            part = slice(cycle * n, (cycle + 1) * n)
            rate = prescribed(name, substeps).histories.sweep_rate[part]
            means.append(np.mean(plugin_torques(name, substeps)[part, 0] * np.sign(rate)))
        assert means[1] == pytest.approx(means[0], rel=0.005)


def sliding(attributes: dict[str, str]) -> str:
    """A wing on three slides along the world's axes and a hinge, pitched by half a radian."""
    slides = "".join(f'<joint type="slide" axis="{axis}"/>' for axis in ("1 0 0", "0 1 0", "0 0 1"))
    hinge = '<joint axis="0.3 -1 0.2"/>'
    place = f'xyaxes="0 {-math.sin(0.5)} {-math.cos(0.5)} 1 0 0"'
    return document(
        instance(attributes), f"<body>{slides}<geom size='0.01'/>{wing(hinge, place=place)}</body>"
    )


def slide_forces(
    attributes: dict[str, str], velocity: Array, spin: float, steps: int = 30
) -> Array:
    """World force and hinge torque of the air on a wing that moves steadily along and turns,
    and what the plate's own inertia adds, which is the same in any steady frame.

    Shape (steps, 4).
    """
    model = load(sliding(attributes))
    model.opt.timestep = 0.02
    data, forces = mujoco.MjData(model), np.zeros((steps, 4))
    for i in range(steps):
        data.qvel[:], data.qacc[:] = (*velocity, spin), 0.0
        data.qpos[:] = i * model.opt.timestep * data.qvel
        mujoco.mj_inverse(model, data)
        forces[i] = -data.qfrc_inverse
        mujoco.mj_step(model, data)
    return forces


@pytest.mark.parametrize("spin", [0.0, 1.5])
@pytest.mark.parametrize(
    ("attributes", "tolerance"),
    [(LATTICE | {"wake_step": "0.1"}, 3e-6), (BLADES, 1e-11)],
    ids=["uvlm", "quasi_steady"],
)
def test_wind_on_a_fixed_wing_is_a_wing_moving_in_still_air(
    attributes: dict[str, str], tolerance: float, spin: float
) -> None:
    """Galileo; the roll-up of the wake is in single precision."""
    velocity = np.array([0.02, 0.3, -0.05])
    moving = slide_forces(attributes, velocity, spin)
    wind = " ".join(repr(-v) for v in velocity.tolist())
    fixed = slide_forces(attributes | {"wind": wind}, np.zeros(3), spin)
    size = np.abs(moving).max(axis=0)
    assert size[:3].max() > 0.5
    np.testing.assert_allclose(fixed / size, moving / size, rtol=0, atol=tolerance)
