"""`flaprig check`: exit status, files, one JSON object, and one sentence for every bad file."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from flaprig import cli, feasibility, scaling
from flaprig.strokes import load

QUICK = ["check", "--model", "quasi-steady", "--cycles", "2"]
TIME = 5.0 * np.arange(100) / 100
SWEEP = -1.047 * np.cos(2.0 * np.pi * TIME / 5.0)
PITCH = 0.785 * np.sin(2.0 * np.pi * TIME / 5.0)


def write(path: Path, *columns: np.ndarray, head: str = "time_s,sweep_rad,pitch_rad") -> str:
    np.savetxt(path, np.column_stack(columns), "%.9g", ",", header=head, comments="")
    return str(path)


def test_feasible_is_0_and_infeasible_is_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(QUICK) == 0
    out = capsys.readouterr().out
    assert "Feasible. Smallest margin: sweep position, 33 %." in out
    assert "winding temperature" in out and "deg/s2" in out
    assert cli.main([*QUICK, "--frequency", "0.7"]) == 1
    out = capsys.readouterr().out
    assert "Not feasible: sweep velocity" in out and "Nearest stroke within the limits" in out


def test_no_number_is_cut_in_a_narrow_terminal(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    assert cli.main([*QUICK, "--frequency", "0.7"]) == 1
    out = capsys.readouterr().out
    assert "as asked" in out and "\u2026" not in out


def test_json_is_one_object(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*QUICK, "--frequency", "0.7", "--pitch-duration", "0.2", "--json"]) == 1
    out, err = capsys.readouterr()
    summary = json.loads(out)
    assert summary["command"] == "check" and summary["feasible"] is False and not err
    # infinite jerk: no number in JSON, and not kept
    jerk = summary["verdicts"]["pitch_jerk_rad_per_s3"]
    assert jerk["value"] is None and jerk["holds"] is False


def test_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*QUICK, "--out", str(tmp_path / "good"), "--json"]) == 0
    folder = tmp_path / "good"
    names = ["report.csv", "summary.json", "torque_speed.png"]
    assert sorted(path.name for path in folder.iterdir()) == names
    assert json.loads((folder / "summary.json").read_text()) == json.loads(capsys.readouterr().out)
    assert cli.main([*QUICK, "--frequency", "0.6", "--out", str(tmp_path / "fast")]) == 1
    nearest = load(tmp_path / "fast" / "nearest.csv")
    assert nearest.frequency == pytest.approx(0.6)
    # what the rig can do instead is within its limits
    capsys.readouterr()
    words = ["--stroke", str(tmp_path / "fast" / "nearest.csv"), "--json"]
    cli.main([*QUICK, *words])
    verdicts = json.loads(capsys.readouterr().out)["verdicts"]
    assert verdicts["sweep_acceleration_rad_per_s2"]["holds"]
    assert verdicts["sweep_nearest_motion_rad"]["value"] < 1e-5


def test_options_reach_the_check(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*QUICK, "--limits", "paper", "--frequency", "0.35"]) == 1
    assert "sweep acceleration" in capsys.readouterr().out
    assert cli.main([*QUICK, "--rms-tracking", "0.0001"]) == 1
    errors = []
    for more in ([], ["--no-feedforward"]):
        capsys.readouterr()
        assert cli.main([*QUICK, "--json", *more]) == 0
        verdicts = json.loads(capsys.readouterr().out)["verdicts"]
        errors.append(verdicts["sweep_rms_tracking_error_rad"]["value"])
    # without the feedforward the servo needs an error to give a torque
    assert errors[1] > 3.0 * errors[0]


def test_rigs_log_in_degrees_and_of_many_cycles(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    head = "time_s,sweep_deg,pitch_deg"
    one = write(tmp_path / "one.csv", TIME, np.degrees(SWEEP), np.degrees(PITCH), head=head)
    assert cli.main([*QUICK, "--stroke", one, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["sweep_amplitude_rad"] == pytest.approx(1.047, abs=1e-3)
    time = np.concatenate([TIME, TIME + 5.0])
    two = write(tmp_path / "two.csv", time, np.tile(SWEEP, 2), np.tile(PITCH, 2))
    assert cli.main([*QUICK, "--stroke", two, "--log-frequency", "0.2", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["frequency_Hz"] == pytest.approx(0.2)


def bad_files(folder: Path) -> dict[str, tuple[str, str]]:
    """Files by what is wrong with them, and what must be said."""
    half = slice(0, 50)
    text = '{"stroke": "sun_tang", "parameters": {"frequency": 0.2, "sweep_amplitude": 60, '
    (folder / "degrees.json").write_text(text + '"pitch_amplitude": 45}}')
    (folder / "empty.csv").write_text("")
    return {
        "column": (write(folder / "c.csv", TIME, SWEEP, head="time_s,sweep_rad"), "pitch_rad"),
        "degrees": (write(folder / "d.csv", TIME, np.degrees(SWEEP), PITCH), "degrees?"),
        "half": (write(folder / "h.csv", TIME[half], SWEEP[half], PITCH[half]), "half a cycle?"),
        "formula": (str(folder / "degrees.json"), "radians, not degrees"),
        "empty": (str(folder / "empty.csv"), "empty file"),
        "none": (str(folder / "none.csv"), "No such file"),
        "folder": (str(folder), "Is a directory"),
    }


BAD = ["column", "degrees", "half", "formula", "empty", "none", "folder"]


@pytest.mark.parametrize("name", BAD)
def test_bad_file_is_one_sentence_and_2(
    name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, said = bad_files(tmp_path)[name]
    assert cli.main([*QUICK, "--stroke", path]) == 2
    out, err = capsys.readouterr()
    assert not out and err.startswith("flaprig: ") and said in err
    assert err.count("\n") == 1 and "Traceback" not in err


def test_file_with_one_bad_sample_is_read_and_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    late, broken = TIME.copy(), SWEEP.copy()
    late[5], broken[7] = late[4], math.nan
    for columns, line in (((TIME, broken, PITCH), "line 9"), ((late, SWEEP, PITCH), "line 7")):
        path = write(tmp_path / "log.csv", *columns)
        assert cli.main([*QUICK, "--stroke", path, "--json"]) == 0
        assert any(line in said for said in json.loads(capsys.readouterr().out)["notices"])


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--cycles", "1"], "cycles must be a whole number from 2"),
        (["--rms-tracking", "-1"], "--rms-tracking"),
        (["--peak-tracking", "nan"], "--peak-tracking"),
        (["--log-frequency", "0.2"], "--log-frequency must be left out"),
        (["--limits", "none"], "--limits"),
        (["--time-step", "1"], "time_step"),
        (["--stroke", "x.csv", "--frequency", "0.3"], "--frequency must be left out"),
    ],
)
def test_bad_option_is_2(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*QUICK[:3], *words]) == 2
    assert said in capsys.readouterr().err


def test_a_failure_is_neither_yes_nor_no(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise FloatingPointError("the wake blew up")

    monkeypatch.setattr(feasibility, "check_feasibility", fails)
    assert cli.main(QUICK) == 3
    assert capsys.readouterr().err == "flaprig: the wake blew up\n"


def test_scale(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(scaling, "GIVE_UP", 1)
    words = ["--time-step", "0.02", "--steps-per-cycle", "40", "--scale"]
    assert cli.main([*QUICK, *words, "--limits", "paper", "--json"]) == 0
    scale = json.loads(capsys.readouterr().out)["scale"]
    # 3.72 rad/s2 end the sinusoid at 0.3 Hz, and 2 % of forgiveness
    assert scale["highest_frequency_Hz"] == pytest.approx(0.303, abs=0.004)
    assert "sweep_acceleration_rad_per_s2" in scale["limited_by"]
    assert scale["smallest_servo"] == "XL330-M288"


def test_help(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        cli.main(["check", "--help"])
    out = capsys.readouterr().out
    assert "0 feasible" in out and "default: None" not in out
