"""Timing and tie-breaks that a classical problem cannot express: deadlines, durations, preferences."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from comity_domain.choices.options import Options, options
from comity_domain.classical.initial_state import (
    COMPANY,
    SIDE,
    USER,
    spot_words,
    tasks,
    visit_names,
    way_words,
)
from comity_domain.classical.naming import PddlNames, PddlWord
from comity_domain.labelling.skipping import left_out
from comity_domain.problem.agenda import PlainTask
from comity_domain.problem.request import VisitRequest
from comity_domain.problem.spot import Way


@dataclass(frozen=True, slots=True)
class Timing:
    """Timing of visits, named by the objects of the problem."""

    by_s: Mapping[str, float] = field(default_factory=dict)
    """By user, the deadline of the greeting, from the start, > 0 [s]."""
    durations_s: Mapping[Way, float] = field(default_factory=dict)
    """Durations from a user, a location or the start (None) to a user or a location, >= 0 [s]; needed for
    each route if there is a deadline."""
    details: Mapping[str, str] = field(default_factory=dict)
    """By task, what determines its duration but is not in the problem: the text of a message."""
    announced: frozenset[str] = frozenset()
    """Users to whom the robot announces its approach, which takes longer."""
    ties: Mapping[tuple[str, ...], int] = field(default_factory=dict)
    """Tie-breaks by user and side; by user, modality and gesture; and likewise for groups. Among plans of
    equal cost the one with the smallest sum is chosen (`choices.ties`); >= 0, and 0 if there is no entry."""

    def __bool__(self) -> bool:
        """Whether it restricts the plans; other engines ignore it."""
        return bool(self.by_s)


NO_TIMING = Timing()


def timing_of(request: VisitRequest) -> Timing:
    """What `problem_of(request)` omits."""
    choices = options(request.dropping(left_out(request)))
    return timing_with(choices, visit_names(choices))


def timing_with(choices: Options, names: PddlNames) -> Timing:
    """The timing for options whose problem uses these names."""
    people = choices.people
    ids = {name: names.id("user", name) for name in people}
    places = ids | {at.place: names.id("location", at.place) for at in choices.locations}
    return Timing(
        {ids[name]: person.by_s for name, person in people.items() if person.by_s is not None},
        {
            (None if start is None else places[start], places[end]): seconds
            for (start, end), seconds in choices.durations_s.items()
            if end in places and (start is None or start in places)
        },
        dict(_details(choices, names.ids)),
        frozenset(ids[name] for name, person in people.items() if person.is_told),
        {tuple(names.ids[word] for word in words): tie for words, tie in _ties(choices) if tie},
    )


def _ties(choices: Options) -> Iterator[tuple[tuple[PddlWord, ...], int]]:
    for person in choices.people.values():
        user = PddlWord(USER, person.name)
        for side in person.sides.values():
            yield (user, PddlWord(SIDE, side.name)), side.tie_break
        for greeting in person.greetings:
            yield (user, *way_words(greeting.way)), greeting.tie_break
    for company in choices.companies.values():
        together = PddlWord(COMPANY, company.name)
        for spot, tie in company.spot_ties.items():
            yield (together, *spot_words(spot)), tie
        for way, tie in company.greeting_ties.items():
            yield (together, *way_words(way)), tie


def _details(choices: Options, ids: Mapping[PddlWord, str]) -> Iterator[tuple[str, str]]:
    for person in choices.people.values():
        for task, word in zip(person.agenda, tasks(person), strict=True):
            if isinstance(task, PlainTask) and task.detail:
                yield ids[word], task.detail
