"""Reads the options of a visit problem back from its initial values and goals.

The options are stated again and compared with the problem: a fact or goal that this domain's search would
overlook is rejected rather than ignored.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from comity_domain.choices.companies import CompanyOptions
from comity_domain.choices.greeting import Greeting
from comity_domain.choices.options import Options, PersonOptions, Priced
from comity_domain.choices.side import Side
from comity_domain.choices.ties import untied
from comity_domain.classical.initial_state import (
    ENTRANCE,
    brought,
    goals,
    state_and_costs,
    tasks,
    turns_of,
)
from comity_domain.classical.naming import PddlNames, PddlWord
from comity_domain.classical.timing import NO_TIMING, Timing
from comity_domain.classical.timing_check import require_timing
from comity_domain.problem.agenda import PLAIN, Agenda, Offer, TakeLeave, Task
from comity_domain.problem.spot import START, Spot
from comity_fis.errors import InputError, Where, shown
from comity_fis.inference.value import Inference

if TYPE_CHECKING:
    from unified_planning.model import FNode, Problem

Atom = tuple[str, *tuple[str, ...]]
"""A fluent and its arguments, by their names in the problem."""
SIDES = ("front", "left", "right")
"""Tie-break order (`choices.ties`)."""
BOUND = frozenset(("distance_mm", "speed_mm_s", "direction_mdeg"))
"""Fluents that actions bind, on which no condition or cost depends."""
NO_VALUES = Inference("none", "exact", {}, {})
"""Placeholder: a problem states what everything costs, but not why."""


def choices_of(problem: Problem, timing: Timing = NO_TIMING) -> tuple[Options, PddlNames]:
    """The options that a problem states, and their PDDL names.

    Args:
        problem: A problem in the form of `problem_of`, with any names; costs in cm.
        timing: What the problem cannot express.

    Raises:
        InputError: The problem states something that `problem_of` cannot.
    """
    _require_visit_domain(problem)
    stated = _Stated(problem)
    require_timing(timing, stated.types, stated.ways())
    choices = stated.choices(timing)
    names = stated.names(choices)
    _require_same(
        {atom: value for atom, value in stated.values.items() if atom[0] not in BOUND},
        {(f.fluent, *(names.ids[word] for word in f.arguments)): f.value for f in state_and_costs(choices)},
        "initial value",
    )
    _require_same(
        dict.fromkeys(_wanted(problem), True),
        {(f.fluent, *(names.ids[word] for word in f.arguments)): f.value for f in goals(choices)},
        "goal",
    )
    return choices, names


class _Stated:
    """The initial values of a problem."""

    def __init__(self, problem: Problem) -> None:
        self.types = {each.name: each.type.name for each in problem.all_objects}
        self._users = [name for name, kind in self.types.items() if kind == "user"]
        self.values = {
            _atom(atom): value.constant_value()
            for atom, value in problem.explicit_initial_values.items()
            if value.constant_value()
        }
        """All true facts, and all numbers except 0."""
        self._by_fluent: dict[str, dict[tuple[str, ...], int]] = defaultdict(dict)
        for (fluent, *arguments), value in self.values.items():
            self._by_fluent[fluent][tuple(arguments)] = value
        self._turns = self._all_turns()
        self._agendas = {user: self._tasks(user) for user in self._users}

    def ways(self) -> Iterator[tuple[str, str]]:
        """Start and end of every way to a user or a location, several times if there are several sides."""
        for fluent in ("route", "way_to"):
            for start, _side, place, _to in self._by_fluent[fluent]:
                yield start, place

    def choices(self, timing: Timing) -> Options:
        """See `choices_of`."""
        prices = self._by_fluent["skip_cost"]
        dropped = {user: prices.get((user,), 0) for (user,) in self._by_fluent["dropped"]}
        people = {user: self._person(user, timing) for user in self._users if user not in dropped}
        companies = {name: self._company(name, timing) for (name,) in self._by_fluent["whole"]}
        spots = [spot for person in people.values() for spot in person.spots()]
        robot = next((name for name, kind in self.types.items() if kind == "robot"), "")
        legs = dict(self._legs())
        dislikes = dict.fromkeys(spots, 0)
        return Options(robot, people, companies, legs, dislikes, timing.durations_s, dropped)

    def names(self, choices: Options) -> PddlNames:
        """The PDDL name of each word; all but tasks, objects and turns keep their names."""
        ids = {PddlWord(kind, name): name for name, kind in self.types.items()}
        ids |= zip(turns_of(choices), self._turns, strict=False)
        for person in choices.people.values():
            ids |= zip(tasks(person), self._agendas[person.name], strict=True)
            for task, thing in brought(person):
                ids[thing] = self._one("brings", ids[task])
        return PddlNames(ids, {name: word for word, name in ids.items()})

    def _facts(self, fluent: str, *first: str) -> Iterator[tuple[tuple[str, ...], int]]:
        """The other arguments and the value of every fact that starts with these arguments."""
        for arguments, value in self._by_fluent[fluent].items():
            if arguments[: len(first)] == first:
                yield arguments[len(first) :], value

    def _one(self, fluent: str, *first: str) -> str:
        """The last argument of a fact that occurs at most once; empty if it does not occur."""
        return next((arguments[-1] for arguments, _ in self._facts(fluent, *first)), "")

    def _chain(self, fluent: str, first: str) -> list[str]:
        """The sequence from `first` on, each item once."""
        found: list[str] = []
        while first and first not in found:
            found.append(first)
            first = self._one(fluent, first)
        return found

    def _all_turns(self) -> list[str]:
        return self._chain("then", self._one("now"))

    def _tasks(self, user: str) -> list[str]:
        return self._chain("follows", self._one("opens", user))

    def _legs(self) -> Iterator[tuple[tuple[Spot, Spot], int]]:
        numbers = self._by_fluent
        for start, side, user, to in numbers["route"]:
            cost = numbers["travel_cost"].get((start, side, user, to), 0)
            yield (_origin(start, side), Spot(user, to)), cost
        for start, side, place, there in numbers["way_to"]:
            cost = numbers["fetch_cost"].get((start, side, place), 0)
            yield (_origin(start, side), Spot(place, there)), cost

    def _person(self, user: str, timing: Timing) -> PersonOptions:
        sides = [side for (side,), _ in self._facts("reachable", user)]
        sides.sort(key=lambda side: (SIDES.index(side) if side in SIDES else len(SIDES), side))
        agenda: Agenda = tuple(self._task(task, timing) for task in self._agendas[user])
        things = [thing for task in self._agendas[user] if (thing := self._one("brings", task))]
        greetings, priority = self._greetings(user, timing)
        bringing = {
            greeting: cost
            for greeting, cost in greetings.items()
            if things and (things[0], greeting.gesture) in self._by_fluent["leaves_open"]
        }
        return PersonOptions(
            user,
            NO_VALUES,
            {side: _side(side, timing.ties.get((user, side), 0)) for side in sides},
            {},
            greetings,
            {},
            priority,
            timing.by_s.get(user),
            agenda=agenda,
            bringing=bringing or None,
            greeted=(user,) in self._by_fluent["greeted"],
            in_hand=bool(things) and self._one("holds") == things[0],
            after=self._one("after", user) or None,
            is_told=user in timing.announced,
        )

    def _greetings(self, user: str, timing: Timing) -> tuple[Priced, int]:
        """Cost of each greeting as the first one, and the additional cost per person greeted before.

        Among equal costs the one stated first comes first.
        """
        costs = self._by_fluent["greet_cost"]
        first, *later = self._turns or [""]
        prices = {
            Greeting(modality, gesture, *untied(timing.ties.get((user, modality, gesture), 0))): costs.get(
                (user, modality, gesture, first), 0
            )
            for (modality, gesture), _ in self._facts("permitted", user)
        }
        sorted_prices = dict(sorted(prices.items(), key=lambda priced: priced[1]))
        if not later or not prices:
            return sorted_prices, 0
        modality, gesture = next(iter(prices)).way
        return sorted_prices, costs.get((user, modality, gesture, later[0]), 0) - next(iter(prices.values()))

    def _task(self, task: str, timing: Timing) -> Task:
        if thing := self._one("brings", task):
            return Offer(thing, self._one("kept", thing))
        for kind in PLAIN:
            if (task,) in self._by_fluent[kind.fact]:
                numbers = {name: self._by_fluent[name].get((task,), 0) for name in kind.thousandths}
                return kind.read(timing.details.get(task, task), numbers)
        return TakeLeave()

    def _company(self, name: str, timing: Timing) -> CompanyOptions:
        members = tuple(user for (user, company) in self._by_fluent["member"] if company == name)
        spots = [Spot(user, side) for (user, side), _ in self._facts("overlooks", name)]
        ways = [(modality, gesture) for (modality, gesture), _ in self._facts("welcome", name)]
        costs, first = self._by_fluent["greet_together_cost"], self._turns[:1]

        def cost(spot: Spot, way: tuple[str, str]) -> int:
            return costs.get((name, spot.place, spot.side, *way, *first), 0)

        # The problem states only the sum of the spot's and the greeting's costs.
        prices = {spot: min(cost(spot, way) for way in ways) for spot in spots if ways}
        least = next(iter(prices.items()), None)
        beyond = {way: cost(least[0], way) - least[1] if least else 0 for way in ways}
        return CompanyOptions(
            name,
            members,
            prices,
            dict(sorted(beyond.items(), key=lambda priced: priced[1])),
            {spot: timing.ties.get((name, spot.place, spot.side), 0) for spot in prices},
            {way: timing.ties.get((name, *way), 0) for way in ways},
        )


def _origin(place: str, side: str) -> Spot:
    return START if place == ENTRANCE.name else Spot(place, side)


def _side(name: str, tie: int) -> Side:
    desirability, departures = untied(tie)
    return Side(name, 0.0, desirability, inferred=not departures)


def _require_visit_domain(problem: Problem) -> None:
    from unified_planning.model import Problem

    from comity_domain.classical.visit_domain import empty_problem

    if not isinstance(problem, Problem):
        _refuse("a Problem of unified-planning", shown(problem))
    ours = empty_problem("visit", problem.environment)
    for what, theirs, known in (
        ("fluent", _named(problem.fluents), _named(ours.fluents)),
        ("action", _named(problem.actions), _named(ours.actions)),
        ("metric", _named(problem.quality_metrics), _named(ours.quality_metrics)),
    ):
        for name in (*known, *theirs):
            if name not in theirs:
                _refuse(f"the {what} {name} of the visit domain", "a problem without it")
            if name not in known:
                _refuse(f"the {what}s of the visit domain", f"another one, {name}")
            if theirs[name] != known[name]:
                _refuse(f"the {what} {name} as the visit domain has it", "another one of that name")


def _named(parts: Iterable[Any]) -> dict[str, Any]:
    """Fluents and actions by name; metrics by class, such as `MinimizeActionCosts`."""
    return {getattr(part, "name", type(part).__name__): part for part in parts}


def _wanted(problem: Problem) -> Iterator[Atom]:
    """The goals: single facts, or facts joined by `and`."""
    waiting = list(problem.goals)
    while waiting:
        goal = waiting.pop()
        if goal.is_and():
            waiting += goal.args
        elif goal.is_fluent_exp():
            yield _atom(goal)
        else:
            _refuse("that everybody is greeted and every task done as goals", str(goal))


def _atom(node: FNode) -> Atom:
    return (node.fluent().name, *(argument.object().name for argument in node.args))


def _require_same(theirs: Mapping[Atom, int], ours: Mapping[Atom, int], what: str) -> None:
    """Compare all facts, and only our numbers: others belong to actions that are never applicable."""
    facts = (atom for atom, value in theirs.items() if value is True)
    for atom in (*facts, *ours):
        if theirs.get(atom, 0) != ours.get(atom, 0):
            none = False if isinstance(theirs.get(atom, ours.get(atom)), bool) else 0
            expected, got = (f"{_shown(atom)} = {values.get(atom, none)}" for values in (ours, theirs))
            _refuse(f"{expected} as {what}, as `problem_of` states such visits", got)


def _shown(atom: Atom) -> str:
    fluent, *arguments = atom
    return f"{fluent}({', '.join(arguments)})"


def _refuse(expected: str, got: str) -> None:
    raise InputError(
        expected=expected,
        got=got,
        remedy="Make the problem by `problem_of`, or have it planned by another engine.",
        where=Where("comity"),
    )
