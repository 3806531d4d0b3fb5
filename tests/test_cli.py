"""The command line: exit codes, one sentence for bad input, one JSON object on stdout."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from flaprig import cli
from flaprig.commands import simulate

ROOT = Path(__file__).resolve().parents[1]
# quick: quasi-steady, one cycle
QUICK = ["simulate", "--model", "quasi-steady", "--cycles", "1"]


@pytest.mark.parametrize("words", [[], *([name] for name in ("simulate", "twin", "view", "demo"))])
def test_help_of_every_command(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        cli.main([*words, "--help"])
    out, err = capsys.readouterr()
    assert stop.value.code == 0
    assert out.startswith("usage: flaprig") and not err
    assert "default: None" not in out


def test_json_is_one_object_and_nothing_else(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*QUICK, "--json"]) == 0
    out, err = capsys.readouterr()
    summary = json.loads(out)
    assert summary["model"] == "quasi-steady" and summary["cycles"] == 1
    # one averaged cycle has no spread: NaN, which JSON does not know
    assert summary["cl_spread"] is None
    assert summary["cl"] == pytest.approx(2.137, abs=0.01)
    assert not err


def test_table_is_for_people(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(QUICK) == 0
    out, _ = capsys.readouterr()
    assert "C_L" in out and "N m" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["simulate", "--frequency", "-1"], "frequency"),
        (["simulate", "--frequency", "nan"], "frequency"),
        (["simulate", "--sweep-amplitude", "200"], "--sweep-amplitude"),
        (["simulate", "--core", "inf"], "core"),
        (["simulate", "--cycles", "0"], "cycles"),
        (["simulate", "--cycles", "2.5"], "--cycles"),
        (["simulate", "--span", "-0.1"], "span"),
        (["simulate", "--density", "0"], "density"),
        (["simulate", "--model", "cfd"], "--model"),
        (["simulate", "--model", "quasi-steady", "--chordwise", "8"], "--chordwise"),
        (["simulate", "--coefficients", "lee2016"], "--coefficients"),
        (["simulate", "--r1", "0.5"], "--r1"),
        (["simulate", "--stroke", "no_such_file.json"], "no_such_file.json"),
        (["simulate", "--speed", "3"], "--speed"),
        (["view", "--width", "100"], "--width"),
        (["view", "--video", "film.avi"], "--video"),
        (["fly"], "fly"),
        ([], "simulate"),
    ],
)
def test_bad_input_is_one_sentence(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(words) == 2
    out, err = capsys.readouterr()
    assert not out
    assert err.startswith("flaprig: ") and said in err
    assert err.count("\n") == 1 and "Traceback" not in err


@pytest.mark.parametrize("encoding", ["ascii", "utf-8"])
def test_any_terminal(encoding: str) -> None:
    """Frames and signs that a terminal cannot show change nothing else."""
    variables = os.environ | {"PYTHONIOENCODING": encoding}
    for words, code, said in ((QUICK, 0, b"C_L"), ([*QUICK, "--speed"], 2, b"options: --speed (")):
        command = [sys.executable, "-m", "flaprig", *words]
        done = subprocess.run(command, capture_output=True, cwd=ROOT, env=variables, check=False)
        assert done.returncode == code and said in done.stdout + done.stderr


@pytest.mark.parametrize("inside", ["", "deeper"])
def test_out_that_is_a_file(
    tmp_path: Path, inside: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "taken").write_text("mine")
    assert cli.main([*QUICK, "--out", str(tmp_path / "taken" / inside)]) == 2
    assert "--out must be a folder" in capsys.readouterr().err
    assert (tmp_path / "taken").read_text() == "mine"


def test_ctrl_c_says_what_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(simulate, "write_pictures", interrupted)
    assert cli.main([*QUICK, "--out", str(tmp_path)]) == 130
    err = capsys.readouterr().err
    assert "histories.csv, histories.npz, summary.json" in err and err.count("\n") == 1
    monkeypatch.setattr(simulate.flaprig, "simulate", interrupted)
    assert cli.main([*QUICK, "--out", str(tmp_path / "new")]) == 130
    assert "nothing was written" in capsys.readouterr().err


@pytest.mark.parametrize("error", [FloatingPointError, ImportError, RuntimeError])
def test_a_run_that_fails(
    error: type[Exception], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def fails(*_: object, **__: object) -> None:
        raise error("the wake\nblew up")

    monkeypatch.setattr(simulate.flaprig, "simulate", fails)
    assert cli.main(QUICK) == 1
    assert capsys.readouterr().err == "flaprig: the wake blew up\n"


def test_reader_that_goes_away() -> None:
    """`flaprig simulate --json | true` must not print a traceback."""
    command = [sys.executable, "-m", "flaprig", *QUICK, "--json"]
    read, write = os.pipe()
    os.close(read)
    with os.fdopen(write, "wb") as closed:
        done = subprocess.run(command, stdout=closed, stderr=subprocess.PIPE, cwd=ROOT, check=False)
    assert done.returncode == 1
    assert done.stderr == b""


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out.strip()
