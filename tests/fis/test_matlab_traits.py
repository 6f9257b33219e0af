"""Traits of `.fis` files from many programs: all are read, and mean what MATLAB makes of them."""

import numpy as np
import pytest
from scipy.integrate import quad

from comity_fis import InputError, load_rulebook
from comity_fis.audit import audit
from comity_fis.matlab.check import compare
from comity_fis.matlab.reader import parse_fis
from comity_fis.matlab.writer import write_fis
from comity_fis.membership.function import Singleton
from comity_fis.rulebook.writer import rulebook_yaml
from comity_fis.validation.yaml_file import parse_yaml

PLAIN = """\
[System]
Name='plain'
Type='mamdani'
Version=2.0
NumInputs=1
NumOutputs=1
NumRules=2
AndMethod='min'
OrMethod='max'
ImpMethod='min'
AggMethod='max'
DefuzzMethod='centroid'

[Input1]
Name='x'
Range=[0 10]
NumMFs=2
MF1='low':'trimf',[-10 0 10]
MF2='high':'trimf',[0 10 20]

[Output1]
Name='y'
Range=[0 20]
NumMFs=3
MF1='s':'trimf',[0 5 10]
MF2='m':'trimf',[5 10 15]
MF3='b':'trimf',[10 15 20]

[Rules]
1, 1 (1) : 1
2, 3 (1) : 1
"""

SUGENO = (
    PLAIN.replace("Type='mamdani'", "Type='sugeno'")
    .replace("DefuzzMethod='centroid'", "DefuzzMethod='wtaver'")
    .replace("'trimf',[0 5 10]", "'constant',[2]")
    .replace("'trimf',[5 10 15]", "'constant',7")
    .replace("'trimf',[10 15 20]", "'linear',[0 12]")
)


def changed(*pairs, text=PLAIN):
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


def value(text, **inputs):
    return parse_fis(text, "a.fis").infer(inputs or {"x": 2.5})["y"].number


def cut(x, middle, height):
    return min(height, max(0.0, 1 - abs(x - middle) / 5))


def centroid(*cuts):
    """Of triangles 10 wide, cut at heights, by quadrature between all of their corners."""
    corners = sorted({m + s * w for m, h in cuts for s in (1, -1) for w in (0, 5, 5 * (1 - h))})
    united = [
        quad(lambda x, k=k: x**k * max(cut(x, *one) for one in cuts), 0, 20, points=corners) for k in (0, 1)
    ]
    return united[1][0] / united[0][0]


def test_the_plain_file_gives_what_quadrature_gives():
    assert value(PLAIN) == pytest.approx(centroid((5, 0.75), (15, 0.25)), abs=1e-9)


@pytest.mark.parametrize(
    "text",
    [
        changed(("1, 1 (1) : 1", "1.000 , 1.000 (1.000) : 1"), ("2, 3 (1) : 1", "2.000 , 3. (1.000) : 1.0")),
        changed(("NumMFs=2", "NumMFs=2.000"), ("NumRules=2", "NumRules=2.0"), ("[0 10]", "[0.000 10.000]")),
        changed(("'low'", "'low '"), ("'x'", "' x '"), ("'plain'", "'plain '"), ("'b'", "'b\t'")),
        changed(("\n[", " \t\n\n  ["), ("MF1=", "\tMF1 = "), ("(1) : 1", "(1):1 ")),
        changed(("OrMethod='max'", "OrMethod=''"), ("AndMethod='min'", "AndMethod=''")),
        changed(("NumRules=2", "NumRules=3"), ("[Rules]\n", "[Rules]\n2, 0 (1) : 1\n")),
    ],
    ids=[
        "indexes",
        "counts",
        "blanks in names",
        "blanks in lines",
        "methods that no rule needs",
        "no conclusion",
    ],
)
def test_how_a_program_writes_numbers_and_blanks_does_not_matter(text):
    assert parse_fis(text, "a.fis") == parse_fis(PLAIN, "a.fis")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "latin-1", "utf-16"])
def test_names_keep_their_letters_in_every_encoding(tmp_path, encoding):
    path = tmp_path / "a.FIS"
    path.write_bytes(
        changed(("'plain'", "'Müller'"), ("'x'", "'Größe'"), ("'y'", "'Temperatur °C'")).encode(encoding)
    )
    rulebook = load_rulebook(path)
    assert (rulebook.name, *rulebook.variables, *rulebook.parameters) == ("Müller", "Größe", "Temperatur °C")
    assert rulebook.infer({"Größe": 2.5})["Temperatur °C"].number == value(PLAIN)


def test_what_is_no_text_is_refused(tmp_path):
    path = tmp_path / "a.fis"
    path.write_bytes(b"[System]\x00\xff")
    with pytest.raises(InputError, match="no text"):
        load_rulebook(path)


def test_a_rule_of_weight_0_is_off_and_stays_so():
    text = changed(("NumRules=2", "NumRules=3"), ("[Rules]\n", "[Rules]\n1, 2 (0) : 1\n"))
    rulebook = parse_fis(text, "a.fis")
    assert [rule.enabled for rule in rulebook.rules] == [False, True, True]
    assert value(text) == value(PLAIN)
    assert "\n1, 2 (0) : 1\n" in write_fis(rulebook).text


def test_an_input_without_terms_is_there_and_changes_nothing():
    text = changed(
        ("NumInputs=1", "NumInputs=2"),
        ("[Output1]", "[Input2]\nName='unused'\nRange=[0 1]\nNumMFs=0\n\n[Output1]"),
        ("1, 1 (1)", "1 0, 1 (1)"),
        ("2, 3 (1)", "2 0, 3 (1)"),
    )
    assert value(text, x=2.5, unused=0.3) == value(text, x=2.5) == value(PLAIN)
    with pytest.raises(InputError, match="the index 0 of 'unused', which has no terms"):
        parse_fis(changed(("2 0, 3 (1)", "2 1, 3 (1)"), text=text), "a.fis")


def test_an_output_without_terms_is_the_middle_of_its_range():
    text = changed(
        ("NumOutputs=1", "NumOutputs=2"),
        ("[Rules]", "[Output2]\nName='z'\nRange=[0 4]\nNumMFs=0\n\n[Rules]"),
        ("1, 1 (1)", "1, 1 0 (1)"),
        ("2, 3 (1)", "2, 3 0 (1)"),
    )
    answer = parse_fis(text, "a.fis").infer({"x": 2.5})
    assert (answer["z"].number, answer["z"].origin) == (2, "neutral")


@pytest.mark.parametrize("term", ["'trimf',[-20 -15 -5]", "'trapmf',[21 22 23 24]", "'trimf',[-10 -5 0]"])
def test_an_output_term_outside_the_range_gives_nothing(term):
    text = changed(("'trimf',[0 5 10]", term))
    assert value(text, x=5) == pytest.approx(centroid((15, 0.5)), abs=1e-9)
    nothing = parse_fis(text, "a.fis").infer({"x": 0})["y"]
    assert (nothing.number, nothing.origin) == (10, "neutral")  # as in MATLAB, the middle of the range


def test_triangles_without_width_are_constants():
    text = changed(("[0 5 10]", "[2 2 2]"), ("[5 10 15]", "[7 7 7]"), ("[10 15 20]", "[12 12 12]"))
    assert parse_fis(text, "a.fis").parameters["y"].terms["s"] == Singleton(2)
    assert value(text) == pytest.approx(0.75 * 2 + 0.25 * 12)


def test_a_sugeno_system_of_constants_gives_their_weighted_mean():
    assert value(SUGENO) == pytest.approx(0.75 * 2 + 0.25 * 12)
    twice = changed(("NumRules=2", "NumRules=3"), ("[Rules]\n", "[Rules]\n1, 1 (0.4) : 1\n"), text=SUGENO)
    assert value(twice) == pytest.approx((1.4 * 0.75 * 2 + 0.25 * 12) / (1.4 * 0.75 + 0.25))


@pytest.mark.parametrize("method", ["ImpMethod='min'", "AggMethod='max'", "AggMethod=''"])
def test_what_a_sugeno_file_says_of_implication_and_aggregation_does_not_matter(method):
    key = method.partition("=")[0]
    line = next(line for line in SUGENO.splitlines() if line.startswith(key))
    assert parse_fis(changed((line, method), text=SUGENO), "a.fis") == parse_fis(SUGENO, "a.fis")


def test_a_constant_may_lie_outside_the_range_of_its_output():
    text = changed(("'constant',[2]", "'constant',[-40]"), text=SUGENO)
    assert value(text) == pytest.approx(0.75 * -40 + 0.25 * 12)


def test_the_audit_names_terms_outside_their_range():
    rulebook = parse_fis(changed(("'trimf',[0 5 10]", "'trimf',[-20 -15 -5]")), "a.fis")
    assert audit(rulebook).empty_terms == {"y": ("s",)}
    assert audit(parse_fis(PLAIN, "a.fis")).empty_terms == {}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("'linear',[0 12]", "'linear',[0.5 12]", "order 1"),
        ("'linear',[0 12]", "'linear',[12]", "2 parameters of linear"),
        ("'constant',[2]", "'trimf',[0 1 2]", "'constant' in an output of a Sugeno system"),
        ("DefuzzMethod='wtaver'", "DefuzzMethod='wtsum'", "wtsum"),
        ("2, 3 (1) : 1", "2, -3 (1) : 1", "A constant has no opposite"),
    ],
)
def test_what_of_sugeno_stays_out_is_named_with_its_line(old, new, message):
    text = changed((old, new), text=SUGENO)
    with pytest.raises(InputError) as refusal:
        parse_fis(text, "a.fis")
    assert message in str(refusal.value)
    assert new in text.splitlines()[refusal.value.where.line - 1]


@pytest.mark.parametrize(
    "text",
    [
        SUGENO,
        changed(("[0 5 10]", "[2 2 2]"), ("[5 10 15]", "[7 7 7]"), ("[10 15 20]", "[12 12 12]")),
        changed(("'trimf',[0 5 10]", "'trimf',[-20 -15 -5]")),
        changed(("NumRules=2", "NumRules=3"), ("[Rules]\n", "[Rules]\n-1, -2 (0) : 2\n")),
        changed(
            (
                "NumMFs=2\nMF1='low':'trimf',[-10 0 10]\nMF2='high':'trimf',[0 10 20]",
                "NumMFs=1\nMF1='at 3':'trimf',[3 3 3]",
            ),
            ("2, 3 (1)", "-1, 3 (1)"),
        ),
    ],
    ids=["sugeno", "constants", "outside", "weight 0", "an input's single value"],
)
def test_every_trait_survives_both_formats(text):
    rulebook = parse_fis(text, "a.fis")
    by_yaml = load_rulebook(parse_yaml(rulebook_yaml(rulebook, "a.fis"), "a.yaml", "a.yaml"))
    by_fis = parse_fis(write_fis(rulebook).text, "a.fis")
    assert by_yaml == by_fis == rulebook
    assert compare(rulebook, by_fis).differences == {"y": 0}
    assert np.array_equal(
        by_yaml.infer_many({"x": [0, 3, 9.5]})["y"], by_fis.infer_many({"x": [0, 3, 9.5]})["y"]
    )
