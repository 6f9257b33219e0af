"""Consistency of a scenario's goals beyond names: the order of greetings, and places of things."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.specification.goals import Goal, greeted
from comity_fis import InputError, closest, unknown_word

if TYPE_CHECKING:
    from comity.specification.scenario_check import FilePlaces


MOST_IN_ORDER = 12
"""Maximum number of people whose order the planner can keep: for more it proves nothing."""


@dataclass(frozen=True, slots=True)
class GoalCheck:
    """The goals of one scenario.

    Args:
        goals: All goals.
        people: All people in the scenario.
        done: People already greeted.
        where: Positions in the file.
    """

    goals: Sequence[Goal]
    people: Collection[str]
    done: Collection[str]
    where: FilePlaces

    def order(self) -> None:
        """Refuse tasks for unknown people, before a greeting, or after leave was taken."""
        first = {name: i for i, name in reversed(greeted(self.goals))}
        left: set[str] = set()
        for i, goal in enumerate(self.goals):
            if goal.person not in self.people:
                raise unknown_word(
                    "a person from `people`",
                    goal.person,
                    self.people,
                    where=self.where("goals", i, goal.person_key),
                )
            if goal.greet is None:
                self._after_greeting(i, goal, first)
            if goal.person in left:
                raise InputError(
                    expected="nothing more to do with a person after `take_leave`",
                    got=f"`{goal.kind}` about {goal.person!r}",
                    remedy="Move `take_leave` behind it, or remove one of them.",
                    where=self.where("goals", i, goal.kind),
                )
            if goal.take_leave is not None:
                left.add(goal.person)

    def after(self) -> None:
        """Refuse an order that includes people who are not greeted, is circular, or has too many people."""
        first = {goal.greet: goal.after for goal in self.goals if goal.greet and goal.after}
        greeted_ = {name: i for i, name in greeted(self.goals)}
        for name, before in first.items():
            where = self.where("goals", greeted_[name], "after")
            if before not in greeted_:
                raise unknown_word("a person whom another goal greets", before, greeted_, where=where)
            seen = [name]
            while (earlier := first.get(seen[-1])) is not None and earlier not in seen:
                seen.append(earlier)
            if earlier == name:  # a circle that it only leads to is reported by its members
                raise InputError(
                    expected="an order without a circle",
                    got=f"{name} after {before}" + (f", who comes after {name}" if before != name else ""),
                    remedy="Remove one `after`.",
                    where=where,
                )
            if len(greeted_) > MOST_IN_ORDER:
                raise InputError(
                    expected=f"at most {MOST_IN_ORDER} people to greet where an order is asked for",
                    got=f"{len(greeted_)}",
                    remedy="Remove `after`, or some of the people.",
                    where=where,
                )

    def places(self, known: Collection[str]) -> None:
        """Refuse things without a place to fetch them from.

        Args:
            known: Names of the furniture and the locations.
        """
        for i, goal in enumerate(self.goals):
            if goal.from_ is not None and (goal.from_ not in known or goal.from_ in self.people):
                raise InputError(
                    expected="a piece of furniture, or a location of the place, to fetch it from",
                    got=repr(goal.from_),
                    remedy=closest(goal.from_, known) if known else "Add it to `furniture`.",
                    where=self.where("goals", i, "from"),
                )

    def _after_greeting(self, i: int, goal: Goal, first: dict[str, int]) -> None:
        name = goal.person
        if name in self.done:
            raise InputError(
                expected="somebody who is still to be greeted",
                got=f"{name!r}, greeted already",
                remedy="Remove the fact from `already`: what is to be done follows a greeting.",
                where=self.where("goals", i, goal.person_key),
            )
        if first.get(name, len(self.goals)) > i:
            raise InputError(
                expected=f"`greet: {name}` before what else is to be done with {name}",
                got="no such goal" if name not in first else "it later in the list",
                remedy=f"Write `- greet: {name}` above it.",
                where=self.where("goals", i, goal.person_key),
            )
