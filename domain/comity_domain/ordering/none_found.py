"""What is said where no order of visits was found."""

from __future__ import annotations

from comity_domain.choices.options import Options
from comity_domain.errors import NoPlan, PlanningFailed, out_of_time


def none_found(time_limit_s: float, *, in_time: bool, proven: bool = False) -> PlanningFailed:
    """That there is no order, or that none was found.

    Args:
        time_limit_s: The limit that the search had.
        in_time: Whether the search ended by itself.
        proven: Whether there is none.
    """
    remedy = "Name later deadlines, or look at the map for a person who is cut off from the others."
    if proven:
        return NoPlan("no plan reaches all goals", remedy=remedy)
    if not in_time:
        return out_of_time(time_limit_s)
    return PlanningFailed(
        "no order of visits was found that keeps every deadline and has a route to each next person, which "
        "does not prove that there is none",
        remedy=remedy,
    )


def require_free_hands(choices: Options) -> None:
    """Refuse a person who can only be greeted with the hands, where these are full."""
    if choices.bearer_of is None:
        return
    bearer = choices.people[choices.bearer_of]
    if not bearer.may_come_bringing:
        against = (bearer.ruled_out_bringing or {}).items()
        reasons = "; ".join(f"{greeting.words}: {reason}" for greeting, reason in against)
        raise PlanningFailed(
            f"no greeting of {bearer.name} is left with what they are offered in the hands ({reasons})",
            remedy="Let them be greeted in words, or with a nod, or hand over what the robot holds first.",
        )
