"""Fresh processes and the machine."""

import numpy as np
import pytest

from flaprig.benchmark import fresh
from flaprig.benchmark.machine import machine


def test_what_a_process_says():
    assert fresh.said("print(1 + 1)") == "2"


def test_a_process_that_fails_is_one_sentence():
    with pytest.raises(RuntimeError, match="^a fresh process failed: ValueError: no$"):
        fresh.said("raise ValueError('no')")


def test_memory_is_the_process_own():
    # this process is large, and its child inherits nothing of that
    held = np.ones(40_000_000)
    assert 1.0 < fresh.peak_memory("pass") < held.nbytes / 1e6
    assert fresh.peak_memory("x = bytearray(10**8)") > 100.0


def test_machine():
    here = machine()
    assert here["processor"] and here["cores"] >= 1
    assert here["python"].startswith("3.") and here["mujoco"] and here["date"].startswith("20")
