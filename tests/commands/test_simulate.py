"""`flaprig simulate`: numbers and files."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from flaprig import cli


def test_files_of_a_lattice_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = "simulate --cycles 2 --chordwise 3 --spanwise 4 --steps-per-cycle 24 --json --out"
    assert cli.main([*words.split(), str(tmp_path / "new" / "folder")]) == 0
    folder = tmp_path / "new" / "folder"
    names = ["forces.png", "histories.csv", "histories.npz", "summary.json", "wake.png"]
    assert sorted(path.name for path in folder.iterdir()) == names
    assert json.loads((folder / "summary.json").read_text()) == json.loads(capsys.readouterr().out)
    table = np.genfromtxt(folder / "histories.csv", delimiter=",", names=True)
    assert table.size == 48
    np.testing.assert_allclose(table["lift_N"], np.load(folder / "histories.npz")["lift_N"])


def test_pitch_flip_changes_the_lift(capsys: pytest.CaptureFixture[str]) -> None:
    """A wing that stays upright hardly lifts: the pitch option reaches the solver."""
    words = ["simulate", "--model", "quasi-steady", "--cycles", "1", "--json"]
    assert cli.main([*words, "--pitch-amplitude", "0"]) == 0
    upright = json.loads(capsys.readouterr().out)
    assert cli.main(words) == 0
    flapping = json.loads(capsys.readouterr().out)
    assert abs(upright["cl"]) < 0.1 * flapping["cl"]


def test_stroke_file_gives_the_same_run(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    from flaprig.commands.options import StrokeOptions

    StrokeOptions().build().save(tmp_path / "stroke.json")
    words = ["simulate", "--model", "quasi-steady", "--cycles", "1", "--json"]
    found = []
    for more in ([], ["--stroke", str(tmp_path / "stroke.json")]):
        assert cli.main([*words, *more]) == 0
        found.append(json.loads(capsys.readouterr().out))
    for summary in found:
        del summary["wall_time_s"]
    assert found[0] == found[1]
