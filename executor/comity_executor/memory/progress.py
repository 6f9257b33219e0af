"""How far visits are that are not over, for planning what is left of them."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress

from comity_domain.plans.actions import OFFER
from comity_domain.plans.rest import VisitProgress
from comity_executor.memory.visit import TaskMemory
from comity_executor.memory.visit_context import VisitContext
from comity_executor.robots.carrier import HAND_OVER, Carrier
from comity_executor.robots.robot import Robot


def progress_of(meetings: Iterable[VisitContext], robot: Robot) -> dict[str, VisitProgress]:
    """By person, of all that have an agenda.

    Args:
        meetings: Of everybody; the last of each person counts.
        robot: Whose hands are looked at.
    """
    carried = None
    if isinstance(robot, Carrier):
        with suppress(Exception):  # what cannot be told is taken to be gone: it is fetched again
            carried = robot.carried()
    return {meeting.person: _progress(meeting, carried) for meeting in meetings if meeting.memory.agenda}


def _progress(meeting: VisitContext, carried: str | None) -> VisitProgress:
    left = [task for task in meeting.memory.agenda if task.done_s is None]
    offer = next((task for task in left if task.action == OFFER), None)
    greeted = meeting.is_greeted and meeting.is_attended
    return VisitProgress(greeted, len(left), offer is not None and _is_taken(offer, carried))


def _is_taken(offer: TaskMemory, carried: str | None) -> bool:
    return HAND_OVER in offer.performed or carried == offer.arguments[2]
