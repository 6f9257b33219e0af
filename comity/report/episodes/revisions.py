"""Events during an episode, and the resulting plan updates, as in its account."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.run import DoorTurnAnswer, RevisionAnswer
from comity.report.plans.plan import steps_answer

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from comity_executor import PlanUpdate, TraceEvent
    from comity_sim2d import DoorTurn


def revision_answers(
    events: Iterable[TraceEvent], revisions: Iterable[PlanUpdate]
) -> Iterator[RevisionAnswer]:
    """Every plan update with the resulting plan.

    Args:
        events: Events of the trace.
        revisions: Plan updates, one for every event `rebound` or `replanned`, in order.
    """
    following = iter(revisions)
    for event in events:
        if event.status not in ("rebound", "replanned", "not_replanned"):
            continue
        because = tuple(cause.text for cause in event.because)
        if event.status == "not_replanned":
            yield RevisionAnswer(t=event.t, kind=event.status, because=because)
            continue
        revision = next(following)
        yield RevisionAnswer(
            t=event.t,
            kind=event.status,
            because=because,
            cost=revision.plan.cost,
            steps=steps_answer(revision.plan, revision.values),
            unserved=revision.unserved,
        )


def door_answers(turns: Iterable[DoorTurn]) -> Iterator[DoorTurnAnswer]:
    """All door movements."""
    for turn in turns:
        yield DoorTurnAnswer(t=turn.t, door=turn.door, open=turn.is_open)
