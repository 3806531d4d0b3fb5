"""`flaprig demo` and `flaprig twin` with everything short."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest

from flaprig import UVLM, QuasiSteady, cli
from flaprig.commands import demo, rig_film
from flaprig.render import gl
from flaprig.report import video
from flaprig.report.film import Format
from flaprig.report.folder import Folder
from flaprig.rig import Rig

COARSE = UVLM(chordwise=2, spanwise=3, steps_per_cycle=16)


def test_twin_writes_and_tells(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = "twin --cycles 1 --chordwise 2 --spanwise 3 --steps-per-cycle 16 --time-step 0.01"
    assert cli.main([*words.split(), "--json", "--out", str(tmp_path)]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert summary["command"] == "twin" and summary["cl"] > 0.5
    assert {path.name for path in tmp_path.iterdir()} == {
        *("histories.csv", "histories.npz", "summary.json"),
        *("forces.png", "motors.png", "wake.png"),
    }


def test_demo_leaves_its_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The video has its own tests: here its place is taken by a text file."""

    def film(folder: Folder) -> str:
        folder.write_text("film.txt", "")
        return "Filmed."

    monkeypatch.setattr(demo, "MODELS", (COARSE, QuasiSteady(steps_per_cycle=20)))
    monkeypatch.setattr(demo, "TIME_STEP", 0.01)
    monkeypatch.setattr(demo, "_film", film)
    assert cli.main(["demo", "--out", str(tmp_path), "--cycles", "1"]) == 0
    out = capsys.readouterr().out
    for word in ("1.94", "0.74", "quasi-steady, twin", "Filmed."):
        assert word in out
    names = {path.name for path in tmp_path.iterdir()}
    assert names == {"forces.png", "wake.png", "motors.png", "summary.json", "film.txt"}
    summary = json.loads((tmp_path / "summary.json").read_text())
    runs = summary["runs"]
    assert len(runs) == 4
    difference = summary["difference_percent"]["quasi-steady, prescribed"]["cl"]
    expected = 100.0 * (runs["quasi-steady, prescribed"]["cl"] / 1.94 - 1.0)
    assert difference == pytest.approx(expected)


def test_mp4_without_ffmpeg(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(video, "ending", lambda: ".gif")
    stroke, span = demo._case(COARSE, 1).stroke, (0.2, 0.8)
    with pytest.raises(ValueError, match="imageio-ffmpeg"):
        rig_film.film_rig(Folder(tmp_path), "film.mp4", Rig.load(), stroke, span, Format())


@pytest.mark.parametrize("drawn", ["MuJoCo", "matplotlib"])
def test_film_by_either_means(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, drawn: str) -> None:
    if drawn == "matplotlib":
        monkeypatch.setattr(gl, "backend", lambda: None)
    elif gl.backend() is None:
        pytest.skip("no OpenGL library works here: " + gl.ADVICE)
    monkeypatch.setattr(rig_film, "SLOW_RATE", 1.0)
    rig, folder = Rig.load().with_(model=COARSE), Folder(tmp_path)
    stroke = demo._case(COARSE, 1).stroke
    form = replace(Format(), width=160, height=96, rate=1.0)
    done = rig_film.film_rig(folder, "film", rig, stroke, (0.2, 0.8), form)
    assert done.path == tmp_path / f"film{video.ending()}"
    assert done.path.stat().st_size > 500
    assert drawn in done.words
    # says how to get the better one, only where there is a better one
    assert (gl.ADVICE in done.words) == (drawn == "matplotlib")
