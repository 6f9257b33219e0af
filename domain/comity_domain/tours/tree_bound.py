"""Lower bound on the cost of all legs of a plan in any order: minimum spanning trees.

A tour without its last leg is a spanning tree, so no tour costs less than the minimum 1-tree. Each person's
price counts twice in a tour, and once per edge in a tree, so that prices can push the tree towards a tour:
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
"""Rounds of price updates; more of them gain next to nothing."""
FAR = 1e9
"""Cost of a leg without a route [cm]."""


def least_legs(options: Options) -> int:
    """Minimum cost of the legs to everybody [cm], with the preference cost of the sides."""
    groups = _groups(options)
    if len(groups) < 2:
        return 0
    # Prices are valid for tours only: if a group may be reached more than once, there are none.
    rounds = 1 if options.companies else ROUNDS
    return max(0, math.ceil(_one_tree_bound(_between(options, groups), rounds) - 1e-6))


def _groups(options: Options) -> list[frozenset[str]]:
    """Sets of people that one leg can reach: a group, or a single person."""
    companies = [frozenset(company.members) for company in options.companies.values()]
    members = frozenset[str]().union(*companies)
    return [*companies, *(frozenset([name]) for name in options.people if name not in members)]


def _between(options: Options, groups: list[frozenset[str]]) -> Costs:
    """Minimum cost between any two groups in either direction; the start is first, the free end last.

    Half of a side's preference cost counts on the leg to it and half on the leg from it: costs are symmetric.
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
            # An offered object may be fetched on the way; the leg to its location is counted separately.
            for origin in range(len(groups) + 1):
                _lower(costs, origin, goal, leg - dislikes[end] / 2)
    np.fill_diagonal(costs, FAR)
    return costs


def _lower(costs: Costs, one: int, other: int, way: float) -> None:
    costs[one, other] = costs[other, one] = min(costs[one, other], way)


def _one_tree_bound(costs: Costs, rounds: int) -> float:
    """The best bound of all rounds, with prices updated by the degrees of the 1-tree.

    Args:
        costs: Costs between groups, shape (n, n); the last node joins the tour's ends.
        rounds: Number of rounds; the first is without prices.
    """
    import numpy as np

    # Subgradient ascent on the Lagrangian dual (Held and Karp 1971). In a tour every node has degree 2, in a
    # minimum tree not necessarily. Prices on nodes of higher degree and rewards on nodes of degree 1 keep the
    # order of tours, since each tour pays the same, and push the tree towards a tour. Every round gives a
    # valid bound, so the best one is kept; the steps shrink geometrically so that the rounds converge.
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
    """The minimum 1-tree: the cheapest tree over all nodes but the last, plus its two edges; all degrees."""
    import numpy as np
    from scipy.sparse.csgraph import minimum_spanning_tree

    inner = costs[:-1, :-1]
    lift = 1.0 - float(inner.min())  # an edge of cost 0 would count as missing
    tree = minimum_spanning_tree(np.triu(inner + lift, 1)).tocoo()
    ends = np.array([0, 1 + int(np.argmin(costs[-1, 1:-1]))])
    joined = np.concatenate([tree.row, tree.col, ends, [len(inner)] * 2])
    total = float(tree.data.sum()) - lift * tree.nnz + float(costs[-1, ends].sum())
    return total, np.bincount(joined, minlength=len(costs))
