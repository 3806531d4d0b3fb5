"""Folders of results: made when needed, files whole or absent."""

from __future__ import annotations

import json
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


def run(path: Path, *names: str, finish: bool = True) -> Folder:
    """A run that writes files of these names, and its summary where it comes to an end."""
    folder = Folder(path)
    folder.create()
    for name in names:
        folder.write_text(name, name)
    if finish:
        folder.write_summary({"command": "test"})
    folder.release()
    return folder


def names_in(path: Path) -> list[str]:
    return sorted(p.relative_to(path).as_posix() for p in path.rglob("*") if p.is_file())


def test_a_new_run_leaves_nothing_of_an_old_one(tmp_path: Path) -> None:
    (tmp_path / "mine.csv").write_text("mine")
    run(tmp_path, "a.csv", "b.csv")
    second = run(tmp_path, "a.csv")
    assert names_in(tmp_path) == ["a.csv", "mine.csv", "summary.json"]
    assert second.sentences().endswith("Removed, of an earlier run: b.csv")
    third = run(tmp_path, "c.csv")
    assert names_in(tmp_path) == ["c.csv", "mine.csv", "summary.json"]
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["files"] == ["c.csv", "summary.json"]
    assert len(summary["run_id"]) == 32 and "a.csv" in third.sentences()


@pytest.mark.parametrize("finish", [True, False])
def test_files_of_a_run_without_an_end_are_known_too(tmp_path: Path, finish: bool) -> None:
    """Killed, stopped or without a summary: the next run still removes what it wrote."""
    (tmp_path / "deep").mkdir()
    run(tmp_path, "a.csv", "deep/b.csv", finish=finish)
    run(tmp_path, "c.csv", finish=False)
    run(tmp_path, "d.csv")
    assert names_in(tmp_path) == ["d.csv", "summary.json"]


def test_a_run_that_fails_before_its_first_file_leaves_the_old_ones(tmp_path: Path) -> None:
    run(tmp_path, "a.csv", "b.csv")
    before = {name: (tmp_path / name).read_bytes() for name in names_in(tmp_path)}

    def fails(draft: Path) -> None:
        draft.write_text("half")
        raise OSError("disk full")

    folder = Folder(tmp_path)
    folder.create()
    with pytest.raises(OSError, match="disk full"):
        folder.write("a.csv", fails)
    folder.release()
    assert {name: (tmp_path / name).read_bytes() for name in names_in(tmp_path)} == before


def test_two_runs_at_a_time_are_refused(tmp_path: Path) -> None:
    first = Folder(tmp_path / "out")
    first.create()
    with pytest.raises(ValueError, match="--out must be a folder that no other run writes into"):
        Folder(tmp_path / "out").create()
    first.release()
    Folder(tmp_path / "out").create()


def test_a_shared_folder_keeps_everything(tmp_path: Path) -> None:
    run(tmp_path, "a.csv")
    folder = Folder(None)
    folder.share(tmp_path)
    folder.create()
    folder.write_text("film.txt", "film")
    assert names_in(tmp_path) == ["a.csv", "film.txt", "summary.json"]


@pytest.mark.parametrize(
    "text",
    [
        "{", "[]", "{}", '{"files": ["mine.csv"]}', '{"run_id": "x", "files": "mine.csv"}',
        '{"run_id": "x", "files": [["mine.csv"], 3]}', '{"run_id": "x", "files": ["../mine.csv"]}',
        "[" * 100_000,
    ],
)  # fmt: skip
def test_somebody_elses_summary_removes_nothing(tmp_path: Path, text: str) -> None:
    out = tmp_path / "out"
    out.mkdir()
    for place in (tmp_path, out):
        (place / "mine.csv").write_text("mine")
    (out / "summary.json").write_text(text)
    run(out, "a.csv")
    assert names_in(out) == ["a.csv", "mine.csv", "summary.json"]
    assert (tmp_path / "mine.csv").read_text() == "mine"


def test_a_damaged_list_is_one_sentence(tmp_path: Path) -> None:
    run(tmp_path, "a.csv", finish=False)
    (tmp_path / ".flaprig_run.json").write_text("{")
    with pytest.raises(ValueError, match="is damaged; remove it"):
        Folder(tmp_path).create()
