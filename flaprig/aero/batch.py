"""Many strokes at once, on all cores: the same loads as one by one, bit for bit."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from flaprig import _checks as check
from flaprig.aero.air import WingLoads
from flaprig.aero.models import UVLM, AirModel
from flaprig.aero.result import Result
from flaprig.aero.rigid_motion import RigidMotion
from flaprig.aero.simulate import check_setup, prescribed, result_of
from flaprig.fluid import WATER, Fluid
from flaprig.native import _native
from flaprig.strokes.stroke import Stroke
from flaprig.wing import Wing

Array = NDArray[np.float64]


def simulate_batch(
    wing: Wing,
    strokes: Sequence[Stroke],
    model: AirModel | None = None,
    fluid: Fluid = WATER,
    cycles: int = 5,
    threads: int | None = None,
    buoyancy: bool = False,
) -> list[Result]:
    """Loads on one wing along each of many strokes, as `simulate` gives them.

    Args:
        wing: the wing.
        strokes: the strokes; those of one frequency run side by side.
        model: the air; UVLM() when None. Its own `threads` should stay 1 here.
        fluid: the fluid.
        cycles: number of cycles, 1 to 1000.
        threads: strokes at work at a time; one for each core when None.
        buoyancy: whether the pitch torque has that of the displaced fluid in it.

    Raises:
        ValueError: an argument of the wrong type or out of its range.
        FloatingPointError: the loads of a stroke are not finite.
    """
    owner = "simulate_batch"
    model = UVLM() if model is None else model
    check_setup(owner, wing, model, fluid)
    strokes = _checked_strokes(owner, strokes)
    cycles = check.whole(owner, "cycles", cycles, 1, 1000)
    cores = os.cpu_count() or 1
    threads = check.whole(owner, "threads", cores if threads is None else threads, 1, 1024)
    check.flag(owner, "buoyancy", buoyancy)
    results: dict[int, Result] = {}
    for members in _alike(wing, strokes, model, fluid):
        chosen = [strokes[k] for k in members]
        group = _run(wing, chosen, model, fluid, cycles, threads, buoyancy)
        results |= dict(zip(members, group, strict=True))
    return [results[k] for k in range(len(strokes))]


def _checked_strokes(owner: str, strokes: Sequence[Stroke]) -> list[Stroke]:
    if isinstance(strokes, type) or not isinstance(strokes, Iterable):
        raise check.fail(owner, "strokes", "a list of strokes", strokes)
    chosen = list(strokes)
    for number, stroke in enumerate(chosen):
        words = "a stroke, for instance a SunTangStroke"
        check.instance(owner, f"strokes[{number}]", stroke, Stroke, words)
    return chosen


def _alike(wing: Wing, strokes: Sequence[Stroke], model: AirModel, fluid: Fluid) -> list[list[int]]:
    """Indices of the strokes that can share one native model."""
    groups: dict[tuple[tuple[str, str], ...], list[int]] = {}
    for k, stroke in enumerate(strokes):
        settings = model.attributes(wing, fluid, stroke.frequency, stroke.sweep_amplitude)
        groups.setdefault(tuple(settings.items()), []).append(k)
    return list(groups.values())


def _run(
    wing: Wing,
    strokes: list[Stroke],
    model: AirModel,
    fluid: Fluid,
    cycles: int,
    threads: int,
    buoyancy: bool,
) -> list[Result]:
    first, steps = strokes[0], model.steps_per_cycle
    motions = [prescribed(stroke, cycles, steps) for stroke in strokes]
    rigid = [RigidMotion.from_stroke(motion) for motion in motions]
    settings = model.attributes(wing, fluid, first.frequency, first.sweep_amplitude)
    loads = batch_loads(model, settings, rigid, 1.0 / (steps * first.frequency), threads)
    return [
        result_of(wing, stroke, fluid, motion, load, cycles, buoyancy)
        for stroke, motion, load in zip(strokes, motions, loads, strict=True)
    ]


def batch_loads(
    model: AirModel,
    settings: dict[str, str],
    motions: Sequence[RigidMotion],
    step: float,
    threads: int,
) -> list[WingLoads]:
    """Loads along motions of equal length, each beginning in still fluid of its own."""
    native = _native.Air(model.plugin, settings)
    count, length = len(motions), len(motions[0])
    states = np.zeros(count * native.state_size)
    parts = native.run_batch(
        states,
        count,
        step,
        np.concatenate([m.position for m in motions]),
        np.concatenate([m.rotation for m in motions]),
        np.concatenate([m.twist for m in motions]),
        np.concatenate([m.twist_rate for m in motions]),
        threads,
    )
    cut = [slice(k * length, (k + 1) * length) for k in range(count)]
    return [WingLoads(*(part[piece] for part in parts)) for piece in cut]
