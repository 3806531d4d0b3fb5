"""Random numbers in the plugin's state, and all that reads them; perturb.py is the script."""

from __future__ import annotations

import copy
import faulthandler
import pickle
import warnings
from collections import Counter
from collections.abc import Callable

import mujoco
import numpy as np

from tests.plugin.models import (
    BLADES,
    FREE,
    LAGGING,
    OWN_MEMORY,
    Array,
    load,
    native,
    random_state,
    two_hinges,
)

# seconds for one perturbation after which it counts as hanging
HANGS = 120.0
SMALL = {"chordwise": "2", "spanwise": "3", "wake_step": "0.02", "wake_rows": "14"}
AIRS = {
    "blades": BLADES,
    "brute force": FREE | SMALL | {"wake_detail": "0"},
    "merging": FREE | SMALL | {"wake_detail": "2", "wake_rows": "40"},
    # as long as the one above
    "merging, other rows": FREE | SMALL | {"wake_detail": "2", "wake_rows": "41"},
    "young": FREE | SMALL | {"wake_detail": "50"},
    "of the instant": LAGGING | SMALL | {"wake_detail": "3"},
    "double, lagging": FREE
    | SMALL
    | {"precision": "double", "circulation_lag": "0.2", "threads": "2"},
}
# the wake's header: started, age, interval, rows
HEADER = OWN_MEMORY + np.arange(4)
ODD = np.array([
    np.nan, np.inf, -np.inf, -1, -0.0, 0, 0.5, 1, 1.5, 2, 3, 5, 7, 13, 14, 15, 40, 41, 100, 1e3,
    1e5, 1e9, 2.0**31, 2.0**32, 2.0**53, 1e18, 1e19, 1e300, -1e300, 1e-300, 5e-324, -5, -100,
    1e-12, 4, 4.5,
])  # fmt: skip


class Bench:
    """Small models, each with states of a run."""

    def __init__(self) -> None:
        self.models, self.data, self.states, self.airs = {}, {}, {}, {}
        for name, air in AIRS.items():
            model = load(two_hinges(air, 'timestep="0.005"', 'damping="1e-3" stiffness="0.05"'))
            data = random_state(model, 0, 1.0)
            states = []
            for _ in range(60):
                mujoco.mj_step(model, data, nstep=7)
                states.append(data.plugin_state.copy())
            assert not data.warning.number.any()
            self.models[name], self.data[name], self.states[name] = model, data, states
            self.airs[name] = native(air)

    def sound(self, rng: np.random.Generator, name: str) -> Array:
        states = self.states[name]
        return states[rng.integers(len(states))].copy()


Change = Callable[[Bench, np.random.Generator, str, Array], None]


def noise(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    state += 10.0 ** rng.uniform(-9, 9) * rng.normal(size=state.size)


def some_noise(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    if state.size:
        at = rng.integers(state.size, size=rng.integers(1, 5))
        state[at] *= 1 + rng.normal(size=at.size)


def odd_numbers(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    if state.size:
        state[rng.integers(state.size, size=rng.integers(1, 9))] = rng.choice(ODD)


def odd_header(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    at = HEADER[HEADER < state.size]
    if at.size:
        state[rng.choice(at, rng.integers(1, 5))] = rng.choice(ODD)


def counts_off_by_one(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    """Every whole number may be a count."""
    whole = np.flatnonzero((state == np.round(state)) & (state != 0))
    if whole.size:
        state[rng.choice(whole, rng.integers(1, 4))] += rng.choice([-1.0, 1.0, 2.0])


def of_another(bench: Bench, rng: np.random.Generator, _: str, state: Array) -> None:
    """A file of another rig: as much of it as there is room for."""
    other = bench.sound(rng, rng.choice(list(AIRS)))
    n = min(len(other), len(state))
    state[:n] = other[:n]


def shifted(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    state[:] = np.roll(state, rng.integers(-40, 40))


def shuffled(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    rng.shuffle(state)


def bits(_: Bench, rng: np.random.Generator, __: str, state: Array) -> None:
    """Any 64 bits: denormal, signalling NaN."""
    state.view(np.uint64)[:] = rng.integers(0, 2**64, state.size, dtype=np.uint64)


def untouched(_: Bench, __: np.random.Generator, ___: str, ____: Array) -> None:
    """A sound state, so that the way on from it is in."""


CHANGES: tuple[Change, ...] = (
    noise, some_noise, odd_numbers, odd_header, counts_off_by_one, of_another, shifted, shuffled,
    bits, untouched,
)  # fmt: skip


def steps(bench: Bench, name: str, rng: np.random.Generator) -> None:
    mujoco.mj_step(bench.models[name], bench.data[name], nstep=int(rng.integers(1, 12)))


def evaluates(bench: Bench, name: str, _: np.random.Generator) -> None:
    mujoco.mj_forward(bench.models[name], bench.data[name])


def draws(bench: Bench, name: str, _: np.random.Generator) -> None:
    model = bench.models[name]
    scene = mujoco.MjvScene(model, maxgeom=200)
    mujoco.mjv_updateScene(
        model, bench.data[name], mujoco.MjvOption(), None, mujoco.MjvCamera(),
        int(mujoco.mjtCatBit.mjCAT_ALL), scene,
    )  # fmt: skip


def half_steps(bench: Bench, name: str, rng: np.random.Generator) -> None:
    """Written into between the halves of a step, as dm_control makes it."""
    model, data = bench.models[name], bench.data[name]
    kept = data.plugin_state.copy()
    data.plugin_state[:] = bench.sound(rng, name)
    mujoco.mj_step1(model, data)
    data.plugin_state[:] = kept
    mujoco.mj_step2(model, data)


def copies(bench: Bench, name: str, _: np.random.Generator) -> None:
    model = bench.models[name]
    for data in (copy.copy(bench.data[name]), pickle.loads(pickle.dumps(bench.data[name]))):
        mujoco.mj_step(model, data, nstep=2)


def runs_without_mujoco(bench: Bench, name: str, rng: np.random.Generator) -> None:
    air, state = bench.airs[name], bench.data[name].plugin_state[OWN_MEMORY:].copy()
    n = int(rng.integers(1, 8))
    turned, rate = np.tile(np.eye(3), (n, 1, 1)), np.zeros((n, 6))
    air.run(state, 0.005, np.zeros((n, 3)), turned, rng.normal(size=(n, 6)), rate)


def reads_without_mujoco(bench: Bench, name: str, _: np.random.Generator) -> None:
    air, state = bench.airs[name], bench.data[name].plugin_state[OWN_MEMORY:].copy()
    if name != "blades":
        air.wake(state)
        air.bound_circulation(state)
        air.circulation(state, np.zeros(3), np.eye(3), np.zeros(6), np.zeros(6))


USES = (
    steps, steps, steps, evaluates, draws, half_steps, copies, runs_without_mujoco,
    reads_without_mujoco,
)  # fmt: skip


def perturb(count: int, seed: int = 0) -> Counter[str]:
    """Perturb and use that many states; how many of them went on, and how many were warned of."""
    bench, rng, tally = Bench(), np.random.default_rng(seed), Counter[str]()
    names = list(AIRS)
    for _ in range(count):
        faulthandler.dump_traceback_later(HANGS, exit=True)
        name = names[rng.integers(len(names))]
        model, data = bench.models[name], bench.data[name]
        mujoco.mj_resetData(model, data)
        data.qpos[:], data.qvel[:] = rng.uniform(-1, 1, 2), rng.uniform(-1, 1, 2)
        change = CHANGES[rng.integers(len(CHANGES))]
        state = bench.sound(rng, name)
        with np.errstate(all="ignore"):
            change(bench, rng, name, state)
        data.plugin_state[:] = state
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            USES[rng.integers(len(USES))](bench, name, rng)
        warned = bool(data.warning.number.any() or told)
        tally["warned" if warned else "went on"] += 1
        if change is untouched:
            assert not warned, f"a sound state of {name} was refused: {told}"
    faulthandler.cancel_dump_traceback_later()
    return tally
