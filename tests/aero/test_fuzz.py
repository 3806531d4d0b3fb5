"""Random wings, strokes and models: each is refused in one sentence, or simulates to numbers."""

import random

import numpy as np
import pytest

from flaprig import strokes
from flaprig.aero.coefficients import Coefficients
from flaprig.aero.models import UVLM, QuasiSteady
from flaprig.aero.simulate import simulate
from flaprig.wing import Wing

NASTY = [float("nan"), float("inf"), -1.0, 0.0, 1e300, 1e-300, None, "x", [], True, 1 + 1j]


def number(rng, low, high):
    return rng.choice(NASTY) if rng.random() < 0.08 else rng.uniform(low, high)


def numbers(rng, count, low, high):
    return [number(rng, low, high) for _ in range(count + (rng.random() < 0.05))]


def random_wing(rng):
    kind = rng.random()
    if kind < 0.4:
        return Wing.rectangular(*(number(rng, 0.01, 2) for _ in range(rng.randint(2, 6))))
    if kind < 0.6:
        return Wing.beta(*(number(rng, 0.05, 0.9) for _ in range(rng.randint(3, 6))))
    count = rng.randint(0, 6)
    radius = (
        np.cumsum([rng.random() for _ in range(count)]).tolist()
        if rng.random() < 0.8
        else (numbers(rng, count, -1, 3))
    )
    return Wing.from_table(radius, numbers(rng, count, 0, 1), numbers(rng, count, -1, 1))


def random_stroke(rng):
    kind = rng.random()
    if kind < 0.4:
        values = [number(rng, 0.01, x) for x in (5, 1.5, 1.5, 0.5, 0.5)]
        return strokes.SunTangStroke(*values, rng.choice(["half_sine", "raised_cosine", "x"]))
    count = rng.randint(0, 4)
    lists = [numbers(rng, count, -0.7, 0.7) for _ in range(4)]
    if kind < 0.6:
        return strokes.FourierStroke(number(rng, 0.01, 5), *lists)
    if kind < 0.8:
        amplitudes = number(rng, 0.1, 1.5), number(rng, 0.1, 1.5)
        return strokes.FourierStroke.normalized(number(rng, 0.01, 5), *lists, *amplitudes)
    count = rng.randint(0, 20)
    time = np.linspace(0, 1, count).tolist() if rng.random() < 0.8 else numbers(rng, count, 0, 1)
    return strokes.SampledStroke(time, numbers(rng, count, -1, 1), numbers(rng, count, -1, 1))


def random_model(rng):
    if rng.random() < 0.5:
        table = Coefficients.from_table(
            sorted(rng.uniform(0, 3.2) for _ in range(3)), numbers(rng, 3, -2, 3), [0.1, 2, 1]
        )
        return QuasiSteady(table, rng.randint(-1, 9), 8, rng.choice([True, False, 1]))
    size = rng.randint(0, 3), rng.randint(0, 4), rng.randint(3, 12)
    settings = (number(rng, 0, 1), number(rng, 0, 2), number(rng, 0.1, 1.5), number(rng, 0.1, 0.5))
    return UVLM(*size, *settings)


def is_sentence(error):
    return 0 < len(str(error)) < 600 and "\n" not in str(error)


def made(make, rng, count):
    """What `make` built in `count` tries; every refusal must be one sentence."""
    good, refusals = [], []
    for _ in range(count):
        try:
            good.append(make(rng))
        except ValueError as error:
            refusals.append(error)
    assert all(map(is_sentence, refusals))
    assert 0.05 * count < len(good) < 0.98 * count
    return good


@pytest.mark.parametrize("make", [random_wing, random_stroke, random_model])
def test_refused_in_one_sentence_or_built(make):
    made(make, random.Random(3), 3000)


def test_whatever_is_built_simulates():
    rng = random.Random(4)
    wings, motions, models = (
        made(make, rng, 1000) for make in (random_wing, random_stroke, random_model)
    )
    loud = []
    for i in range(400):
        parts = (rng.choice(pool) for pool in (wings, motions, models))
        try:
            result = simulate(*parts, cycles=1)
            assert np.isfinite(result.lift).all() and np.isfinite(result.pitch_torque).all(), i
        except (ValueError, FloatingPointError) as error:
            loud.append(error)
    assert all(map(is_sentence, loud))
    assert len(loud) < 40
