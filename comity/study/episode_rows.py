"""Table rows of an episode: the measurements of each visit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from comity.parameters.used import used_of
from comity.people.profile import Declared
from comity.report.episodes.run import visit_answers
from comity.sharing.person import Filter, age_band, plain_words
from comity_fis import Interval
from comity_sim2d import of_episode, of_person

if TYPE_CHECKING:
    from collections.abc import Collection

    from comity.answers.run import VisitAnswer
    from comity.episode import Episode
    from comity.preparation import PlannedEpisode
    from comity.scenario import ComfortSpec
    from comity.sharing.extra import Extra

StudyRow = dict[str, Any]
"""Values by column; columns without a value are omitted."""
ERROR, NO_PLAN = "error", "no_plan"
"""Outcomes of visits in episodes that raised an exception, and in those without a plan."""


def episode_rows(
    episode: Episode, individual: str | None, *, filtered: Collection[Extra] | None
) -> Iterator[StudyRow]:
    """A row for each person whom the robot was to visit, in the order of the names.

    Args:
        episode: What happened.
        individual: The person replaced by an individual of the population; None without one.
        filtered: For an individual who may be a real person, facts disclosed besides age bands and closed
            vocabularies; None for an invented one, for whom all facts used by the rulebook are disclosed.
    """
    whole = {f"episode_{name}": value for name, value in of_episode(episode.metrics).items()}
    people = episode.prepared.file.scenario.people
    ended = {"episode_outcome": episode.outcome, "trace_sha256": episode.trace_sha256}
    for answer in sorted(visit_answers(episode), key=lambda one: one.person):
        is_filtered = filtered if answer.person == individual else None
        yield _without_gaps(
            {
                "person": answer.person,
                **facts_used(episode.prepared, answer.person, is_filtered),
                **_visit(answer),
                **_comfort(people[answer.person].comfort, answer.distance_actual_m),
                **of_person(episode.metrics, answer.person),
                **whole,
                **ended,
            }
        )


def failed_rows(persons: Collection[str], outcome: str, reason: str) -> Iterator[StudyRow]:
    """A row for each person who was to be visited in a failed episode.

    Args:
        persons: Their names.
        outcome: `error` or `no_plan`.
        reason: What happened.
    """
    for person in sorted(persons):
        told = {"error": reason} if outcome == ERROR else {"reason": reason}
        yield {"person": person, "outcome": outcome, **told}


def facts_used(prepared: PlannedEpisode, person: str, filtered: Collection[Extra] | None) -> dict[str, Any]:
    """The person's facts and wishes that the rulebook used, as columns."""
    used = used_of(Declared(prepared.profiles[person], None), prepared.rulebook, prepared.day).profile
    words = plain_words(prepared.rulebook)
    told: Mapping[str, Any]
    if filtered is not None:
        people = Filter(frozenset(filtered), words)
        told, wishes = people.facts(used, prepared.day), people.wishes(used)
        if "culture" in told:
            told = {**told, "culture": _shares(told["culture"])}
    else:
        told, wishes = used.facts(prepared.day), dict(used.settings)
        if cultures := used.cultures(prepared.day):
            told = {**told, "culture": _shares({one.words: one.weight for one in cultures})}
    facts = {f"fact_{name}": _plain(fact) for name, fact in told.items()}
    return facts | {f"wish_{name}": wish for name, wish in wishes.items()}


def _shares(cultures: Mapping[str, float]) -> str:
    """Cultures as text: `SWE`, or `EGY 0.33 + SWE 0.67`."""
    if len(cultures) == 1:
        return next(iter(cultures))
    return " + ".join(f"{name} {weight:.2f}" for name, weight in cultures.items())


def _plain(fact: Any) -> float | str:
    match fact:
        case Interval():
            return age_band(fact)
        case tuple() | list():
            return " + ".join(map(str, fact))
        case bool() | int() | float() | str():
            return fact
    return str(fact)


def _visit(answer: VisitAnswer) -> StudyRow:
    return {
        "outcome": answer.outcome,
        "reason": answer.reason,
        "distance_target_m": answer.distance_target_m,
        "distance_actual_m": answer.distance_actual_m,
        "centre_distance_actual_m": answer.centre_distance_actual_m,
        "bearing_target_deg": answer.bearing_target_deg,
        "bearing_actual_deg": answer.bearing_actual_deg,
        "approach_speed_target_m_s": answer.approach_speed_target_m_s,
        "approach_speed_actual_m_s": answer.approach_speed_actual_m_s,
        "greeting": " + ".join(answer.greeting) or None,
        "deviation_reason": answer.deviation_reason,
        "docked_s": answer.docked_at_s,
        "greeted_s": answer.greeted_s,
        "late_s": answer.late_s,
        "noticed": answer.noticed,
    }


def _comfort(comfort: ComfortSpec | None, distance_m: float | None) -> StudyRow:
    """The person's comfort interval, and the distance of the robot's stop from it [m]."""
    if comfort is None:
        return {}
    near_m, far_m = comfort.wants_m
    return {
        "comfort_near_m": near_m,
        "comfort_far_m": far_m,
        "comfort_gap_m": None if distance_m is None else comfort_gap_m(distance_m, near_m, far_m),
    }


def comfort_gap_m(distance_m: float, near_m: float, far_m: float) -> float:
    """Distance from an interval [m]: negative if too near, positive if too far, 0 inside."""
    return min(distance_m - near_m, 0.0) + max(distance_m - far_m, 0.0)


def _without_gaps(row: StudyRow) -> StudyRow:
    return {column: value for column, value in row.items() if value is not None}
