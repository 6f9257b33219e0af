"""Export then import gives the same answers; what would change them is refused, what is lost is listed."""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_fis import InputError, load_rulebook
from comity_fis.matlab.check import compare
from comity_fis.matlab.columns import input_column
from comity_fis.matlab.reader import parse_fis
from comity_fis.matlab.writer import FIRST_LINE, write_fis
from comity_fis.membership.curved import CURVED
from comity_fis.membership.function import Bump, Categories, Trapezoid, TwoTermGaussian
from comity_fis.membership.interval import Interval
from comity_fis.rulebook.rulebook import Rulebook
from comity_fis.rulebook.writer import rulebook_yaml
from comity_fis.rules.methods import CHOICES, MAMDANI, Methods
from comity_fis.rules.rule import And, Is, Not, Or, Rule, Source
from comity_fis.validation.yaml_file import parse_yaml
from comity_fis.variables.measurement import Level
from comity_fis.variables.parameter import NumericParameter
from comity_fis.variables.variable import NominalVariable, NumericVariable, OrdinalVariable

SOURCE = Source("book", "A book", "read")
inside = st.floats(-9.5, 9.5)


@st.composite
def shapes(draw):
    a, b, c, d = sorted(draw(st.lists(inside, min_size=4, max_size=4, unique=True)))
    width = draw(st.floats(0.5, 5))
    return draw(
        st.sampled_from(
            [
                Trapezoid(a, b, c, max(d, a + 0.5)),
                Trapezoid(a, a, b, max(c, a + 0.5)),
                Trapezoid(a, b, b, max(c, a + 0.5)),
                CURVED["gaussmf"](width, a),
                CURVED["gauss2mf"](width, a, width / 2, c),
                CURVED["gbellmf"](width, 1.5, b),
                CURVED["sigmf"](width, c),
                CURVED["smf"](a, a + width),
            ]
        )
    )


@st.composite
def methods(draw):
    return Methods(**{field: draw(st.sampled_from(choices)) for field, choices in CHOICES.items()})


terms = st.dictionaries(
    st.sampled_from(["poor", "so so", "not good", "50% good", "is", "good-ish"]),
    shapes(),
    min_size=1,
    max_size=3,
)


@st.composite
def rulebooks(draw):
    variables = {
        "service": _variable("service", draw(terms)),
        "the food": _variable("the food", draw(terms)),
        "table": NominalVariable(
            name="table", kind="situation", categories=("inside", "terrace", "bar"), reason="made up"
        ),
    }
    parameters = {name: _parameter(name, draw(terms)) for name in ("tip", "smile at them")}
    count = draw(st.integers(1, 4))
    chosen = draw(methods())
    rules = tuple(_rule(number, draw, variables, parameters) for number in range(1, count + 1))
    return Rulebook(
        name="a place",
        description="Made up.",
        variables=variables,
        parameters=parameters,
        rules=rules,
        sources={"book": SOURCE},
        methods=chosen,
    )


def _variable(name, terms):
    return NumericVariable(
        name=name,
        kind="situation",
        level=Level.INTERVAL,
        domain=Interval(-10, 10),
        terms=terms,
        reason="made up",
    )


def _parameter(name, terms, neutral=0.0):
    domain = Interval(-10, 10)
    reasons = dict.fromkeys(("ranges", "terms", "neutral", "spread"), "made up")
    return NumericParameter(
        name=name, kind="behaviour", unit="1", rules=domain, ask=domain, safe=domain, terms=terms,
        neutral=neutral, spread=1.0, reasons=reasons,
    )  # fmt: skip


def _rule(number, draw, variables, parameters):
    read = draw(st.lists(st.sampled_from(sorted(variables)), min_size=1, max_size=3, unique=True))
    literals = [Is(name, draw(st.sampled_from(sorted(variables[name].terms)))) for name in read]
    parts = tuple(Not(is_) if draw(st.booleans()) else is_ for is_ in literals)
    antecedent = parts[0] if len(parts) == 1 else draw(st.sampled_from([And, Or]))(parts)
    gives = draw(st.lists(st.sampled_from(sorted(parameters)), min_size=1, max_size=2, unique=True))
    consequents = tuple(Is(name, draw(st.sampled_from(sorted(parameters[name].terms)))) for name in gives)
    weight = draw(st.sampled_from([1.0, 0.5, 0.123456789, 1e-3]))
    return plain_rule(number, antecedent, *consequents, weight=weight)


def plain_rule(number, antecedent, *consequents, weight=1.0):
    text = f"if {antecedent} then {' and '.join(map(str, consequents))}"
    return Rule(
        number=number, text=text, antecedent=antecedent, consequents=consequents, sources=(SOURCE,),
        evidence="weak", weight=weight,
    )  # fmt: skip


@settings(max_examples=30, deadline=None)
@given(rulebooks())
def test_export_then_import_gives_the_same_answers(rulebook):
    back = parse_fis(write_fis(rulebook).text, "a.fis")
    assert set(compare(rulebook, back, samples=4).differences.values()) == {0.0}


@settings(max_examples=30, deadline=None)
@given(rulebooks())
def test_a_second_export_changes_nothing_but_the_comments(rulebook):
    back = parse_fis(write_fis(rulebook).text, "a.fis")
    again = parse_fis(write_fis(back).text, "a.fis")
    assert again == back


@settings(max_examples=30, deadline=None)
@given(rulebooks())
def test_yaml_reads_back_as_the_same_rulebook(rulebook):
    text = rulebook_yaml(rulebook, "a test")
    assert load_rulebook(parse_yaml(text, "a.yaml", "a.yaml")) == rulebook


@pytest.mark.parametrize("name", ["bruno2017-case1", "bruno2017-case2", "bruno2017"])
def test_a_shipped_rulebook_reads_back_from_yaml_with_the_same_answers(name):
    rulebook = load_rulebook(name)
    back = load_rulebook(parse_yaml(rulebook_yaml(rulebook, name), "a.yaml", "a.yaml"))
    for inputs in ({"individualism": 38}, {"individualism": 67, "gender": "male"}):
        known = {key: value for key, value in inputs.items() if key in rulebook.variables}
        assert back.infer(known).as_json() == rulebook.infer(known).as_json()


@pytest.fixture
def plain():
    """A rulebook to vary: temperature and two words decide a speed."""
    variables = {
        "heat": _variable("heat", {"cold": Trapezoid(-10, -10, -5, 5), "hot": Trapezoid(-5, 5, 10, 10)}),
        "day": NominalVariable(name="day", kind="situation", categories=("sun", "mon", "tue")),
    }
    parameters = {
        "speed": _parameter("speed", {"slow": Trapezoid(-10, -10, -5, 5), "fast": Trapezoid(-5, 5, 10, 10)})
    }
    return Rulebook(
        name="plain", description="Made up.", variables=variables, parameters=parameters,
        rules=(plain_rule(1, Is("heat", "hot"), Is("speed", "slow")),), sources={"book": SOURCE},
    )  # fmt: skip


def with_rule(rulebook, antecedent, *consequents, **changes):
    return replace(
        rulebook, rules=(plain_rule(1, antecedent, *consequents or (Is("speed", "slow"),)),), **changes
    )


HOT, COLD, SUN, MON = Is("heat", "hot"), Is("heat", "cold"), Is("day", "sun"), Is("day", "mon")


@pytest.mark.parametrize(
    ("antecedent", "rows"),
    [
        (And((HOT, Or((SUN, MON)))), 2),
        (Or((And((HOT, SUN)), And((COLD, MON)))), 2),
        (Or((SUN, MON)), 2),
        (Not(And((HOT, SUN))), 1),
        (Not(Or((HOT, And((COLD, SUN))))), 0),
        (And((HOT, HOT)), 1),
    ],
)
def test_brackets_become_rows_that_mean_the_same(plain, antecedent, rows):
    rulebook = with_rule(plain, antecedent)
    if not rows:  # `not hot` and `not cold` at once: a row has one index per variable
        with pytest.raises(InputError, match="each variable once"):
            write_fis(rulebook)
        return
    exported = write_fis(rulebook)
    back = parse_fis(exported.text, "a.fis")
    assert len(back.rules) == rows
    assert (f"rule 1: {rows} rows" in exported.changed) == (rows > 1)
    assert compare(rulebook, back).differences["speed"] < 1e-9


def test_words_become_codes_and_the_codes_are_told(plain):
    exported = write_fis(with_rule(plain, Not(MON)))
    assert "day: 1 = sun, 2 = mon, 3 = tue" in exported.changed
    assert "% day: 1 = sun, 2 = mon, 3 = tue" in exported.text
    back = parse_fis(exported.text, "a.fis")
    assert back.infer({"day": 2})["speed"].origin == "neutral"
    assert back.infer({"day": 3})["speed"].fired[0].strength == 1


def test_what_is_lost_is_listed_and_stands_in_the_comments(plain):
    parameter = replace(plain.parameters["speed"], neutral=3.0, ask=Interval(-20, 20))
    exported = write_fis(replace(plain, parameters={"speed": parameter}))
    lost = "\n".join(exported.lost)
    for what in ("sources and evidence", "not disclosed", "-20..20", "spread 1", "neutral value 3"):
        assert what in lost
    assert exported.text.startswith(FIRST_LINE)
    assert "A book" in exported.text
    assert "evidence weak" in exported.text


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda r: with_rule(r, And((HOT, Or((SUN, MON)))), methods=Methods(conjunction="prod")), "not both"),
        (lambda r: with_rule(r, And((HOT, Or((SUN, MON)))), methods=Methods(aggregation="sum")), "not both"),
        (
            lambda r: with_rule(r, Not(And((HOT, SUN))), methods=Methods(conjunction="prod")),
            "in front of brackets",
        ),
        (lambda r: with_rule(r, And((HOT, COLD))), "heat twice"),
        (lambda r: with_rule(r, Is("speed", "fast")), "one step"),
    ],
)
def test_a_rule_without_rows_that_mean_the_same_is_refused(plain, change, message):
    if "one step" in message:
        plain = replace(
            plain,
            parameters=plain.parameters | {"noise": _parameter("noise", {"loud": Trapezoid(0, 1, 2, 3)})},
        )
        rule = plain_rule(1, Is("speed", "fast"), Is("noise", "loud"))
        rulebook = replace(plain, rules=(rule,))
    else:
        rulebook = change(plain)
    with pytest.raises(InputError, match=message) as refusal:
        write_fis(rulebook)
    assert "rule 1" in str(refusal.value)


def test_a_parameter_that_is_a_word_is_refused():
    with pytest.raises(InputError, match="no outputs that are words"):
        write_fis(load_rulebook("bruno2017"), tolerance=0.2)


@pytest.mark.parametrize("said", ["very near", "not very near"])
def test_hedges_are_refused(said):
    book = load_rulebook("bruno2017-case1")
    old = str(book.rules[0])
    name, term = book.rules[0].reads[0], next(iter(book.variables[book.rules[0].reads[0]].terms))
    hedged = said.replace("near", term)
    with pytest.raises(InputError, match="no hedges"):
        write_fis(book.with_rule(1, f"if {name} is {hedged} then{old.partition('then')[2]}"), tolerance=1)


def test_words_in_an_order_become_their_codes_in_that_order():
    levels = OrdinalVariable(
        name="education",
        kind="culture",
        categories=("none", "school", "degree"),
        groups={"some": Categories(frozenset({"school", "degree"}))},
        numbered_from=0,
        reason="made up",
    )
    column = input_column(levels)
    assert (column.low, column.high) == (1, 3)
    assert column.shapes["some"].numbers == (1, 2, 3, 4)
    assert column.notes == ("education: 1 = none, 2 = school, 3 = degree",)


def test_the_papers_curves_are_refused_unless_an_error_is_allowed():
    case2 = load_rulebook("bruno2017-case2")
    with pytest.raises(InputError, match="--piecewise-linear"):
        write_fis(case2)
    with pytest.raises(InputError, match=r"largest error of 0\.05\d\d by the best one found"):
        write_fis(case2, tolerance=0.01)


def test_the_papers_curves_become_trapezoids_that_say_their_error():
    case2 = load_rulebook("bruno2017-case2")
    exported = write_fis(case2, tolerance=0.06)
    back = parse_fis(exported.text, "case2.fis")
    for term in ("LC1", "LC2"):
        curve, straight = (book.variables["individualism"].terms[term] for book in (case2, back))
        worst = max(abs(curve(x / 10) - straight(x / 10)) for x in range(1001))
        assert worst < 0.06
        assert (
            f"individualism is {term}: a trapezoid in place of the curve, largest error {worst:.3f}"
            in "\n".join(exported.changed)
        )


def test_a_single_gaussian_is_no_approximation(plain):
    bell = TwoTermGaussian(Bump(1, 2, 3), Bump(0, 0, 1))
    rulebook = replace(plain, variables=plain.variables | {"heat": _variable("heat", {"hot": bell})})
    exported = write_fis(rulebook)
    assert "'gaussmf'" in exported.text
    assert compare(rulebook, parse_fis(exported.text, "a.fis")).differences["speed"] < 1e-9


def test_a_complement_is_written_as_a_negative_index():
    text = write_fis(parse_fis(SMALL, "small.fis")).text
    assert "\n1, -1 (1) : 1\n" in text
    assert "not slow" not in text.partition("[System]")[2]


def test_the_default_methods_are_matlabs(plain):
    text = write_fis(replace(plain, methods=MAMDANI)).text
    for line in (
        "AndMethod='min'",
        "OrMethod='max'",
        "ImpMethod='min'",
        "AggMethod='max'",
        "DefuzzMethod='centroid'",
    ):
        assert line in text


SMALL = """\
[System]
Name='small'
Type='mamdani'
NumInputs=1
NumOutputs=1
NumRules=1
AndMethod='min'
OrMethod='max'
ImpMethod='min'
AggMethod='max'
DefuzzMethod='centroid'
[Input1]
Name='heat'
Range=[0 1]
NumMFs=1
MF1='hot':'trimf',[0 1 1]
[Output1]
Name='speed'
Range=[0 1]
NumMFs=1
MF1='slow':'trimf',[0 0 1]
[Rules]
1, -1 (1) : 1
"""
