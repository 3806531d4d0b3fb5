"""`flaprig reproduce`: the paper's section 3.2 from a seed, beside its Table 1."""

from __future__ import annotations

import csv
import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

from rich.console import Console
from tyro.conf import arg

import flaprig
from flaprig import _checks as check
from flaprig.commands.run_output import timed
from flaprig.commands.verdict_of_strokes import judge
from flaprig.report.folder import Folder
from flaprig.report.numbers import as_json
from flaprig.report.reproduction import draw_reproduction, print_reproduction
from flaprig.report.table import named_notices, print_notices
from flaprig.strokes import Stroke, SunTangStroke, load

# the paper's section 2.2
SINUSOID = SunTangStroke(0.2, 1.0471975511965976, 0.7853981633974483)


@dataclass(frozen=True)
class Reproduce:
    """Learn the paper's cases A and B, and judge them by the vortex lattice and with the motors.

    Case A learns in quasi-steady air throughout; case B learns its second half by the vortex
    lattice. Both have their first half in common. A run that was stopped goes on where it was when
    the same command is given again. Needs a clone with training/ and the extra `train`.

    Attributes:
        seed: of everything random.
        out: folder of the runs, pictures and summary.json.
        sweep_acceleration: bound, times the sinusoid's 1.654 rad/s2.
        pitch_acceleration: bound, times the sinusoid's 1.240 rad/s2.
        quasi_steady_steps: strokes in the first half, and in case A's second.
        uvlm_steps: strokes in case B's second half.
        cycles: of the final judgement; means are over the third to the last, at most three.
        json: print exactly one JSON object and nothing else.
    """

    seed: int = 1
    out: Annotated[Path, arg(metavar="DIR")] = field(default_factory=lambda: Path("reproduction"))
    sweep_acceleration: float = 2.0
    pitch_acceleration: float = 2.0
    quasi_steady_steps: int = 300_000
    uvlm_steps: int = 4_800
    cycles: int = 5
    json: bool = False

    def __post_init__(self) -> None:
        check.whole("reproduce", "--seed", self.seed, 0, 2**31 - 1)
        for name in ("sweep_acceleration", "pitch_acceleration"):
            flag = "--" + name.replace("_", "-")
            check.in_range("reproduce", flag, getattr(self, name), 1.0, 1000.0)
        for name in ("quasi_steady_steps", "uvlm_steps"):
            flag = "--" + name.replace("_", "-")
            check.whole("reproduce", flag, getattr(self, name), 1, 10**9)
        check.whole("reproduce", "--cycles", self.cycles, 1, 1000)


@dataclass(frozen=True)
class Half:
    """One call of training.ppo.

    Attributes:
        name: of its folder.
        quasi_steady: strokes in quasi-steady air.
        uvlm: strokes by the vortex lattice.
        start: folder of the run whose policy it goes on with.
    """

    name: str
    quasi_steady: int
    uvlm: int
    start: str | None = None


def run(args: Reproduce, folder: Folder) -> None:
    """Learn, judge, draw, tell.

    Raises:
        ValueError: bad input.
        RuntimeError: a part of the learning failed, or training/ is not here.
        OSError: a file cannot be written.
    """
    root = _training_root()
    folder.create()
    halves = (
        Half("first_half", args.quasi_steady_steps, 0),
        Half("case_a", args.quasi_steady_steps, 0, "first_half"),
        Half("case_b", 0, args.uvlm_steps, "first_half"),
    )
    spent: dict[str, float] = {}
    for half in halves:
        spent[f"{half.name}_s"] = _learn(root, args, half)
    strokes: dict[str, Stroke] = {
        "sinusoid": SINUSOID,
        "case A": load(_best_of_a(args.out)),
        "case B": load(args.out / "case_b" / "best_uvlm.json"),
    }
    with timed() as judging:
        rows = judge(strokes, args.cycles)
    summary: dict[str, Any] = {
        "command": "reproduce",
        "seed": args.seed,
        "bounds": {"sweep": args.sweep_acceleration, "pitch": args.pitch_acceleration},
        "cases": rows,
        "notices": named_notices(
            {f"{n}, {part}": row[part] for n, row in rows.items() for part in ("uvlm", "twin")}
        ),
        "wall_time": {**spent, "judging_s": judging["wall_time_s"]},
    }
    folder.write_summary(summary)
    for name, stroke in zip(("case_a", "case_b"), list(strokes.values())[1:], strict=True):
        folder.write(f"{name}.json", stroke.save)
    draw_reproduction(folder, strokes)
    summary = folder.write_summary(summary)
    if args.json:
        print(as_json(summary))
        return
    print_reproduction(Console(), rows, summary)
    print_notices(Console(), summary["notices"])


def _training_root() -> Path:
    """The clone that holds training/; a wheel carries none."""
    root = Path(flaprig.__file__).resolve().parents[1]
    if not (root / "training" / "ppo.py").is_file():
        raise RuntimeError("reproduce: training/ is not here; it runs in a clone (make build)")
    return root


def _learn(root: Path, args: Reproduce, half: Half) -> float:
    """Run training.ppo in a process of its own; the seconds that it has learned, all told."""
    out = args.out / half.name
    command = [sys.executable, "-m", "training.ppo", "--out", str(out.resolve()), "--resume"]
    options = {
        "--seed": args.seed,
        "--quasi-steady.steps": half.quasi_steady,
        "--uvlm.steps": half.uvlm,
        "--problem.bounds.sweep": args.sweep_acceleration,
        "--problem.bounds.pitch": args.pitch_acceleration,
    }
    command += [str(word) for pair in options.items() for word in pair]
    if half.start is not None:
        command += ["--start", str((args.out / half.start / "checkpoint.pt").resolve())]
    path = os.pathsep.join(filter(None, [str(root), os.environ.get("PYTHONPATH")]))
    began = time.perf_counter()
    # its bar and what it says when it fails go to standard error
    done = subprocess.run(
        command, env={**os.environ, "PYTHONPATH": path}, stdout=subprocess.DEVNULL
    )
    if done.returncode:
        raise RuntimeError(f"reproduce: {half.name} failed with exit code {done.returncode}")
    return round(max(time.perf_counter() - began, _learned_seconds(out)), 3)


def _learned_seconds(out: Path) -> float:
    """Time that a run took before it was stopped and resumed, by its last row of metrics."""
    with open(out / "metrics.csv", newline="") as stream:
        return max(float(row["seconds"]) for row in csv.DictReader(stream))


def _best_of_a(out: Path) -> Path:
    """Case A's stroke: the better one of its halves, by the quasi-steady reward."""

    def worth(half: str) -> float:
        text = (out / half / "best_quasi_steady_worth.json").read_text()
        return float(json.loads(text)["reward"])

    best = max(("first_half", "case_a"), key=worth)
    return out / best / "best_quasi_steady.json"
