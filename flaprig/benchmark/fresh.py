"""Fresh processes of Python: how long one takes, and the most memory that it ever had."""

from __future__ import annotations

import subprocess
import sys

# prints the largest resident size [MB]: the kernel's own mark where there is one, since a process
# inherits the usage that getrusage tells from the process that started it
PEAK = """
import pathlib, resource, sys
status = pathlib.Path("/proc/self/status")
if status.exists():
    kilobytes = next(l.split()[1] for l in status.read_text().splitlines() if l[:5] == "VmHWM")
    print(int(kilobytes) * 1024 / 1e6)
else:
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(most * (1 if sys.platform == "darwin" else 1024) / 1e6)
"""


def said(code: str) -> str:
    """What the code prints in a fresh process.

    Raises:
        RuntimeError: the code failed; holds its last words.
    """
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        words = done.stderr.strip().splitlines()[-1:] or ["no words"]
        raise RuntimeError(f"a fresh process failed: {words[0]}")
    return done.stdout.strip()


def peak_memory(code: str) -> float:
    """Largest resident size of a fresh process that runs the code [MB]."""
    return float(said(code + PEAK).splitlines()[-1])
