"""Whatever a user feeds it: an answer or a clear refusal, in bounded time and memory."""

import math

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_fis import InputError, Interval, load_rulebook
from comity_fis.defuzzification.closed_form import closed_form
from comity_fis.membership.function import Trapezoid
from comity_fis.rulebook.models import LARGEST, MAX_RULES
from comity_fis.rules.grammar import parse_rule

TERMS = {"a": ["b"]}
RULE = "  - {rule: if warmth is warm then distance is near, sources: [book], evidence: weak}\n"
LAST = "rules:\n"

on_files = settings(deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
words = st.sampled_from(
    [
        "[",
        "]",
        "{",
        "}",
        ":",
        "-",
        "~",
        "1e308",
        "-1e308",
        "1e-320",
        ".nan",
        ".inf",
        "1e400",
        "9" * 400,
        "&a",
        "*a",
        "!!python/object:os.system",
        "<<",
        "''",
        '"',
        "#",
        "|",
        ">",
        "\t",
        "\x00",
        "\ud7ff",
        "true",
        "0",
        "-0.0",
    ]
)


def placed(refusal):
    assert refusal.expected
    assert refusal.remedy
    assert refusal.where is not None


def loads_or_refuses(path):
    """A rulebook whose answers stay in their range, or a refusal that says what to do."""
    try:
        rulebook = load_rulebook(path)
    except InputError as refusal:
        placed(refusal)
        return
    for value in rulebook.infer({}).parameters.values():
        assert isinstance(value.value, str) or math.isfinite(value.value)


@on_files
@given(content=st.binary(max_size=200))
def test_random_bytes(tmp_path, content):
    (tmp_path / "x.yaml").write_bytes(content)
    loads_or_refuses(tmp_path / "x.yaml")


@on_files
@given(data=st.data())
def test_a_rulebook_with_a_word_exchanged(small, write, data):
    path = write()
    lines = path.read_text(encoding="utf-8").splitlines()
    row = data.draw(st.integers(0, len(lines) - 1))
    parts = lines[row].split(" ")
    place = data.draw(st.integers(0, len(parts) - 1))
    parts[place] = data.draw(words | st.text(max_size=8))
    lines[row] = " ".join(parts)
    path.write_text("\n".join(lines), encoding="utf-8", errors="replace")
    loads_or_refuses(path)


@given(
    st.floats(-LARGEST, LARGEST),
    st.floats(1e-300, LARGEST),
    st.lists(st.floats(0, 1), min_size=3, max_size=3),
)
def test_wherever_a_range_lies_and_however_narrow_it_is_the_centre_lies_in_it(low, width, strengths):
    high = low + width
    if not low < low + width / 4 < low + width / 2 < high:
        return
    quarter, half = low + width / 4, low + width / 2
    terms = {
        "near": Trapezoid(low, low, quarter, half),
        "middle": Trapezoid(quarter, half, half, high),
        "away": Trapezoid(half, high, high, high),
    }
    form = closed_form(terms, Interval(low, high))
    centre = form.centre(dict(zip(terms, strengths, strict=True)))
    assert centre is None or low <= centre <= high


@pytest.mark.parametrize("number", ["1e13", "-1e308", ".inf", "1e400", "9" * 400])
def test_huge_numbers_are_refused(write, number):
    with pytest.raises(InputError):
        load_rulebook(write(("range: [0, 10]", f"range: [0, {number}]")))


@given(st.text(alphabet="abis then or not (very)'\"\n", max_size=200))
def test_a_rule_of_random_words(text):
    try:
        parse_rule(f"if {text} then a is b", inputs=TERMS, outputs=TERMS)
    except InputError as refusal:
        placed(refusal)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("if " + "(" * 200 + "a is b" + ")" * 200 + " then a is b", "brackets"),
        ("if " + "not " * 200 + "a is b then a is b", "brackets and `not`s"),
        ("if " + "a " * 100_000, "characters"),
        ("if " + "(" * 1_000_000, "characters"),
    ],
)
def test_a_rule_that_nobody_could_read(text, message):
    with pytest.raises(InputError, match=message):
        parse_rule(text, inputs=TERMS, outputs=TERMS)


def test_as_deep_as_is_allowed_works():
    text = "if " + "(not " * 25 + "a is b" + ")" * 25 + " then a is b"
    antecedent, _ = parse_rule(text, inputs=TERMS, outputs=TERMS)
    assert str(antecedent).count("not") == 25


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ((LAST, LAST + RULE * (MAX_RULES + 1)), f"{MAX_RULES}|values"),
        ((LAST, LAST + RULE * 1_000_000), "bytes"),
        (
            (LAST, LAST + "  - {rule: " + "a " * 100_000 + ", sources: [book], evidence: weak}\n"),
            "characters",
        ),
        (("name: small", "name: " + "x" * 1_000_000), "80"),
        (("description: two", "description: " + "[" * 10_000 + "two"), "nesting"),
        (("[calm, lively]", "[calm, lively" + "".join(f", c{i}" for i in range(2000)) + "]"), "1000"),
        (("name: small", "a: &a [x]\nb: &b [*a, *a]\nc: &c [*b, *b]\nname: small"), "alias"),
    ],
)
def test_what_is_too_much_is_refused_soon(write, change, message):
    path = write(change)
    with pytest.raises(InputError, match=message):
        load_rulebook(path)


@pytest.mark.parametrize(
    "value", [10**400, -(10**400), 1e308, complex(1, 1), b"38", object(), [], {}, lambda x: x]
)
def test_what_is_no_input_is_refused(bruno2017, value):
    for name in ("individualism", "gender"):
        with pytest.raises(InputError):
            bruno2017.infer({name: value})
