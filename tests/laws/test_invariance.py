"""What the loads must not notice: mirrors, a moving frame, a turned world, a longer arm."""

from dataclasses import replace

import numpy as np
import pytest

from flaprig.aero.air import Air
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER
from flaprig.strokes import FourierStroke, SunTangStroke
from flaprig.wing import RIG_WING, Wing
from tests.laws.motions import FLUID, flight, turned

MODELS = [UVLM(chordwise=4, spanwise=6, steps_per_cycle=60), QuasiSteady(steps_per_cycle=60)]
STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.3, 0.3)
# angular velocities and moments are pseudovectors
MIRROR = np.array([1.0, 1, -1, -1, -1, 1])


def loads(motion, model):
    air = Air(RIG_WING, WATER, model, STROKE.frequency)
    return air.run(motion, STROKE.period / model.steps_per_cycle)


def one_cycle(stroke, steps):
    return stroke.motion(stroke.period / steps * np.arange(steps))


@pytest.mark.parametrize("model", MODELS, ids=["uvlm", "quasi_steady"])
def test_mirrored_stroke_gives_mirrored_loads(model):
    motion = one_cycle(STROKE, model.steps_per_cycle)
    flipped = ("sweep", "pitch", "sweep_rate", "pitch_rate")
    flipped += ("sweep_acceleration", "pitch_acceleration")
    mirror = replace(motion, **{name: -getattr(motion, name) for name in flipped})
    here, there = (loads(RigidMotion.from_stroke(m), model) for m in (motion, mirror))
    for part in ("base", "extra", "added_mass"):
        expected, ours = getattr(here, part), getattr(there, part) * MIRROR
        np.testing.assert_allclose(ours, expected, atol=1e-9 * np.abs(expected).max())
    assert np.abs(here.total).max() > 0.1


@pytest.mark.parametrize("model", MODELS, ids=["uvlm", "quasi_steady"])
def test_turned_world_gives_the_same_loads(model):
    motion = RigidMotion.from_stroke(one_cycle(STROKE, model.steps_per_cycle))
    rotation = RigidMotion.from_stroke(STROKE.motion(np.array([0.7]))).rotation[0]
    here, there = (loads(m, model).total for m in (motion, turned(motion, rotation)))
    np.testing.assert_allclose(there, here, atol=1e-5 * np.abs(here).max())


def test_shifted_world_gives_the_same_loads():
    motion = RigidMotion.from_stroke(one_cycle(STROKE, 60))
    there = replace(motion, position=motion.position + np.array([3.0, -2.0, 5.0]))
    here, shifted = (loads(m, MODELS[0]).total for m in (motion, there))
    np.testing.assert_allclose(shifted, here, atol=1e-5 * np.abs(here).max())


@pytest.mark.parametrize("model", MODELS, ids=["uvlm", "quasi_steady"])
def test_flight_in_still_air_is_a_wing_in_the_wind(model):
    time, step = 0.1 * np.arange(60), 0.1
    pitch = (0.2 + 0.1 * np.sin(time), 0.1 * np.cos(time), -0.1 * np.sin(time))
    wing, settings = Wing.rectangular(4.0, 1.0), {} if model is MODELS[1] else {"wake_step": "0.1"}
    flying = Air(wing, FLUID, model, 1.0, **settings).run(flight(time, 2.0, pitch=pitch), step)
    still = Air(wing, FLUID, model, 1.0, wind="2 0 0", **settings)
    held = still.run(flight(time, 0.0, pitch=pitch), step)
    for part in ("base", "extra", "added_mass"):
        expected = getattr(flying, part)
        np.testing.assert_allclose(
            getattr(held, part), expected, atol=1e-6 * np.abs(flying.total).max()
        )
    assert np.abs(flying.total).max() > 0.1


def test_threads_change_nothing():
    motion = RigidMotion.from_stroke(one_cycle(STROKE, 60))
    one, four = (loads(motion, replace(MODELS[0], threads=n)).total for n in (1, 4))
    np.testing.assert_array_equal(four, one)


@pytest.mark.parametrize("model", MODELS, ids=["uvlm", "quasi_steady"])
def test_scaled_rig_gives_scaled_loads(model):
    # twice the size, half the frequency: speeds stay, so forces grow by 4 and moments by 8
    big = Wing.rectangular(0.5, 0.125, 0.05)
    slow = SunTangStroke(0.1, np.pi / 3, np.pi / 4, 0.3, 0.3)
    steps = model.steps_per_cycle
    small = loads(RigidMotion.from_stroke(one_cycle(STROKE, steps)), model).total
    air = Air(big, WATER, model, 0.1)
    large = air.run(RigidMotion.from_stroke(one_cycle(slow, steps)), slow.period / steps).total
    scale = np.array([4.0, 4, 4, 8, 8, 8])
    bound = 1e-5 * np.abs(small * scale).max(axis=0) + 1e-12
    assert np.all(np.abs(large - small * scale) < bound)


def test_run_in_pieces_is_run_at_once():
    motion = RigidMotion.from_stroke(one_cycle(STROKE, 60))
    step = STROKE.period / 60
    whole, parts = (Air(RIG_WING, WATER, MODELS[0], STROKE.frequency) for _ in range(2))
    expected = whole.run(motion, step).total
    pieces = [parts.run(motion.part(s), step).total for s in (slice(0, 17), slice(17, 60))]
    np.testing.assert_array_equal(np.concatenate(pieces), expected)
    np.testing.assert_array_equal(parts.state, whole.state)


def test_no_motion_no_load():
    rest = FourierStroke(0.2, (0.0,), (0.0,), (0.0,), (0.0,))
    for model in MODELS:
        total = loads(RigidMotion.from_stroke(one_cycle(rest, 60)), model).total
        assert not total.any()
