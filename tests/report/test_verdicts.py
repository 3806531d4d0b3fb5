"""The tables and sentences of a check."""

from __future__ import annotations

import io
import math

import pytest
from rich.console import Console

from flaprig.report.verdicts import (
    frequency_sentence,
    number,
    percent,
    print_verdicts,
    servo_sentence,
)
from flaprig.scaling import FrequencyRange
from flaprig.servo_choice import ServoChoice
from flaprig.verdict import Verdict


class Report:
    """Two verdicts and nothing else."""

    verdicts = (
        Verdict("sweep", "velocity", 1.0, 2.0, "rad/s"),
        Verdict("pitch", "mean_power", 0.25, None, "W"),
    )
    feasible, worst = True, verdicts[0]


def test_table_is_in_degrees() -> None:
    text = io.StringIO()
    print_verdicts(Console(file=text, width=80), "title", Report())  # type: ignore[arg-type]
    row = next(line for line in text.getvalue().splitlines() if "sweep velocity" in line)
    assert row.split() == ["sweep", "velocity", "57.3", "114.6", "deg/s", "50", "%"]
    assert "Smallest margin: sweep velocity, 50 %." in text.getvalue()


def test_table_fits_a_terminal() -> None:
    text = io.StringIO()
    wide = Verdict("pitch", "mean_regenerative_power", 123456.7, 0.001, "rad/s3")
    report = type("Wide", (Report,), {"verdicts": (wide,)})()
    print_verdicts(Console(file=text, width=80), "title", report)
    assert "…" not in text.getvalue()
    assert max(map(len, text.getvalue().splitlines())) <= 80


@pytest.mark.parametrize(
    ("margin", "said"),
    [(None, ""), (0.333, "33 %"), (-0.02, "-2 %"), (-math.inf, "-inf %")],
)
def test_percent(margin: float | None, said: str) -> None:
    assert percent(margin) == said


@pytest.mark.parametrize(
    ("value", "said"), [(0.12346, "0.1235"), (78945.2, "78945"), (math.inf, "inf"), (0.0, "0")]
)
def test_number(value: float, said: str) -> None:
    assert number(value) == said


def test_sentences_on_frequencies() -> None:
    def say(*words: object) -> str:
        return frequency_sentence(FrequencyRange(*words, ()))  # type: ignore[arg-type]

    assert say(0.5, 0.51, ("x",), (0.9,)) == (
        "Feasible up to 0.5 Hz; at 0.51 Hz: x. Feasible again at 0.9 Hz."
    )
    assert say(6.4, None, (), ()) == "Feasible up to 6.4 Hz, where the scan ends."
    assert say(None, 0.01, ("x",), ()) == "No feasible frequency was found down to 0.01 Hz."


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        (("A", "A", "A", None), "Smallest on both joints: A."),
        (("B", "B", "A", True), "both joints: B. B on the sweep with A on the pitch holds too."),
        ((None, "B", "A", True), "Smallest: B for the sweep, A for the pitch."),
        ((None, None, "A", None), "No servo of the catalogue keeps the limits of the sweep."),
    ],
)
def test_sentences_on_servos(choice: tuple[str | None, ...], said: str) -> None:
    assert said in servo_sentence(ServoChoice(*choice, ()))  # type: ignore[arg-type]
