"""Set points for the real rig: two whole files, within limits, and one sentence for bad input."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from flaprig.cli import main


def test_files_hold_the_stroke_from_rest_to_rest(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["export", "--cycles", "1", "--json", "--out", str(tmp_path)]) == 0
    told = json.loads(capsys.readouterr().out)
    path = np.genfromtxt(tmp_path / "trajectory.csv", delimiter=",", names=True)
    assert len(path) == told["set_points"] and told["joined_at_s"] < 1.0
    # begins and ends at rest, and reaches the stroke's 60 degrees in between
    for k in (0, -1):
        assert path["sweep_rate_rad_per_s"][k] == pytest.approx(0.0, abs=1e-9)
    assert np.abs(path["sweep_rad"]).max() == pytest.approx(np.pi / 3, abs=1e-3)
    # hardly more than the fluid's torque on the prescribed stroke, 0.13 N m
    assert 0.1 < told["peak_sweep_torque_Nm"] < 0.25
    counts = np.loadtxt(tmp_path / "counts.csv", delimiter=",", skiprows=1)
    turned = (counts[:, 1] - counts[0, 1]) * 2 * np.pi / 4096
    swept = path["sweep_rad"] - path["sweep_rad"][0]
    np.testing.assert_allclose(np.abs(turned), np.abs(swept), atol=2 * np.pi / 4096)


def test_bad_interval_is_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", "--interval", "0", "--out", str(tmp_path)]) == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not list(tmp_path.iterdir())
