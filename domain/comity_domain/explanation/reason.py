"""Why a step is done this way: the desirability, the rule behind it, and what other ways would cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from comity_domain.choices.greeting import BOTH, NO_GESTURE, VERBAL, Greeting, keeps_words
from comity_domain.choices.options import Options, PersonOptions
from comity_domain.choices.side import Side
from comity_domain.explanation.evidence import because
from comity_domain.plans.plan import Alternative, RuledOut, StepExplanation
from comity_domain.problem.agenda import Offer
from comity_domain.problem.spot import Spot
from comity_domain.tours.tour import PlannedVisit, tour_cost
from comity_fis.defuzzification.curve import Choice


def why_this_side(index: int, visits: Sequence[PlannedVisit], options: Options) -> StepExplanation:
    """Why the visit at this index is on its side; with another one, the next leg changes, too."""
    visit = visits[index]
    tours = {
        spot: [*visits[:index], replace(visit, spot=spot), *visits[index + 1 :]]
        for spot in options.people[visit.spot.place].spots()
    }
    return _why_here(visit.spot, tours, options)


def why_this_return(
    offer: Offer, trip: int, index: int, visits: Sequence[PlannedVisit], options: Options
) -> StepExplanation:
    """Why the robot comes back on this side.

    Args:
        offer: With what.
        trip: The number of the coming back in this visit, from 0.
        index: The visit.
        visits: All.
        options: What else there was.
    """
    visit = visits[index]
    tours = {
        spot: [
            *visits[:index],
            replace(visit, returns=(*visit.returns[:trip], spot, *visit.returns[trip + 1 :])),
            *visits[index + 1 :],
        ]
        for spot in options.people[visit.spot.place].spots()
    }
    why = _why_here(visit.returns[trip], tours, options)
    return replace(why, text=f"back with {offer.thing}; {why.text}")


def _why_here(here: Spot, tours: Mapping[Spot, Sequence[PlannedVisit]], options: Options) -> StepExplanation:
    """Why the robot stands here and not on another side.

    Args:
        here: The spot.
        tours: By each spot before the same person, the tour with it, all else being alike.
        options: What the person accepts.
    """
    person, cost = options.people[here.place], tour_cost(tours[here], options)
    alternatives = [
        Alternative(
            (options.robot, person.name, spot.side), other - cost, liked_side(person.sides[spot.side], person)
        )
        for spot, tour in tours.items()
        if spot != here and cost is not None and (other := tour_cost(tour, options)) is not None
    ]
    alternatives.sort(key=lambda alternative: alternative.extra_cost)
    ruled_out = tuple(
        RuledOut((options.robot, person.name, side), reason) for side, reason in person.blocked_sides.items()
    )
    reason = f"{here.side}: {liked_side(person.sides[here.side], person)}"
    text = f"{reason}; {runner_up(alternatives, 'side')}"
    return StepExplanation(text, tuple(alternatives), ruled_out, chosen=reason)


def why_this_greeting(visit: PlannedVisit, options: Options, cost: int) -> StepExplanation:
    """Why a person is greeted this way.

    Args:
        visit: The greeting.
        options: What else there was.
        cost: What it costs, others' turns before it included.
    """
    person = options.people[visit.spot.place]
    priced = person.priced(bringing=visit.bringing)
    ruled_out = (person.ruled_out_bringing or {}) if visit.bringing else person.ruled_out
    chosen = next(greeting for greeting in priced if greeting.way == visit.way)
    start = (options.robot, person.name)
    alternatives = _others(chosen, priced, start, person)
    parts = [f"{chosen.words}: {_greeting(chosen, person)}", *wishes_at_rest(person)]
    parts += waited(cost - priced[chosen])
    parts.append(runner_up(alternatives, "greeting"))
    return StepExplanation("; ".join(parts), alternatives, _out(ruled_out, start), chosen=parts[0])


def why_this_farewell(visit: PlannedVisit, options: Options) -> StepExplanation:
    """Why leave is taken this way: as a person would be greeted, with what is in the hands by then."""
    person = options.people[visit.spot.place]
    chosen = next(greeting for greeting in person.greetings if greeting.way == visit.farewell)
    start = (options.robot, person.name)
    alternatives = _others(chosen, person.greetings, start, person)
    parts = (
        f"{chosen.words}: {_greeting(chosen, person)}",
        *wishes_at_rest(person),
        runner_up(alternatives, "farewell"),
        "that the rules of greeting hold for a farewell is a design choice without a source",
    )
    return StepExplanation("; ".join(parts), alternatives, _out(person.ruled_out, start), chosen=parts[0])


def _others(
    chosen: Greeting, priced: Mapping[Greeting, int], start: tuple[str, ...], person: PersonOptions
) -> tuple[Alternative, ...]:
    """The other greetings, cheapest first."""
    others = [
        Alternative((*start, *greeting.way), price - priced[chosen], _greeting(greeting, person))
        for greeting, price in priced.items()
        if greeting != chosen
    ]
    return tuple(sorted(others, key=lambda alternative: alternative.extra_cost))


def _out(ruled_out: Mapping[Greeting, str], start: tuple[str, ...]) -> tuple[RuledOut, ...]:
    return tuple(RuledOut((*start, *greeting.way), reason) for greeting, reason in ruled_out.items())


def liked_side(side: Side, person: PersonOptions) -> str:
    """How much a side is liked, and from which rule."""
    liked = f"desirability {side.desirability:.2f} for the approach direction"
    return f"{liked} ({because(person.values, 'approach_direction')})"


def _greeting(greeting: Greeting, person: PersonOptions) -> str:
    words = _words_kept(person) if greeting.modality == BOTH and keeps_words(person.values) else None
    reasons = [f"modality: {words or because(person.values, 'greeting_modality', greeting.modality)}"]
    if greeting.gesture != NO_GESTURE:
        reasons.append(f"gesture: {because(person.values, 'greeting_gesture', greeting.gesture)}")
    return f"desirability {greeting.desirability:.2f} as a greeting ({'; '.join(reasons)})"


def _words_kept(person: PersonOptions) -> str | None:
    """Why words go with a gesture that was asked for, where the rules say words rather than both."""
    liked = person.values["greeting_modality"].desirability
    if not isinstance(liked, Choice) or liked(VERBAL) <= liked(BOTH):
        return None
    inferred = because(person.values, "greeting_modality", VERBAL)
    return f"{VERBAL} as inferred, with the gesture asked for; {inferred}"


def wishes_at_rest(person: PersonOptions) -> list[str]:
    """What of a greeting the person asked for and cannot have."""
    return [why for parameter, why in person.at_rest.items() if parameter.startswith("greeting_")]


def waited(cost: int) -> list[str]:
    """That others are greeted before, where it costs anything."""
    return [f"{cost} cm because others are greeted before"] if cost else []


def in_words(words: Sequence[str]) -> str:
    """A greeting's modality and gesture as a reader says them."""
    return " with ".join(word for word in words if word != NO_GESTURE)


def runner_up(alternatives: Sequence[Alternative], what: str) -> str:
    """What the cheapest alternative would have cost."""
    if not alternatives:
        return f"no other {what} is possible"
    first = alternatives[0]
    name = in_words(first.arguments[2:])
    if first.extra_cost == 0:
        return f"{name} would cost the same with the rest as it is"
    return f"{name} would cost {first.extra_cost} cm more with the rest as it is"
