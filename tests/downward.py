"""Fast Downward as an oracle: what a visit costs at least, by the PDDL that is exported."""

from __future__ import annotations

import re
from importlib.util import find_spec

import pytest

from comity_domain import NoPlan, VisitRequest, plan_pddl
from comity_domain.custom.engines.fast_downward import Search, search

PROOF = Search(
    "iterated([eager_wastar([ff()],w=1),eager_wastar([lmcut()],w=2),astar(lmcut())],pass_bound=false)"
)
"""Two quick searches, whose plans bound nothing, and then the proof.

A* with LM-cut expands hundreds of states where blind A* expands 150 000 (12 people, three sides each): every
person still to be visited is a landmark with a least price.
"""

needs_fast_downward = pytest.mark.skipif(
    find_spec("up_fast_downward") is None, reason="Fast Downward is not installed: comity[fast-downward]"
)


def cost_by_fast_downward(request: VisitRequest, *, time_limit_s: float = 60.0) -> int | None:
    """The cost of a cheapest plan, deadlines not counted, in cm; None where there is none."""
    try:
        found = search(*plan_pddl(request), time_limit_s=time_limit_s, search_for=PROOF)
    except NoPlan:
        return None
    assert found.finished
    return min(map(int, re.findall(r"^; cost = (\d+) ", found.text, re.MULTILINE)))
