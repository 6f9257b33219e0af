"""Why a step is done this way: the desirability, the rule behind it, and what other ways would cost."""

from __future__ import annotations

from collections.abc import Sequence

from comity_domain.greeting import NO_GESTURE, Greeting
from comity_domain.options import Options, PersonOptions
from comity_domain.plan import Alternative, Why
from comity_domain.request import Spot
from comity_domain.setting import is_setting
from comity_domain.tour import cost_of
from comity_fis.disclosure import facts_first, kept_back, rests_on_facts
from comity_fis.value import FiredRule, Inference


def why_this_side(index: int, spots: Sequence[Spot], options: Options) -> Why:
    """Why the visit at this index is on its side; with another one, the next leg changes, too."""
    here = spots[index]
    person = options.people[here.place]
    cost = cost_of(spots, options)
    alternatives = []
    for spot in person.spots():
        swapped = cost_of([*spots[:index], spot, *spots[index + 1 :]], options)
        if spot != here and cost is not None and swapped is not None:
            alternatives.append(Alternative((options.robot, spot.place, spot.side), swapped - cost))
    alternatives.sort(key=lambda alternative: alternative.extra_cost)
    side = person.sides[here.side]
    liked = f"desirability {side.desirability:.2f} for the approach direction"
    reason = f"{side.name}: {liked} ({_because(person.values, 'approach_direction')})"
    return Why(f"{reason}; {_runner_up(alternatives, 'side')}", tuple(alternatives))


def why_this_greeting(chosen: Greeting, person: PersonOptions, robot: str) -> Why:
    """Why a person is greeted this way."""
    cost = person.greetings[chosen]
    alternatives = [
        Alternative((robot, person.name, greeting.modality, greeting.gesture), other - cost)
        for greeting, other in person.greetings.items()
        if greeting != chosen
    ]
    alternatives.sort(key=lambda alternative: alternative.extra_cost)
    reasons = [f"modality: {_because(person.values, 'greeting_modality', chosen.modality)}"]
    if chosen.gesture != NO_GESTURE:
        reasons.append(f"gesture: {_because(person.values, 'greeting_gesture', chosen.gesture)}")
    reason = f"{chosen.words}: desirability {chosen.desirability:.2f} as a greeting ({'; '.join(reasons)})"
    return Why(f"{reason}; {_runner_up(alternatives, 'greeting')}", tuple(alternatives))


def _because(values: Inference, parameter: str, category: str | None = None) -> str:
    """The strongest rule behind a value; of a nominal one, the strongest that concludes the category.

    Rules that rest on something disclosed go first; of another one the words say that it is only possible.
    """
    value = values[parameter]
    if is_setting(value):
        return "asked for"
    if not value.fired:
        return value.note or f"{value.origin} value"
    speaking = [fired for fired in value.fired if _concludes(fired, parameter, category)]
    rule = facts_first(speaking or value.fired, values.inputs)[0].rule
    hidden = " and ".join(map(_words, kept_back(rule, values.inputs)))
    said = f"rule {rule.number}: {_words(rule.text)}"
    if not hidden:
        return said
    return f"{said}; {hidden} not disclosed" + (
        "" if rests_on_facts(rule, values.inputs) else ", only possible"
    )


def _words(name: str) -> str:
    """Names as people say them."""
    return name.replace("_", " ")


def _concludes(fired: FiredRule, parameter: str, category: str | None) -> bool:
    return any((is_.name, is_.term) == (parameter, category) for is_ in fired.rule.consequents)


def _runner_up(alternatives: Sequence[Alternative], what: str) -> str:
    """What the cheapest alternative would have cost."""
    if not alternatives:
        return f"no other {what} is possible"
    first = alternatives[0]
    name = " with ".join(word for word in first.arguments[2:] if word != NO_GESTURE)
    if first.extra_cost == 0:
        return f"{name} would cost the same"
    return f"{name} would cost {first.extra_cost} cm more"
