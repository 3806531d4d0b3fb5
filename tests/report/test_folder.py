"""Folders of results: made when needed, files whole or absent."""

from __future__ import annotations

from pathlib import Path

import pytest

from flaprig.report.folder import Folder


def test_creates_and_remembers(tmp_path: Path) -> None:
    folder = Folder(tmp_path / "a" / "b")
    folder.create()
    folder.create()
    folder.write_text("one.txt", "1")
    folder.write("two.bin", lambda draft: draft.write_bytes(b"2"))
    assert folder.written == [tmp_path / "a/b/one.txt", tmp_path / "a/b/two.bin"]
    assert (tmp_path / "a/b/one.txt").read_text() == "1"


def test_a_writer_that_fails_leaves_the_old_file(tmp_path: Path) -> None:
    folder = Folder(tmp_path)
    (tmp_path / "x.txt").write_text("old")

    def fails(draft: Path) -> None:
        draft.write_text("half")
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        folder.write("x.txt", fails)
    assert [path.name for path in tmp_path.iterdir()] == ["x.txt"]
    assert (tmp_path / "x.txt").read_text() == "old" and not folder.written


def test_without_a_path_nothing_happens() -> None:
    folder = Folder(None)
    folder.create()
    folder.write_text("x.txt", "1")
    assert not folder and not folder.written


def test_a_file_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "x").touch()
    for path in (tmp_path / "x", tmp_path / "x" / "y"):
        with pytest.raises(ValueError, match="--out must be a folder"):
            Folder(path).create()
