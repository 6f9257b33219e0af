import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import InputError
from comity_fis.rules.grammar import parse_guard, parse_rule
from comity_fis.rules.hedge import HEDGES
from comity_fis.rules.rule import And, Hedged, Is, Not, Or, Rule

INPUTS = {
    "individualism": ["LC1", "LC2"],
    "gender": ["female", "male"],
    "culture": ["JPN", "Arab countries", "not"],
    "nothing": ["is-on", "island"],
    "more": ["very", "more or less", "more", "extremely-so"],
    "what is not": ["it is"],
}
OUTPUTS = {"conversational_distance": ["close", "medium", "far"], "greeting_gesture": ["wave", "bow_and_nod"]}


def literals(terms):
    return st.sampled_from(sorted(terms)).flatmap(
        lambda name: st.builds(Is, st.just(name), st.sampled_from(terms[name]))
    )


conditions = st.recursive(
    literals(INPUTS) | st.builds(Hedged, st.sampled_from(sorted(HEDGES)), literals(INPUTS)),
    lambda inner: (
        st.builds(Not, inner)
        | st.builds(And, st.lists(inner, min_size=2, max_size=3).map(tuple))
        | st.builds(Or, st.lists(inner, min_size=2, max_size=3).map(tuple))
    ),
    max_leaves=10,
)


def parse(text):
    return parse_rule(text, inputs=INPUTS, outputs=OUTPUTS)


@given(conditions, st.lists(literals(OUTPUTS), min_size=1, max_size=2).map(tuple))
def test_a_rule_survives_being_printed_and_parsed(antecedent, consequents):
    rule = Rule(
        number=1, text="", antecedent=antecedent, consequents=consequents, sources=(), evidence="design"
    )
    text = str(rule)
    if len(text) <= 1000:
        assert parse(text) == (antecedent, consequents)


@given(conditions)
def test_a_guard_survives_too(condition):
    if len(str(condition)) <= 1000:
        assert parse_guard(str(condition), inputs=INPUTS) == condition


def test_the_papers_words():
    antecedent, consequents = parse(
        "if individualism is LC1 and gender is female then conversational_distance is close"
    )
    assert antecedent == And((Is("individualism", "LC1"), Is("gender", "female")))
    assert consequents == (Is("conversational_distance", "close"),)


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("gender is not female", "not gender is female"),
        ("gender is not female", "NOT (gender IS female)"),
        (
            "gender is male or gender is female and culture is JPN",
            "gender is male or (gender is female and culture is JPN)",
        ),
        ("not gender is male and culture is JPN", "(not (gender is male)) and culture is JPN"),
        ("gender   is\n  male", "gender is male"),
        ("gender is VERY male", "gender is very male"),
        ("gender is not more\n or  less male", "not (gender is more or less male)"),
        ("more is 'very'", "'more' is \"very\""),
        ("culture is 'Arab countries'", 'culture is "Arab countries"'),
    ],
)
def test_two_ways_to_say_the_same(text, same):
    assert parse_guard(text, inputs=INPUTS) == parse_guard(same, inputs=INPUTS)


def test_and_binds_tighter_than_or():
    assert isinstance(parse_guard("gender is male or gender is female and culture is JPN", inputs=INPUTS), Or)


@pytest.mark.parametrize(
    ("text", "column", "message"),
    [
        ("if gender is femal then conversational_distance is far", 14, "Did you mean 'female'?"),
        ("if gendre is female then conversational_distance is far", 4, "Did you mean 'gender'?"),
        ("if gender is female then conversational_distance is mediun", 53, "Did you mean 'medium'?"),
        ("if gender is female then gender is male", 26, "expected a parameter"),
        ("if gender iz female then conversational_distance is far", 11, "expected 'is', got 'iz'"),
        ("if gender is female conversational_distance is far", 21, "'then'"),
        ("gender is female then conversational_distance is far", 1, "expected 'if'"),
        ("if then conversational_distance is far", 4, "got 'then'"),
        ("if gender is female then", 25, "got the end"),
        ("if (gender is female then conversational_distance is far", 22, "')'"),
        ("if gender is female then conversational_distance is not far", 53, "got 'not'"),
        ("if gender is female then conversational_distance is far!", 56, "got '!'"),
        ("if gender is verry female then conversational_distance is far", 14, "Did you mean 'very'?"),
        (
            "if gender is not extremly female then conversational_distance is far",
            18,
            "Did you mean 'extremely'?",
        ),
        ("if gender is very femal then conversational_distance is far", 19, "Did you mean 'female'?"),
        (
            "if gender is very very female then conversational_distance is far",
            19,
            "expected one hedge before a term, got 'very'",
        ),
        (
            "if gender is female then conversational_distance is very far",
            53,
            "expected a conclusion without a hedge",
        ),
        ("if gender = female then conversational_distance is far", 11, "got '='"),
        ("", 1, "expected 'if', got the end"),
    ],
)
def test_a_mistake_is_placed_and_explained(text, column, message):
    with pytest.raises(InputError) as refusal:
        parse(text)
    assert refusal.value.where.column == column
    assert message in str(refusal.value)


def test_a_rule_that_nobody_could_read_is_refused():
    with pytest.raises(InputError, match="1000 characters"):
        parse("if " + "not " * 300 + "gender is female then conversational_distance is far")
