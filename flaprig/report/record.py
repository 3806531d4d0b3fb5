"""Which files of a folder a run has written: so that no folder mixes two runs.

While a run writes, the list is in a hidden file of the folder; a run that was killed leaves it
there. A run that ends well with a summary.json has the list in it and needs no other file.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import Any

from flaprig.files import written_whole

# what a run leaves at its end, and the list while it writes
SUMMARY, HIDDEN = "summary.json", ".flaprig_run.json"


@dataclass
class Record:
    """The list of a run.

    Attributes:
        run_id: of the run that writes.
        files: that it has written, or is about to.
        stale: files of earlier runs that are not yet removed.
    """

    run_id: str
    files: list[str] = field(default_factory=list)
    stale: list[str] = field(default_factory=list)

    def save(self, folder: Path) -> None:
        """Write the hidden file.

        Raises:
            OSError: it cannot be written.
        """
        entry = {"run_id": self.run_id, "files": self.files, "stale": self.stale}
        with written_whole(folder / HIDDEN) as draft:
            draft.write_text(json.dumps(entry, indent=2) + "\n", encoding="utf-8")


def earlier_files(folder: Path) -> list[str]:
    """Names of what earlier runs have left in the folder, relative to it; no file of anybody else.

    Raises:
        ValueError: the hidden list is damaged.
        OSError: it cannot be read.
    """
    found = _listed(folder / SUMMARY)
    hidden = folder / HIDDEN
    if hidden.is_file():
        listed = _listed(hidden)
        if not listed:
            raise ValueError(
                f"--out: {hidden}, the list of what an earlier run wrote, is damaged; remove it, "
                "and files of that run that you do not need"
            )
        found += listed
    return list(dict.fromkeys(found))


def _listed(file: Path) -> list[str]:
    """Names in a run's summary or hidden list; none in whatever else has that name."""
    try:
        entry: Any = json.loads(file.read_text(encoding="utf-8"))
    except (FileNotFoundError, IsADirectoryError, ValueError, RecursionError):
        return []
    if not isinstance(entry, dict) or "run_id" not in entry:
        return []
    listed = [entry.get(key, []) for key in ("files", "stale")]
    names = [name for part in listed if isinstance(part, list) for name in part]
    return [name for name in names if isinstance(name, str) and _is_inside(name)]


def _is_inside(name: str) -> bool:
    """Whether a name stays in its folder: a list from elsewhere removes nothing elsewhere."""
    path = PurePosixPath(name)
    return bool(path.parts) and not path.is_absolute() and ".." not in path.parts
