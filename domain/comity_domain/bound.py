"""What no plan can cost less than, when a search was cut off before it proved an optimum."""

from __future__ import annotations

from collections.abc import Mapping

from comity_domain.options import Options


def lower_bound(options: Options) -> int:
    """Everybody is reached by their cheapest leg and greeted in the cheapest way; what is offered is fetched.

    A company counts once, as it may be greeted at once. The order, and so every priority, is left out.
    """
    return sum(least_costs(options).values())


def least_costs(options: Options) -> Mapping[str, int]:
    """By person, in cm, what they add at least to a plan.

    Of a company only the first member counts, with the cheapest leg to and the cheapest greeting of any.
    """
    legs: dict[str, int] = {}
    for (_, end), cost in options.legs.items():
        legs[end.place] = min(cost, legs.get(end.place, cost))
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
