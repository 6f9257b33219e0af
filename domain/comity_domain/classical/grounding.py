"""Translates the visits of a tour to ground actions, with the domain's internal turns, objects and tasks."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from comity_domain.choices.options import Options
from comity_domain.classical.initial_state import (
    NOTHING,
    brought,
    held,
    spot_words,
    tasks,
    turns_of,
    way_words,
)
from comity_domain.classical.naming import PddlWord
from comity_domain.plans import actions
from comity_domain.problem.agenda import Offer, PlainTask, TakeLeave, Task
from comity_domain.problem.spot import START, Spot
from comity_domain.tours.tour import PlannedVisit, served

Ground = tuple[str, Sequence[PddlWord]]
"""Name of an action, and all its arguments except the robot."""


def grounded(visits: Sequence[PlannedVisit], choices: Options) -> Iterator[tuple[str, Sequence[PddlWord]]]:
    """Each ground action: its name and all its arguments.

    Args:
        visits: A tour.
        choices: The options that the tour was chosen from.
    """
    robot, ground = PddlWord("robot", choices.robot), _Grounding(choices)
    for visit in visits:
        for action, words in ground.visit(visit):
            yield action, (robot, *words)
    for name in choices.dropped:
        yield actions.SKIP, (robot, PddlWord("user", name))


class _Grounding:
    """The state that changes from visit to visit: position, hands, number of greeted people."""

    def __init__(self, choices: Options) -> None:
        self._choices = choices
        self._turns = turns_of(choices)
        self._here, self._holds, self._greeted = START, held(choices), 0

    def visit(self, visit: PlannedVisit) -> Iterator[Ground]:
        person = self._choices.people[visit.spot.place]
        user, words, things = PddlWord("user", person.name), tasks(person), dict(brought(person))
        if visit.bringing and not person.in_hand:
            first = next(word for word in words if word in things)
            yield self._fetch(user, first, things[first], person.fetched_at[0])
        yield actions.REACH, (user, PddlWord("side", visit.spot.side), *spot_words(self._here), self._holds)
        self._here = visit.spot
        if visit.way is not None:
            yield self._greet(user, visit, visit.way)
        trips = zip(
            person.fetched_at[len(person.fetched_at) - len(visit.returns) :], visit.returns, strict=True
        )
        for task, word in zip(person.agenda, words, strict=True):
            if isinstance(task, Offer) and self._holds == NOTHING:
                kept, spot = next(trips)
                yield self._fetch(user, word, things[word], kept)
                yield (
                    actions.RETURN,
                    (user, PddlWord("side", spot.side), word, self._holds, *spot_words(kept)),
                )
                self._here = spot
            yield self._task(user, task, word, visit)

    def _fetch(self, user: PddlWord, task: PddlWord, thing: PddlWord, kept: Spot) -> Ground:
        origin, self._here, self._holds = self._here, kept, thing
        return actions.FETCH, (user, task, thing, *spot_words(kept), *spot_words(origin), NOTHING)

    def _greet(self, user: PddlWord, visit: PlannedVisit, way: tuple[str, str]) -> Ground:
        people = len(served(visit, self._choices))
        last, before = len(self._turns) - 1, self._greeted
        self._greeted += people
        turns = self._turns[min(before, last)], self._turns[min(self._greeted, last)]
        if visit.company is None:
            return actions.GREET, (user, *way_words(way), *turns, self._holds)
        company, side = PddlWord("company", visit.company), PddlWord("side", visit.spot.side)
        return actions.GREET_TOGETHER, (company, user, side, *way_words(way), *turns)

    def _task(self, user: PddlWord, task: Task, word: PddlWord, visit: PlannedVisit) -> Ground:
        match task:
            case PlainTask():
                return task.action, (user, word)
            case Offer():
                thing, self._holds = self._holds, NOTHING
                return actions.OFFER, (user, word, thing, NOTHING)
            case TakeLeave():
                assert visit.farewell is not None  # the agenda includes a farewell here
                return actions.LEAVE, (user, word, *way_words(visit.farewell), self._holds)
