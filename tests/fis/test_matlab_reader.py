"""`.fis` files as people write them are read; what a rulebook cannot say is refused with its line."""

import math
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis import InputError, load_rulebook, read_rulebook
from comity_fis.matlab.lines import MAX_BYTES, MAX_RULES
from comity_fis.matlab.reader import parse_fis, read_fis
from comity_fis.membership.curved import Gaussian
from comity_fis.membership.function import Complement, Trapezoid
from comity_fis.rules.methods import Methods
from comity_fis.rules.rule import And, Is, Not, Or

TIPPER = """\
% A tip for a waiter.
[System]
Name='tipper'
Type='mamdani'
Version=2.0
NumInputs=2
NumOutputs=1
NumRules=4
AndMethod='prod'
OrMethod='probor'
ImpMethod='prod'
AggMethod='sum'
DefuzzMethod='bisector'

[Input1]
Name='service quality'
Range=[0 1e1]
NumMFs=2
MF1='poor':'gaussmf',[1.5 0]   % a comment
MF2='100% good':'linsmf',[5 9]

[Input2]
Name='food'
Range=[-0.5 10]
NumMFs=2
MF1='rancid':'trapmf',[-Inf, -Inf, 1, 3]
MF2='delicious':'trimf',[7 10 10]

[Output1]
Name='tip'
Range=[0 30]
NumMFs=3
MF1='cheap':'trimf',[0 5 10]
MF2='average':'linzmf',[10 20]
MF3='generous':'trapmf',[20 20 30 30]

[Rules]
1 1, 1 (1) : 2
2 0, -2 (0.5) : 1
-2 2, 3 (1) : 1
0 -1, 2 (2.5e-1) : 1
"""


def changed(old, new):
    assert old in TIPPER, old
    return TIPPER.replace(old, new, 1)


@pytest.fixture(scope="module")
def tipper():
    return parse_fis(TIPPER, "tipper.fis")


def test_names_ranges_and_shapes(tipper):
    assert (tipper.name, list(tipper.variables), list(tipper.parameters)) == (
        "tipper",
        ["service quality", "food"],
        ["tip"],
    )
    service, food, tip = (*tipper.variables.values(), tipper.parameters["tip"])
    assert service.domain.ends == (0, 10)
    assert service.terms == {"poor": Gaussian(1.5, 0), "100% good": Trapezoid(5, 9, 10, 10)}
    assert food.terms == {"rancid": Trapezoid(-0.5, -0.5, 1, 3), "delicious": Trapezoid(7, 10, 10, 10)}
    assert tip.terms["average"] == Trapezoid(0, 0, 10, 20)
    assert tip.terms["not average"] == Complement(Trapezoid(0, 0, 10, 20))


def test_rules_weights_negation_and_what_is_left_out(tipper):
    poor, good = Is("service quality", "poor"), Is("service quality", "100% good")
    assert [rule.antecedent for rule in tipper.rules] == [
        Or((poor, Is("food", "rancid"))),
        good,
        And((Not(good), Is("food", "delicious"))),
        Not(Is("food", "rancid")),
    ]
    assert [rule.weight for rule in tipper.rules] == [1, 0.5, 1, 0.25]
    assert tipper.rules[1].consequents == (Is("tip", "not average"),)
    assert (
        tipper.rules[2].text
        == "if 'service quality' is not '100% good' and food is delicious then tip is generous"
    )


def test_methods(tipper):
    assert tipper.methods == Methods(
        conjunction="prod",
        disjunction="probor",
        implication="prod",
        aggregation="sum",
        defuzzification="bisector",
    )


def test_what_the_file_does_not_say_is_chosen_and_labelled(tipper):
    tip = tipper.parameters["tip"]
    assert (tip.neutral, tip.ask, tip.safe, tip.spread) == (15, tip.rules, tip.rules, 30 / math.sqrt(12))
    assert {v.kind for v in tipper.variables.values()} == {"situation"}
    assert {rule.evidence for rule in tipper.rules} == {"design"}
    assert "tipper.fis" in tipper.rules[0].source


def test_where_no_rule_fires_the_middle_of_the_range_stands():
    rules = TIPPER[TIPPER.index("1 1, 1 (1)") :]
    text = TIPPER.replace(rules, "2 0, 1 (1) : 1\n").replace("NumRules=4", "NumRules=1")
    value = parse_fis(text, "tipper.fis").infer({"service quality": 2, "food": 5})["tip"]
    assert (value.number, value.origin) == (15, "neutral")


@pytest.mark.parametrize(
    "text",
    [
        TIPPER.replace("\n", "\r\n"),
        "\ufeff" + TIPPER,
        TIPPER.replace("=", " = ").replace("%", "#", 1),
        TIPPER.replace("[5 9]", "[ 5,9 ]").replace("1 1, 1 (1) : 2", "1  1 ,1 ( 1 ):2"),
        TIPPER.replace("'poor':'gaussmf',", '"poor" : "gaussmf" , '),
        TIPPER + "\n\n% the end",
    ],
)
def test_spelling_does_not_matter(tmp_path, tipper, text):
    path = tmp_path / "tipper.fis"
    path.write_bytes(text.encode())
    assert read_fis(path, "tipper.fis") == tipper


def test_a_rulebook_loads_from_a_fis_file_wherever_one_is_loaded(tmp_path, tipper):
    path = tmp_path / "tipper.fis"
    path.write_text(TIPPER)
    assert load_rulebook(path) == load_rulebook(str(path)) == load_rulebook(read_rulebook(path)) == tipper


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("Type='mamdani'", "Type='tsukamoto'", 4, "Type='mamdani', or Type='sugeno'"),
        ("Type='mamdani'", "Type='sugeno'", 33, "'constant' in an output of a Sugeno system"),
        ("Version=2.0", "TypeReductionMethod='karnikmendel'", 5, "Type-2 systems are not read"),
        ("AndMethod='prod'", "AndMethod='mymin'", 9, "min, prod"),
        ("OrMethod='probor'", "OrMethod='sum'", 10, "max, probor"),
        ("AggMethod='sum'", "AggMethod='summ'", 12, "Did you mean 'sum'?"),
        ("DefuzzMethod='bisector'", "DefuzzMethod='wtaver'", 13, "centroid, bisector, mom, som, lom"),
        ("Version=2.0", "Colour='red'", 5, "a known key in [System], got 'Colour'"),
        ("NumMFs=2", "NumMFs=2\nUnit='m'", 19, "'Unit'"),
        ("NumMFs=2", "NumMFs=3", 15, "a line MF3=... in [Input1]"),
        ("NumMFs=2", "NumMFs=1", 20, "a known key in [Input1], got 'MF2'"),
        ("NumMFs=2", "NumMFs=-2", 18, "a whole number"),
        ("NumInputs=2", "NumInputs=3", 6, "a section [Input3]"),
        ("NumInputs=2", "NumInputs=1", 22, "1 sections [Input...]"),
        ("NumInputs=2", "NumInputs=1000000000", 6, "a whole number from 1 to 100"),
        ("NumRules=4", "NumRules=5", 8, "the number of rules, 4"),
        ("'gaussmf',[1.5 0]", "'mymf',[1.5 0]", 19, "one of MATLAB's membership functions"),
        ("'gaussmf',[1.5 0]", "'gausmf',[1.5 0]", 19, "Did you mean 'gaussmf'?"),
        ("'gaussmf',[1.5 0]", "'constant',[1.5]", 19, "outputs of files with Type='sugeno' only"),
        ("'gaussmf',[1.5 0]", "'gaussmf',[1.5]", 19, "2 parameters of gaussmf"),
        ("'gaussmf',[1.5 0]", "'gaussmf',[0 0]", 19, "a sigma that is not 0"),
        ("'gaussmf',[1.5 0]", "'gaussmf',[NaN 0]", 19, "a number"),
        ("'gaussmf',[1.5 0]", "'gaussmf',[1e999 0]", 19, "gaussmf"),
        ("'gaussmf',[1.5 0]", "'gaussmf',[1.5 0],[1 0]", 19, "a type-2 system"),
        ("'gaussmf',[1.5 0]", "'gaussmf',[1.5 zero]", 19, "a number where 'zero'"),
        ("'trimf',[0 5 10]", "'trimf',[5 0 10]", 33, "never decrease"),
        ("[-Inf, -Inf, 1, 3]", "[-Inf, 0, 1, 3]", 26, "finite corners"),
        ("Range=[0 1e1]", "Range=[10 0]", 17, "the lower one first"),
        ("Range=[0 1e1]", "Range=[0 Inf]", 17, "finite"),
        ("Range=[0 1e1]", "Range=0 10", 17, "square brackets"),
        ("Name='food'", "Name='tip'", 30, "each name once"),
        ("Name='food'", "Name='service quality'", 23, "each name once"),
        ("Name='food'", "Name=food", 23, "single quotes"),
        ("Name='food'", "Name='  '", 23, "a name of 1 to 80 characters"),
        ("'100% good'", "'poor'", 20, "each term's name once"),
        ("1 1, 1 (1) : 2", "1 1, 1 (1) : 3", 38, "1 (and) or 2 (or)"),
        ("1 1, 1 (1) : 2", "1 1, 4 (1) : 2", 38, "an index of 'tip' from -3 to 3"),
        ("1 1, 1 (1) : 2", "-3 1, 1 (1) : 2", 38, "an index of 'service quality'"),
        ("1 1, 1 (1) : 2", "1 1.3, 1 (1) : 2", 38, "hedges"),
        ("1 1, 1 (1) : 2", "1 1 1, 1 (1) : 2", 38, "2 input indexes"),
        ("1 1, 1 (1) : 2", "0 0, 1 (1) : 2", 38, "reads at least one input"),
        ("1 1, 1 (1) : 2", "1 1, 1 (-1) : 2", 38, "a weight from 0 to 1"),
        ("1 1, 1 (1) : 2", "1 1, 1 (2) : 2", 38, "Write 1 for a rule that counts in full"),
        ("1 1, 1 (1) : 2", "1 1, 1 : 2", 38, "a rule such as"),
        ("1 1, 1 (1) : 2", "99999999999999999999 1, 1 (1) : 2", 38, "a whole number"),
        ("[Input2]", "[Input1]", 22, "each section once"),
        ("[Input2]", "[Inputs]", 22, "a section or a line KEY=VALUE"),
        ("Range=[0 1e1]", "Range=[0 1e1]\nRange=[0 5]", 18, "Range once"),
        ("% A tip for a waiter.", "A tip for a waiter.", 1, "[System] first"),
        ("'cheap'", "'not average'", 39, "a term of 'tip' that can be called 'not average'"),
    ],
)
def test_what_cannot_be_said_is_refused_with_its_line(old, new, line, message):
    with pytest.raises(InputError) as refusal:
        parse_fis(changed(old, new), "tipper.fis")
    assert message in str(refusal.value)
    assert (refusal.value.where.file, refusal.value.where.line) == ("tipper.fis", line)
    assert refusal.value.remedy


@pytest.mark.parametrize("lines", range(0, TIPPER.count("\n"), 3))
def test_a_file_that_is_cut_off_is_refused(lines):
    with pytest.raises(InputError):
        parse_fis("\n".join(TIPPER.splitlines()[:lines]), "tipper.fis")


@settings(max_examples=200, deadline=None)
@given(st.binary(max_size=300))
def test_random_bytes_are_refused(tmp_path_factory, content):
    path = tmp_path_factory.getbasetemp() / "random.fis"
    path.write_bytes(content)
    with pytest.raises(InputError):
        load_rulebook(path)


@settings(max_examples=300, deadline=None)
@given(st.integers(0, len(TIPPER) - 1), st.integers(0, 12), st.text("'[]():,=%-.eEI19 \n", max_size=8))
def test_any_slip_of_the_pen_is_read_or_refused(start, length, slip):
    text = TIPPER[:start] + slip + TIPPER[start + length :]
    try:
        rulebook = parse_fis(text, "tipper.fis")
        middle = {name: sum(v.domain.ends) / 2 for name, v in rulebook.variables.items()}
        value = rulebook.infer(middle)[next(iter(rulebook.parameters))]
    except InputError:
        return
    assert math.isfinite(value.number)


def test_a_million_rules_are_refused_before_they_are_read(tmp_path):
    path = tmp_path / "large.fis"
    path.write_text(changed("1 1, 1 (1) : 2", "1 1, 1 (1) : 2\n" * 1_000_000))
    assert path.stat().st_size > MAX_BYTES
    with pytest.raises(InputError, match=f"more than {MAX_BYTES} bytes"):
        load_rulebook(path)


def test_too_many_rules_are_refused():
    with pytest.raises(InputError, match=f"at most {MAX_RULES} rules"):
        parse_fis(changed("1 1, 1 (1) : 2", "1 1, 1 (1) : 2\n" * (MAX_RULES + 1)), "tipper.fis")


@pytest.mark.parametrize("name", ["none.fis", "folder.fis"])
def test_what_is_no_file_is_refused(tmp_path, name):
    (tmp_path / "folder.fis").mkdir()
    with pytest.raises(InputError, match=r"a \.fis file of MATLAB"):
        load_rulebook(Path(tmp_path / name))
