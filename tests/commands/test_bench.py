"""`flaprig bench`: benchmarks by name, their own options, JSON, pictures and the page."""

from __future__ import annotations

import json
from functools import partial
from pathlib import Path

import pytest

from flaprig import cli
from flaprig.benchmark.kernel import Kernel
from flaprig.benchmark.suite import BENCHMARKS
from flaprig.benchmark.window import Window
from flaprig.commands import bench

GRID = "--chordwise 1 --spanwise 2 --steps-per-cycle 8 --cycles 1 --turns 2"
WINDOW = ["bench", "window", *GRID.split()]


@pytest.fixture
def few(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two small benchmarks are all there are."""
    small = {
        "kernel": partial(Kernel, rows=3, strips=2, duration=1e-4, turns=1),
        "window": partial(Window, chordwise=1, spanwise=2, steps_per_cycle=8, cycles=1, turns=1),
    }
    monkeypatch.setattr(bench, "BENCHMARKS", small)
    monkeypatch.setattr(bench, "benchmark_named", small.__getitem__)


def test_one_benchmark_takes_its_own_options(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main([*WINDOW, "--json"]) == 0
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert found["command"] == "bench" and found["machine"]["cores"] >= 1
    (part,) = found["benchmarks"]
    assert part["benchmark"] == "window" and part["wall_time_s"] >= 0.0
    assert part["command"] == f"flaprig bench window {GRID}"
    for row in part["rows"]:
        assert row["command"] == part["command"] and len(row["turns"]) == 2
        assert row["value"] > 0.0 and row["unit"] in {"s", "x"}
    assert not err


def test_table_is_for_people(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(WINDOW) == 0
    out = capsys.readouterr().out
    assert "window: the paper's window" in out and "default dial" in out and "cores" in out


def test_without_a_name_all_of_them_run(
    few: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["bench", "--json", "--out", str(tmp_path)]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [part["benchmark"] for part in found["benchmarks"]] == ["kernel", "window"]
    assert json.loads((tmp_path / "summary.json").read_text()) == found
    # neither has a picture
    assert [path.name for path in tmp_path.iterdir()] == ["summary.json"]


def test_the_page_has_every_row(
    few: None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["bench", "--all", "--out", str(tmp_path)]) == 0
    text = (tmp_path / "benchmarks.md").read_text()
    assert "| processor |" in text and "| date | 20" in text and "| numpy |" in text
    # one in the section of aims, one in its own
    assert text.count("1 cycles, default dial |") == 2
    assert "| edges, single precision, 1 thread |" in text
    assert "`flaprig bench kernel --rows 3" in text and "## window" in text
    assert f"Written to {tmp_path}" in capsys.readouterr().out.replace("\n", "")


def test_pictures_go_beside_the_page(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    growth = partial(
        BENCHMARKS["growth"], steps=(8, 16), spanwise=(2, 4), steps_per_cycle=8, turns=1
    )
    monkeypatch.setattr(bench, "BENCHMARKS", {"growth": growth})
    monkeypatch.setattr(bench, "benchmark_named", lambda name: growth)
    assert cli.main(["bench", "--all", "--out", str(tmp_path)]) == 0
    assert "![growth](images/benchmarks/growth.png)" in (tmp_path / "benchmarks.md").read_text()
    assert (tmp_path / "images" / "benchmarks" / "growth.png").is_file()
    capsys.readouterr()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nonsense"], "bench: NAME must be one of peer, "),
        (["nonsense", "--json"], "bench: NAME must be one of peer, "),
        (["window", "nonsense"], "bench: NAME must be one of peer, "),
        (["window", "--aspect-ratio", "3"], "--aspect-ratio"),
        (["window", "--cycles", "0"], "window: cycles must be"),
        (["window", "kernel", "--cycles", "4"], "--cycles"),
        (["window", "--all"], "--all must be given without names"),
    ],
)
def test_bad_words_are_one_sentence(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["bench", *words]) == cli.BAD_INPUT
    out, err = capsys.readouterr()
    assert said in err and err.count("\n") == 1 and not out


def test_help_names_every_benchmark(capsys: pytest.CaptureFixture[str]) -> None:
    for words in (["bench", "--help"], ["bench", "peer", "--help"]):
        with pytest.raises(SystemExit) as stop:
            cli.main(words)
        assert stop.value.code == 0
    out = capsys.readouterr().out
    assert f"Benchmarks: {', '.join(BENCHMARKS)};" in " ".join(out.split())
    assert "--peer-repeats INT" in out
