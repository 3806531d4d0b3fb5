"""Batches are nothing but speed: every number is the single simulation's."""

from __future__ import annotations

import math

import numpy as np
import pytest

from flaprig.aero.batch import simulate_batch
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.simulate import simulate
from flaprig.strokes.sun_tang import SunTangStroke
from flaprig.wing import RIG_WING

MODELS = (UVLM(4, 6, steps_per_cycle=30), QuasiSteady(steps_per_cycle=40))


def strokes() -> list[SunTangStroke]:
    """Different shapes, and one of another frequency among them."""
    shapes = [(0.2, 0.5), (0.2, 0.3), (0.3, 0.4), (0.2, 0.16), (0.2, 0.45)]
    return [SunTangStroke(f, math.pi / 3, math.pi / 4, 0.5, d) for f, d in shapes]


@pytest.mark.parametrize("model", MODELS, ids=lambda m: m.plugin)
@pytest.mark.parametrize("threads", [1, 3])
def test_batch_is_the_single_simulation_bit_for_bit(model: UVLM, threads: int) -> None:
    batch = simulate_batch(RIG_WING, strokes(), model, cycles=2, threads=threads)
    for stroke, result in zip(strokes(), batch, strict=True):
        alone = simulate(RIG_WING, stroke, model, cycles=2)
        for name, column in alone.histories.columns().items():
            np.testing.assert_array_equal(result.histories.columns()[name], column)
        assert result.summary() == alone.summary() or math.isnan(alone.cl_spread)
        assert result.reference_force == alone.reference_force


def test_no_strokes_give_no_results() -> None:
    assert simulate_batch(RIG_WING, [], MODELS[0]) == []


def test_a_stroke_without_sweep_is_one_sentence() -> None:
    still = SunTangStroke(0.2, 0.0, 0.5)
    for call in (lambda: simulate(RIG_WING, still), lambda: simulate_batch(RIG_WING, [still])):
        with pytest.raises(ValueError, match=r"^simulate: stroke\.sweep_amplitude must be at"):
            call()


@pytest.mark.parametrize(("name", "bad"), [("cycles", 0), ("threads", -1), ("threads", 1.5)])
def test_bad_numbers_are_one_sentence(name: str, bad: float) -> None:
    with pytest.raises(ValueError, match=rf"^simulate_batch: {name} must be a whole number"):
        simulate_batch(RIG_WING, strokes(), MODELS[1], **{name: bad})
