"""Why a visit failed: the last reason, and what kept the robot from the people in its way until then."""

from __future__ import annotations

from math import dist
from operator import attrgetter
from typing import TYPE_CHECKING

from comity.simulation.passages import KEEPS
from comity_executor.memory.visit import PROPER_OUTCOMES
from comity_executor.trees.passing import ASK
from comity_sim2d.metrics.intrusion import TICK_S
from comity_sim2d.pictures.drawing import pose_at

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from comity.episode import Episode
    from comity_executor import TraceEvent, Visit


def reason_of(visit: Visit, episode: Episode) -> str | None:
    """The reason of a visit that was not served; None of one that was.

    A time limit is followed by the people who were asked in vain before it, and any reason by who of those
    who were asked stood at the robot's goal, and by why it came no nearer to those who let it pass.
    """
    if not visit.failure or visit.outcome in PROPER_OUTCOMES:
        return visit.failure
    events = [event for event in episode.events if event.person == visit.person]
    asked = set(_asked(events, episode))
    kept = {
        one.about: one.text
        for one in episode.disturbances
        if one.kind == "passage" and one.about in asked and one.text.startswith(KEEPS)
    }
    return "; ".join([visit.failure, *_in_vain(events, visit.failure, asked, episode), *kept.values()])


def _in_vain(
    events: list[TraceEvent], failure: str, asked: Collection[str], episode: Episode
) -> Iterator[str]:
    """What is told of people who were asked in vain, where a visit failed by that or by a time limit."""
    failed = (event for event in events if event.action == "Await_way" and event.status == "failure")
    last = max((event for event in failed if event.because), key=attrgetter("t"), default=None)
    if last is None:
        return
    waited = last.because[0].text
    if failure != waited:
        limits = (event for event in events if event.action.startswith("Timeout"))
        if not any(cause.text == failure for event in limits for cause in event.because):
            return
        yield f"before that, {waited}"
    yield from (f"{name} stood where the robot was to stand" for name in _at_goal(asked, last.t, episode))


def _at_goal(names: Collection[str], t: float, episode: Episode) -> Iterator[str]:
    """Who stood at the robot's goal at a time, and not on the way to it."""
    scene = episode.prepared.scene
    goal = next((span.goal for span in episode.motion if span.end_s > t - TICK_S), None)
    if goal is None:
        return
    for person in scene.people:
        at = pose_at(episode.frames, person.name, t).xy
        if person.name in names and dist(at, goal) < person.radius_m + scene.robot.radius_m + person.margin_m:
            yield person.name


def _asked(events: list[TraceEvent], episode: Episode) -> Iterator[str]:
    """Who was asked to let the robot pass on the way to a person."""
    begun_s: float | None = None
    for event in (event for event in events if event.action == "Ask_to_pass"):
        if event.status == "running":
            begun_s = event.t
        elif begun_s is not None:
            yield from (
                act.person for act in episode.acts if act.act == ASK and begun_s <= act.t_start <= event.t
            )
