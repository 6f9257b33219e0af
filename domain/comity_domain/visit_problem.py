"""One request as a planning problem: objects, initial state and goals added to the domain."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from comity_domain.companies import CompanyOptions
from comity_domain.naming import Names, Word, name_all
from comity_domain.options import Options, PersonOptions
from comity_domain.request import START, Spot
from comity_domain.visit_domain import visit_domain

if TYPE_CHECKING:
    from unified_planning.model import Problem

_ROBOT = "robot"
_PLACE = "place"
_USER = "user"
_SIDE = "side"
_MODALITY = "modality"
_GESTURE = "gesture"
_COMPANY = "company"
_TURN = "turn"


class Fact(NamedTuple):
    """The value of one grounded fluent in the initial state."""

    fluent: str
    arguments: tuple[Word, ...]
    value: bool | int = True


def visit_names(options: Options) -> Names:
    """The PDDL words of all that a request names; the domain's own come first and so keep theirs."""
    greetings = [greeting for person in options.people.values() for greeting in person.greetings]
    return name_all(
        [
            Word(_PLACE, START.place),
            *(Word(_SIDE, side) for side in (START.side, "front", "left", "right")),
            *(
                Word(_MODALITY, modality)
                for modality in sorted({greeting.modality for greeting in greetings})
            ),
            *(Word(_GESTURE, gesture) for gesture in sorted({greeting.gesture for greeting in greetings})),
            Word(_ROBOT, options.robot),
            *(Word(_USER, person) for person in options.people),
            *(Word(_COMPANY, company) for company in options.companies),
            *_turns(options),
        ]
    )


def visit_problem(options: Options, names: Names) -> Problem:
    """The problem, in a fresh environment: in a shared one, a failed call can make the next one fail, too."""
    from unified_planning.environment import Environment

    environment = Environment()
    environment.credits_stream = None
    problem = visit_domain(environment)
    objects = {
        word: problem.add_object(id_, problem.user_type(word.kind)) for id_, word in names.words.items()
    }
    for fact in initial_state(options):
        fluent = problem.fluent(fact.fluent)
        problem.set_initial_value(fluent(*(objects[word] for word in fact.arguments)), fact.value)
    for person in options.people:
        problem.add_goal(problem.fluent("greeted")(objects[Word(_USER, person)]))
    return problem


def initial_state(options: Options) -> Iterator[Fact]:
    """What is true, and what things cost, before the first action."""
    robot = Word(_ROBOT, options.robot)
    yield Fact("at", (robot, *_words(START)))
    yield Fact("free", (robot,))
    turns = _turns(options)
    yield Fact("now", turns[:1])
    yield from (Fact("then", pair) for pair in _steps(turns, 1))
    for person in options.people.values():
        yield from _person(person, turns)
    for company in options.companies.values():
        yield from _company(company, options, turns)
    for (start, end), cost in options.legs.items():
        yield Fact("route", (*_words(start), *_words(end)))
        yield Fact("travel_cost", (*_words(start), *_words(end)), cost)


def _person(person: PersonOptions, turns: Sequence[Word]) -> Iterator[Fact]:
    user, values = Word(_USER, person.name), person.values
    yield Fact("distance_mm", (user,), _thousandths(values["conversational_distance"].number))
    yield Fact("speed_mm_s", (user,), _thousandths(values["approach_speed"].number))
    for name, side in person.sides.items():
        yield Fact("reachable", (user, Word(_SIDE, name)))
        # Without its sign, which Fast Downward would refuse: the side says it.
        yield Fact("direction_mdeg", (user, Word(_SIDE, name)), _thousandths(abs(side.bearing_deg)))
    for greeting, cost in person.greetings.items():
        words = (user, *_way(greeting.way))
        yield Fact("permitted", words)
        for before, turn in enumerate(turns):
            yield Fact("greet_cost", (*words, turn), cost + person.priority * before)


def _company(company: CompanyOptions, options: Options, turns: Sequence[Word]) -> Iterator[Fact]:
    together = Word(_COMPANY, company.name)
    waiting = sum(options.people[member].priority for member in company.members)
    yield Fact("whole", (together,))
    yield from (Fact("member", (Word(_USER, member), together)) for member in company.members)
    yield from (Fact("welcome", (together, *_way(way))) for way in company.greetings)
    for pair in _steps(turns, len(company.members)):
        yield Fact("then_together", (together, *pair))
    for spot in company.spots:
        yield Fact("overlooks", (together, *_words(spot)))
        for way in company.greetings:
            for before, turn in enumerate(turns):
                cost = company.cost(spot, way) + waiting * before
                yield Fact("greet_together_cost", (together, *_words(spot), *_way(way), turn), cost)


def _turns(options: Options) -> tuple[Word, ...]:
    """One for each number of people who were greeted; a single one where that number is no matter."""
    count = len(options.people) + 1 if options.has_priorities else 1
    return tuple(Word(_TURN, f"after {before}") for before in range(count))


def _steps(turns: Sequence[Word], people: int) -> Iterator[tuple[Word, Word]]:
    """From each turn to the one after so many people."""
    if len(turns) == 1:
        return iter([(turns[0], turns[0])])
    return zip(turns, turns[people:], strict=False)


def _way(way: tuple[str, str]) -> tuple[Word, Word]:
    modality, gesture = way
    return Word(_MODALITY, modality), Word(_GESTURE, gesture)


def _words(spot: Spot) -> tuple[Word, Word]:
    kind = _PLACE if spot == START else _USER
    return Word(kind, spot.place), Word(_SIDE, spot.side)


def _thousandths(value: float) -> int:
    return round(1000.0 * value)
