"""Videos from pictures: MP4 where an ffmpeg is found, GIF everywhere."""

from __future__ import annotations

from collections.abc import Iterable
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Picture = NDArray[np.uint8]

# how to get the better file where only GIF can be written
ADVICE = "for MP4 instead of GIF install the Python package imageio-ffmpeg (extra `video`)"
# sides must be multiples of this [pixels]: blocks of the H.264 codec
BLOCK = 16
# constant quality of H.264: 18 is visually lossless, 23 the usual, more is smaller
QUALITY = 20
# colours of a GIF
COLOURS = 255


def ending() -> str:
    """The best ending that can be written here: ".mp4" or ".gif"."""
    if find_spec("imageio_ffmpeg") is None:
        return ".gif"
    import imageio_ffmpeg

    try:
        imageio_ffmpeg.get_ffmpeg_exe()
    except (RuntimeError, OSError):
        return ".gif"
    return ".mp4"


def write_video(path: Path, pictures: Iterable[Picture], rate: float) -> None:
    """Write pictures (height, width, 3), all of one size, to an MP4 or GIF file.

    Args:
        path: the ending chooses the format; ".mp4" needs imageio-ffmpeg.
        pictures: at least one; both sides multiples of 16 for MP4.
        rate: pictures per second.

    Raises:
        ValueError: no picture, or another ending.
        OSError: the file cannot be written.
    """
    writers = {".mp4": _write_mp4, ".gif": _write_gif}
    if path.suffix not in writers:
        raise ValueError(f"a video must end in .mp4 or .gif, got {path.name!r}")
    queue = iter(pictures)
    first = next(queue, None)
    if first is None:
        raise ValueError("a video must have at least one picture")
    writers[path.suffix](path, first, queue, rate)


def _write_mp4(path: Path, first: Picture, rest: Iterable[Picture], rate: float) -> None:
    import imageio_ffmpeg

    size = first.shape[1], first.shape[0]
    options = ["-crf", str(QUALITY), "-movflags", "+faststart"]
    writer = imageio_ffmpeg.write_frames(
        str(path),
        size,
        fps=rate,
        codec="libx264",
        quality=None,
        output_params=options,
        ffmpeg_log_level="fatal",
    )
    writer.send(None)
    try:
        for picture in (first, *rest):
            writer.send(np.ascontiguousarray(picture))
    finally:
        writer.close()


def _write_gif(path: Path, first: Picture, rest: Iterable[Picture], rate: float) -> None:
    from PIL import Image

    images = [Image.fromarray(picture) for picture in (first, *rest)]
    # one palette for all, from some pictures side by side: no flicker, still parts cost nothing
    some = np.concatenate([np.asarray(image) for image in images[:: 1 + len(images) // 8]])
    cut = Image.Quantize.MEDIANCUT
    palette = Image.fromarray(some).quantize(COLOURS, method=cut, kmeans=2)
    small: list[Any] = [
        image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images
    ]
    # GIF counts time in hundredths of a second
    duration = 10 * max(2, round(100.0 / rate))
    small[0].save(path, save_all=True, append_images=small[1:], duration=duration, loop=0)
