"""The rulebook `evidence`: every finding with its grade, the weak and contested ones off."""

from dataclasses import replace
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import NumericParameter, Rulebook, load_rulebook
from comity_fis.audit.attributes import attributes
from comity_fis.audit.findings import held_to, shipped_findings

GRADES = {
    **dict.fromkeys(("dist-1", "dist-2", "dist-3", "dist-4", "dist-5", "dist-6"), "contested"),
    **dict.fromkeys(("dist-7", "dist-8", "dist-9"), "strong"),
    **{"dist-10": "moderate", "dir-1": "strong", "dir-2": "moderate", "dir-3": "weak"},
    **{"speed-1": "weak", "speed-2": "weak", "speed-3": "weak"},
    **{"greet-1": "moderate", "greet-2": "moderate", "greet-3": "weak", "greet-4": "weak"},
    **{"greet-5": "moderate", "bow-1": "weak", "bow-2": "weak", "vol-1": "weak", "vol-2": "moderate"},
    **{"rate-1": "weak", "gaze-1": "contested", "gaze-2": "weak", "gest-1": "weak", "gest-2": "weak"},
    **{"dirv-1": "weak", "dirv-2": "weak", "form-1": "weak", "form-2": "weak"},
    **{"rhet-1": "weak", "touch-1": "norm", "touch-2": "weak", "init-1": "weak", "init-2": "weak"},
}
"""Every finding that was collected, with its grade."""

PARAMETERS = {
    "conversational_distance": ("close", "medium", "far"),
    "approach_direction": ("front", "front_side", "side"),
    "approach_speed": ("slow", "medium", "fast"),
    "greeting_modality": ("verbal", "gestural", "both"),
    "greeting_gesture": ("wave", "nod", "bow", "bow_and_nod", "handshake", "palms_together"),
    "bow_extent": ("small", "medium", "deep"),
    "voice_volume": ("soft", "normal", "loud"),
    "speech_rate": ("slow", "normal"),
    "mutual_gaze": ("low", "medium", "high"),
    "gesture_amplitude": ("small", "medium", "large"),
    "verbal_directness": ("implicit", "explicit"),
    "formality": ("informal", "neutral", "formal"),
    "touch": ("none", "accept", "offer"),
    "initiative": ("wait", "offer", "act"),
}
"""The candidate parameters with their terms."""

NEVER = ("religion", "ethnicity", "education", "indulgence", "long_term_orientation", "masculinity")


@pytest.fixture(scope="session")
def evidence() -> Rulebook:
    return load_rulebook("evidence")


def test_every_finding_is_there_with_its_grade(evidence):
    assert {rule.finding: rule.evidence for rule in evidence.rules} == GRADES


def test_those_that_are_on_are_exactly_the_moderate_the_strong_and_the_norms(evidence):
    for rule in evidence.rules:
        assert rule.enabled == (rule.evidence in ("moderate", "strong", "norm")), rule.text


def test_every_parameter_is_there_with_its_terms_in_order(evidence):
    for name, terms in PARAMETERS.items():
        assert tuple(evidence.parameters[name].terms) == terms


def test_every_number_has_unit_ranges_and_spread_with_a_reason(evidence):
    for parameter in evidence.parameters.values():
        if isinstance(parameter, NumericParameter):
            assert parameter.unit
            assert parameter.spread > 0
            assert parameter.ask.covers(parameter.rules) or parameter.name == "approach_speed"
            assert parameter.safe.low > float("-inf") or parameter.safe.high < float("inf")
            for key in ("ranges", "terms", "neutral", "spread"):
                reason = parameter.reasons[key].lower()
                cited = any(character.isdigit() for character in reason)
                assert "design choice" in reason or cited or "by definition" in reason, (parameter.name, key)


def test_every_source_says_what_was_found_how_it_was_measured_and_what_was_read(evidence):
    used = {source.key for rule in evidence.rules for source in rule.sources}
    assert used == set(evidence.sources)
    for source in evidence.sources.values():
        assert source.found
        assert source.measured
        assert source.verified


def test_no_rule_reads_what_no_usable_finding_is_about(evidence):
    assert not set(NEVER) & set(evidence.variables)


def test_what_is_only_remembered_says_so(evidence):
    assert "from memory, unverified" in evidence.sources["brown1987"].verified
    assert "from memory, unverified" in evidence.sources["rehm2007"].verified


FACTS = st.fixed_dictionaries(
    {
        "individualism": st.none() | st.floats(0, 100),
        "culture": st.sampled_from([None, "JPN", "DEU", "IND", "GBR", "MEX", "ITA"]),
        "gender": st.sampled_from([None, "female", "male"]),
        "age": st.none() | st.floats(0, 117),
        "language": st.sampled_from([None, "eng", "ara", "swe"]),
        "familiarity": st.sampled_from([None, "close", "acquaintance", "stranger"]),
        "posture": st.sampled_from([None, "standing", "seated"]),
        "space": st.sampled_from([None, "open", "narrow"]),
        "robot_experience": st.sampled_from([None, "low", "high"]),
        "occasion": st.sampled_from([None, "informal", "formal"]),
        "touch_consent": st.sampled_from([None, "given", "withheld"]),
    }
)


@given(FACTS)
def test_whatever_is_disclosed_or_not_every_value_stands_and_is_safe(evidence, facts):
    for name, value in evidence.infer(facts).parameters.items():
        parameter = evidence.parameters[name]
        if isinstance(parameter, NumericParameter):
            assert value.number in parameter.ask
            assert value.number in parameter.safe
            assert sum(part.value for part in value.contributions) == pytest.approx(value.number)
        else:
            assert value.word in parameter.terms
    if facts["touch_consent"] != "given":
        assert evidence.infer(facts)["touch"].word == "none"
        assert evidence.infer(facts)["greeting_gesture"].word != "handshake"


@given(FACTS)
def test_a_stranger_is_never_met_closer_than_an_acquaintance_nor_that_one_than_a_friend(evidence, facts):
    close, acquaintance, stranger = (
        evidence.infer({**facts, "familiarity": familiarity})["conversational_distance"].number
        for familiarity in ("close", "acquaintance", "stranger")
    )
    assert close <= acquaintance + 1e-9 <= stranger + 2e-9


@given(FACTS)
def test_experience_with_robots_never_moves_one_farther_off(evidence, facts):
    used, new = (
        evidence.infer({**facts, "robot_experience": experience})["conversational_distance"].number
        for experience in ("high", "low")
    )
    assert used <= new + 1e-9


@given(FACTS)
def test_individualism_and_gender_change_no_distance_while_their_rules_are_off(evidence, facts):
    others = {**facts, "individualism": None, "gender": None, "culture": None, "age": None}
    assert (
        evidence.infer(facts)["conversational_distance"].number
        == evidence.infer(others)["conversational_distance"].number
    )


def test_rules_that_are_off_would_change_something_were_they_on(evidence):
    """Each of them is a rule that works, and is not kept out by a slip."""
    for rule in evidence.rules:
        if rule.enabled:
            continue
        on = evidence.with_rule(rule.number, replace(rule, enabled=True))
        assert any(_differs(evidence, on, facts, rule) for facts in _everybody()), rule.text


def _differs(before, after, facts, rule):
    names = [is_.name for is_ in rule.consequents]
    return any(
        before.infer(facts)[name].contributions != after.infer(facts)[name].contributions for name in names
    )


def _everybody():
    shared = {"power_distance": 90, "uncertainty_avoidance": 90, "age": 80, "familiarity": "close"}
    shared |= {"robot_experience": "low", "language": "ara"}
    for individualism, culture, gender in product(
        (20, 80), ("JPN", "IND", "GBR", "MEX", "ITA"), ("female", "male")
    ):
        facts = {"individualism": individualism, "culture": culture, "gender": gender}
        yield {**shared, **facts, "touch_consent": "given", "language_command": "not_native"}


def test_findings_that_speak_against_the_paper_stand_beside_those_for_it_and_an_audit_counts_them():
    book = load_rulebook("bruno2017")
    held = held_to(book, shipped_findings(), attributes(book))
    on_gender = [row for row in held.rows if row.finding.larger.attribute == "gender"]
    against = {row.finding.key for row in on_gender if row.finding.larger.value == "female"}
    assert against == {"takayama2009", "sorokowska2017"}
    assert {row.verdict for row in on_gender if row.finding.key in against} == {"contradicting"}
    assert {"female", "male"} in [{one.value, other.value} for one, other in held.disputed]


def test_individualism_has_its_counter_evidence_wherever_a_distance_follows_from_it():
    for name, count in {"bruno2017-case1": 2, "bruno2017-case2": 4, "bruno2017": 4, "evidence": 6}.items():
        rules = [
            rule
            for rule in load_rulebook(name).rules
            if "individualism" in rule.reads and rule.consequents[0].name == "conversational_distance"
        ]
        assert len(rules) == count
        assert all("Minkov" in rule.counter_evidence for rule in rules)
