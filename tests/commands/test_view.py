"""`flaprig view`: a window where there is a display, else a file."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace

import mujoco.viewer
import pytest

from flaprig import cli
from flaprig.commands import rig_film
from flaprig.render import gl

COARSE = ["--chordwise", "2", "--spanwise", "3", "--steps-per-cycle", "16"]


class Window:
    """A stand-in for MuJoCo's window that is closed after some pictures."""

    def __init__(self, pictures: int) -> None:
        self.left = pictures
        self.times: list[float] = []

    def is_running(self) -> bool:
        self.left -= 1
        return self.left >= 0

    def sync(self) -> None:
        self.times.append(self.data.time)

    @contextmanager
    def lock(self) -> Iterator[None]:
        yield

    @contextmanager
    def opened(self, model: mujoco.MjModel, data: mujoco.MjData) -> Iterator[Window]:
        self.data = data
        yield self


def test_window_runs_as_fast_as_the_world(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    window = Window(pictures=12)
    monkeypatch.setattr(mujoco.viewer, "launch_passive", window.opened)
    monkeypatch.setattr(gl, "has_display", lambda: True)
    monkeypatch.chdir(tmp_path)
    assert cli.main(["view", *COARSE]) == 0
    assert len(window.times) == 12
    assert window.times == sorted(window.times) and 0.01 < window.times[-1] < 5.0
    assert not list(tmp_path.iterdir())


def test_without_a_display_a_file_is_written(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = SimpleNamespace()

    def film(folder: object, name: str, rig: object, stroke: object, *rest: object) -> object:
        asked.name, asked.span, asked.form = name, *rest
        return rig_film.Filmed(tmp_path / "flapping.mp4", "made somehow")

    monkeypatch.setattr(rig_film, "film_rig", film)
    monkeypatch.setattr(gl, "has_display", lambda: False)
    monkeypatch.chdir(tmp_path)
    assert cli.main(["view", "--skip", "0.5", "--cycles", "2", "--rate", "10"]) == 0
    assert asked.name == "flapping" and asked.span == (0.5, 2.5) and asked.form.rate == 10.0
    out = capsys.readouterr().out
    assert "made somehow" in out and "where there is a display" in out


@pytest.mark.parametrize("name", ["DISPLAY", "WAYLAND_DISPLAY"])
def test_display_of_linux(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.setattr(gl.sys, "platform", "linux")
    for variable in ("DISPLAY", "WAYLAND_DISPLAY"):
        monkeypatch.delenv(variable, raising=False)
    assert not gl.has_display()
    monkeypatch.setenv(name, ":0")
    assert gl.has_display()
