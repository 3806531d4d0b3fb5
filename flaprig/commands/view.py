"""`flaprig view`: the rig and its wake in a window, or in a video file without a display."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from rich.console import Console
from tyro.conf import arg

from flaprig import _checks as check
from flaprig.commands import options
from flaprig.commands.rig_options import RigFile, rig_of
from flaprig.render import gl
from flaprig.report.folder import Folder
from flaprig.report.table import print_notices

if TYPE_CHECKING:
    from flaprig.report.film import Format
    from flaprig.report.flight import Flight
    from flaprig.strokes import Stroke
    from flaprig.twin import Twin

# pictures per second of the window
WINDOW_RATE = 60.0


@dataclass(frozen=True)
class View:
    """The rig flapping with its wake: in MuJoCo's viewer, or in a video file without a display.

    Says which it did, and how to get the better one.

    Attributes:
        rig: MJCF file of a rig: its wing, fluid, servos and model of the fluid count, but for what
            other options say.
        cycles: length of the video [cycles]; the window stays until it is closed.
        skip: cycles before the video begins, so that the wake is there.
        width: of the video [pixels], a multiple of 16.
        height: of the video [pixels], a multiple of 16.
        rate: pictures per second of the video.
        video: video file, .mp4 or .gif, written even where there is a display; flapping.mp4 (or
            .gif) where there is none.
    """

    stroke: options.StrokeOptions = field(default_factory=options.StrokeOptions)
    wing: options.WingOptions = field(default_factory=options.WingOptions)
    fluid: options.FluidOptions = field(default_factory=options.FluidOptions)
    model: options.ModelOptions = field(default_factory=options.ModelOptions)
    rig: RigFile = None
    cycles: float = 1.0
    skip: float = 1.0
    width: int = 1280
    height: int = 720
    rate: float = 30.0
    video: Annotated[Path | None, arg(metavar="FILE", help_behavior_hint="(optional)")] = None


def run(args: View, folder: Folder) -> None:
    """Show the rig.

    Raises:
        ValueError: bad input.
        ImportError: the plugin library is missing or does not fit MuJoCo.
        OSError: the video cannot be written.
    """
    # mujoco takes half a second to import: not for --help
    from flaprig.commands.rig_film import film_rig
    from flaprig.report.flight import Flight
    from flaprig.twin import Twin

    asked = args.stroke.read()
    stroke = asked.stroke
    rig = rig_of(args.rig, stroke, args.wing, args.fluid, args.model)
    form = _format(args)
    print_notices(Console(), [*rig.notices, *asked.notices, *_changes(Twin(rig), stroke)])
    if args.video is None and gl.has_display():
        show(Flight(Twin(rig), stroke))
        return
    file = Path("flapping") if args.video is None else args.video
    folder.share(file.parent)
    folder.create()
    span = (args.skip, args.skip + args.cycles)
    done = film_rig(folder, file.name, rig, stroke, span, form)
    print(f"{done.path}: {done.words}")
    if args.video is None:
        print("MuJoCo's viewer opens where there is a display (DISPLAY or WAYLAND_DISPLAY is set).")


def _changes(twin: Twin, stroke: Stroke) -> tuple[str, ...]:
    """What the servos' limits change of the stroke."""
    from flaprig.limits import project
    from flaprig.set_points import own_limits

    return project(stroke, own_limits(twin.rig, twin.rig.spec().compile())).notices


def _format(args: View) -> Format:
    """Size and pace of the video. ValueError for what no video can have."""
    from flaprig.report.film import Format

    check.in_range("view", "--cycles", args.cycles, 0.01, 100.0)
    check.in_range("view", "--skip", args.skip, 0.0, 100.0)
    check.in_range("view", "--rate", args.rate, 1.0, 120.0)
    for name, value in (("--width", args.width), ("--height", args.height)):
        check.whole("view", name, value, 64, 4096)
        if value % 16:
            raise check.fail("view", name, "a multiple of 16", value)
    if args.video is not None and args.video.suffix not in (".mp4", ".gif"):
        raise check.fail("view", "--video", "a file that ends in .mp4 or .gif", str(args.video))
    return Format(args.width, args.height, args.rate)


def show(flight: Flight) -> None:
    """Run the rig in MuJoCo's window, as fast as the world at most, until it is closed."""
    import mujoco.viewer

    data = flight.data
    with mujoco.viewer.launch_passive(flight.model, data) as window:
        print("The window stays open until you close it.")
        start = time.monotonic() - data.time
        while window.is_running():
            with window.lock():
                target = min(time.monotonic() - start, data.time + 1.0 / WINDOW_RATE)
                while data.time < target:
                    flight.step()
            window.sync()
            ahead = data.time - (time.monotonic() - start)
            # a slow machine does not try to catch up
            start += max(0.0, -ahead - 0.5)
            time.sleep(max(0.0, min(ahead, 1.0 / WINDOW_RATE)) + 1e-3)
