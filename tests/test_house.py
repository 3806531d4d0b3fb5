"""The rules of the house, read from the sources: floors, who may import what, sizes, hygiene."""

from __future__ import annotations

import ast
import re
import subprocess
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]

# rooms of flaprig from the ground up; a room imports from its own floor and from those below.
# a new file or folder in flaprig/ gets its name here
FLOORS = (
    ("_checks", "_paths", "files", "planform", "wing", "fluid", "strokes", "theory"),
    ("native", "aero", "render"),
    ("limits", "logs"),
    (
        *("motors", "motor_histories", "motor_record", "rig", "energy"),
        *("servo_link", "set_points", "feedforward"),
        *("twin_log", "twin_run", "twin_record", "twin", "as_asked"),
        *("verdict", "motion_verdicts", "servo_verdicts", "servo_work"),
        *("nearest_run", "feasibility", "catalogue"),
        *("scaling", "servo_choice"),
    ),
    ("tasks",),
    ("envs",),
    ("report", "validation", "benchmark", "commands", "demo", "cli", "__init__", "__main__"),
)
FLOOR = {room: level for level, rooms in enumerate(FLOORS) for room in rooms}

# third parties and the only places that may import them, as prefixes of the path
ONLY_IN = {
    "ruckig": ("flaprig/limits/ruckig_motion.py",),
    "clarabel": ("flaprig/limits/programme.py",),
    "gymnasium": ("flaprig/envs",),
    "dm_control": ("flaprig/tasks", "flaprig/envs"),
    "torch": ("training",),
    "stable_baselines3": ("training",),
}
# the numpy rooms simulate nothing
NUMPY_ROOMS = FLOORS[0]

# lines; a place that needs more wants to be two
FILE_CEILING = 300
FUNCTION_CEILING = 50

SOURCE = {".py", ".cpp", ".hpp"}
BINARY = {".png", ".jpg", ".gif", ".mp4", ".npz", ".npy", ".pdf", ".stl", ".zip", ".gz"}


@cache
def files() -> tuple[Path, ...]:
    """Every file that git keeps or would keep; without git, all but what builds leave behind."""
    command = ["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"]
    try:
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
        paths = [ROOT / name for name in done.stdout.split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        skip = re.compile(r"(^|/)(\.(?!ci/)[^/]+|build|dist|demo_output|__pycache__)/")
        paths = [p for p in ROOT.rglob("*") if not skip.search(name_of(p))]
    return tuple(sorted(p for p in paths if p.is_file()))


def inside(path: Path, *folders: str) -> bool:
    return any(path.is_relative_to(ROOT / folder) for folder in folders)


def name_of(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


def python_files(*folders: str) -> list[Path]:
    return [path for path in files() if path.suffix == ".py" and inside(path, *folders)]


def imported(path: Path) -> Iterator[tuple[int, str]]:
    """(line, full dotted name) of every import, also inside functions; relative ones resolved."""
    package = path.relative_to(ROOT).with_suffix("").parts[:-1]
    for node in ast.walk(ast.parse(path.read_text(), str(path))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            module = ".".join((*base, *filter(None, [node.module])))
            yield from ((node.lineno, f"{module}.{alias.name}") for alias in node.names)


def room_of_file(path: Path) -> str:
    return path.relative_to(ROOT / "flaprig").with_suffix("").parts[0]


def room_of_import(name: str) -> str | None:
    """The room that `flaprig.room...` names; the public face when it is no room."""
    parts = name.split(".")
    if parts[0] != "flaprig":
        return None
    room = parts[1] if len(parts) > 1 else "__init__"
    here = ROOT / "flaprig"
    return room if (here / room).is_dir() or (here / f"{room}.py").is_file() else "__init__"


def climbs(path: Path) -> list[str]:
    """Imports of this file that reach to a floor above its own."""
    level = FLOOR[room_of_file(path)]
    rooms = ((line, room_of_import(name)) for line, name in imported(path))
    return [
        f"{name_of(path)}:{line} is on floor {level} and imports {room} from floor {FLOOR[room]}"
        for line, room in rooms
        if room is not None and FLOOR.get(room, 99) > level and room in FLOOR
    ]


def test_every_room_has_a_floor() -> None:
    rooms = {room_of_file(path) for path in python_files("flaprig")}
    homeless = sorted(rooms - set(FLOOR))
    assert not homeless, f"give these rooms of flaprig/ a floor in FLOORS: {homeless}"


def test_nothing_imports_upward() -> None:
    known = [path for path in python_files("flaprig") if room_of_file(path) in FLOOR]
    assert known, "no source was found: the check would hold for nothing"
    assert not [fault for path in known for fault in climbs(path)]


def test_flaprig_imports_neither_training_nor_tests() -> None:
    above = {"training", "tests", "benchmarks"}
    faults = [
        f"{name_of(path)}:{line} imports {name}"
        for path in python_files("flaprig")
        for line, name in imported(path)
        if name.split(".")[0] in above
    ]
    assert not faults


@pytest.mark.parametrize("package", ONLY_IN)
def test_third_party_stays_in_its_room(package: str) -> None:
    faults = [
        f"{name_of(path)}:{line} imports {name}, allowed only in {', '.join(ONLY_IN[package])}"
        for path in python_files("flaprig", "training")
        for line, name in imported(path)
        if name.split(".")[0] == package and not inside(path, *ONLY_IN[package], "training")
    ]
    assert not faults


def test_numpy_rooms_know_no_simulator() -> None:
    simulators = {"mujoco", "dm_control", "gymnasium", "ruckig"}
    rooms = [path for path in python_files("flaprig") if room_of_file(path) in NUMPY_ROOMS]
    assert rooms, "no numpy room was found: the check would hold for nothing"
    faults = [
        f"{name_of(path)}:{line} imports {name}"
        for path in rooms
        for line, name in imported(path)
        if name.split(".")[0] in simulators
    ]
    assert not faults


def test_imports_are_read_at_any_depth(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The reader itself: nested, relative and plain imports all come out with their full name."""
    monkeypatch.setitem(globals(), "ROOT", tmp_path)
    path = tmp_path / "flaprig" / "strokes" / "sampled.py"
    path.parent.mkdir(parents=True)
    path.write_text("from . import stroke\nfrom ..rig import Rig\ndef f():\n    import torch.nn\n")
    assert list(imported(path)) == [
        (1, "flaprig.strokes.stroke"),
        (2, "flaprig.rig.Rig"),
        (4, "torch.nn"),
    ]
    (tmp_path / "flaprig" / "rig.py").touch()
    assert [fault.split(" is on")[0] for fault in climbs(path)] == ["flaprig/strokes/sampled.py:2"]


def test_files_stay_small() -> None:
    sources = [p for p in files() if p.suffix in SOURCE and inside(p, "flaprig", "training")]
    sizes = {name_of(path): len(path.read_text().splitlines()) for path in sources}
    assert not {name: size for name, size in sizes.items() if size > FILE_CEILING}


def test_functions_stay_small() -> None:
    sizes = {
        f"{name_of(path)}:{node.lineno} {node.name}": (node.end_lineno or 0) - node.lineno + 1
        for path in python_files("flaprig", "training", "tests", "benchmarks")
        for node in ast.walk(ast.parse(path.read_text()))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }
    assert sizes
    assert not {name: size for name, size in sizes.items() if size > FUNCTION_CEILING}


def forbidden() -> re.Pattern[str]:
    """Registry hosts and paths of one machine, put together here so that this file holds none."""
    hosts = ["py" + "pi.org", "python" + "hosted.org", "anaconda" + ".org", "py" + "pi/simple"]
    paths = ["fi" + "le://", *(rf"(?<![\w.}}]){path}\b" for path in ("/wo" + "rk", "/tm" + "p"))]
    return re.compile("|".join([*map(re.escape, hosts), *paths]), re.IGNORECASE)


def test_no_file_names_a_registry_or_a_machine() -> None:
    pattern = forbidden()
    texts = [path for path in files() if path.suffix.lower() not in BINARY]
    faults = [
        f"{name_of(path)}:{number}: {found.group()}"
        for path in texts
        for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1)
        if (found := pattern.search(line))
    ]
    assert not faults


def test_forbidden_words_are_recognised() -> None:
    pattern = forbidden()
    for text in ("see /tm" + "p/x", "cd /wo" + "rk", "fi" + "le:///x", "https://py" + "pi.org/x"):
        assert pattern.search(text), text
    for text in ("motors/work", "force/temperature", "$OUT/tmpl", "../shared"):
        assert not pattern.search(text), text
