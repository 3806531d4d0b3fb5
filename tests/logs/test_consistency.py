"""A record is consistent with itself: its clock, its period, its cycles; what is not is said."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import flaprig
from tests.logs.records import COUNT, angles, clock, text, written

TIME = clock(6.0, 100.0)
SWEEP, PITCH = angles(TIME)


def read(tmp_path: Path, *columns: np.ndarray, **settings: object) -> flaprig.RigLog:
    return flaprig.read_log(written(tmp_path / "log.csv", text(*columns)), **settings)


def is_the_sinusoid(log: flaprig.RigLog, frequency: float = 2e-5, angle: float = 0.02) -> bool:
    own = np.degrees([log.stroke.sweep_amplitude, log.stroke.pitch_amplitude])
    return abs(log.stroke.frequency - 0.2) < frequency and bool(
        np.abs(own - [60.0, 45.0]).max() < angle
    )


# ---- the clock


def test_jitter_is_no_noise(tmp_path: Path) -> None:
    time = clock(6.0, 48.0, jitter=0.3)
    log = read(tmp_path, time, *angles(time))
    assert is_the_sinusoid(log) and not log.doubts
    # what is left is the rounding to counts
    assert max(log.residual_rms) == pytest.approx(np.radians(COUNT) / np.sqrt(12.0), rel=0.05)


def test_repeated_stamps_are_spread(tmp_path: Path) -> None:
    log = read(tmp_path, np.floor(TIME * 10.0) / 10.0, SWEEP, PITCH)
    assert is_the_sinusoid(log, 1e-4, 0.1)
    assert "time_s repeats the stamp before it" in log.doubts[0] and "lines 3, 4" in log.doubts[0]


def test_a_gap_is_said(tmp_path: Path) -> None:
    kept = (TIME < 6.3) | (TIME > 7.6)
    log = read(tmp_path, TIME[kept], SWEEP[kept], PITCH[kept])
    assert is_the_sinusoid(log)
    (said,) = log.doubts
    assert said.startswith("line 632: 1.32 s are missing before it (0.01 s are usual)")


def test_stamps_out_of_order_and_begun_anew(tmp_path: Path) -> None:
    time = TIME.copy()
    time[100] = time[97] - 0.001
    log = read(tmp_path, time, SWEEP, PITCH)
    assert is_the_sinusoid(log) and log.doubts[0].startswith("line 102: time_s is not between")
    time = np.where(TIME < 9.99, TIME, TIME - 9.99)
    log = read(tmp_path, time, SWEEP, PITCH)
    assert is_the_sinusoid(log, 1e-4) and log.cycles == pytest.approx(4.0, abs=0.01)
    assert "line 1001: time_s falls (from 9.98 to 0 s first)" in log.doubts[0]
    blocks = np.arange(TIME.size)
    blocks[500:502], blocks[502:504] = blocks[502:504].copy(), blocks[500:502].copy()
    log = read(tmp_path, TIME[blocks], SWEEP[blocks], PITCH[blocks])
    assert is_the_sinusoid(log) and any("put in their place" in d for d in log.doubts)


@pytest.mark.parametrize("scale", [1e3, 1e6, 1e9])
def test_stamps_since_1970_under_seconds(scale: float, tmp_path: Path) -> None:
    stamps = np.rint((1.764e9 + clock(2.0)) * scale)
    content = text(stamps, *angles(clock(2.0)), form="%.10g").replace("e+", "e")
    rows = [
        ",".join([f"{s:.0f}", *line.split(",")[1:]])
        for s, line in zip(stamps, content.split("\n")[1:], strict=False)
    ]
    path = written(tmp_path / "log.csv", "\n".join(["time_s,sweep_deg,pitch_deg", *rows]))
    log = flaprig.read_log(path)
    assert is_the_sinusoid(log, 1e-4)
    unit = {1e3: "ms", 1e6: "us", 1e9: "ns"}[scale]
    assert log.doubts[0].startswith("line 2: time_s: the number 1.764e+")
    assert log.doubts[0].endswith(f"were read as {unit}")


# ---- the angles


def test_cells_and_lines_that_are_no_numbers(tmp_path: Path) -> None:
    sweep = SWEEP.copy()
    sweep[[3, 50]] = np.nan
    content = text(TIME, sweep, PITCH)[:-1] + "\n30.0\n"
    log = flaprig.read_log(written(tmp_path / "log.csv", content))
    assert is_the_sinusoid(log)
    assert log.doubts[0] == "line 3002 is cut off: it was left out"
    assert log.doubts[1] == "lines 5, 52: pitch_deg is no number (first '30.0'); left out" or (
        log.doubts[1].startswith("lines 5, 52: sweep_deg is no number (first 'nan')")
    )
    with pytest.raises(ValueError, match="line 2: pitch_deg must be a finite number, got 'nan'"):
        read(tmp_path, TIME, SWEEP, np.full(TIME.size, np.nan))


def test_strays_are_named_by_line(tmp_path: Path) -> None:
    sweep, pitch = SWEEP.copy(), PITCH.copy()
    sweep[[10, 700]] = 9999.0, -65535.0
    sweep[1500], pitch[1700] = 20.0, -80.0
    log = read(tmp_path, TIME, sweep, pitch)
    assert is_the_sinusoid(log)
    assert log.doubts[0].startswith("lines 12, 702: sweep is far from all other angles (first 9999")
    assert log.doubts[1].startswith("lines 1502, 1702: ") and "left out as strays" in log.doubts[1]


def test_turns_of_an_encoder_are_undone(tmp_path: Path) -> None:
    log = read(tmp_path, TIME, np.mod(SWEEP + 300.0, 360.0), PITCH)
    assert is_the_sinusoid(log)
    assert "sweep jumps by a turn of the encoder; the jumps were undone" in log.doubts[0]


@pytest.mark.parametrize("middle", [180.0, -89.0, 300.0])
def test_off_centre_is_said_and_can_be_shifted(middle: float, tmp_path: Path) -> None:
    log = read(tmp_path, TIME, SWEEP + middle, PITCH)
    said = f"sweep is centred at {middle:.3g} deg and leaves the joints' range of +-90 deg; shifted"
    assert log.doubts[0].startswith(said) and f"by {-middle:+.3g} deg it fits" in log.doubts[0]
    log = read(tmp_path, TIME, SWEEP + middle, PITCH, center=True)
    assert abs(log.stroke.motion(1.25).sweep) < 1e-3
    assert f"sweep by {-middle:+.3g} deg" in log.doubts[0]


def test_radians_under_degrees(tmp_path: Path) -> None:
    log = read(tmp_path, TIME, np.radians(SWEEP), np.radians(PITCH))
    assert [
        doubt.endswith(f"(then name the column {joint}_rad)")
        for doubt, joint in zip(log.doubts, ("sweep", "pitch"), strict=True)
    ] == [True, True]
    assert "radians?" in log.doubts[0]


def test_a_third_angle_and_the_other_sign(tmp_path: Path) -> None:
    head = "time_s,sweep_deg,pitch_deg,deviation_deg"
    content = text(TIME, SWEEP, -PITCH, 8.0 * np.sin(2.5 * TIME), header=head)
    path = written(tmp_path / "log.csv", content)
    log = flaprig.read_log(path)
    assert log.doubts[0].startswith("deviation_deg (amplitude 8 deg) is left out")
    assert log.doubts[1].startswith("lift points down")
    log = flaprig.read_log(path, flip_pitch=True)
    assert "lift points down" not in " ".join(log.doubts)
    assert "the sign of the pitch was turned" in " ".join(log.doubts)


# ---- the period


@pytest.mark.parametrize("cycles", [0.998, 1.0, 1.02, 1.2, 1.5, 2.0, 2.7, 17.3])
@pytest.mark.parametrize("start", [0.0, 3.3])
def test_the_period_is_found(cycles: float, start: float, tmp_path: Path) -> None:
    time = clock(cycles, 100.0)
    log = read(tmp_path, time, *angles(time + start))
    assert is_the_sinusoid(log, 2e-4 if cycles < 1.5 else 5e-6, 0.1)
    assert log.cycles == pytest.approx(cycles, abs=0.01)


@pytest.mark.parametrize("cycles", [0.25, 0.5, 0.75, 0.9])
@pytest.mark.parametrize("start", [0.0, 1.25, 3.3])
def test_part_of_a_cycle_is_no_cycle(cycles: float, start: float, tmp_path: Path) -> None:
    time = clock(cycles, 100.0)
    with pytest.raises(ValueError, match="must cover one whole cycle or several"):
        read(tmp_path, time, *angles(time + start))


@pytest.mark.parametrize(
    ("frequency", "words"),
    [
        (0.202, r"cycles differ from their mean by up to \d+\.?\d* deg; the best period is 5 s"),
        (0.21, r"cycles differ from their mean by .* the best period is 5 s \(0.2 Hz\)"),
        (0.4, r"cycles differ from their mean by up to \d\d"),
        (5.0, r"the best period is 5 s \(0.2 Hz\)"),
        (0.1, r"every cycle holds the motion 2 times; the best period is 5 s \(0.2 Hz\)"),
        (0.05, "every cycle holds the motion 4 times"),
        (0.01, r"must cover one whole cycle of 100 s, got 29.99 s; the best period is 5 s"),
    ],
)
def test_a_wrong_frequency_is_refused_with_the_best(
    frequency: float, words: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=words):
        read(tmp_path, TIME, SWEEP, PITCH, frequency=frequency)


def test_a_frequency_that_nearly_fits(tmp_path: Path) -> None:
    assert read(tmp_path, TIME, SWEEP, PITCH, frequency=0.2).doubts == ()
    log = read(tmp_path, TIME, SWEEP, PITCH, frequency=0.201)
    assert log.stroke.frequency == 0.201
    assert "the cycles drift by 0.03 of a cycle" in log.doubts[0]
    assert "the best frequency is 0.2 Hz" in log.doubts[0]


def test_rest_and_ramps_around_the_motion_are_cut(tmp_path: Path) -> None:
    before, after = np.full(300, 1.0), np.full(1000, 1.0)
    time = np.arange(300 + TIME.size + 1000) / 100.0
    columns = [np.concatenate([before * x[0], x, after * x[-1]]) for x in (SWEEP, PITCH)]
    log = read(tmp_path, time, *columns)
    assert is_the_sinusoid(log) and "rest was cut: 3" in log.doubts[0]
    # a slow ramp into the first cycle
    ramp = np.clip(TIME / 2.0, 0.0, 1.0)
    log = read(tmp_path, TIME, SWEEP * ramp, PITCH * ramp)
    assert is_the_sinusoid(log, 1e-4, 0.3) and "a start of " in " ".join(log.doubts)


def test_motions_that_do_not_repeat(tmp_path: Path) -> None:
    phase = 2.0 * np.pi * (0.1 * TIME + 0.01 * TIME**2)
    rng = np.random.default_rng(3)
    still = 0.05 * rng.standard_normal(TIME.size)
    cases = {
        "chirp": (60.0 * np.cos(phase), 45.0 * np.sin(phase)),
        "step": (np.where(TIME > 5.0, 60.0, 0.0) + still, np.where(TIME > 5.0, 30.0, 0.0) + still),
        "growth": (SWEEP * (0.5 + TIME / 30.0), PITCH * (0.5 + TIME / 30.0)),
    }
    for columns in cases.values():
        with pytest.raises(ValueError, match="the motion is not periodic"):
            read(tmp_path, TIME, *columns)
    with pytest.raises(ValueError, match="nothing moves: sweep stays within"):
        read(tmp_path, TIME, still, still[::-1])


def test_too_few_samples_in_a_cycle(tmp_path: Path) -> None:
    time = clock(6.0, 1.2)
    with pytest.raises(ValueError, match="must have 8 samples in a cycle, got 6"):
        read(tmp_path, time, *angles(time))


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"frequency": -1.0}, "read_log: frequency must be a positive number in Hz, got -1"),
        ({"frequency": np.nan}, "read_log: frequency must be a positive number"),
        ({"center": 1}, "read_log: center must be True or False, got 1"),
        ({"counts": 4096}, "read_log: counts must be a PositionCounts, got 4096"),
    ],
)
def test_bad_arguments(settings: dict[str, object], words: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=words):
        read(tmp_path, TIME, SWEEP, PITCH, **settings)
    with pytest.raises(FileNotFoundError):
        flaprig.read_log(tmp_path / "none.csv")
    with pytest.raises(FileNotFoundError):
        flaprig.read_log(tmp_path / "none.npz")
