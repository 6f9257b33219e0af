"""A plan in the words of the domain, with the turns, things and tasks that people never see."""

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
from comity_domain.classical.naming import Word
from comity_domain.plans import actions
from comity_domain.plans.plan import Plan, PlanStep
from comity_domain.problem.request import Spot, location


def grounded(plan: Plan, choices: Options) -> Iterator[tuple[str, Sequence[Word]]]:
    """Each action by its name, with all its arguments; who is left out has none.

    Args:
        plan: Its steps.
        choices: What they were chosen from.
    """
    ground = _Grounding(choices)
    for step in plan.steps:
        if step.person in choices.people:
            yield step.action, (Word("robot", choices.robot), *ground.arguments(step))


class _Grounding:
    """What changes as the steps are gone through: the hands, how many were greeted, what comes next."""

    def __init__(self, choices: Options) -> None:
        people = choices.people.values()
        self._turns = turns_of(choices)
        self._holds, self._greeted, self._side = held(choices), 0, ""
        self._due = {person.name: list(tasks(person)) for person in people}
        self._things = {task: thing for person in people for task, thing in brought(person)}

    def arguments(self, step: PlanStep) -> Sequence[Word]:
        """All but the robot."""
        user = Word("user", step.person)
        words: Sequence[Word]
        match step.action:
            case actions.REACH:
                self._side = step.arguments[2]
                words = (user, Word("side", self._side), *_origin(step), self._holds)
            case actions.RETURN:
                task = self._due[step.person][0]
                words = (user, Word("side", step.arguments[2]), task, self._holds, *_origin(step))
            case actions.FETCH:
                task = next(task for task in self._due[step.person] if task in self._things)
                self._holds = self._things[task]
                place, side = spot_words(location(step.arguments[3]))
                words = (user, task, self._holds, place, side, *_origin(step), NOTHING)
            case actions.GREET:
                words = (user, *_way(step), *self._turn(1), self._holds)
            case actions.GREET_TOGETHER:
                company = Word("company", step.arguments[2])
                words = (company, user, Word("side", self._side), *_way(step), *self._turn(len(step.people)))
            case actions.OFFER:
                words = (user, self._due[step.person].pop(0), self._holds, NOTHING)
                self._holds = NOTHING
            case actions.LEAVE:
                words = (user, self._due[step.person].pop(0), *_way(step), self._holds)
            case _:
                words = (user, self._due[step.person].pop(0))
        return words

    def _turn(self, people: int) -> tuple[Word, Word]:
        """How many were greeted before and after, where that is a matter."""
        last, before = len(self._turns) - 1, self._greeted
        self._greeted += people
        return self._turns[min(before, last)], self._turns[min(self._greeted, last)]


def _origin(step: PlanStep) -> tuple[Word, Word]:
    assert step.origin is not None  # the robot moves
    return spot_words(Spot(*step.origin))


def _way(step: PlanStep) -> tuple[Word, Word]:
    modality, gesture = step.arguments[-2:]
    return way_words((modality, gesture))
