"""The rule behind a value, in one clause: the reason quoted by a plan."""

from __future__ import annotations

from comity_domain.problem.setting import is_setting
from comity_fis.explanation.disclosure import facts_first, kept_back, rests_on_facts
from comity_fis.inference.value import FiredRule, Inference
from comity_fis.listing import listed


def because(values: Inference, parameter: str, category: str | None = None) -> str:
    """The strongest rule behind a value; of a nominal one, the strongest that concludes the category.

    Rules that rest on disclosed facts come first; for others the text says that they are only possible.
    """
    value = values[parameter]
    if is_setting(value):
        return "asked for"
    if not value.fired:
        return value.note or f"{value.origin} value"
    speaking = [fired for fired in value.fired if concludes(fired, parameter, category)]
    if category is not None and not speaking and category != value.value:
        return "no rule speaks for it"
    rule = facts_first(speaking or value.fired, values.inputs)[0].rule
    hidden = listed(map(words, kept_back(rule, values.inputs)))
    said = f"rule {rule.number}: {words(rule.text)}"
    if not hidden:
        return said
    return f"{said}; {hidden} not disclosed" + (
        "" if rests_on_facts(rule, values.inputs) else ", only possible"
    )


def words(name: str) -> str:
    """Names as people say them."""
    return name.replace("_", " ")


def concludes(fired: FiredRule, parameter: str, category: str | None) -> bool:
    """Whether a rule speaks for a category of a parameter."""
    return any((is_.name, is_.term) == (parameter, category) for is_ in fired.rule.consequents)
