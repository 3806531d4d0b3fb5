"""Text attributes of both plugins: what is refused, with which words."""

import math
import random

import numpy as np
import pytest

from flaprig.native import _native

UVLM, QS = "flaprig.uvlm", "flaprig.quasi_steady"
WING = {"span": "0.25", "chord": "0.0625"}
TABLE = {"coefficients": "table", "coefficient_table": "0 0 1 1 2 3"}

# number attributes: model, name, allowed, some values that are not
NUMBERS = [
    (UVLM, "span", "one number from 1e-05 to 1000 m", ["0", "-1", "1001", "1e-6"]),
    (UVLM, "chord", "one number from 1e-05 to 1000 m", ["0", "-0.1", "1e9"]),
    (UVLM, "root_offset", "one number from -1000 to 1000 m", ["1001", "-1e4"]),
    (UVLM, "pitch_axis", "one number from -10 to 10 chords", ["11", "-10.5"]),
    (UVLM, "density", "one number above 0 and up to 100000 kg/m3", ["0", "-1", "1e6"]),
    (UVLM, "thickness", "one number from 0 to 10 m", ["-0.001", "11"]),
    (UVLM, "wake_step", "one number from 1e-07 to 1000 s", ["0", "-0.05", "1e-8", "2000"]),
    (UVLM, "core", "one number above 0 and up to 2 mean chords", ["0", "-0.1", "2.1"]),
    (UVLM, "shedding_fraction", "one number from 0.01 to 0.99", ["0", "1", "-0.3"]),
    (UVLM, "wake_detail", "a whole number from 0 to 100000", ["-1", "100001", "2.5"]),
    (UVLM, "wake_fade", "one number from 0 to 1", ["-0.1", "1.01"]),
    (UVLM, "tip_inset", "one number from 0 to 0.5 strips", ["-0.1", "0.6"]),
    (UVLM, "suction_efficiency", "one number from 0 to 10", ["-1", "10.1"]),
    (UVLM, "suction_factor", "one number from 0 to 2", ["-1", "2.1"]),
    (UVLM, "side_suction_efficiency", "one number from 0 to 10", ["-1", "10.1"]),
    (UVLM, "circulation_lag", "one number from 0 to 10 chords", ["-1", "10.1"]),
    (UVLM, "chordwise", "a whole number from 1 to 64", ["0", "65", "2.5", "-3"]),
    (UVLM, "spanwise", "a whole number from 1 to 128", ["0", "129", "1.5"]),
    (UVLM, "wake_rows", "a whole number from 1 to 100000", ["0", "100001", "0.5"]),
    (UVLM, "threads", "a whole number from 1 to 64", ["0", "65", "1.1"]),
    (QS, "strips", "a whole number from 1 to 1000", ["0", "1001", "3.3"]),
]
# what no number may be
NO_NUMBER = ["nan", "inf", "-inf", "1e999", "abc", "1 2", "1,5", "0x10", "--1", "1e", "1\x00", "½"]


def refusal(model, attributes):
    """The one line that a set of attributes is refused with."""
    with pytest.raises(ValueError) as caught:
        _native.check_attributes(model, attributes)
    sentence = str(caught.value)
    assert sentence and "\n" not in sentence and len(sentence) < 600
    return sentence


@pytest.mark.parametrize(
    ("model", "name", "allowed", "bad"), NUMBERS, ids=[row[1] for row in NUMBERS]
)
def test_numbers_out_of_range_and_no_numbers(model, name, allowed, bad):
    for value in bad + [text for text in NO_NUMBER if "\x00" not in text]:
        sentence = refusal(model, WING | {name: value})
        assert sentence.startswith(f"{name} must be {allowed}"), sentence
        assert f'got "{value}"' in sentence


def test_ends_of_ranges_are_allowed():
    good = {"density": "1e5", "thickness": "0", "core": "2", "shedding_fraction": "0.01"}
    good |= {"tip_inset": "0.5", "suction_efficiency": "10", "chordwise": "8", "spanwise": "128"}
    good |= {"wake_rows": "1", "wake_step": " 1e-7 ", "root_offset": "-1000", "threads": "64.0"}
    assert _native.check_attributes(UVLM, WING | good) > 0
    # blank is as good as absent
    blank = {name: "  " for name in _native.attribute_names(UVLM) if name not in WING}
    default = _native.check_attributes(UVLM, WING)
    assert _native.check_attributes(UVLM, WING | blank) == default


CASES = [
    (UVLM, {"chord": "1"}, 'span must be given, in m, unless stations are, got ""'),
    (QS, {"span": "1"}, 'chord must be given, in m, unless stations are, got ""'),
    (UVLM, WING | {"chordwise": "64", "spanwise": "64"}, "spanwise must be at most 1024 over"),
    (UVLM, WING | {"spanwise": "64", "wake_rows": "100000"}, "wake_rows must be at most 5e6 over"),
    (UVLM, WING | {"wind": "1 2"}, 'wind must be three numbers within +-1000 m/s, got "1 2"'),
    (UVLM, WING | {"wind": "1 2 2000"}, "wind must be three numbers within +-1000 m/s"),
    (UVLM, WING | {"wind": "1 2 nan"}, "wind must be finite numbers with spaces between them"),
    (UVLM, WING | {"buoyancy": "yes"}, 'buoyancy must be false or true, got "yes"'),
    (QS, WING | {"rotation": "1"}, 'rotation must be false or true, got "1"'),
    (QS, WING | {"added_mass": "True"}, 'added_mass must be false or true, got "True"'),
    (UVLM, WING | {"rate": "late"}, "rate must be ramped, backward or second_order"),
    (UVLM, WING | {"precision": "half"}, "precision must be single or double"),
    (QS, WING | {"coefficients": "lee"}, "coefficients must be dickinson1999, lee2016 or table"),
    (QS, WING | {"coefficients": "lee2016"}, "reynolds must be given with coefficients lee2016"),
    (
        QS,
        WING | {"coefficients": "lee2016", "reynolds": "50"},
        "reynolds must be one number from 100 to 1e+07",
    ),
    (QS, WING | {"coefficients": "table"}, "coefficient_table must be 2 to 1000 triples"),
    (UVLM, {"stations": "0 1 0"}, "stations must be 2 to 1000 triples of numbers"),
    (UVLM, {"stations": "0 1 0 1 1"}, "stations must be 2 to 1000 triples of numbers"),
    (UVLM, {"stations": "0 1 0 1 1 x"}, "stations must be finite numbers with spaces"),
    (UVLM, {"stations": "0 1 0 1 1 0"} | WING, "span must be left out when stations are given"),
    (UVLM, {"stations": "0 1 0 0 1 0"}, "stations: station 1 must lie further out than the last"),
    (UVLM, {"stations": "0 1 0 1 -1 0"}, "stations: station 1 must have a chord from 0 to 1000 m"),
    (UVLM, {"stations": "0 1 0 2000 1 0"}, "stations: station 1 must have a radius within"),
    (UVLM, {"stations": "0 1 2000 1 1 0"}, "stations: station 0 must have a leading edge within"),
    (
        UVLM,
        {"stations": "0 1 0 1 0 0 2 1 0"},
        "stations: station 1 must have a positive chord; only the ends may be points",
    ),
    (UVLM, {"stations": "0 0 0 1 0 0"}, "stations: the wing's area must be above 1e-12 m2"),
    (UVLM, WING | {"coefficients": "table"}, 'there is no attribute "coefficients"; use site'),
    (QS, WING | {"wake_step": "1"}, 'there is no attribute "wake_step"; use site'),
    (QS, WING | {"": "1"}, 'there is no attribute ""; use site'),
    ("flaprig.other", WING, "model must be flaprig.quasi_steady or flaprig.uvlm, got flaprig.oth"),
]


@pytest.mark.parametrize(("model", "attributes", "start"), CASES)
def test_refusals_name_value_and_what_is_allowed(model, attributes, start):
    assert refusal(model, attributes).startswith(start)


@pytest.mark.parametrize(
    "table",
    ["0 1", "0 1 1", "0 1 1 0 1 1", "1 1 1 0 1 1", "-1 1 1 1 1 1", "0 1 1 4 1 1", "0 101 1 1 1 1"],
)
def test_bad_tables(table):
    sentence = refusal(QS, WING | TABLE | {"coefficient_table": table})
    assert sentence.startswith("coefficient_table must be 2 to 1000 triples")


def test_long_values_are_cut_short():
    assert "..." in refusal(UVLM, WING | {"wind": "1 " * 5000})
    assert "..." in refusal(UVLM, WING | {"x" * 5000: "1"})


@pytest.mark.parametrize("before", range(4))
@pytest.mark.parametrize("letter", ["é", "€", "𝄞"])
def test_cut_falls_between_characters(letter, before):
    for attributes in ({"density": "1" * before + letter * 60}, {"x" * before + letter * 60: "1"}):
        assert f'{letter}..."' in refusal(UVLM, WING | attributes)


@pytest.mark.parametrize("text", ["1\n2", "\r1x", "1\t2\x7f"])
def test_sentence_stays_one_line(text):
    for attributes in ({"density": text}, {text: "1"}):
        assert refusal(UVLM, WING | attributes).isprintable()


def test_every_name_is_read():
    """A garbage value is refused for every name: none is silently left unread."""
    free_text = {"site"}
    for model in (UVLM, QS):
        names = set(_native.attribute_names(model)) - free_text
        for name in names:
            extra = {"coefficients": "lee2016"} if name == "reynolds" else {}
            extra |= {"coefficients": "table"} if name == "coefficient_table" else {}
            base = {} if name == "stations" else WING
            assert refusal(model, base | extra | {name: "?"}).startswith(name)


NASTY = ["nan", "inf", "-1", "0", "1e308", "-1e308", "1e-320", "", " ", "x", "true", "false"]
NASTY += ["1 2 3", "0 1 0 1 1 0", "0 0 0 1 1 1", "table", "lee2016", "9" * 400, "\t\n", "é", "%s%n"]
PLAIN = ["1", "2", "3", "0.25", "0.5", "5"]


def random_value(rng):
    kind = rng.random()
    if kind < 0.35:
        return rng.choice(PLAIN)
    if kind < 0.6:
        return rng.choice(NASTY)
    if kind < 0.85:
        return repr(math.ldexp(rng.uniform(-1, 1), rng.randint(-40, 40)))
    if kind < 0.95:
        return " ".join(repr(rng.uniform(-2, 5)) for _ in range(rng.randint(0, 12)))
    return "".join(chr(rng.randint(1, 255)) for _ in range(rng.randint(0, 20)))


def random_attributes(rng, names):
    chosen = rng.sample(names, rng.randint(0, min(5, len(names))))
    attributes = dict(WING) if rng.random() < 0.8 else {}
    attributes |= {name: random_value(rng) for name in chosen}
    if rng.random() < 0.03:
        attributes["".join(rng.choices("abcd_ \n", k=4))] = "1"
    return attributes


def outcome(model, attributes):
    """None for an accepted set, or the sentence of its refusal."""
    try:
        assert _native.check_attributes(model, attributes) >= 0
        return None
    except ValueError as error:
        # a text that is no UTF-8 would come as one of its children
        return str(error) if type(error) is ValueError else f"{type(error)}\n"


def test_two_hundred_thousand_random_sets_are_accepted_or_refused():
    rng = random.Random(1)
    names = {model: _native.attribute_names(model) for model in (UVLM, QS)}
    sentences = [
        outcome(model, random_attributes(rng, names[model]))
        for _ in range(100_000)
        for model in (UVLM, QS)
    ]
    refusals = [sentence for sentence in sentences if sentence is not None]
    assert 10_000 < len(refusals) < 190_000
    assert not [s for s in refusals if not 0 < len(s) < 600 or "\n" in s or "\r" in s]


def small(attributes):
    """Keeps what is built affordable: fine lattices and long wakes are another test's matter."""
    size = [attributes.get(n, "1").strip() for n in ("chordwise", "spanwise", "wake_rows")]
    return all(float(x or 100) <= 20 for x in size)


def motion(rng, count):
    rotation = np.linalg.qr(rng.standard_normal((count, 3, 3)))[0]
    parts = [rng.standard_normal((count, n)) for n in (3, 6, 6)]
    return parts[0], rotation, parts[1], parts[2]


def test_two_thousand_random_sets_run_two_steps():
    rng, noise = random.Random(2), np.random.default_rng(2)
    ran = 0
    while ran < 2000:
        model = UVLM if ran % 2 else QS
        attributes = random_attributes(rng, _native.attribute_names(model))
        if model == UVLM:
            attributes = {"chordwise": "2", "spanwise": "3", "wake_rows": "4"} | attributes
        try:
            _native.check_attributes(model, attributes)
        except ValueError:
            continue
        if not small(attributes):
            continue
        air = _native.Air(model, attributes)
        loads = air.run(np.zeros(air.state_size), 0.01, *motion(noise, 2))
        # every accepted setting gives numbers
        assert all(np.isfinite(part).all() for part in loads), attributes
        ran += 1
