"""Visits to one person, as JSON output and as a table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from datetime import timedelta
from typing import TYPE_CHECKING

from comity.answers.visits import MeetingAnswer, VisitsAnswer
from comity.report.text import number, table, unbroken
from comity_fis.learning.signals import SAID

if TYPE_CHECKING:
    from datetime import date

    from rich.console import RenderableType

    from comity.adaptation.visits import Acquaintance, VisitRecord
    from comity.scenario import ComfortSpec


def visits_answer(
    acquaintance: Acquaintance,
    comfort: ComfortSpec,
    meetings: Sequence[VisitRecord],
    *,
    rulebook: str,
    remembered_as: str | None,
    today: date,
) -> VisitsAnswer:
    """The answer with all visits."""
    liked_m = sum(comfort.wants_m) / 2
    days = [acquaintance.begin + timedelta(meeting.days) for meeting in meetings]
    return VisitsAnswer(
        profile=acquaintance.profile,
        rulebook=rulebook,
        seed=acquaintance.seed,
        every_days=acquaintance.every_days,
        likes_m=comfort.wants_m,
        method="episodes",
        known_before=len(acquaintance.known),
        remembered_as=remembered_as,
        days_to_come=sum(day > today for day in days),
        visits=tuple(_meeting(i, meeting, liked_m) for i, meeting in enumerate(meetings, start=1)),
    )


def _meeting(visit: int, meeting: VisitRecord, liked_m: float) -> MeetingAnswer:
    reached = meeting.reached_m
    return MeetingAnswer(
        visit=visit,
        days=meeting.days,
        distance_liked_m=liked_m,
        distance_model_m=meeting.model_m,
        interval_m=meeting.interval_m,
        distance_target_m=meeting.wanted_m,
        distance_actual_m=reached,
        error_m=None if reached is None else reached - liked_m,
        shown=meeting.shown,
        noticed=meeting.seen.signal if meeting.seen else None,
    )


def summary(answer: VisitsAnswer) -> Iterator[RenderableType]:
    """Target and actual distance, belief and reaction, visit by visit."""
    low, high = answer.likes_m
    yield (
        f"\n{answer.profile}, met {len(answer.visits)} times, every {answer.every_days} days; "
        "each visit an episode in the world"
    )
    yield (
        f"  The person is at ease from {low:.2f} to {high:.2f} m and likes {(low + high) / 2:.2f} m best. "
        "The robot is not told."
    )
    if answer.known_before:
        yield f"  It remembers {answer.known_before} earlier observations."
    yield table(
        [_row(visit) for visit in answer.visits],
        head=("visit", "day", "target", "actual", "error", "90 % interval", "the person"),
    )
    yield unbroken(_remembered(answer))


def _remembered(answer: VisitsAnswer) -> str:
    kept, later = answer.remembered_as, answer.days_to_come
    if kept is None:
        return "  Simulated: nothing of it is remembered."
    ahead = f" {later} of them on days that are still to come." if later else ""
    forget = f"`comity profile reset {kept} distance` forgets it."
    return f"  Remembered of {kept}, marked as simulated.{ahead} {forget}"


def _row(visit: MeetingAnswer) -> tuple[str, ...]:
    low, high = visit.interval_m
    off = "-" if visit.error_m is None else f"{100 * visit.error_m:+.0f} cm"
    return (
        str(visit.visit),
        str(visit.days),
        number(visit.distance_target_m, digits=2),
        number(visit.distance_actual_m, "m", digits=2),
        off,
        f"{low:.2f}..{high:.2f} m",
        _shown(visit),
    )


def _shown(visit: MeetingAnswer) -> str:
    """The reaction that the robot noticed, and the true one if different."""
    if visit.noticed is None:
        return "was not reached"
    truth = "" if visit.shown in (visit.noticed, None) else f" (in truth {SAID[visit.shown]})"
    return SAID[visit.noticed] + truth
