"""What learning refuses before it writes, what --ppo.log-std does, and files from elsewhere."""

from __future__ import annotations

import io
import json
import zipfile
from pathlib import Path

import numpy as np
import pytest
import torch

from flaprig.files import FolderLock
from flaprig.tasks.hover_settings import HoverSettings
from training import baselines, checkpoint, export, ppo
from training.learner import build
from training.records import read_metrics
from training.settings import FIRST_LOG_STD, Pace, Ppo
from training.vector import HoverVecEnv

PACE = Pace(steps=64, envs=4, rollout=8, batch=32, epochs=1, learning_rate=1e-3)


@pytest.mark.parametrize(
    "lattice",
    [
        ("chordwise", "64", "spanwise", "128", "at most 1024, got 8192"),
        ("spanwise", "0", "cycles", "1", "spanwise must be a whole number"),
        ("steps-per-cycle", "5", "cycles", "2", "steps_per_cycle"),
        ("chordwise", "33", "spanwise", "32", "got 1056"),
    ],
)
@pytest.mark.parametrize("program", [ppo, baselines])
def test_a_wrong_lattice_leaves_no_folder(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], lattice: tuple[str, ...], program: object
) -> None:
    """Also where the first stage would not need it."""
    first, value, second, other, said = lattice
    words = [f"--problem.lattice.{first}", value, f"--problem.lattice.{second}", other]
    assert program.main(["--out", str(tmp_path / "run"), *words]) == 2
    err = capsys.readouterr().err
    assert said in err and err.count("\n") == 1
    assert not (tmp_path / "run").exists()


def test_exploration_of_a_beginning() -> None:
    assert Ppo().begun(trained=False).log_std == FIRST_LOG_STD
    assert Ppo().begun(trained=True).log_std == Ppo().last_log_std
    for trained in (False, True):
        assert Ppo(log_std=-0.5).begun(trained).log_std == -0.5
    with pytest.raises(ValueError, match="last_log_std must be a number from -7 to -4"):
        Ppo(log_std=-4.0)


def test_log_std_with_start_is_what_was_asked(tmp_path: Path, small: list[str]) -> None:
    """Both kinds of start; left out, a trained policy explores as it did at its end."""
    short = [w if w != "768" else "128" for w in small]
    assert ppo.main(["--out", str(tmp_path / "first"), *short]) == 0
    for file in ("checkpoint.pt", "policy.npz"):
        start = ["--start", str(tmp_path / "first" / file), "--quasi-steady.learning-rate", "1e-8"]
        found = []
        for name, words in (("asked", ["--ppo.log-std", "-1"]), ("left_out", [])):
            # two updates: the cap has come half the way down after the first
            more = [w if w != "128" else "256" for w in short]
            out = tmp_path / f"{file}_{name}"
            assert ppo.main(["--out", str(out), *more, *start, *words]) == 0
            found.append(float(read_metrics(out / "metrics.csv")[0]["std"]))
        assert found == pytest.approx([np.exp(-2.25), np.exp(-3.5)], rel=1e-3)


def test_a_start_that_is_no_policy_leaves_no_run(
    tmp_path: Path, small: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "p.npz").write_bytes(b"nothing")
    words = ["--out", str(tmp_path / "run"), *small]
    assert ppo.main([*words, "--start", str(tmp_path / "p.npz")]) == 2
    assert "no exported policy" in capsys.readouterr().err
    assert not (tmp_path / "run" / "config.json").exists()
    assert ppo.main([w if w != "768" else "128" for w in words]) == 0


def test_other_settings_are_told_the_way_on(
    tmp_path: Path, small: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "config.json").write_text('{"settings": {"seed": 9}}')
    assert ppo.main(["--out", str(tmp_path), *small, "--resume"]) == 2
    assert f"--start {tmp_path / 'checkpoint.pt'}" in capsys.readouterr().err
    for damaged in ("{", "[]", '{"settings": 3}'):
        (tmp_path / "config.json").write_text(damaged)
        assert ppo.main(["--out", str(tmp_path), *small, "--resume"]) == 2
        err = capsys.readouterr().err
        assert "no config of a run" in err and err.count("\n") == 1


def test_two_runs_in_one_folder(
    tmp_path: Path, small: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    lock = FolderLock(tmp_path)
    assert ppo.main(["--out", str(tmp_path), *small]) == 2
    assert "that no other run writes into" in capsys.readouterr().err
    lock.release()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("error", [MemoryError(), RuntimeError("torch"), TypeError("a fault")])
def test_failures_are_one_line(
    tmp_path: Path,
    small: list[str],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    error: Exception,
) -> None:
    def fails(*_: object) -> None:
        raise error

    monkeypatch.setattr(ppo.Run, "run", fails)
    if isinstance(error, TypeError):
        # what nobody expects is a fault of the program, and shown as such
        with pytest.raises(TypeError):
            ppo.main(["--out", str(tmp_path), *small])
        return
    assert ppo.main(["--out", str(tmp_path), *small]) == 1
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "config.json").exists()


class Trap:
    def __reduce__(self) -> tuple[object, ...]:
        return Path.touch, (Path("never"),)


def test_torchs_advice_to_run_the_file_reaches_nobody(tmp_path: Path) -> None:
    torch.save({"version": 1, "x": Trap()}, tmp_path / "a.pt")
    (tmp_path / "b.pt").write_bytes(b"PK\x03\x04 cut")
    for name in ("a.pt", "b.pt"):
        with pytest.raises(ValueError, match="read safely") as caught:
            checkpoint.read(tmp_path / name)
        for word in ("weights_only", "trust", "arbitrary", "PyTorch", "\n"):
            assert word not in str(caught.value)


def bomb(path: Path, claimed: int, stored: int) -> None:
    """An NPZ whose array claims a number of bytes, and unpacks to another."""
    head = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        head, {"descr": "<f8", "fortran_order": False, "shape": (claimed // 8,)}
    )
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        about = io.BytesIO()
        np.save(about, np.array(json.dumps({"format": export.FORMAT})))
        archive.writestr("about.npy", about.getvalue())
        with archive.open("log_std.npy", "w", force_zip64=True) as member:
            member.write(head.getvalue())
            for _ in range(stored // 2**20):
                member.write(bytes(2**20))


@pytest.mark.parametrize(
    ("claimed", "stored", "said"),
    [
        (2**27, 2**27, "at most 64 MiB unpacked, got 128 MiB"),
        (2**62, 2**20, "no exported policy"),
        (2**36, 2**20, "no exported policy"),
    ],
)
def test_zip_bombs_are_one_sentence(tmp_path: Path, claimed: int, stored: int, said: str) -> None:
    bomb(tmp_path / "p.npz", claimed, stored)
    assert (tmp_path / "p.npz").stat().st_size < 2**19
    with pytest.raises(ValueError, match=said):
        export.load_weights(tmp_path / "p.npz")


def test_a_policy_is_far_below_the_limit(tmp_path: Path) -> None:
    policy = build(HoverVecEnv(HoverSettings(threads=1), 4), PACE, Ppo(), 5).policy
    export.save_policy(tmp_path / "p.npz", policy, {})
    export.check_size(tmp_path / "p.npz", export.MOST_BYTES // 100)
