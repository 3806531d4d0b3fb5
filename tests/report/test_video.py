"""Videos: what is written is what was drawn."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from flaprig.report import video


def pictures(count: int = 4) -> list[np.ndarray]:
    """A bright bar that moves from left to right."""
    frames = []
    for k in range(count):
        frame = np.full((48, 64, 3), 30, dtype=np.uint8)
        frame[:, 16 * k : 16 * k + 16] = (220, 90, 10)
        frames.append(frame)
    return frames


def test_gif_keeps_pictures_and_pace(tmp_path: Path) -> None:
    video.write_video(tmp_path / "x.gif", pictures(), 10.0)
    with Image.open(tmp_path / "x.gif") as image:
        assert image.n_frames == 4 and image.info["duration"] == 100
        for k, frame in enumerate(pictures()):
            image.seek(k)
            seen = np.asarray(image.convert("RGB")).astype(int)
            assert np.abs(seen - frame).mean() < 8


# imageio-ffmpeg's reader leaves its pipes to the garbage collector
@pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning")
def test_mp4_keeps_pictures_and_pace(tmp_path: Path) -> None:
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    video.write_video(tmp_path / "x.mp4", iter(pictures()), 10.0)
    reader = ffmpeg.read_frames(str(tmp_path / "x.mp4"))
    meta = next(reader)
    assert meta["size"] == (64, 48) and meta["fps"] == 10.0
    frames = [np.frombuffer(raw, np.uint8).reshape(48, 64, 3).astype(int) for raw in reader]
    assert len(frames) == 4
    # the colours are coded coarsely, so only the middle of the bar is compared
    for k, frame in enumerate(frames):
        assert np.abs(frame[24, 16 * k + 8] - (220, 90, 10)).max() < 30


def test_bad_videos(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="must end in .mp4 or .gif"):
        video.write_video(tmp_path / "x.avi", pictures(), 10.0)
    with pytest.raises(ValueError, match="at least one picture"):
        video.write_video(tmp_path / "x.gif", [], 10.0)


def test_ending_without_ffmpeg(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(video, "find_spec", lambda name: None)
    assert video.ending() == ".gif"
