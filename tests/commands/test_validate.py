"""`flaprig validate`: cases by name, their own options, JSON, pictures and the page."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from flaprig import cli
from flaprig.commands import validate
from flaprig.validation.suite import CASES


def test_without_a_name_the_cases_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["validate"]) == 0
    out = capsys.readouterr().out
    assert all(name in out for name in CASES)


def test_one_case_takes_its_own_options(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["validate", "katz-plotkin", "--aspect-ratio", "6", "--distance", "1", "--json"]
    assert cli.main(words) == 0
    out, err = capsys.readouterr()
    found = json.loads(out)
    assert found["case"] == "katz-plotkin" and found["aspect_ratio"] == 6.0
    assert len(found["ut_over_c"]) == len(found["cl"]) == len(found["cd"]) == 16
    assert not err


def test_several_cases_are_a_list(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    assert cli.main(["validate", "kelvin", "wagner", "--json", "--out", str(tmp_path)]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [part["case"] for part in found["cases"]] == ["kelvin", "wagner"]
    assert json.loads((tmp_path / "summary.json").read_text()) == found
    # kelvin has nothing to look at
    assert sorted(p.name for p in tmp_path.iterdir()) == ["summary.json", "wagner.png"]


def test_the_exit_status_is_the_verdict(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["validate", "wagner", "--chordwise", "2"]) == 1
    out = capsys.readouterr().out
    assert "outside" in out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["nonsense"], "validate: CASE must be one of"),
        (["nonsense", "--json"], "validate: CASE must be one of"),
        (["wagner", "nonsense"], "validate: CASE must be one of"),
        (["wagner", "--aspect-ratio", "3"], "--aspect-ratio"),
        (["wagner", "--chordwise", "0"], "chordwise"),
        (["wagner", "kelvin", "--chordwise", "4"], "--chordwise"),
        (["wagner", "--all"], "--all must be given without names"),
        (["measured", "--cases", "/nowhere/file.json"], "file.json"),
        (["measured", "--model", "cfd"], "--model"),
    ],
)
def test_bad_words_are_one_sentence(
    words: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["validate", *words]) == cli.BAD_INPUT
    out, err = capsys.readouterr()
    assert said in err and err.count("\n") == 1 and not out


def test_help_of_a_case(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        cli.main(["validate", "measured", "--help"])
    assert stop.value.code == 0
    assert "--cases FILE" in capsys.readouterr().out


def test_the_page_has_every_row_and_picture(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    few = {name: CASES[name] for name in ("kelvin", "wagner")}
    monkeypatch.setattr(validate, "CASES", few)
    assert cli.main(["validate", "--all", "--out", str(tmp_path)]) == 0
    text = (tmp_path / "validation.md").read_text()
    assert "## wagner" in text and "| s = 10 |" in text and "R. T. Jones 1940" in text
    assert "![wagner](images/validation/wagner.png)" in text
    assert (tmp_path / "images" / "validation" / "wagner.png").is_file()
    assert "![kelvin]" not in text
    capsys.readouterr()
