"""Why a step is done this way: the desirability, the rule behind it, and what other ways would cost."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from comity_domain.agenda import Offer
from comity_domain.evidence import because
from comity_domain.greeting import NO_GESTURE, Greeting
from comity_domain.options import Options, PersonOptions
from comity_domain.plan import Alternative, RuledOut, Why
from comity_domain.request import Spot
from comity_domain.side import Side
from comity_domain.tour import Visit, greeting_cost, tour_cost


def why_this_side(index: int, visits: Sequence[Visit], options: Options) -> Why:
    """Why the visit at this index is on its side; with another one, the next leg changes, too."""
    visit = visits[index]
    tours = {
        spot: [*visits[:index], replace(visit, spot=spot), *visits[index + 1 :]]
        for spot in options.people[visit.spot.place].spots()
    }
    return _why_here(visit.spot, tours, options)


def why_this_return(offer: Offer, trip: int, index: int, visits: Sequence[Visit], options: Options) -> Why:
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


def _why_here(here: Spot, tours: Mapping[Spot, Sequence[Visit]], options: Options) -> Why:
    """Why the robot stands here and not on another side.

    Args:
        here: The spot.
        tours: By each spot before the same person, the tour with it, all else being alike.
        options: What the person accepts.
    """
    person, cost = options.people[here.place], tour_cost(tours[here], options)
    alternatives = [
        Alternative(
            (options.robot, person.name, spot.side), other - cost, _side(person.sides[spot.side], person)
        )
        for spot, tour in tours.items()
        if spot != here and cost is not None and (other := tour_cost(tour, options)) is not None
    ]
    alternatives.sort(key=lambda alternative: alternative.extra_cost)
    ruled_out = tuple(
        RuledOut((options.robot, person.name, side), "no free place there that a route leads to")
        for side in person.blocked_sides
    )
    reason = f"{here.side}: {_side(person.sides[here.side], person)}"
    text = f"{reason}; {_runner_up(alternatives, 'side', 2)}"
    return Why(text, tuple(alternatives), ruled_out, chosen=reason)


def why_this_greeting(visit: Visit, options: Options, cost: int) -> Why:
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
    parts = [f"{chosen.words}: {_greeting(chosen, person)}", *_waited(cost - priced[chosen])]
    parts.append(_runner_up(alternatives, "greeting", 2))
    return Why("; ".join(parts), alternatives, _out(ruled_out, start), chosen=parts[0])


def why_this_farewell(visit: Visit, options: Options) -> Why:
    """Why leave is taken this way: as a person would be greeted, with what is in the hands by then."""
    person = options.people[visit.spot.place]
    chosen = next(greeting for greeting in person.greetings if greeting.way == visit.farewell)
    start = (options.robot, person.name)
    alternatives = _others(chosen, person.greetings, start, person)
    parts = (
        f"{chosen.words}: {_greeting(chosen, person)}",
        _runner_up(alternatives, "farewell", 2),
        "that the rules of greeting hold for a farewell is a design choice without a source",
    )
    return Why("; ".join(parts), alternatives, _out(person.ruled_out, start), chosen=parts[0])


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


def why_this_company(visit: Visit, options: Options, cost: int) -> Why:
    """Why a company is greeted in this way at once."""
    assert visit.company is not None
    assert visit.way is not None  # a company is greeted, whole
    company, reached = options.companies[visit.company], visit.spot.place
    own = greeting_cost(visit, options)
    start = (options.robot, reached, company.name)
    alternatives = [
        Alternative(
            (*start, *way), company.cost(visit.spot, way) - own, _all_of_them(way, company.members, options)
        )
        for way in company.greetings
        if way != visit.way
    ]
    alternatives.sort(key=lambda alternative: alternative.extra_cost)
    accepted = _all_of_them(visit.way, company.members, options)
    parts = [f"one greeting for {', '.join(company.members)}, {_way(visit.way)}: {accepted}"]
    if near := company.spots[visit.spot]:
        parts.append(f"{near} cm for standing nearer to the others than suits them")
    parts += [*_waited(cost - own), _runner_up(alternatives, "greeting", 3)]
    return Why("; ".join(parts), tuple(alternatives), _not_for_all(visit, options), chosen=parts[0])


def _not_for_all(visit: Visit, options: Options) -> tuple[RuledOut, ...]:
    """Greetings that suit some of a company and are out for another one."""
    assert visit.company is not None
    company = options.companies[visit.company]
    against: dict[tuple[str, str], str] = {}
    for name in company.members:
        person = options.people[name]
        open_to_them = {greeting.way for greeting in person.greetings}
        for greeting, reason in person.ruled_out.items():
            against.setdefault(greeting.way, f"{name}: {reason}")
        for other in company.members:
            for greeting in options.people[other].greetings:
                if greeting.way not in open_to_them:
                    against.setdefault(greeting.way, f"{name} does not accept it")
    start = (options.robot, visit.spot.place, company.name)
    return tuple(RuledOut((*start, *way), reason) for way, reason in against.items())


def _side(side: Side, person: PersonOptions) -> str:
    liked = f"desirability {side.desirability:.2f} for the approach direction"
    return f"{liked} ({because(person.values, 'approach_direction')})"


def _greeting(greeting: Greeting, person: PersonOptions) -> str:
    reasons = [f"modality: {because(person.values, 'greeting_modality', greeting.modality)}"]
    if greeting.gesture != NO_GESTURE:
        reasons.append(f"gesture: {because(person.values, 'greeting_gesture', greeting.gesture)}")
    return f"desirability {greeting.desirability:.2f} as a greeting ({'; '.join(reasons)})"


def _all_of_them(way: tuple[str, str], members: Sequence[str], options: Options) -> str:
    """What a greeting is worth to whom of a company it suits least."""
    worth = {
        name: greeting.desirability
        for name in members
        for greeting in options.people[name].greetings
        if greeting.way == way
    }
    least = min(worth, key=lambda name: worth[name])
    return f"desirability {worth[least]:.2f} for {least}, whom it suits least"


def _waited(cost: int) -> list[str]:
    return [f"{cost} cm because others are greeted before"] if cost else []


def _way(words: Sequence[str]) -> str:
    return " with ".join(word for word in words if word != NO_GESTURE)


def _runner_up(alternatives: Sequence[Alternative], what: str, choices_from: int) -> str:
    """What the cheapest alternative would have cost."""
    if not alternatives:
        return f"no other {what} is possible"
    first = alternatives[0]
    name = _way(first.arguments[choices_from:])
    if first.extra_cost == 0:
        return f"{name} would cost the same"
    return f"{name} would cost {first.extra_cost} cm more"
