"""Lower bound on a plan's cost, for a search that was cut off before it proved an optimum."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from comity_domain.choices.options import Options
from comity_domain.problem.agenda import takes_leave
from comity_domain.tours.tree_bound import least_legs
from comity_domain.tours.waiting_bound import least_waiting


def lower_bound(options: Options) -> int:
    """The sum of the minimum travel, waiting and other costs, each computed independently.

    It neglects how these interact: high-priority people may be far away, deadlines restrict the order, and a
    visit's side is shared by the leg to it and the leg from it.
    """
    apart = sum(least_costs(options).values())
    if any(person.skip is not None for person in options.people.values()):
        return apart
    joined = least_legs(options) + sum(_least_acts(options)) + least_waiting(options)
    return max(apart, joined)


def _least_acts(options: Options) -> Iterator[int]:
    """Minimum cost of every greeting, farewell and fetch; one greeting per group."""
    together = {name for company in options.companies.values() for name in company.members}
    for company in options.companies.values():
        yield min(options.people[name].least_dislike() for name in company.members)
    to = _least_legs_to(options)
    for name, person in options.people.items():
        if name not in together:
            yield person.least_dislike()
        if takes_leave(person.agenda):
            yield min(person.greetings.values())
        yield from (to.get(at.place, 0) for at in person.fetched_at)


def _least_legs_to(options: Options) -> Mapping[str, int]:
    legs: dict[str, int] = {}
    for (_, end), cost in options.legs.items():
        legs[end.place] = min(cost, legs.get(end.place, cost))
    return legs


def least_costs(options: Options) -> Mapping[str, int]:
    """Minimum additional cost of each person in a plan [cm], by name.

    For a group only the first member counts, with the cheapest leg to, and greeting of, any member.
    """
    legs = _least_legs_to(options)
    least = {
        name: legs.get(name, 0)
        + person.least_dislike()
        + sum(legs.get(at.place, 0) for at in person.fetched_at)
        for name, person in options.people.items()
    }
    for company in options.companies.values():
        first, *others = company.members
        least[first] = min(legs.get(name, 0) for name in company.members) + min(
            min(options.people[name].greetings.values()) for name in company.members
        )
        least |= dict.fromkeys(others, 0)
    skips = {name: person.skip for name, person in options.people.items()}
    return {name: cost if (skip := skips[name]) is None else min(cost, skip) for name, cost in least.items()}
