"""The chain of causes, as far as it is known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from comity_executor.nodes.cause import Account, Provenance, chain
from comity_fis.inference.value import FiredRule
from comity_fis.rules.rule import Is, Rule


def concluding(gesture: str, strength: float) -> FiredRule:
    rule = Rule(
        number=1,
        text=f"if gender is female then greeting_gesture is {gesture}",
        antecedent=Is("gender", "female"),
        consequents=(Is("greeting_gesture", gesture),),
        sources=(),
        evidence="design",
    )
    return FiredRule(rule, strength)


def kinds(causes) -> list[str]:
    return [cause.kind for cause in causes]


def grounds_of(episode: Callable) -> Provenance:
    visits = episode()
    return Provenance(visits.plan.steps[1], visits.values["johanna"])


def test_for_a_word_the_rule_that_concludes_it_is_named(episode) -> None:
    """Not the strongest one, which may conclude another word."""
    provenance = grounds_of(episode)
    fired = (concluding("bow", 0.9), concluding("nod", 0.6))
    nod = replace(provenance.values["greeting_gesture"], fired=fired)
    values = replace(provenance.values, parameters={**provenance.values.parameters, "greeting_gesture": nod})
    causes = chain("c", Account("a", parameter="greeting_gesture"), Provenance(provenance.step, values))
    assert [cause.text for cause in causes if cause.kind == "rule"] == [fired[1].rule.text]
    assert causes[-1].text == "gender female"


def test_for_a_number_rules_of_equal_strength_that_say_different_things_are_all_named(episode) -> None:
    provenance = grounds_of(episode)
    said = [("bow", 0.9), ("nod", 0.9), ("bow", 0.9), ("wave", 0.3)]
    fired = tuple(concluding(*one) for one in said)
    number = replace(provenance.values["greeting_gesture"], value=0.5, fired=fired)
    values = replace(provenance.values, parameters={"greeting_gesture": number})
    causes = chain("c", Account("a", parameter="greeting_gesture"), Provenance(provenance.step, values))
    assert [cause.text for cause in causes if cause.kind == "rule"] == [one.rule.text for one in fired[:2]]


def test_a_rule_that_rests_on_something_disclosed_goes_before_a_stronger_one_that_does_not(episode) -> None:
    provenance = grounds_of(episode)
    only_possible = concluding("nod", 1.0).rule
    only_possible = replace(
        only_possible, text="if age is old then greeting_gesture is nod", antecedent=Is("age", "old")
    )
    fired = (FiredRule(only_possible, 1.0), concluding("nod", 0.6))
    nod = replace(provenance.values["greeting_gesture"], fired=fired)
    values = replace(provenance.values, parameters={**provenance.values.parameters, "greeting_gesture": nod})
    causes = chain("c", Account("a", parameter="greeting_gesture"), Provenance(provenance.step, values))
    assert [cause.text for cause in causes if cause.kind == "rule"] == [fired[1].rule.text]


def test_a_value_that_no_rule_gave_ends_the_chain_at_the_parameter(episode) -> None:
    causes = chain("c", Account("a", parameter="greeting_gesture"), grounds_of(episode))
    assert kinds(causes) == ["reading", "condition", "step", "parameter"]


def test_what_depends_on_no_parameter_ends_at_the_step(episode) -> None:
    assert kinds(chain("c", Account("a"), grounds_of(episode))) == ["reading", "condition", "step"]


def test_a_node_without_account_or_grounds_still_names_itself() -> None:
    assert kinds(chain("c", None, None)) == ["condition"]
