"""The scripts of examples/ run, say what they did, and leave files that hold what they promise."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

SCRIPTS = ("rollout.py", "batch_rollout.py", "feasible_stroke.py")


def run(root: Path, folder: Path, script: str, *words: str) -> str:
    """What a script prints when it is run in an empty folder."""
    command = [sys.executable, str(root / "examples" / script), *words]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    # nobody's display
    assert "GL" not in done.stderr
    return done.stdout


@pytest.fixture
def here(root: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder, with flaprig of this clone in reach."""
    monkeypatch.setenv("PYTHONPATH", str(root))
    for name in ("DISPLAY", "MUJOCO_GL"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


@pytest.mark.parametrize("script", SCRIPTS)
def test_help_tells_the_options(root: Path, here: Path, script: str) -> None:
    said = run(root, here, script, "--help")
    assert "--out" in said and "usage" in said
    assert not list(here.iterdir())


def test_every_script_is_tested_and_in_the_readme(root: Path) -> None:
    found = {path.name for path in (root / "examples").glob("*.py")}
    assert found == set(SCRIPTS)
    text = (root / "examples" / "README.md").read_text()
    assert all(f"`{name}`" in text for name in found)
    assert all(len((root / "examples" / name).read_text().splitlines()) <= 80 for name in found)


def test_rollout(root: Path, here: Path) -> None:
    said = run(root, here, "rollout.py", "--cycles", "0.5")
    assert "250 observations" in said
    with np.load(here / "rollout.npz") as file:
        assert file["time"].shape == (250,) and file["time"][-1] == pytest.approx(2.5)
        assert file["qpos"].shape == (250, 2) and file["ctrl"].shape == (250, 6)
        assert file["aero"].shape == (250, 9) and file["load_cell"].shape == (250, 6)
        # a quarter of the stroke on: in the middle, wing down at 45 deg, lifting
        assert abs(file["qpos"][124, 0]) < 0.05
        assert file["qpos"][124, 1] == pytest.approx(np.radians(45.0), abs=0.05)
        assert file["aero"][100:150, 6].min() > 0.1


def test_batch_rollout(root: Path, here: Path) -> None:
    words = ("--pitch", "30", "60", "--cycles", "1", "--quasi-steady")
    said = run(root, here, "batch_rollout.py", *words)
    assert said.count("deg: lift") == 2
    with np.load(here / "batch.npz") as file:
        assert file["qpos"].shape == (2, 500, 2) and file["aero"].shape == (2, 500, 9)
        assert file["time"][-1] == pytest.approx(5.0)
        swing = np.degrees(np.ptp(file["qpos"][..., 1], axis=1) / 2.0)
        np.testing.assert_allclose(swing, file["pitch_deg"], atol=1.0)
        # 30 deg from the vertical is a large angle of attack: more drag
        lift, drag = file["aero"][..., 6].mean(axis=1), file["aero"][..., 7].mean(axis=1)
        assert drag[0] > 1.8 * drag[1] and np.all(lift > 0.25)


def test_feasible_stroke(root: Path, here: Path) -> None:
    words = ("--acceleration", "0.8", "--cycles", "1", "--quasi-steady")
    said = run(root, here, "feasible_stroke.py", *words)
    assert "sweep: nearest stroke 1.2" in said and "0.9649 of the amplitude" in said
    folder = here / "feasible_stroke"
    assert {p.name for p in folder.iterdir()} == {"trajectory.csv", "counts.csv", "twin.npz"}
    table = np.genfromtxt(folder / "trajectory.csv", delimiter=",", names=True)
    limit = 0.8 * np.radians(60.0) * (2.0 * np.pi * 0.2) ** 2
    assert np.abs(table["sweep_acceleration_rad_per_s2"]).max() <= limit * (1.0 + 1e-9)
    for name in ("sweep_rate_rad_per_s", "pitch_rate_rad_per_s"):
        assert table[name][0] == table[name][-1] == 0.0
    assert 0.05 < np.abs(table["sweep_torque_Nm"]).max() < 0.5
    counts = np.genfromtxt(folder / "counts.csv", delimiter=",", names=True)
    np.testing.assert_allclose(
        (counts["sweep_count"] - 2048) * 2.0 * np.pi / 4096,
        table["sweep_rad"],
        atol=np.pi / 4096 * 1.001,
    )
