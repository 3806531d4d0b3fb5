"""Training by its command line: it learns, repeats itself, survives SIGKILL, refuses nonsense."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from flaprig.strokes import FourierStroke, load
from training import checkpoint, ppo
from training.settings import Pace


def rows(folder):
    """Metrics without the wall time, which is no part of the curve."""
    with open(folder / "metrics.csv", newline="") as stream:
        found = list(csv.DictReader(stream))
    return [{k: v for k, v in row.items() if k != "seconds"} for row in found]


def train(folder, words):
    assert ppo.main(["--out", str(folder), *words]) == 0
    return rows(folder)


def test_a_short_training_improves_the_reward(tmp_path, small):
    words = [w if w != "768" else "10240" for w in small]
    found = train(tmp_path / "run", words)
    rewards = [float(row["reward_mean"]) for row in found]
    best = float(found[-1]["best_reward"])
    # the sinusoid is worth 0.2135; noise alone, in the first updates, much less than that
    assert np.mean(rewards[-10:]) > np.mean(rewards[:10]) + 0.3
    assert best > 1.5


def test_same_seed_same_curve_and_other_seed_another(tmp_path, small):
    first, second = (train(tmp_path / name, small) for name in ("a", "b"))
    assert first == second
    assert train(tmp_path / "c", ["--seed", "4", *small[2:]]) != first


def test_transfer_to_the_lattice_and_the_files_left_behind(tmp_path, small):
    coarse = ["--uvlm.envs", "2", "--uvlm.rollout", "4", "--uvlm.batch", "8", "--uvlm.epochs", "1"]
    lattice = ["--problem.lattice.chordwise", "2", "--problem.lattice.spanwise", "3"]
    steps = ["--problem.lattice.steps-per-cycle", "20", "--problem.horizon", "8"]
    words = [w if w != "768" else "128" for w in small if w not in ("--uvlm.steps", "0")]
    found = train(tmp_path, [*words, "--uvlm.steps", "16", *coarse, *lattice, *steps])
    assert [row["stage"] for row in found] == ["quasi_steady", "uvlm", "uvlm"]
    assert isinstance(load(tmp_path / "best_quasi_steady.json"), FourierStroke)
    assert isinstance(load(tmp_path / "best_uvlm.json"), FourierStroke)
    config = json.loads((tmp_path / "config.json").read_text())
    assert config["settings"]["seed"] == 3 and "torch" in config["versions"]
    assert (tmp_path / "policy.npz").is_file() and (tmp_path / "tensorboard").is_dir()
    # exploration goes on where the first stage left it
    assert float(found[1]["std"]) <= np.exp(-3.5) + 1e-6


def killed(folder, words, updates):
    """Run in a process of its own, killed as soon as it has kept some updates."""
    command = [sys.executable, "-m", "training.ppo", "--out", str(folder), *words]
    path = os.pathsep.join(filter(None, [os.getcwd(), os.environ.get("PYTHONPATH")]))
    process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": path})
    deadline = time.monotonic() + 120.0
    while time.monotonic() < deadline and process.poll() is None:
        file = folder / "checkpoint.pt"
        if file.is_file() and len(checkpoint.read(file)["rows"]) >= updates:
            break
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    return process.wait()


def test_killed_and_resumed_is_the_uninterrupted_run(tmp_path, small):
    words = [w if w != "768" else "2560" for w in small]
    whole = train(tmp_path / "whole", words)
    assert killed(tmp_path / "cut", words, 3) == -signal.SIGKILL
    kept = checkpoint.read(tmp_path / "cut" / "checkpoint.pt")["rows"]
    assert 3 <= len(kept) < len(whole)
    assert train(tmp_path / "cut", [*words, "--resume"]) == whole
    a, b = (checkpoint.read(tmp_path / name / "checkpoint.pt") for name in ("whole", "cut"))
    for name, value in a["learner"]["policy"].items():
        assert (value == b["learner"]["policy"][name]).all(), name


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["--quasi-steady.batch", "100"], "batch must be a divisor"),
        (["--problem.bounds.sweep", "nan"], "sweep must be a number from 1"),
        (["--problem.horizon", "0"], "horizon must be"),
        (["--ppo.gamma", "1.5"], "gamma must be"),
        (["--seed", "-1"], "seed must be"),
        (["--start", "nowhere.pt"], "there is none"),
        (["--quasi-steady.steps", "0", "--uvlm.steps", "0"], "must have steps"),
    ],
)
def test_wrong_settings_are_one_sentence_and_leave_no_folder(tmp_path, capsys, words, sentence):
    out = tmp_path / "run"
    assert ppo.main(["--out", str(out), *words]) == 2
    assert sentence in capsys.readouterr().err
    assert not out.exists()


def test_wrong_settings_fail_before_torch_is_imported(tmp_path):
    # importing torch is what takes longer than a second
    code = (
        "import sys; from training import ppo; "
        f"code = ppo.main(['--out', {str(tmp_path / 'run')!r}, '--ppo.gamma', '2']); "
        "sys.exit(3 if 'torch' in sys.modules else code)"
    )
    path = os.pathsep.join(filter(None, [os.getcwd(), os.environ.get("PYTHONPATH")]))
    done = subprocess.run([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": path},
                          capture_output=True, text=True)  # fmt: skip
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_a_folder_in_use_is_refused(tmp_path, small, capsys):
    (tmp_path / "config.json").write_text('{"settings": {"seed": 9}}')
    assert ppo.main(["--out", str(tmp_path), *small]) == 2
    assert "--resume continues it" in capsys.readouterr().err
    assert ppo.main(["--out", str(tmp_path), *small, "--resume"]) == 2
    assert "other settings of" in capsys.readouterr().err


def test_help_says_what_every_setting_is(capsys):
    with pytest.raises(SystemExit) as stop:
        ppo.main(["--help"])
    assert stop.value.code == 0
    text = capsys.readouterr().out
    for word in ("--resume", "--quasi-steady.learning-rate", "--problem.bounds.sweep", "discount"):
        assert word in text


def test_updates_are_whole():
    assert Pace(100, 8, 8, 32, 1, 1e-3).updates == 2
