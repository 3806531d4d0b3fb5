import json
import os

import numpy as np
import pytest

from flaprig import strokes
from flaprig.strokes import FourierStroke, SampledStroke, SunTangStroke

TIME = np.arange(20) / 20 * 1.7
EXAMPLES = [
    SunTangStroke(0.2, np.pi / 3, np.pi / 4, 0.16, 0.32, "raised_cosine"),
    FourierStroke.normalized(0.21, [-1, 0.1], [0, 1 / 3], [0, 0.2], [1, 0], 1.0, 0.7),
    SampledStroke(TIME, np.sin(3.3 * TIME), np.cos(2.9 * TIME)),
]


@pytest.mark.parametrize("stroke", EXAMPLES, ids=lambda s: type(s).__name__)
def test_saved_stroke_comes_back_bit_for_bit(stroke, tmp_path):
    path = tmp_path / "stroke.any"
    stroke.save(path)
    again = strokes.load(str(path))
    assert again == stroke and type(again) is type(stroke)
    np.testing.assert_array_equal(again.sample(50).pitch_rate, stroke.sample(50).pitch_rate)
    # nothing but the file is left behind
    assert os.listdir(tmp_path) == ["stroke.any"]


@pytest.mark.parametrize("ending", [".csv", ".CSV", ".txt", ".npz", ".json"])
@pytest.mark.parametrize("stroke", EXAMPLES, ids=lambda s: type(s).__name__)
def test_an_ending_that_promises_another_form_is_refused(stroke, ending, tmp_path):
    path, table = tmp_path / f"s{ending}", isinstance(stroke, SampledStroke)
    if ending in ((".csv", ".CSV", ".txt") if table else (".json",)):
        stroke.save(path)
        assert strokes.load(path) == stroke
        return
    form = "CSV" if table else "JSON"
    with pytest.raises(ValueError, match=f"must not end in .*written as {form}"):
        stroke.save(path)
    assert not list(tmp_path.iterdir())


def test_failed_save_keeps_the_old_file(tmp_path, monkeypatch):
    path = tmp_path / "stroke.json"
    EXAMPLES[0].save(path)
    before = path.read_text()

    def fails(*_):
        raise OSError("disk full")

    monkeypatch.setattr("pathlib.Path.replace", fails)
    with pytest.raises(OSError, match="disk full"):
        EXAMPLES[1].save(path)
    assert path.read_text() == before and os.listdir(tmp_path) == ["stroke.json"]


def test_hand_made_csv_with_windows_line_ends_and_mark(tmp_path):
    path = tmp_path / "s.csv"
    rows = [f"{t}, {np.sin(t)}, {np.cos(t)}" for t in np.arange(10) * 0.6]
    path.write_bytes(("\ufefftime_s, sweep_rad, pitch_rad\r\n" + "\r\n".join(rows)).encode())
    assert strokes.load(path).period == pytest.approx(6.0)


SUN = {"frequency": 0.2, "sweep_amplitude": 1.0, "pitch_amplitude": 0.5}


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "a log must have a line of names, got an empty file"),
        ("a,b\n1,2", "columns missing: time_s; sweep_rad, sweep_deg or sweep_count"),
        ("{", "not valid JSON"),
        ('{"a":' * 100000, "nested so deeply|not valid JSON"),
        ("{}", '"stroke" must be one of sun_tang, fourier, got None'),
        ('{"stroke": ["sun_tang"]}', '"stroke" must be one of'),
        ('{"stroke": "sun_tang", "parameters": 3}', '"parameters" must be an object'),
        (json.dumps({"stroke": "sun_tang", "parameters": {}}), "missing .*frequency"),
        (json.dumps({"stroke": "sun_tang", "parameters": SUN | {"x": 1}}), r"unknown \['x'\]"),
        (
            json.dumps({"stroke": "sun_tang", "parameters": SUN | {"frequency": None}}),
            "frequency must be a positive number",
        ),
        (
            json.dumps({"stroke": "sun_tang", "parameters": SUN | {"frequency": np.nan}}),
            "frequency must be a positive number",
        ),
        (
            json.dumps(
                {
                    "stroke": "fourier",
                    "parameters": {
                        "frequency": 1,
                        "sweep_cos": "abc",
                        "sweep_sin": [1],
                        "pitch_cos": [1],
                        "pitch_sin": {},
                    },
                }
            ),
            "sweep_cos must be",
        ),
        ("time_s,sweep_rad,pitch_rad\n", "a log must have 8 to 2000000 rows, got 0"),
        ("time_s,sweep_rad,pitch_rad\n0,1\n", "a log must have 8 to 2000000 rows, got 1"),
        ("time_s,sweep_rad,pitch_rad\n0,1,2\n0,x,2\n", "a log must have 8 to 2000000 rows, got 2"),
        (
            "time_s,sweep_rad,pitch_rad\n" + "0,1,nan\n" * 9,
            "line 2: pitch_rad must be a finite number, got 'nan'",
        ),
    ],
)
def test_malformed_file_gives_one_sentence(text, sentence, tmp_path):
    path = tmp_path / "bad.txt"
    path.write_text(text)
    with pytest.raises(ValueError, match=sentence) as caught:
        strokes.load(path)
    assert str(caught.value).startswith(str(path)) and "\n" not in str(caught.value)


def test_binary_and_missing_files(tmp_path):
    (tmp_path / "b").write_bytes(bytes(range(256)))
    with pytest.raises(ValueError, match="this is no text; what can be read is a table"):
        strokes.load(tmp_path / "b")
    with pytest.raises(FileNotFoundError):
        strokes.load(tmp_path / "none")
