"""The folder of a run: config, versions, metrics, best strokes, checkpoint, policy; all whole."""

from __future__ import annotations

import json
import platform
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from flaprig.files import FolderLock, sweep_drafts, written_whole
from flaprig.report.numbers import as_json
from flaprig.tasks.hover_settings import HoverSettings
from training.candidate import Candidate

CONFIG, METRICS, CHECKPOINT, POLICY = "config.json", "metrics.csv", "checkpoint.pt", "policy.npz"
# endings of what a run keeps as it goes
_KEPT = (".pt", ".csv")
# what a result depends on
PACKAGES = ("flaprig", "mujoco", "numpy", "torch", "stable-baselines3", "gymnasium", "cma")


def versions() -> dict[str, str]:
    """Versions of Python and of the packages that results depend on."""
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed"
    return found


@contextmanager
def opened_folder(path: Path, settings: dict[str, Any], resume: bool) -> Iterator[None]:
    """The folder of a run, which no other run writes into meanwhile, with its config.

    A new run that fails before it has kept anything takes its config away again.

    Raises:
        ValueError: a run is there already, or the one to be resumed has other settings.
        OSError: the folder cannot be made.
    """
    if path.exists() and not path.is_dir():
        raise ValueError(f"--out must be a folder, and {path} is a file")
    path.mkdir(parents=True, exist_ok=True)
    lock = FolderLock(path)
    try:
        sweep_drafts(path)
        config = path / CONFIG
        begun = config.is_file()
        if begun and not resume:
            raise ValueError(f"{path} holds a run already: --resume continues it")
        if begun:
            _check_same(path, _settings_of(config), settings)
        else:
            _write(config, as_json({"settings": settings, "versions": versions()}) + "\n")
        try:
            yield
        except BaseException:
            if not begun and not any(file.suffix in _KEPT for file in path.iterdir()):
                config.unlink(missing_ok=True)
            raise
    finally:
        lock.release()


def _settings_of(config: Path) -> dict[str, Any]:
    try:
        settings = json.loads(config.read_text(encoding="utf-8"))["settings"]
    except (ValueError, KeyError, TypeError, RecursionError):
        settings = None
    if not isinstance(settings, dict):
        raise ValueError(f"{config} is no config of a run, so nothing can be resumed there")
    return settings


def _check_same(path: Path, old: dict[str, Any], new: dict[str, Any]) -> None:
    new = json.loads(as_json(new))
    other = sorted(key for key in old.keys() | new.keys() if old.get(key) != new.get(key))
    if other:
        raise ValueError(
            f"{path} was begun with other settings of {', '.join(other)}; with these, another "
            f"--out and --start {path / CHECKPOINT} go on from its policy"
        )


def write_metrics(path: Path, rows: Sequence[dict[str, Any]], name: str = METRICS) -> None:
    """Write all rows as CSV; a key that a row lacks is left empty."""
    keys = list(dict.fromkeys(key for row in rows for key in row))
    lines = [",".join(keys), *(",".join(_cell(row.get(key)) for key in keys) for row in rows)]
    _write(path / name, "\n".join(lines) + "\n")


def read_metrics(path: Path) -> list[dict[str, str]]:
    """Rows of a metrics file as text by column."""
    head, *lines = path.read_text().splitlines()
    keys = head.split(",")
    return [dict(zip(keys, line.split(","), strict=True)) for line in lines]


def write_best(path: Path, name: str, best: Candidate, settings: HoverSettings) -> None:
    """The stroke as a stroke file, and beside it what it is worth."""
    settings.stroke(best.coefficients).save(path / f"{name}.json")
    _write(path / f"{name}_worth.json", as_json(asdict(best)) + "\n")


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.9g}" if isinstance(value, float) else str(value)


def _write(path: Path, text: str) -> None:
    with written_whole(path) as draft:
        draft.write_text(text, encoding="utf-8")
