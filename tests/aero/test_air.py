"""A run of the native air is copied and pickled with its wake."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from flaprig.aero.air import Air, WingLoads
from flaprig.aero.models import UVLM, AirModel, QuasiSteady
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.fluid import WATER
from flaprig.native import _native
from flaprig.strokes import SunTangStroke
from flaprig.wing import RIG_WING

STEPS = 60
STROKE = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.3, 0.3)
MOTION = RigidMotion.from_stroke(STROKE.motion(STROKE.period / STEPS * np.arange(2 * STEPS)))
UNSTEADY = UVLM(chordwise=3, spanwise=4, steps_per_cycle=STEPS)
MODELS = {
    "uvlm": UNSTEADY,
    "second order, lagging": replace(UNSTEADY, rate="second_order", circulation_lag=0.3),
    "old wake": replace(UNSTEADY, wake_detail=0.1),
    "quasi_steady": QuasiSteady(),
}
WAYS: dict[str, Callable[[Any], Any]] = {
    "copy": copy.copy,
    "deepcopy": copy.deepcopy,
    "pickle": lambda it: pickle.loads(pickle.dumps(it)),
}


def flown(air: Air, first: int, last: int) -> WingLoads:
    return air.run(MOTION.part(slice(first, last)), STROKE.period / STEPS)


@pytest.mark.parametrize("model", MODELS.values(), ids=MODELS)
@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_copy_continues_bit_for_bit_and_alone(way: Callable[[Any], Any], model: AirModel) -> None:
    air = Air(RIG_WING, WATER, model, STROKE.frequency, STROKE.sweep_amplitude)
    flown(air, 0, 70)
    twin = way(air)
    kept = twin.state.copy()
    ours = flown(air, 70, 120)
    np.testing.assert_array_equal(twin.state, kept)
    theirs = flown(twin, 70, 120)
    np.testing.assert_array_equal(theirs.total, ours.total)
    np.testing.assert_array_equal(twin.state, air.state)


@pytest.mark.parametrize("way", WAYS.values(), ids=WAYS)
def test_solver_is_made_again_from_its_attributes(way: Callable[[Any], Any]) -> None:
    attributes = UNSTEADY.attributes(RIG_WING, WATER, 0.2) | {"wind": "1 0 0"}
    solver = _native.Air("flaprig.uvlm", attributes)
    twin = way(solver)
    assert type(twin) is _native.Air
    assert twin.state_size == solver.state_size
    np.testing.assert_array_equal(twin.lattice, solver.lattice)
    motion = MOTION.part(slice(0, 40))
    given = (motion.position, motion.rotation, motion.twist, motion.twist_rate)
    ours, theirs = (each.run(np.zeros(each.state_size), 0.05, *given) for each in (solver, twin))
    np.testing.assert_array_equal(theirs[0], ours[0])


def test_pickle_goes_on_in_another_process() -> None:
    air = Air(RIG_WING, WATER, UNSTEADY, STROKE.frequency)
    flown(air, 0, 70)
    sent = pickle.dumps((air, MOTION.part(slice(70, 120)), STROKE.period / STEPS))
    code = (
        "import pickle, sys; air, motion, step = pickle.load(sys.stdin.buffer);"
        "sys.stdout.buffer.write(pickle.dumps(air.run(motion, step).total))"
    )
    done = subprocess.run([sys.executable, "-c", code], input=sent, capture_output=True, check=True)
    np.testing.assert_array_equal(pickle.loads(done.stdout), flown(air, 70, 120).total)
