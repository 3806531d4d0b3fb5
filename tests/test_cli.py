"""The command line: exit codes, one sentence for bad input, one JSON object on stdout."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
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

    monkeypatch.setattr(simulate, "write_forces", interrupted)
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


# interrupts the program where it begins to load a module, and runs it
INTERRUPT = """
import os, signal, sys
module = sys.argv[1]
class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == module:
            os.kill(os.getpid(), signal.SIGINT)
sys.meta_path.insert(0, Finder())
# a shell without job control starts programs deaf to it
signal.signal(signal.SIGINT, signal.default_int_handler)
from flaprig.__main__ import main
sys.argv = ["flaprig", "simulate"]
sys.exit(main())
"""


@pytest.mark.parametrize("module", ["flaprig.cli", "numpy", "rich.console", "tyro", "scipy"])
def test_ctrl_c_while_loading_is_one_line(module: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPT, module], capture_output=True, cwd=ROOT, check=False
    )
    assert done.returncode == 130
    assert done.stderr == b"flaprig: stopped; nothing was written\n" and not done.stdout


def test_the_installed_command_is_the_one_that_hears_ctrl_c() -> None:
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert project["scripts"] == {"flaprig": "flaprig.__main__:main"}


@pytest.mark.parametrize(("words", "code"), [(QUICK, 1), (["check", "--cycles", "2"], 3)])
@pytest.mark.parametrize("words_of_it", ["Unable to allocate 4.00 EiB", ""])
def test_too_little_memory_is_one_line(
    words: list[str],
    code: int,
    words_of_it: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def fails(*_: object, **__: object) -> None:
        if words_of_it:
            np.empty(2**59)
        raise MemoryError

    monkeypatch.setattr(simulate.flaprig, "simulate", fails)
    monkeypatch.setattr("flaprig.feasibility.check_feasibility", fails)
    assert cli.main(words) == code
    out, err = capsys.readouterr()
    assert not out and err.count("\n") == 1
    assert err.startswith("flaprig: the memory is too small for this run") and words_of_it in err


def shell(line: str) -> subprocess.CompletedProcess[str]:
    """A line of the shell with `flaprig` in it."""
    line = line.replace("flaprig", f"{sys.executable} -m flaprig", 1)
    return subprocess.run(["bash", "-c", line], capture_output=True, text=True, cwd=ROOT)


@pytest.mark.parametrize("words", [" ".join([*QUICK, "--json"]), "--help", "--version", "validate"])
def test_closed_output_is_one_line(words: str) -> None:
    """Nothing is computed whose result nobody could see."""
    done = shell(f"flaprig {words} >&-")
    assert done.returncode == 2
    assert done.stderr.startswith("flaprig: standard output is closed")
    assert done.stderr.count("\n") == 1


def test_closed_output_does_not_matter_to_files(tmp_path: Path) -> None:
    done = shell(f"flaprig {' '.join(QUICK)} --out {tmp_path} >&- <&-")
    assert done.returncode == 0 and not done.stderr
    assert json.loads((tmp_path / "summary.json").read_text())["cl"] > 2.0
    with np.load(tmp_path / "histories.npz") as data:
        assert np.isfinite(data["lift_N"]).all()


def test_closed_error_stream_puts_no_error_on_the_output() -> None:
    done = shell("flaprig simulate --cycles 0 2>&-")
    assert done.returncode == 2 and not done.stdout
    assert shell("flaprig simulate --cycles 0 2>&- >&-").returncode == 2


@pytest.mark.parametrize(
    ("words", "said", "page"),
    [
        (["simulat"], "perhaps you meant simulate", "flaprig --help"),
        (["chek", "--json"], "perhaps you meant check", "flaprig --help"),
        (["twin", "--time-stp", "3"], "perhaps you meant --time-step", "flaprig twin --help"),
        (["check", "--rms-trackin", "2"], "--rms-tracking", "flaprig check --help"),
        (
            ["validate", "wagner", "--chordwis", "2"],
            "--chordwise",
            "flaprig validate wagner --help",
        ),
        (["bench", "--jsn"], "perhaps you meant --json", "flaprig bench --help"),
        (["export", "--intervall", "1"], "perhaps you meant --interval", "flaprig export --help"),
        (["simulate", "--speed", "3"], "options: --speed, 3 (", "flaprig simulate --help"),
    ],
)
@pytest.mark.parametrize("encoding", ["ascii", "utf-8"])
def test_a_slip_of_the_keyboard_is_helped(
    words: list[str],
    said: str,
    page: str,
    encoding: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("PYTHONIOENCODING", encoding)
    assert cli.main(words) == 2
    err = capsys.readouterr().err
    assert said in err and f"({page} " in err and err.count("\n") == 1


def test_out_of_two_runs_holds_the_second_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The run's number is in every file with room for it; the first run's files are gone."""
    quick = [*QUICK, "--out", str(tmp_path), "--json"]
    assert cli.main(["export", "--cycles", "1", "--out", str(tmp_path)]) == 0
    assert (tmp_path / "trajectory.csv").is_file()
    found = []
    for _ in range(2):
        capsys.readouterr()
        assert cli.main(quick) == 0
        found.append(json.loads(capsys.readouterr().out)["run_id"])
    assert found[0] != found[1]
    assert {path.name for path in tmp_path.iterdir()} == {
        *("histories.csv", "histories.npz", "summary.json", "forces.png"),
    }
    with np.load(tmp_path / "histories.npz") as data:
        assert json.loads(str(data["summary"]))["run_id"] == found[1]
    assert found[1].encode() in (tmp_path / "forces.png").read_bytes()


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["--version"]) == 0
    assert capsys.readouterr().out.strip()
