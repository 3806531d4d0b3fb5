"""No memory grows: millions of steps, thousands of models made, freed and refused."""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable
from pathlib import Path

import mujoco
import pytest

from tests.plugin.models import BLADES, FREE, REFUSED_MODELS, load, random_state, two_hinges

# growth of the resident memory that is still noise of the allocators [MB]
NOISE = 4.0

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="reads the resident memory from /proc"
)


def resident() -> float:
    """Memory of this process [MB]."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6


def growth(work: Callable[[int], None], warm: int, count: int) -> float:
    """Megabytes more after the work than after a first part of it."""
    work(warm)
    start = resident()
    work(count)
    return resident() - start


@pytest.mark.parametrize(
    ("air", "steps"),
    [
        (BLADES | {"strips": "4"}, 1_000_000),
        (FREE | {"chordwise": "2", "spanwise": "3", "wake_rows": "10"}, 20_000),
    ],
    ids=["quasi_steady", "uvlm"],
)
def test_steps_leave_nothing_behind(air: dict[str, str], steps: int) -> None:
    model = load(two_hinges(air, 'timestep="0.002"', 'damping="1e-3" stiffness="0.05"'))
    data = random_state(model, 0, 1.0)
    assert growth(lambda n: mujoco.mj_step(model, data, nstep=n), 1000, steps) < NOISE
    assert data.time > 0.9 * steps * 0.002
    assert not data.warning.number.any()


def made_and_freed(xml: str, count: int) -> None:
    for _ in range(count):
        model = load(xml)
        data = random_state(model, 0)
        mujoco.mj_step(model, data, nstep=2)


def refused(xml: str, count: int) -> None:
    for _ in range(count):
        with pytest.raises(ValueError, match="air"):
            load(xml)


SMALL = FREE | {"chordwise": "2", "spanwise": "2", "wake_rows": "5"}


def test_models_are_freed() -> None:
    xml = two_hinges(SMALL)
    assert growth(lambda n: made_and_freed(xml, n), 300, 3000) < NOISE


@pytest.mark.parametrize("name", REFUSED_MODELS)
def test_refused_models_are_freed(name: str) -> None:
    """An error out of a callback jumps past destructors: nothing may be held at that point."""
    xml = REFUSED_MODELS[name]
    assert growth(lambda n: refused(xml, n), 300, 3000) < NOISE
