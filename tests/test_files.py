"""Files are whole or absent, on the disk before they count, and drafts of the dead are swept."""

from __future__ import annotations

import errno
import os
import signal
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from flaprig import QuasiSteady, SunTangStroke, simulate
from flaprig.files import FolderLock, sweep_drafts, written_whole
from flaprig.wing import RIG_WING

ROOT = Path(__file__).resolve().parents[1]
STROKE = SunTangStroke(0.2, 1.0, 0.8)
# begins a draft in the folder of its argument, says so, and waits to be killed
WRITER = """
import sys
from flaprig.files import written_whole
with written_whole(sys.argv[1] + "/run.csv") as draft:
    draft.write_text("half")
    print("writing", flush=True)
    sys.stdin.read()
"""


def started(folder: Path) -> subprocess.Popen[str]:
    command = [sys.executable, "-c", WRITER, str(folder)]
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, cwd=ROOT
    )
    assert process.stdout is not None and process.stdout.readline() == "writing\n"
    return process


def test_draft_and_folder_are_on_the_disk_around_the_rename(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    steps: list[str] = []
    sync, replace = os.fsync, Path.replace

    def synced(number: int) -> None:
        steps.append("folder" if stat.S_ISDIR(os.fstat(number).st_mode) else "file")
        sync(number)

    def replaced(self: Path, target: Path) -> Path:
        steps.append("rename")
        return replace(self, target)

    monkeypatch.setattr(os, "fsync", synced)
    monkeypatch.setattr(Path, "replace", replaced)
    with written_whole(tmp_path / "a.txt") as draft:
        draft.write_text("whole")
    assert steps == ["file", "rename", "folder"]
    assert (tmp_path / "a.txt").read_text() == "whole"


def test_a_disk_that_is_full_at_the_end_keeps_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "a.txt").write_text("old")

    def full(number: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"), written_whole(tmp_path / "a.txt") as draft:
        draft.write_text("new")
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]
    assert (tmp_path / "a.txt").read_text() == "old"


@pytest.mark.parametrize("name", ["run.csv", "run.npz"])
def test_an_error_names_the_target_and_not_the_draft(tmp_path: Path, name: str) -> None:
    result = simulate(RIG_WING, STROKE, QuasiSteady(steps_per_cycle=20), cycles=1)
    target = tmp_path / "nodir" / name
    for save in (result.save, lambda path: STROKE.save(path.with_suffix(".json"))):
        with pytest.raises(FileNotFoundError) as caught:
            save(target)
        assert Path(caught.value.filename).parent == target.parent
        assert Path(caught.value.filename).stem == "run" and ".part" not in str(caught.value)


def test_a_target_that_is_a_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "s.json").mkdir()
    with pytest.raises(IsADirectoryError) as caught:
        STROKE.save(tmp_path / "s.json")
    assert str(caught.value).endswith(f"{str(tmp_path / 's.json')!r}")
    assert [path.name for path in tmp_path.iterdir()] == ["s.json"]


def test_drafts_of_killed_writers_are_swept_and_no_others(tmp_path: Path) -> None:
    killed, alive = started(tmp_path), started(tmp_path)
    try:
        assert len(list(tmp_path.iterdir())) == 2
        killed.send_signal(signal.SIGKILL)
        killed.communicate()
        # what only looks alike is somebody's own
        (tmp_path / ".mine.part.csv").write_text("mine")
        sweep_drafts(tmp_path)
        assert len(list(tmp_path.iterdir())) == 2
        assert alive.communicate("")[0] == "" and alive.returncode == 0
    finally:
        alive.kill()
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == [".mine.part.csv", "run.csv"]
    assert (tmp_path / "run.csv").read_text() == "half"


def test_a_folder_is_locked_until_it_is_released(tmp_path: Path) -> None:
    lock = FolderLock(tmp_path)
    with pytest.raises(ValueError, match="that no other run writes into"):
        FolderLock(tmp_path)
    lock.release()
    lock.release()
    FolderLock(tmp_path).release()


def test_nothing_of_the_lock_is_left(tmp_path: Path) -> None:
    FolderLock(tmp_path).release()
    assert not list(tmp_path.iterdir())


def test_tables_hold_what_they_got(tmp_path: Path) -> None:
    result = simulate(RIG_WING, STROKE, QuasiSteady(steps_per_cycle=20), cycles=1)
    result.save(tmp_path / "a.npz")
    with np.load(tmp_path / "a.npz") as data:
        np.testing.assert_array_equal(data["lift_N"], result.lift)
        assert '"cl_spread": null' in str(data["summary"])
