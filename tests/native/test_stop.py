"""Ctrl-C stops the solver wherever it is; what counts is CPU time, whatever else runs."""

from __future__ import annotations

import subprocess
import sys

import pytest

# CPU seconds from the signal to Python's exception, on all threads together
LATEST = 0.5
# the child sends itself the signal when it has computed for a while inside of the call
CHILD = """
import os, signal, threading, time
import numpy as np
from flaprig import RIG_WING, UVLM, WATER, QuasiSteady, SunTangStroke, simulate, simulate_batch
from flaprig.aero.air import Air
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.native import _native
stroke = SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.3, 0.3)
large = UVLM(chordwise=16, spanwise=32, steps_per_cycle=1000)
{setup}
# a shell starts its background jobs without Ctrl-C
signal.signal(signal.SIGINT, signal.default_int_handler)
begun = time.process_time()
def interrupt():
    while time.process_time() < begun + 1:
        time.sleep(0.01)
    global sent
    sent = time.process_time()
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt, daemon=True).start()
try:
    {call}
except KeyboardInterrupt:
    print(time.process_time() - sent)
    {after}
"""
# one call of the solver, with a state of its own
RUN = """
air = Air(RIG_WING, WATER, {model}, 0.2)
motion = RigidMotion.from_stroke(stroke.motion(0.005 * np.arange({instants})))
arrays = motion.position, motion.rotation, motion.twist, motion.twist_rate
first = tuple(array[:20] for array in arrays)
air.native.run(air.state, 0.005, *first)
before = air.state.copy()
"""
# as large as one step of a wake of 2000 rows, and larger
SHEET = """
rng = np.random.default_rng(0)
vertices, rings = rng.normal(size=(2001, 33, 3)), rng.normal(size=(2000, 32))
points = rng.normal(size=(100_000, 3))
"""
# two seconds for one lattice
LATTICES = """
fine = UVLM(chordwise=8, spanwise=128).attributes(RIG_WING, WATER, 0.2)
"""
# (what is ready before, the call)
CALLS = {
    "simulate": ("", "simulate(RIG_WING, stroke, large, WATER, cycles=100)"),
    "batch": ("", "simulate_batch(RIG_WING, [stroke] * 3, large, WATER, cycles=2)"),
    "batch on two threads": (
        "",
        "simulate_batch(RIG_WING, [stroke] * 3, large, WATER, cycles=2, threads=2)",
    ),
    "blade elements": (
        RUN.format(model="QuasiSteady(strips=1000)", instants=400_000),
        "air.native.run(air.state, 0.005, *arrays)",
    ),
    "lattices": (LATTICES, "while True: _native.Air('flaprig.uvlm', fine)"),
    "one roll-up": (SHEET, "_native.sheet_velocity(vertices, rings, 0.15, points)"),
    "one roll-up on two threads": (
        SHEET,
        "_native.sheet_velocity(vertices, rings, 0.15, points, threads=2)",
    ),
}


def interrupted(setup: str, call: str, after: str = "pass") -> list[str]:
    """What the child prints: first the CPU seconds from Ctrl-C to its exception."""
    code = CHILD.format(setup=setup, call=call, after=after)
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout.splitlines()


@pytest.mark.parametrize("name", CALLS)
def test_interrupt(name: str) -> None:
    assert float(interrupted(*CALLS[name])[0]) < LATEST


def test_state_is_as_before_the_call() -> None:
    """Not one in the middle of a step."""
    setup = RUN.format(model="large", instants=20_000)
    call = "air.native.run(air.state, 0.005, *arrays)"
    told = interrupted(setup, call, "print(before.any(), np.array_equal(air.state, before))")
    assert told[1] == "True True"
