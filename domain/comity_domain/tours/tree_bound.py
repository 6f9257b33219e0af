"""What all legs of a plan cost at least, whatever the order: by the cheapest trees that join everybody.

A tour without its last leg joins everybody, so that no tour costs less than the cheapest tree with one edge
more. Prices on people, which a tour pays twice each and a tree once per edge, draw the tree towards a tour:
Held and Karp 1970, "The traveling-salesman problem and minimum spanning trees", Operations Research 18(6).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from comity_domain.choices.options import Options
from comity_domain.problem.spot import START

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Costs = NDArray[np.float64]

ROUNDS = 200
"""Of raising and lowering the prices; more gain next to nothing."""
FAR = 1e9
"""In cm: no route."""


def least_legs(options: Options) -> int:
    """In cm, what the ways to everybody cost at least, with the dislike of the sides."""
    groups = _groups(options)
    if len(groups) < 2:
        return 0
    # Prices hold for tours only: where a company may be reached more than once, there are none.
    rounds = 1 if options.companies else ROUNDS
    return max(0, math.ceil(_one_tree_bound(_between(options, groups), rounds) - 1e-6))


def _groups(options: Options) -> list[frozenset[str]]:
    """Who may be reached by one leg: a company, or a person of their own."""
    companies = [frozenset(company.members) for company in options.companies.values()]
    members = frozenset[str]().union(*companies)
    return [*companies, *(frozenset([name]) for name in options.people if name not in members)]


def _between(options: Options, groups: list[frozenset[str]]) -> Costs:
    """The least cost between any two groups, either way; first the start, and last the end, which is free.

    Half of a dislike counts on the way there and half on the way on, so that the costs have no direction.
    """
    import numpy as np

    number = {name: i for i, group in enumerate(groups, 1) for name in group}
    costs = np.full((len(groups) + 2, len(groups) + 2), FAR)
    costs[:, -1] = costs[-1, :] = 0.0
    dislikes = options.side_dislikes
    kept = {name: set(options.people[name].fetched_at) for name in options.people}
    for (start, end), leg in options.legs.items():
        goal = number.get(end.place)
        if goal is None or end not in dislikes:
            continue
        if start == START or start.place in number:
            origin = 0 if start == START else number[start.place]
            way = leg - dislikes[end] / 2 + (0 if start == START else dislikes[start] / 2)
            _lower(costs, origin, goal, way)
        elif start in kept[end.place]:
            # What is offered may be fetched on the way; the way to where it is kept counts apart.
            for origin in range(len(groups) + 1):
                _lower(costs, origin, goal, leg - dislikes[end] / 2)
    np.fill_diagonal(costs, FAR)
    return costs


def _lower(costs: Costs, one: int, other: int, way: float) -> None:
    costs[one, other] = costs[other, one] = min(costs[one, other], way)


def _one_tree_bound(costs: Costs, rounds: int) -> float:
    """The best of the bounds while the prices follow how far the trees are from a tour.

    Args:
        costs: Between any two, shape (n, n); the last one joins the tour's ends.
        rounds: The first one is without prices.
    """
    import numpy as np

    # Subgradient ascent on the Lagrangian dual (Held and Karp 1971). A tour has two legs at every place,
    # the cheapest tree need not: a price on places with more legs than two, and a reward on those with one,
    # leave the order of tours as it is, since each tour pays the same, and push the tree towards a tour.
    # Every round gives a valid bound, so the best one stands, also where the rounds do not converge; the
    # steps shrink geometrically so that they do.
    prices, best, step = np.zeros(len(costs)), 0.0, 0.0
    for k in range(rounds):
        tree_cost, degrees = _one_tree(costs + prices[:, None] + prices)
        bound = tree_cost - 2.0 * float(prices.sum())
        best = max(best, bound)
        gap = degrees - 2
        if not gap.any():
            break
        step = step or max(bound, 1.0) / (2.0 * len(costs))
        prices = prices + step * 0.98**k * gap
    return best


def _one_tree(costs: Costs) -> tuple[float, NDArray[np.int64]]:
    """The cheapest tree over all but the last, which joins the first and the cheapest; and all degrees."""
    import numpy as np
    from scipy.sparse.csgraph import minimum_spanning_tree

    inner = costs[:-1, :-1]
    lift = 1.0 - float(inner.min())  # an edge of no cost would count as none
    tree = minimum_spanning_tree(np.triu(inner + lift, 1)).tocoo()
    ends = np.array([0, 1 + int(np.argmin(costs[-1, 1:-1]))])
    joined = np.concatenate([tree.row, tree.col, ends, [len(inner)] * 2])
    total = float(tree.data.sum()) - lift * tree.nnz + float(costs[-1, ends].sum())
    return total, np.bincount(joined, minlength=len(costs))
