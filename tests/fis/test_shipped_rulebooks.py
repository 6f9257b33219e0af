"""What every shipped rulebook owes its reader."""

import pytest

from comity_fis import (
    NominalParameter,
    NumericParameter,
    individualism_scores,
    load_rulebook,
    shipped_rulebooks,
)

NAMES = shipped_rulebooks()
OF_THE_PAPER = [name for name in NAMES if name.startswith("bruno2017")]


def test_these_are_shipped():
    assert set(NAMES) >= {"bruno2017", "bruno2017-case1", "bruno2017-case2"}


@pytest.fixture(params=NAMES)
def rulebook(request):
    return load_rulebook(request.param)


def test_it_bears_its_files_name(rulebook):
    assert rulebook.name in NAMES


def test_every_rule_has_a_source_that_says_how_it_was_checked(rulebook):
    for rule in rulebook.rules:
        assert rule.source
        assert all(source.citation and source.verified for source in rule.sources)


def test_what_is_contested_or_moderate_names_its_counter_evidence(rulebook):
    for rule in rulebook.rules:
        assert rule.counter_evidence or rule.evidence in {"design", "strong", "norm"}, rule.text


def test_a_rule_without_a_publication_is_weak_or_a_design_choice(rulebook):
    for rule in rulebook.rules:
        if {source.key for source in rule.sources} == {"design"}:
            assert rule.evidence in {"weak", "design"}


def test_every_source_is_used(rulebook):
    assert {source.key for rule in rulebook.rules for source in rule.sources} == set(rulebook.sources)


@pytest.mark.parametrize("name", OF_THE_PAPER)
def test_reconstructed_shapes_are_labelled(name):
    distance = load_rulebook(name).parameters["conversational_distance"]
    assert distance.shapes == "reconstructed"
    assert "econstructed" in distance.reasons["terms"]
    assert distance.measured == "surface"


def test_our_choices_are_labelled(rulebook):
    for parameter in rulebook.parameters.values():
        assert _is_ours(parameter.reasons["neutral"])
        if isinstance(parameter, NumericParameter):
            assert _is_ours(parameter.reasons["spread"])


def _is_ours(reason):
    return "our choice" in reason.lower() or "design choice" in reason.lower()


@pytest.mark.parametrize("name", OF_THE_PAPER)
def test_the_coercion_of_the_scores_is_declared(name):
    variable = load_rulebook(name).variables["individualism"]
    assert str(variable.level) == "ordinal"
    assert str(variable.coercion.to) == "interval"
    assert variable.coercion.reason
    assert (variable.derived_from.fact, variable.derived_from.table.name) == ("culture", "individualism")


def test_a_rules_text_says_what_the_rule_is(rulebook):
    for number, rule in enumerate(rulebook.rules, 1):
        assert rule.number == number
        assert str(rule) == " ".join(rule.text.split())


def test_bruno2017_decides_every_parameter_of_the_robots_actions():
    rulebook = load_rulebook("bruno2017")
    assert list(rulebook.parameters) == [
        "conversational_distance",
        "approach_direction",
        "approach_speed",
        "greeting_modality",
        "greeting_gesture",
    ]
    assert all(rulebook.rules_for(parameter) for parameter in rulebook.parameters)


def test_bruno2017_reads_the_variables_in_this_order():
    assert list(load_rulebook("bruno2017").variables) == [
        "individualism",
        "gender",
        "age",
        "culture",
        "posture",
        "robot_experience",
        "formality",
        "touch_consent",
    ]


def test_any_key_of_the_table_is_a_culture():
    rulebook = load_rulebook("bruno2017")
    for row in individualism_scores():
        rulebook.infer({"culture": row.key, "individualism": row.value})


def test_contact_needs_consent():
    gesture = load_rulebook("bruno2017").parameters["greeting_gesture"]
    assert isinstance(gesture, NominalParameter)
    guards = {category.name: str(category.requires) for category in gesture.categories if category.requires}
    assert guards == {"handshake": "touch_consent is given"}


@pytest.mark.parametrize(
    ("inputs", "parameter", "expected"),
    [
        ({"posture": "standing"}, "approach_direction", pytest.approx(35 / 3)),
        ({"posture": "seated"}, "approach_direction", pytest.approx(45)),
        ({"culture": "JPN", "individualism": 46}, "greeting_gesture", "bow"),
        ({"culture": "JPN", "individualism": 46}, "greeting_modality", "both"),
        ({"culture": "IND", "individualism": 48}, "greeting_gesture", "palms_together"),
        ({"culture": "IND", "individualism": 48}, "greeting_modality", "both"),
        ({"culture": "GBR", "individualism": 89}, "greeting_gesture", "wave"),
        ({"culture": "GBR", "individualism": 89}, "greeting_modality", "both"),
        ({"culture": "Arab countries", "individualism": 38}, "greeting_gesture", "nod"),
        ({"culture": "Arab countries", "individualism": 38}, "greeting_modality", "both"),
        ({"culture": "DEU", "individualism": 67}, "greeting_modality", "verbal"),
        ({"culture": "DEU", "individualism": 67, "formality": "formal"}, "greeting_gesture", "wave"),
        (
            {"culture": "DEU", "individualism": 67, "formality": "formal", "touch_consent": "given"},
            "greeting_gesture",
            "handshake",
        ),
        (
            {"culture": "DEU", "individualism": 67, "formality": "informal", "touch_consent": "given"},
            "greeting_gesture",
            "wave",
        ),
    ],
)
def test_bruno2017_by_example(inputs, parameter, expected):
    assert load_rulebook("bruno2017").infer(inputs)[parameter].value == expected


def test_the_inexperienced_and_the_old_are_approached_more_slowly():
    rulebook = load_rulebook("bruno2017")
    at_ease = {"individualism": 67, "age": 30, "robot_experience": "high"}
    speed = rulebook.infer(at_ease)["approach_speed"].number
    assert rulebook.infer(at_ease | {"age": 80})["approach_speed"].number < speed
    assert rulebook.infer(at_ease | {"robot_experience": "low"})["approach_speed"].number < speed


@pytest.mark.parametrize(
    "fact", [{"age": 80.0}, {"robot_experience": "low"}, {"age": 80.0, "robot_experience": "low"}]
)
def test_telling_what_speaks_for_slow_never_makes_the_robot_faster(fact):
    rulebook = load_rulebook("bruno2017")
    assert rulebook.infer(fact)["approach_speed"].number <= rulebook.infer({})["approach_speed"].number
