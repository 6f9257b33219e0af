"""People named by a scenario's goals, the outcomes of their visits, and the parameter values that counted."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from comity.specification.goals import greeted
from comity_fis import unknown_word

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.scenario import Scenario
    from comity_domain import Plan
    from comity_executor import Visit
    from comity_fis import Inference


def goals_of(scenario: Scenario) -> tuple[str, ...]:
    """People named by the goals, including those served before the start."""
    return tuple(goal for _, goal in greeted(scenario.goals))


def to_visit(episode: Episode) -> tuple[str, ...]:
    """People named by the goals, without those served before the start and dropped visits."""
    dropped = {visit.person for visit in episode.visits if visit.outcome == "skipped"}
    return tuple(name for name in episode.prepared.file.scenario.visited() if name not in dropped)


def approached(plan: Plan) -> tuple[str, ...]:
    """People at whom the robot is to dock, in the plan's order."""
    return tuple(step.person for step in plan.steps if step.action == "Reach_user")


def visit_of(visits: Iterable[Visit], person: str) -> Visit | None:
    """The visit of a person; None if the plan has none."""
    return next((visit for visit in visits if visit.person == person), None)


def spoken_to(visits: Iterable[Visit], person: str) -> str:
    """The person at whom the robot docks to greet this person: themselves, or one of their company."""
    visit = visit_of(visits, person)
    return (visit.together_with if visit else None) or person


def outcome_of(episode: Episode, person: str) -> str:
    """Outcome of one person's visit, in a word."""
    visit = visit_of(episode.visits, person)
    if visit is not None:
        return visit.outcome
    return "unreachable" if person in episode.prepared.asked.unreachable else "not_asked"


def judged_s(episode: Episode, person: str, parameter: str) -> float:
    """Time at which a person's parameter counts [s]: the value with which their visit was executed.

    A behaviour parameter, such as the distance, counts as at the last docking. An action parameter, such as
    the gesture, counts as at the greeting. If only one of the two happened, both count as at that time.
    Infinite if neither did: then the final values count.
    """
    visit = visit_of(episode.visits, person)
    known = episode.prepared.rulebook.parameters.get(parameter)
    if visit is None:
        return math.inf
    times = (visit.greeted_s, visit.docked_s)
    if known is not None and known.kind == "behaviour":
        times = times[::-1]
    return next((time for time in times if time is not None), math.inf)


def values_when_judged(episode: Episode, person: str, parameter: str) -> Inference:
    """A person's parameters at the time when the given one counts."""
    return episode.values_at(person, judged_s(episode, person, parameter))


def require_goal(scenario: Scenario, *people: str) -> None:
    """Refuse a sentence about the visit of a person whom no goal names.

    Raises:
        InputError: if no goal names them.
    """
    goals = goals_of(scenario)
    for person in people:
        if person not in goals:
            raise unknown_word("somebody whom the goals name", person, goals)
