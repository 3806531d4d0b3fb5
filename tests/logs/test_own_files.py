"""Every file of angles that flaprig writes is read back as the stroke that it holds."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import flaprig
from flaprig import QuasiSteady, Rig, SampledStroke, SunTangStroke, Twin, simulate
from flaprig.limits import filtered, project, rig_limits
from flaprig.logs import XM430_RIG
from flaprig.motors import RIG_MOTORS
from flaprig.strokes import load
from flaprig.validation.measured_file import read
from tests.logs.records import SINUSOID, angles, clock, text, written

LIMITS = rig_limits(RIG_MOTORS)
FLIPS = SunTangStroke(0.25, 0.9, 0.6, 0.32, 0.32)


def same_motion(log: flaprig.RigLog, stroke: object, within: float) -> None:
    time = np.linspace(0.0, stroke.period, 200)
    own, theirs = log.stroke.motion(time), stroke.motion(time)
    assert log.stroke.frequency == pytest.approx(stroke.frequency, rel=1e-4)
    np.testing.assert_allclose(own.sweep, theirs.sweep, atol=within)
    np.testing.assert_allclose(own.pitch, theirs.pitch, atol=within)


@pytest.mark.parametrize("ending", [".csv", ".npz"])
@pytest.mark.parametrize("stroke", [SINUSOID, FLIPS])
def test_histories_of_a_prescribed_run(ending: str, stroke: SunTangStroke, tmp_path: Path) -> None:
    path = tmp_path / f"histories{ending}"
    simulate(flaprig.RIG_WING, stroke, QuasiSteady(), cycles=3).save(path)
    log = flaprig.read_log(path)
    same_motion(log, stroke, 1e-4)
    assert "lift_N" in log.columns and log.doubts == ()


@pytest.mark.parametrize("ending", [".csv", ".npz"])
def test_histories_of_the_twin(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"histories{ending}"
    run = Twin(Rig.load().with_(model=QuasiSteady()), 0.01).run(FLIPS, 3)
    run.save(path)
    log = flaprig.read_log(path)
    same_motion(log, FLIPS, 0.01)
    # the start from rest is in the file
    assert any(doubt.startswith("a start of") for doubt in log.doubts)


@pytest.mark.parametrize("cycles", [1, 4])
def test_set_points_and_counts(cycles: int, tmp_path: Path) -> None:
    points = filtered(FLIPS, LIMITS, cycles, 0.01)
    points.save(tmp_path / "trajectory.csv")
    points.save(tmp_path / "trajectory.npz")
    for ending in ("csv", "npz"):
        log = flaprig.read_log(tmp_path / f"trajectory.{ending}")
        same_motion(log, points.stroke, 2e-3)
    if cycles > 1:
        XM430_RIG.save(tmp_path / "counts.csv", points.motion)
        log = flaprig.read_log(tmp_path / "counts.csv")
        same_motion(log, points.stroke, 4e-3)
        assert "sweep_count was read as counts of 4096 a turn" in log.doubts[0]


def test_exact_samples_come_back_bit_for_bit(tmp_path: Path) -> None:
    nearest = project(SINUSOID, LIMITS.with_accelerations(flaprig.limits.SINUSOID.times(0.8)))
    assert isinstance(nearest.stroke, SampledStroke)
    nearest.stroke.save(tmp_path / "nearest.csv")
    log = flaprig.read_log(tmp_path / "nearest.csv")
    assert log.stroke == nearest.stroke == load(tmp_path / "nearest.csv")
    assert log.notices == () and log.harmonics == (0, 0)
    with pytest.raises(ValueError, match=r"one period of 5 s \(0.2 Hz\), and 0.4 Hz was given"):
        flaprig.read_log(tmp_path / "nearest.csv", frequency=0.4)


def test_load_and_read_log_agree_and_doubts_are_warnings(tmp_path: Path) -> None:
    time = clock(2.0)
    path = written(tmp_path / "log.csv", text(time, *angles(time)))
    assert load(path) == flaprig.read_log(path).stroke
    path = written(tmp_path / "log.csv", text(time, *angles(time), header="time_s,sweep,pitch_deg"))
    with pytest.warns(UserWarning, match="sweep has no unit: it was read as degrees"):
        load(path)


def test_measured_cases_may_name_a_log(tmp_path: Path) -> None:
    """Motion and forces of a case from one table; the same case as with the published series."""
    time = clock(6.0, 100.0)
    lift = 0.3 + 0.2 * np.cos(2.0 * np.pi * 0.4 * time)
    drag = 0.35 + 0.1 * np.sin(2.0 * np.pi * 0.4 * time)
    head = "time_s,sweep_deg,pitch_deg,lift_N,drag_N"
    written(tmp_path / "run.csv", text(time, *angles(time), lift, drag, header=head))
    case = {
        "id": "mine", "span_m": 0.25, "mean_chord_m": 0.0625, "r1hat": 0.5, "r2hat": 0.56,
        "frequency_Hz": 0.2, "rho": 1000.0, "nu": 1e-6, "stroke_pp_deg": 120.0,
        "root_offset_m": 0.025, "pitch_axis_chord": 0.25, "Re": 14000.0, "log": "run.csv",
    }  # fmt: skip
    file = tmp_path / "cases.json"
    file.write_text(json.dumps({"cases": [case]}))
    (found,) = read(file)
    assert found.stroke.sweep_amplitude == pytest.approx(np.pi / 3, rel=1e-3)
    assert found.mean_lift * found.reference_force == pytest.approx(0.3, rel=1e-3)
    assert found.lift[3] * found.reference_force == pytest.approx(0.2, rel=1e-2)
    assert "least-squares fit" in found.notices[-1]
    written(tmp_path / "run.csv", text(time, *angles(time)))
    with pytest.raises(ValueError, match="CL must be given, or a column lift_N in the log"):
        read(file)
