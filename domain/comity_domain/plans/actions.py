"""The actions of a plan by the names that `visit.pddl` gives them."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

REACH, RETURN = "Reach_user", "Return_to_user"
GREET, GREET_TOGETHER = "Greet_person", "Greet_company"
ANNOUNCED = "announced"
"""A parameter of the first two, where the person does not see: words tell them that the robot comes, has
stopped and leaves."""
TOLD: Mapping[str, str] = MappingProxyType({ANNOUNCED: "in words"})
"""The parameter with its value."""
FETCH, SAY, OFFER, WAIT, LEAVE = "Fetch", "Say", "Offer", "Wait", "Take_leave"
