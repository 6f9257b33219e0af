"""The actions of a plan by the names that `visit.pddl` gives them."""

REACH, RETURN = "Reach_user", "Return_to_user"
GREET, GREET_TOGETHER = "Greet_person", "Greet_company"
FETCH, SAY, OFFER, WAIT, LEAVE = "Fetch", "Say", "Offer", "Wait", "Take_leave"
