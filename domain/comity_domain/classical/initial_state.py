"""The initial state and costs of a request, in the vocabulary of `visit.pddl`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from comity_domain.choices.companies import CompanyOptions
from comity_domain.choices.options import Options, PersonOptions
from comity_domain.classical.naming import PddlNames, PddlWord, name_all
from comity_domain.problem.agenda import Offer, PlainTask, TakeLeave, Task
from comity_domain.problem.circumstances import FREE_OF_HANDS
from comity_domain.problem.spot import START, THERE, Spot

ROBOT, PLACE, USER, LOCATION = "robot", "place", "user", "location"
SIDE, MODALITY, GESTURE = "side", "modality", "gesture"
COMPANY, TURN, TASK, THING = "company", "turn", "task", "thing"
NOTHING = PddlWord(THING, "nothing")
ENTRANCE = PddlWord(PLACE, "entrance")
"""The start (`START` in a plan); not called `start`, which is a PDDL 2.1 keyword that ENHSP rejects."""


class Fact(NamedTuple):
    """The value of one grounded fluent in the initial state."""

    fluent: str
    arguments: tuple[PddlWord, ...]
    value: bool | int = True


def visit_names(options: Options) -> PddlNames:
    """The PDDL names of everything in a request; the domain's own come first and so stay unchanged."""
    sides = (START.side, "front", "left", "right", *([THERE] if options.locations else []))
    modalities = {greeting.modality for person in options.people.values() for greeting in person.greetings}
    things = [thing for person in options.people.values() for _, thing in brought(person)]
    return name_all(
        [
            ENTRANCE,
            NOTHING,
            *(PddlWord(SIDE, side) for side in sides),
            *(PddlWord(MODALITY, modality) for modality in sorted(modalities)),
            *(PddlWord(GESTURE, gesture) for gesture in _gestures(options)),
            PddlWord(ROBOT, options.robot),
            *(PddlWord(USER, person) for person in (*options.people, *options.dropped)),
            *(PddlWord(COMPANY, company) for company in options.companies),
            *(PddlWord(LOCATION, at.place) for at in options.locations),
            *(task for person in options.people.values() for task in tasks(person)),
            *things,
            *turns_of(options),
        ]
    )


def _gestures(options: Options) -> list[str]:
    people = options.people.values()
    return sorted({greeting.gesture for person in people for greeting in person.greetings})


def tasks(person: PersonOptions) -> tuple[PddlWord, ...]:
    """The tasks of a person's agenda, as objects."""
    return tuple(
        PddlWord(TASK, f"{_label(task)} {i} {person.name}") for i, task in enumerate(person.agenda, 1)
    )


def _label(task: Task) -> str:
    match task:
        case PlainTask():
            return task.fact
        case Offer():
            return f"offer {task.thing}"
        case TakeLeave():
            return "farewell"


def brought(person: PersonOptions) -> Iterator[tuple[PddlWord, PddlWord]]:
    """The offers on a person's agenda, each with the object that is handed over."""
    for i, (task, word) in enumerate(zip(person.agenda, tasks(person), strict=True), 1):
        if isinstance(task, Offer):
            yield word, PddlWord(THING, f"{task.thing} {i} for {person.name}")


def initial_state(options: Options) -> Iterator[Fact]:
    """The initial state: all true facts, every cost, and the parameters that the actions bind."""
    yield from state_and_costs(options)
    for person in options.people.values():
        yield from _parameters(person)


def state_and_costs(options: Options) -> Iterator[Fact]:
    """The initial state without bound parameters: all that a search depends on."""
    robot, turns = PddlWord(ROBOT, options.robot), turns_of(options)
    yield Fact("at", (robot, *spot_words(START)))
    yield Fact("free", (robot,))
    yield Fact("holds", (robot, held(options)))
    yield Fact("empty", (NOTHING,))
    yield from (Fact("leaves_open", (NOTHING, PddlWord(GESTURE, gesture))) for gesture in _gestures(options))
    yield Fact("now", turns[:1])
    if len(turns) == 1:
        yield Fact("lasts", turns)
    yield from (Fact("then", pair) for pair in _steps(turns, 1))
    for person in options.people.values():
        yield from _person(person, turns)
        if person.after is not None and person.after in options.people:
            yield Fact("waits", (PddlWord(USER, person.name),))
            yield Fact("after", (PddlWord(USER, person.name), PddlWord(USER, person.after)))
        yield from _agenda(person, _gestures(options))
    for company in options.companies.values():
        yield from _company(company, options, turns)
    for name, price in options.dropped.items():
        yield Fact("dropped", (PddlWord(USER, name),))
        yield Fact("skip_cost", (PddlWord(USER, name),), price)
    for (start, end), cost in options.legs.items():
        legs = (*spot_words(start), *spot_words(end))
        fetching = end.side == THERE
        yield Fact("way_to" if fetching else "route", legs)
        yield Fact("fetch_cost" if fetching else "travel_cost", legs[:3] if fetching else legs, cost)


def goals(options: Options) -> Iterator[Fact]:
    """Everybody is greeted and every agenda done, except for dropped visits."""
    for person in options.people.values():
        yield Fact("greeted", (PddlWord(USER, person.name),))
        yield from (Fact("done", (task,)) for task in tasks(person))
    yield from (Fact("skipped", (PddlWord(USER, name),)) for name in options.dropped)


def held(options: Options) -> PddlWord:
    """The object that the robot holds initially."""
    bearer = options.people.get(options.bearer_of or "")
    return NOTHING if bearer is None else next(thing for _, thing in brought(bearer))


def _person(person: PersonOptions, turns: Sequence[PddlWord]) -> Iterator[Fact]:
    user = PddlWord(USER, person.name)
    yield Fact("suits", (NOTHING, user))
    if person.greeted:
        yield Fact("greeted", (user,))
        yield Fact("begun", (user,))
    yield from (Fact("reachable", (user, PddlWord(SIDE, name))) for name in person.sides)
    for greeting, cost in person.greetings.items():
        words = (user, *way_words(greeting.way))
        yield Fact("permitted", words)
        for before, turn in enumerate(turns):
            yield Fact("greet_cost", (*words, turn), cost + person.priority * before)


def _parameters(person: PersonOptions) -> Iterator[Fact]:
    """The parameters that the actions bind, rounded: no condition or cost depends on them."""
    user, values = PddlWord(USER, person.name), person.values
    yield Fact("distance_mm", (user,), _thousandths(values["conversational_distance"].number))
    yield Fact("speed_mm_s", (user,), _thousandths(values["approach_speed"].number))
    for name, side in person.sides.items():
        # Without its sign, which Fast Downward rejects: the side implies it.
        yield Fact("direction_mdeg", (user, PddlWord(SIDE, name)), _thousandths(abs(side.bearing_deg)))


def _agenda(person: PersonOptions, gestures: Sequence[str]) -> Iterator[Fact]:
    user, words = PddlWord(USER, person.name), tasks(person)
    if not words:
        yield Fact("only_greeted", (user,))
        return
    yield Fact("opens", (user, words[0]))
    yield from (Fact("follows", pair) for pair in pairwise(words))
    yield Fact("last", words[-1:])
    yield from (Fact("of", (word, user)) for word in words)
    for task, word in zip(person.agenda, words, strict=True):
        yield from _task(task, word, person)
    for number, (word, thing) in enumerate(brought(person)):
        yield Fact("brings", (word, thing))
        yield Fact("suits", (thing, user))
        yield from (
            Fact("leaves_open", (thing, PddlWord(GESTURE, g))) for g in gestures if g in FREE_OF_HANDS
        )
        if not number and person.in_hand:
            continue  # already fetched
        yield Fact("kept", (thing, PddlWord(LOCATION, person.fetched_at[number - person.in_hand].place)))
        if not number:
            yield Fact("first_brought", (word,))


def _task(task: Task, word: PddlWord, person: PersonOptions) -> Iterator[Fact]:
    match task:
        case PlainTask():
            yield Fact(task.fact, (word,))
            for number, of in task.thousandths.items():
                yield Fact(number, (word,), _thousandths(getattr(task, of)))
        case TakeLeave():
            yield Fact("farewell", (word,))
            for greeting, cost in person.greetings.items():
                yield Fact("leave_cost", (PddlWord(USER, person.name), *way_words(greeting.way)), cost)
        case Offer():
            return


def _company(company: CompanyOptions, options: Options, turns: Sequence[PddlWord]) -> Iterator[Fact]:
    together = PddlWord(COMPANY, company.name)
    waiting = sum(options.people[member].priority for member in company.members)
    yield Fact("whole", (together,))
    yield from (Fact("member", (PddlWord(USER, member), together)) for member in company.members)
    yield from (Fact("welcome", (together, *way_words(way))) for way in company.greetings)
    for pair in _steps(turns, len(company.members)):
        yield Fact("then_together", (together, *pair))
    for spot in company.spots:
        yield Fact("overlooks", (together, *spot_words(spot)))
        for way in company.greetings:
            for before, turn in enumerate(turns):
                cost = company.cost(spot, way) + waiting * before
                yield Fact("greet_together_cost", (together, *spot_words(spot), *way_words(way), turn), cost)


def turns_of(options: Options) -> tuple[PddlWord, ...]:
    """One turn for each number of greeted people; a single one if that number does not matter."""
    count = len(options.people) + 1 if options.has_priorities else 1
    return tuple(PddlWord(TURN, f"after {before}") for before in range(count))


def _steps(turns: Sequence[PddlWord], people: int) -> Iterator[tuple[PddlWord, PddlWord]]:
    """From each turn to the one after so many more people."""
    if len(turns) == 1:
        return iter([(turns[0], turns[0])])
    return zip(turns, turns[people:], strict=False)


def way_words(way: tuple[str, str]) -> tuple[PddlWord, PddlWord]:
    """The PDDL objects of a modality and a gesture."""
    modality, gesture = way
    return PddlWord(MODALITY, modality), PddlWord(GESTURE, gesture)


def spot_words(spot: Spot) -> tuple[PddlWord, PddlWord]:
    """The PDDL objects of a place and a side."""
    kind = LOCATION if spot.side == THERE else USER
    place = ENTRANCE if spot == START else PddlWord(kind, spot.place)
    return place, PddlWord(SIDE, spot.side)


def _thousandths(value: float) -> int:
    return round(1000.0 * value)
