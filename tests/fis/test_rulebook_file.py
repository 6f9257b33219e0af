"""Every mistake in a rulebook file is refused with its line."""

import pytest

from comity_fis import InputError, load_rulebook, rulebook_schema


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("gesture is wave", "gesture is wawe", "Did you mean 'wave'?"),
        ("mood is lively then distance", "mod is lively then distance", "Did you mean 'mood'?"),
        ("then gesture is wave", "then gestrue is wave", "Did you mean 'gesture'?"),
        (
            "requires: {hug: touch_consent is given}",
            "requires: {hug: touch_consent is gven}",
            "Did you mean 'given'?",
        ),
        (
            "requires: {hug: touch_consent is given}",
            "requires: {hugg: touch_consent is given}",
            "Did you mean 'hug'?",
        ),
        ("cold: {trapezoid: [0, 0, 2, 6]}", "cold: {trapezoid: [0, 6, 2, 0]}", "never decrease"),
        ("cold: {trapezoid: [0, 0, 2, 6]}", "cold: {trapezoid: [0, 0, 2, .nan]}", "finite"),
        ("cold: {trapezoid: [0, 0, 2, 6]}", "cold: {trapezoid: [0, 0, 2]}", "trapezoid"),
        ("cold: {trapezoid: [0, 0, 2, 6]}", "cold: {trapezoid: [0, 0, 2, '6']}", "number"),
        ("cold: {trapezoid: [0, 0, 2, 6]}", "cold: {trapezium: [0, 0, 2, 6]}", "Did you mean 'trapezoid'?"),
        ("cold: {trapezoid: [0, 0, 2, 6]}", "cold: {}", "one shape"),
        ("range: [0, 10]", "range: [10, 0]", "first end is below"),
        ("level: interval", "level: ordinal", "coercion"),
        ("level: interval", "level: intervall", "level"),
        ("    neutral: 3.5", "    neutral: 4.5", "neutral value in the rules' range"),
        ("    spread: 0.5", "    spread: 0", "spread above 0"),
        ("    ask: [0, 8]", "    ask: [4, 8]", "ask range with the neutral value"),
        ("    safe: {at_most: 6}", "    safe: {at_most: 3}", "safe range that covers"),
        ("    neutral: nod", "    neutral: hug", "always permitted"),
        ("    neutral: nod", "    neutral: bow", "always permitted"),
        ("categories: [wave, nod, hug]", "categories: [wave, nod, hug, wave]", "each only once"),
        ("    kind: situation", "    kind: weather", "culture"),
        ("name: small", "nam: small", "Did you mean 'name'?"),
        ("schema_version: 1", "schema_version: 2", "schema_version"),
        ("sources: [book]", "sources: [bok]", "Did you mean 'book'?"),
        ("sources: [book]", "sources: []", "sources"),
        ("evidence: weak", "evidence: overwhelming", "evidence"),
        ("    unit: m\n", "    unit: m\n    colour: red\n", "known key"),
        ("  gesture:\n    kind", "  mood:\n    kind", "a name that no variable has"),
    ],
)
def test_a_mistake_is_placed_and_explained(write, old, new, message):
    path = write((old, new))
    with pytest.raises(InputError) as refusal:
        load_rulebook(path)
    assert message in str(refusal.value)
    assert refusal.value.where.file == str(path)
    # A complaint about how the parts of one thing fit together stands at that thing's first line.
    first, *others = (line for line in new.splitlines() if line.strip())
    lines = path.read_text().splitlines()
    assert refusal.value.where.line <= 1 + max(
        i for i, line in enumerate(lines) if (others or [first])[-1] in line
    )
    assert refusal.value.where.line > 1 or first.startswith("schema_version")


def test_a_misspelt_term_is_placed_to_the_column(write):
    path = write(("distance is middle,", "distance is midle,"))
    with pytest.raises(InputError) as refusal:
        load_rulebook(path)
    where = refusal.value.where
    line = path.read_text().splitlines()[where.line - 1]
    assert line[where.column - 1 :].startswith("midle")
    assert str(refusal.value).startswith(f"{path}:{where.line}:{where.column}: expected a term of distance")


@pytest.mark.parametrize(
    "rule",
    [
        "'if mood is lively then distance is midle'",
        '"if mood is lively then distance is midle"',
        ">-\n      if mood is lively\n      then distance is midle\n   ",
        "|\n      if mood is lively\n      then distance is midle\n   ",
        "if mood is lively\n      then distance is midle\n   ",
    ],
)
def test_the_column_is_right_however_the_rule_is_quoted_or_folded(write, rule):
    old = "- {rule: if mood is lively then distance is middle, sources: [book], evidence: weak}"
    path = write((old, f"- rule: {rule.rstrip()}\n    sources: [book]\n    evidence: weak"))
    with pytest.raises(InputError) as refusal:
        load_rulebook(path)
    where = refusal.value.where
    assert path.read_text().splitlines()[where.line - 1][where.column - 1 :].startswith("midle")


def test_a_rule_that_ends_too_soon_is_placed_behind_its_last_word(write):
    path = write(("if mood is lively then distance is middle", "if mood is lively then distance is"))
    with pytest.raises(InputError, match="got the end") as refusal:
        load_rulebook(path)
    where = refusal.value.where
    assert path.read_text().splitlines()[where.line - 1][: where.column - 1].endswith("distance is")


def test_a_name_that_stands_twice_is_refused_where_it_stands_again(write):
    with pytest.raises(InputError, match="'warm' again") as refusal:
        load_rulebook(write(("cold: {trapezoid: [0, 0, 2, 6]}", "warm: {trapezoid: [0, 0, 2, 6]}")))
    assert refusal.value.where.line == 13


def test_rules_are_needed(write):
    path = write()
    text = path.read_text()
    path.write_text(text[: text.index("rules:\n  -")] + "rules: []\n")
    with pytest.raises(InputError, match="rules"):
        load_rulebook(path)


def test_an_unknown_rulebook_is_refused_with_the_closest_name():
    with pytest.raises(InputError, match="Did you mean 'bruno2017-case1'"):
        load_rulebook("bruno2017-case_1")


def test_a_missing_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        load_rulebook(tmp_path / "none.yaml")


def test_a_rulebook_loads_from_a_path_too(write):
    path = write()
    assert load_rulebook(str(path)) == load_rulebook(path)


def test_the_schema_names_every_part():
    schema = rulebook_schema()
    assert set(schema["required"]) >= {
        "schema_version",
        "name",
        "sources",
        "variables",
        "parameters",
        "rules",
    }
    assert schema["additionalProperties"] is False
