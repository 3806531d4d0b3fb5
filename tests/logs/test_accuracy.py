"""A log gives the loads of the motion that was logged, at any rate: never those of its noise."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import flaprig
from flaprig import QuasiSteady, SampledStroke, SunTangStroke, simulate
from flaprig.logs.harmonics import fit
from tests.logs.records import SINUSOID, angles, clock, text, written

AIR = QuasiSteady(strips=8, steps_per_cycle=400)
STROKES = {
    0.5: SINUSOID,
    0.32: SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.32, 0.32),
    0.16: SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.16, 0.16),
}
# cycles, noise [rad], jitter [steps]
RECORDS = [(1, 0.0, 0.0), (6, 0.0, 0.0), (6, 8e-4, 0.0), (6, 8e-4, 0.3)]


@pytest.mark.parametrize("duration", STROKES)
@pytest.mark.parametrize("rate", [50.0, 100.0, 200.0, 250.0, 500.0])
def test_loads_of_counts_are_those_of_the_motion(
    duration: float, rate: float, tmp_path: Path
) -> None:
    stroke = STROKES[duration]
    exact = simulate(flaprig.RIG_WING, stroke, AIR, cycles=1)
    for cycles, noise, jitter in RECORDS:
        time = clock(cycles, rate, jitter)
        path = written(tmp_path / "log.csv", text(time, *angles(time, stroke, noise)))
        own = simulate(flaprig.RIG_WING, flaprig.read_log(path).stroke, AIR, cycles=1)
        apart = [getattr(own, key) / getattr(exact, key) - 1.0 for key in KEYS]
        assert np.abs(apart).max() < 0.01, (cycles, noise, jitter, apart)
        rms = np.sqrt(np.mean((own.lift - exact.lift) ** 2))
        assert rms < 0.02 * np.abs(exact.lift).max(), (cycles, noise, jitter)


KEYS = ("cl", "cd", "lift_to_drag")


def test_accelerations_of_a_rounded_sinusoid(tmp_path: Path) -> None:
    """Peak acceleration within 1 % at every rate, where a spline's is up to 580 times too large."""
    for rate in (50.0, 250.0, 500.0):
        time = clock(1.0, rate)
        path = written(tmp_path / "log.csv", text(time, *angles(time)))
        motion = flaprig.read_log(path).stroke.sample(400)
        peak = np.abs(motion.sweep_acceleration).max()
        assert peak == pytest.approx(np.pi / 3 * (0.4 * np.pi) ** 2, rel=0.01)


def test_few_harmonics_and_the_noise_floor() -> None:
    """As many harmonics as there are, and the noise that was put in, whatever its size."""
    rng = np.random.default_rng(4)
    time = np.sort(rng.uniform(0.0, 20.0, 2000))
    w = 2.0 * np.pi * 0.3 * time
    truth = 0.1 + np.cos(w) + 0.3 * np.sin(2.0 * w) - 0.1 * np.cos(5.0 * w)
    for sigma in (1e-6, 1e-3, 1e-2):
        found = fit(time, truth + sigma * rng.standard_normal(time.size), 0.3)
        assert 5 <= found.harmonics <= 8 and found.has_floor
        assert found.residual_rms == pytest.approx(sigma, rel=0.1)
        np.testing.assert_allclose(
            [found.mean, found.cos[0], found.sin[1], found.cos[4]], [0.1, 1.0, 0.3, -0.1],
            atol=5.0 * sigma / np.sqrt(500.0),
        )  # fmt: skip


def test_the_fit_is_least_squares() -> None:
    """The residual is orthogonal to every wave of the series."""
    rng = np.random.default_rng(5)
    time, values = np.sort(rng.uniform(0.0, 9.0, 300)), rng.standard_normal(300)
    found = fit(time, values, 0.7, 4)
    rest = values - found(time)
    for n in range(5):
        phase = 2.0 * np.pi * 0.7 * n * time
        assert abs(rest @ np.cos(phase)) < 1e-9 and abs(rest @ np.sin(phase)) < 1e-9


# ---- samples that are exact stay exact


def exact_rows(stroke: object, count: int, cycles: float = 1.0) -> np.ndarray:
    time = np.arange(round(count * cycles)) / count * stroke.period
    motion = stroke.motion(time)
    return np.column_stack([time, motion.sweep, motion.pitch])


@pytest.mark.parametrize("count", [12, 40, 100, 400, 1000])
def test_exact_samples_are_not_fitted_away(count: int, tmp_path: Path) -> None:
    for stroke in STROKES.values():
        rows = exact_rows(stroke, count)
        content = text(*rows.T, header="time_s,sweep_rad,pitch_rad", form="%.12g")
        log = flaprig.read_log(written(tmp_path / "log.csv", content))
        spline = SampledStroke(*(tuple(column.tolist()) for column in rows.T))
        own, theirs = (s.sample(500) for s in (log.stroke, spline))
        np.testing.assert_allclose(own.sweep, theirs.sweep, atol=3e-3)
        if count >= 400:
            assert isinstance(log.stroke, SampledStroke) or log.harmonics == (1, 1)


def test_sampled_strokes_say_when_they_look_measured() -> None:
    rows = exact_rows(STROKES[0.16], 400)
    assert SampledStroke(*(tuple(column.tolist()) for column in rows.T)).notices == ()
    step = 2.0 * np.pi / 4096.0
    rounded = np.column_stack([rows[:, 0], step * np.rint(rows[:, 1:] / step)])
    stroke = SampledStroke(*(tuple(column.tolist()) for column in rounded.T))
    assert len(stroke.notices) == 2
    assert "peak acceleration" in stroke.notices[0] and "read_log" in stroke.notices[0]
    result = simulate(flaprig.RIG_WING, stroke, AIR, cycles=1)
    assert stroke.notices[0] in result.notices
