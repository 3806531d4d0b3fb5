"""Learned strokes judged: by the vortex lattice as prescribed motion, and in the rig's twin."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import flaprig
from flaprig.commands.progress import progress
from flaprig.strokes import Stroke

# the paper's measurements, Table 1
PAPER = {"sinusoid": (1.94, 0.74), "case A": (2.44, 0.92), "case B": (2.63, 0.94)}


def judge(strokes: Mapping[str, Stroke], cycles: int) -> dict[str, dict[str, Any]]:
    """Summaries by case: `uvlm` prescribed, `twin` with motors, both with gains, and `paper`.

    The first stroke is what gains are counted from.
    """
    # mujoco takes half a second to import: not for --help
    from flaprig.rig import Rig
    from flaprig.twin import Twin

    names, model = list(strokes), flaprig.UVLM()
    with progress("vortex lattice"):
        found = flaprig.simulate_batch(flaprig.RIG_WING, list(strokes.values()), model,
                                       cycles=cycles)  # fmt: skip
    rows: dict[str, dict[str, Any]] = {
        name: {"uvlm": result.summary()} for name, result in zip(names, found, strict=True)
    }
    rig = Rig.load().with_(model=model, frequency=strokes[names[0]].frequency)
    for name, stroke in strokes.items():
        with progress(f"twin, {name}") as told:
            done = Twin(rig).run(stroke, cycles, told)
        rows[name]["twin"] = done.summary()
        cl, ratio = PAPER[name]
        rows[name]["paper"] = {"cl": cl, "lift_to_drag": ratio}
    for part in ("uvlm", "twin", "paper"):
        _add_gains([rows[name][part] for name in names])
    return rows


def _add_gains(summaries: list[dict[str, Any]]) -> None:
    """Gains over the first one in percent."""
    first = summaries[0]
    for summary in summaries:
        for key in ("cl", "lift_to_drag"):
            summary[f"{key}_gain_percent"] = 100.0 * (summary[key] / first[key] - 1.0)
