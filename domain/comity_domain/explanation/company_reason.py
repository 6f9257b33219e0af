"""Why a group is greeted at once in this way: what every other way to meet it would have cost."""

from __future__ import annotations

from collections.abc import Sequence

from comity_domain.choices.options import Options
from comity_domain.explanation.reason import in_words, liked_side, waited, wishes_at_rest
from comity_domain.explanation.together import MOST_ORDERS_OF, from_elsewhere, one_by_one
from comity_domain.plans.plan import Alternative, RuledOut, StepExplanation
from comity_domain.tours.lateness import late
from comity_domain.tours.tour import PlannedVisit, greeting_cost, tour_cost

ONE_BY_ONE = "one by one"
"""What stands in the place of a choice where nobody is greeted at once."""


def why_this_company(
    index: int, visits: Sequence[PlannedVisit], options: Options, cost: int
) -> StepExplanation:
    """Why a company is greeted in this way at once, and not otherwise, from elsewhere or one by one.

    Args:
        index: The visit.
        visits: All.
        options: What else there was.
        cost: What the greeting costs, others' turns before it included.
    """
    visit = visits[index]
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
    others, too_late = _otherwise(index, visits, options)
    alternatives = sorted((*alternatives, *others), key=lambda alternative: alternative.extra_cost)
    accepted = _all_of_them(visit.way, company.members, options)
    parts = [f"one greeting for {', '.join(company.members)}, {in_words(visit.way)}: {accepted}"]
    if near := company.spots[visit.spot]:
        parts.append(f"{near} cm for standing nearer to the others than suits them")
    parts += [f"{name}: {wish}" for name in company.members for wish in wishes_at_rest(options.people[name])]
    parts += [*waited(cost - own), _runner_up(alternatives, reached)]
    ruled_out = (*_not_for_all(visit, options), *too_late)
    return StepExplanation("; ".join(parts), tuple(alternatives), ruled_out, chosen=parts[0])


def _otherwise(
    index: int, visits: Sequence[PlannedVisit], options: Options
) -> tuple[list[Alternative], list[RuledOut]]:
    """What the whole plan would cost more with the group met otherwise; and what comes too late."""
    visit, planned = visits[index], tour_cost(visits, options)
    assert visit.company is not None
    tours: dict[tuple[str, ...], tuple[tuple[PlannedVisit, ...], str]] = {}
    for spot, tour in from_elsewhere(index, visits, options):
        person = options.people[spot.place]
        because = f"all at once from there: {liked_side(person.sides[spot.side], person)}"
        if near := options.companies[visit.company].spots[spot]:
            because += f"; {near} cm for standing nearer to the others than suits them"
        tours[options.robot, person.name, spot.side] = tour, because
    each = one_by_one(index, visits, options)
    if each is not None:
        count = len(each) - len(visits) + 1
        names = ", then ".join(one.spot.place for one in each[index : index + count])
        tours[options.robot, visit.spot.place, ONE_BY_ONE] = each, f"a greeting each for {names}"
    alternatives, too_late = [], []
    for arguments, (tour, because) in tours.items():
        cost, found = tour_cost(tour, options), late(tour, options)
        if found is not None:
            told = _in_any_order(str(found), visit.company, options) if tour is each else str(found)
            too_late.append(RuledOut(arguments, told))
        elif cost is not None and planned is not None:
            alternatives.append(Alternative(arguments, cost - planned, because))
    return alternatives, too_late


def _in_any_order(reason: str, company: str, options: Options) -> str:
    """Why a group cannot be met one by one, where the cheapest order has this against it."""
    tried = "" if len(options.companies[company].members) <= MOST_ORDERS_OF else " that was tried"
    return f"{reason}, in the cheapest order; no other one{tried} keeps all deadlines"


def _runner_up(alternatives: Sequence[Alternative], reached: str) -> str:
    """What the cheapest alternative would have cost, of whatever kind it is."""
    if not alternatives:
        return "nothing else is possible"
    first = alternatives[0]
    person, *choice = first.arguments[1:]
    if len(choice) > 1:
        name = in_words(choice[1:])
    elif choice == [ONE_BY_ONE]:
        name = "to greet them one by one"
    else:
        name = f"to greet them from the {choice[0]}" + (f" of {person}" if person != reached else "")
    price = f"{first.extra_cost} cm more" if first.extra_cost else "the same"
    return f"{name} would cost {price} with the rest as it is"


def _not_for_all(visit: PlannedVisit, options: Options) -> tuple[RuledOut, ...]:
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
