"""Lower bound on the cost of waiting: the best order of greetings for that alone."""

from __future__ import annotations

from comity_domain.choices.options import Options


def least_waiting(options: Options) -> int:
    """Minimum cost of waiting for everybody with a priority [cm].

    Highest priority first. Members of a group do not wait for each other, as they may be greeted at once.
    """
    worth = {name: person.priority for name, person in options.people.items() if not person.greeted}
    others = {
        name: len(company.members) - 1 for company in options.companies.values() for name in company.members
    }
    order = sorted(worth, key=lambda name: -worth[name])
    saved = sum(worth[name] * others.get(name, 0) for name in order)
    return max(0, sum(worth[name] * before for before, name in enumerate(order)) - saved)
