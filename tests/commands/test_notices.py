"""Whatever was changed or is doubtful stands where the number is read."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from flaprig import cli
from tests.logs.records import angles, clock, text, written

QUICK = ["--model", "quasi-steady"]


def summary_of(capsys: pytest.CaptureFixture[str], *words: str, code: int = 0) -> dict:
    capsys.readouterr()
    assert cli.main([*words, "--json"]) == code
    out, err = capsys.readouterr()
    assert not err
    return json.loads(out)


def log_file(path: Path, cycles: float = 2.0, middle: float = 0.0) -> str:
    time = clock(cycles)
    sweep, pitch = angles(time)
    return str(written(path, text(time, sweep + middle, pitch)))


def test_the_twin_says_what_was_flown(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = summary_of(capsys, "twin", "--frequency", "1", *QUICK)
    assert found["sweep_amplitude_rad"] == pytest.approx(np.pi / 3)
    assert found["flown_sweep_amplitude_rad"] == pytest.approx(np.radians(19.5), abs=0.01)
    assert found["notices"][0].startswith("sweep was changed to stay within acceleration")
    # by the speed really made the coefficient is one of a wing
    assert found["cl"] < 0.5 < found["flown_cl"] < 4.0
    assert cli.main(["twin", "--frequency", "1", *QUICK, "--out", str(tmp_path)]) == 0
    out = capsys.readouterr().out
    assert "sweep ±19.4" in out.replace("\n", "") and "(asked ±60°)" in out.replace("\n", " ")
    assert "Notice: sweep was changed" in out and "sweep amplitude flown" in out


def test_a_feasible_stroke_has_nothing_to_say(capsys: pytest.CaptureFixture[str]) -> None:
    for command in ("simulate", "twin", "check"):
        assert summary_of(capsys, command, *QUICK)["notices"] == [], command


def test_a_log_is_read_by_every_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = log_file(tmp_path / "two.csv")
    for command in ("simulate", "twin", "check"):
        found = summary_of(capsys, command, *QUICK, "--stroke", file)
        assert found["frequency_Hz"] == pytest.approx(0.2, rel=1e-5), command
        assert found["log_cycles"] == pytest.approx(2.0, abs=0.01)
        assert "least-squares fit to 500 samples" in found["notices"][0]
    found = summary_of(
        capsys, "export", "--stroke", file, "--out", str(tmp_path / "e"), "--cycles", "1"
    )
    assert found["written"] and (tmp_path / "e" / "counts.csv").is_file()


def test_log_options(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = log_file(tmp_path / "two.csv", middle=180.0)
    found = summary_of(capsys, "simulate", *QUICK, "--stroke", file)
    assert "shifted by -180 deg it fits" in found["notices"][0]
    found = summary_of(capsys, "twin", *QUICK, "--stroke", file, "--center")
    assert found["flown_sweep_amplitude_rad"] == pytest.approx(np.pi / 3, rel=1e-2)
    found = summary_of(capsys, "simulate", *QUICK, "--stroke", file, "--flip-pitch")
    assert found["cl"] < 0.0
    assert any("lift points down" in notice for notice in found["notices"])
    capsys.readouterr()
    words = [*QUICK, "--stroke", file, "--log-frequency", "0.1"]
    assert cli.main(["simulate", *words]) == 2
    assert "the best period is 5 s (0.2 Hz)" in capsys.readouterr().err
    for option in (["--center"], ["--log-frequency", "0.2"], ["--log-counts", "4096"]):
        assert cli.main(["simulate", *QUICK, *option]) == 2
        assert f"{option[0]} must be left out unless --stroke FILE" in capsys.readouterr().err


def test_counts_and_names_on_the_command_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    time = clock(2.0)
    ticks = [np.rint(angle / 360.0 * 8192.0) + 1000.0 for angle in angles(time)]
    content = text(time, *ticks, header="time_s,sweep_count,pitch_count").split("\n", 1)[1]
    file = str(written(tmp_path / "log.csv", content))
    words = ["--log-counts", "8192", "--log-zero", "1000", "1000"]
    names = ["--log-columns", "time_s,sweep_count,pitch_count"]
    found = summary_of(capsys, "simulate", *QUICK, "--stroke", file, *words, *names)
    assert found["sweep_amplitude_rad"] == pytest.approx(np.pi / 3, rel=1e-3)
    assert "counts of 8192 a turn with the zero at 1000" in found["notices"][0]


def test_export_writes_no_other_stroke(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "set_points"
    assert cli.main(["export", "--frequency", "1.5", "--out", str(out)]) == 1
    said = capsys.readouterr()
    assert not out.exists() and not said.out
    assert "sweep was changed" in said.err and "--allow-nearest" in said.err
    found = summary_of(capsys, "export", "--frequency", "1.5", "--out", str(out), code=1)
    assert found["written"] is False and not out.exists()
    words = ["export", "--frequency", "1.5", "--allow-nearest", "--cycles", "1"]
    found = summary_of(capsys, *words, "--out", str(out))
    assert found["written"] and "sweep was changed" in found["notices"][0]
    # a stroke about the middle of a turn is no constant posture
    file = log_file(tmp_path / "log.csv", middle=180.0)
    found = summary_of(capsys, "export", "--stroke", file, "--out", str(out / "x"), code=1)
    assert "shifted by" in " ".join(found["notices"]) and not (out / "x").exists()


def test_check_has_two_columns_for_what_cannot_be(capsys: pytest.CaptureFixture[str]) -> None:
    found = summary_of(capsys, "check", *QUICK, "--frequency", "3", code=1)
    torque = found["verdicts"]["sweep_rms_torque_Nm"]
    # what the stroke asked for needs: 19.6 N m, by an independent inverse dynamics with the lattice
    assert torque["value"] > 15.0 and not torque["holds"] and torque["nearest"] < 1.0
    assert found["verdicts"]["sweep_winding_temperature_degC"]["holds"] is False
    assert any("as asked (inverse dynamics)" in notice for notice in found["notices"])
    assert cli.main(["check", *QUICK, "--frequency", "0.6"]) == 1
    out = capsys.readouterr().out
    assert "as asked" in out and "nearest" in out and "Notice: " in out


@pytest.mark.parametrize("rate", [50.0, 100.0, 250.0, 500.0])
@pytest.mark.parametrize("noise", [0.0, 8e-4])
def test_what_the_rig_has_made_is_feasible(
    rate: float, noise: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    time = clock(3.0, rate)
    file = written(tmp_path / "log.csv", text(time, *angles(time, noise=noise)))
    found = summary_of(capsys, "check", *QUICK, "--cycles", "2", "--stroke", str(file))
    assert found["feasible"] and found["verdicts"]["cl_change"]["margin"] > 0.5
