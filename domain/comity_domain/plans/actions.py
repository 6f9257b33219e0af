"""The actions of a plan by the names that `visit.pddl` gives them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from comity_domain.problem.agenda import PLAIN

REACH, RETURN = "Reach_user", "Return_to_user"
GREET, GREET_TOGETHER = GREETINGS = "Greet_person", "Greet_company"
ANNOUNCED = "announced"
"""A parameter of the first two, where the person does not see: words tell them that the robot comes, has
stopped and leaves."""
TOLD: Mapping[str, str] = MappingProxyType({ANNOUNCED: "in words"})
"""The parameter with its value."""
FETCH, OFFER, LEAVE = "Fetch", "Offer", "Take_leave"
TASKS = (*(kind.action for kind in PLAIN), OFFER, LEAVE)
"""What is on agendas, once the person is greeted."""
SKIP = "Skip_visit"
"""Nothing to do: a visit that is dropped at its price."""
