"""What numbers were measured on: processor, versions, date."""

from __future__ import annotations

import os
import platform
import re
import subprocess
import sys
from datetime import datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

# packages whose version matters for speed
PACKAGES = ("flaprig", "numpy", "mujoco", "pterasoftware", "numba")


def machine() -> dict[str, Any]:
    """Processor, cores, what else the machine was doing, versions and the date."""
    return {
        "processor": processor(),
        "cores": os.cpu_count() or 1,
        "system": f"{platform.system()} {platform.machine()}",
        "load_average": _load(),
        "python": platform.python_version(),
        **{name: _version(name) for name in PACKAGES},
        "date": datetime.now().astimezone().date().isoformat(),
    }


def processor() -> str:
    """Name of the processor, as the system tells it."""
    try:
        if sys.platform == "darwin":
            command = ["sysctl", "-n", "machdep.cpu.brand_string"]
            done = subprocess.run(command, capture_output=True, text=True, check=True)
            return done.stdout.strip()
        found = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(), re.M)
    except (OSError, subprocess.CalledProcessError):
        found = None
    return found.group(1) if found else platform.processor() or platform.machine()


def _load() -> float | None:
    """Processes at work in the last minute, beside ours; None where the system does not tell."""
    try:
        return round(os.getloadavg()[0], 2)
    except (AttributeError, OSError):
        return None


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "not installed"
