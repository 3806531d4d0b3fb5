"""The choice of an OpenGL library."""

from __future__ import annotations

import pytest

from flaprig.render import gl


def test_switched_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MUJOCO_GL", "disabled")
    assert gl.backend() is None


def test_first_that_works_is_taken(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    monkeypatch.setattr(gl, "_candidates", lambda: ["egl", "osmesa"])
    monkeypatch.setattr(gl, "works", lambda name: name == "osmesa")
    assert gl.backend() == "osmesa"
    monkeypatch.setattr(gl, "works", lambda name: False)
    assert gl.backend() is None


def test_the_user_decides(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MUJOCO_GL", "osmesa")
    tried: list[str] = []
    monkeypatch.setattr(gl, "works", lambda name: bool(tried.append(name)))
    assert gl.backend() is None and tried == ["osmesa"]


def test_library_that_does_not_exist() -> None:
    assert not gl.works("no_such_library")
