"""Translates a plan's ground actions, found by any engine, to the visits of a tour."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from comity_domain.choices.options import Options
from comity_domain.classical.naming import PddlNames
from comity_domain.plans import actions
from comity_domain.problem.spot import Spot
from comity_domain.tours.tour import PlannedVisit

Grounded = tuple[str, Sequence[str]]
"""Name of an action, in any case, and its arguments."""


def tour_of(steps: Iterable[Grounded], choices: Options, names: PddlNames) -> tuple[PlannedVisit, ...]:
    """The visits, in order.

    Args:
        steps: A plan for the problem.
        choices: The options it may use.
        names: The problem's names.
    """
    visits: list[PlannedVisit] = []
    brought = {name for name, person in choices.people.items() if person.in_hand}
    for name, words in steps:
        _, *said = (names.name(word) for word in words)
        match _own_name(name):
            case actions.FETCH:
                if not visits or visits[-1].spot.place != said[0]:
                    brought.add(said[0])  # before the person is reached
            case actions.REACH:
                person, side = said[:2]
                visits.append(
                    PlannedVisit(Spot(person, side), company=None, way=None, bringing=person in brought)
                )
            case actions.RETURN:
                visits[-1] = replace(visits[-1], returns=(*visits[-1].returns, Spot(said[0], said[1])))
            case actions.GREET:
                visits[-1] = replace(visits[-1], way=(said[1], said[2]))
            case actions.GREET_TOGETHER:
                visits[-1] = replace(visits[-1], company=said[0], way=(said[3], said[4]))
            case actions.LEAVE:
                visits[-1] = replace(visits[-1], farewell=(said[2], said[3]))
    return tuple(visits)


def _own_name(name: str) -> str:
    """Engines that read PDDL ignore case."""
    return name.capitalize()
