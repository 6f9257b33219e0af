"""Hand-made inferences and requests: what these tests are about is the planning, not a rulebook."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import pytest

from comity_domain import (
    START,
    Agenda,
    Circumstances,
    Company,
    Offer,
    Say,
    Spot,
    TakeLeave,
    Visitee,
    VisitRequest,
    Wait,
    Weights,
    location,
    offers,
)
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.inference.value import Contribution, Inference, Origin, ParameterValue

SIDES = ("front", "left", "right")


def price(desirability: float, weight_m: float) -> int:
    """What a choice of this desirability costs, in cm."""
    tangent = max(0.0, 1.0 - 100.0 * desirability)
    return round(100 * weight_m * (tangent - math.log(max(desirability, 0.01))))


@dataclass(frozen=True)
class Line:
    """Straight lines between points, x ascending."""

    points: tuple[tuple[float, float], ...]

    @property
    def domain(self) -> tuple[float, float]:
        return self.points[0][0], self.points[-1][0]

    def __call__(self, x: float) -> float:
        for (x0, y0), (x1, y1) in pairwise(self.points):
            if x0 <= x <= x1:
                return y0 if x1 == x0 else y0 + (y1 - y0) * (x - x0) / (x1 - x0)
        return 0.0

    def _within(self, low: float, high: float) -> list[float]:
        return sorted({low, high, *(x for x, _ in self.points if low < x < high)})

    def height(self, low: float, high: float) -> float:
        return max(self(x) for x in self._within(low, high))

    def centroid(self, low: float, high: float) -> float | None:
        area = moment = 0.0
        for a, b in pairwise(self._within(low, high)):
            fa, fb, width = self(a), self(b), b - a
            area += width * (fa + fb) / 2
            moment += width * (fa * (2 * a + b) + fb * (a + 2 * b)) / 6
        return moment / area if area > 0 else None


def flat(front: float, beside: float) -> Line:
    """One desirability ahead and another beside."""
    return Line(((0.0, front), (22.4, front), (22.5, beside), (90.0, beside)))


def parameter(
    name: str, value: float | str, desirability: Curve | Choice, origin: Origin = "culture"
) -> ParameterValue:
    start = Contribution(origin, value, "")
    return ParameterValue(name, value, None, None, origin, (start,), desirability, (), "")


def infer(
    *,
    direction: float = 0.0,
    curve: Curve | None = None,
    modality: str = "verbal",
    modalities: Mapping[str, float] | None = None,
    gesture: str = "nod",
    gestures: Mapping[str, float] | None = None,
    settings: Sequence[str] = (),
) -> Inference:
    """A person who likes the front and words alone, where nothing else is said."""
    values = (
        ("conversational_distance", 0.640213579, flat(1.0, 1.0)),
        ("approach_direction", direction, curve or flat(1.0, 0.1)),
        ("approach_speed", 0.317716680, flat(1.0, 1.0)),
        ("greeting_modality", modality, Choice(modalities or {"verbal": 1.0, "gestural": 0.2, "both": 0.5})),
        ("greeting_gesture", gesture, Choice(gestures or {"nod": 1.0, "wave": 0.5})),
    )
    parameters = {
        name: parameter(name, value, desirability, "setting" if name in settings else "culture")
        for name, value, desirability in values
    }
    return Inference("by-hand", "exact", {}, parameters)


def travel_everywhere(names: Sequence[str], length_m: float = 5.0) -> dict[tuple[Spot, Spot], float]:
    """All routes of one length."""
    spots = [Spot(name, side) for name in names for side in SIDES]
    return {
        (start, end): length_m
        for start in (START, *spots)
        for end in spots
        if start == START or start.place != end.place
    }


def request_for(
    people: Mapping[str, Inference],
    travel: Mapping[tuple[Spot, Spot], float] | None = None,
    *,
    robot: str = "robot",
    weights: Weights | None = None,
) -> VisitRequest:
    """Visit these people; all routes are 5 m where nothing else is said."""
    visitees = tuple(Visitee(name, values) for name, values in people.items())
    routes = travel_everywhere(list(people)) if travel is None else travel
    return VisitRequest(robot, visitees, routes, weights or Weights())


def random_request(count: int, seed: int) -> VisitRequest:
    """People anywhere in a room, of any taste, with routes that no metric holds together and some missing."""
    rng = random.Random(seed)
    names = [f"person {index}" for index in range(count)]
    people = {}
    for name in names:
        modalities = {word: rng.random() for word in ("verbal", "gestural", "both")}
        gestures = {word: rng.random() for word in ("wave", "nod", "bow")}
        people[name] = infer(
            curve=flat(rng.choice((0.0, 0.3, 1.0)), rng.random()),
            direction=rng.choice((0.0, 45.0)),
            modality=max(modalities, key=lambda word: modalities[word]),
            modalities=modalities,
            gesture=max(gestures, key=lambda word: gestures[word]),
            gestures=gestures,
        )
    routes = {
        leg: round(math.hypot(rng.uniform(0.0, 8.0), rng.uniform(0.0, 8.0)), 3)
        for leg in travel_everywhere(names)
        if rng.random() < 0.85
    }
    return request_for(people, routes, weights=Weights(side_m=rng.choice((0.25, 1.0, 4.0))))


def rich_request(count: int, seed: int, *, deadlines: bool = True) -> VisitRequest:
    """The same with companies, priorities, noise, hands full and, where wanted, deadlines."""
    plain, rng = random_request(count, seed), random.Random(1000 + seed)
    names = [visitee.name for visitee in plain.visitees]
    visitees = tuple(
        replace(
            visitee,
            now=Circumstances(
                robot_carries=rng.choice((None, None, "tray")) if index else None,
                noisy=rng.random() < 0.2,
            ),
            priority_m=rng.choice((0.0, 0.0, 1.5, 3.0)),
            by_s=rng.uniform(20.0, 25.0 * count) if deadlines and rng.random() < 0.4 else None,
        )
        for index, visitee in enumerate(plain.visitees)
    )
    places = [None, *names]
    durations = {(a, b): rng.uniform(2.0, 20.0) for a in places for b in names}
    companies = tuple(
        Company(f"table {first}", members, _overlooked(members, rng))
        for first in range(0, count - 1, 4)
        if len(members := tuple(names[first : first + rng.choice((2, 3))])) > 1
    )
    return replace(plain, visitees=visitees, companies=companies, durations_s=durations)


def with_agendas(request: VisitRequest, agendas: Mapping[str, Agenda], seed: int) -> VisitRequest:
    """The same with more to do at some people's, and ways of any length to and from where things are kept."""
    rng = random.Random(2000 + seed)
    visitees = tuple(replace(each, agenda=agendas.get(each.name, ())) for each in request.visitees)
    kept = sorted({offer.place for each in visitees for offer in offers(each.agenda)})
    spots = [Spot(each.name, side) for each in visitees for side in SIDES]
    there = [location(place) for place in kept]
    ways = [(a, b) for a in (START, *spots) for b in there] + [(a, b) for a in there for b in spots]
    return replace(
        request,
        visitees=visitees,
        travel={**request.travel, **{way: round(rng.uniform(0.0, 9.0), 3) for way in ways}},
        durations_s={
            **request.durations_s,
            **{
                (None if a == START else a.place, b.place): 2.0 + 3.0 * (len(b.place) % 4)
                for a, b in ways
                if request.durations_s
            },
        },
    )


def agenda_request(count: int, seed: int, *, deadlines: bool = False) -> VisitRequest:
    """A rich request with random agendas: no hands are full at the start, so that things can be brought."""
    rich, rng = rich_request(count, seed, deadlines=deadlines), random.Random(3000 + seed)
    visitees = tuple(
        replace(each, now=replace(each.now, robot_carries=None), priority_m=each.priority_m * deadlines)
        for each in rich.visitees
    )
    kinds = (Say("here it is"), Wait(2.0), Offer("tea", "kitchen"), Offer("cake", "pantry"))
    agendas = {
        each.name: (
            *rng.choices(kinds, (3, 1, 2, 2), k=rng.choice((0, 1, 2, 3))),
            *([TakeLeave()] if rng.random() < 0.5 else []),
        )
        for each in visitees
    }
    return with_agendas(replace(rich, visitees=visitees), agendas, seed)


def hall(count: int, seed: int, spare_s: float) -> VisitRequest:
    """People in a hall, most with a deadline that one random order keeps with some seconds to spare."""
    rng = random.Random(seed)
    at = {f"p{i}": (rng.uniform(0.0, 20.0), rng.uniform(0.0, 15.0)) for i in range(count)}
    places: dict[str | None, tuple[float, float]] = {None: (0.0, 0.0), **at}
    ways = {(a, b): math.dist(places[a], at[b]) for a in places for b in at if a != b}
    durations = {way: max(0.0, metres - 1.2) / 0.6 + 9.0 for way, metres in ways.items()}
    order, now, here, by = rng.sample(list(at), count), 0.0, None, {}
    for name in order:
        now, here = now + durations[here, name] + 4.0, name
        if rng.random() < 0.7:
            by[name] = now + spare_s * rng.random()
    travel = {
        (START if a is None else Spot(a, "front"), Spot(b, "front")): metres
        for (a, b), metres in ways.items()
    }
    visitees = tuple(
        Visitee(name, infer(), by_s=by.get(name), priority_m=rng.choice((0.0, 0.0, 5.0))) for name in at
    )
    return VisitRequest("robot", visitees, travel, durations_s=durations, ways_m=ways)


def corridor_of_three(**changes: Mapping[str, object]) -> VisitRequest:
    """Three people along a corridor, 3 m apart: the cheapest order is the one in which they stand."""
    request = request_for({name: infer() for name in ("ada", "bob", "cem")})
    at = {START.place: 0.0, "ada": 3.0, "bob": 6.0, "cem": 9.0}
    travel = {leg: abs(at[leg[0].place] - at[leg[1].place]) for leg in request.travel}
    durations = {
        (None if a == START else a.place, b.place): length / 0.5 for (a, b), length in travel.items()
    }
    visitees = tuple(replace(each, **changes.get(each.name, {})) for each in request.visitees)
    return replace(request, visitees=visitees, travel=travel, durations_s=durations)


def _overlooked(members: Sequence[str], rng: random.Random) -> dict[Spot, dict[str, float]]:
    return {
        Spot(name, side): {other: rng.uniform(0.4, 2.0) for other in members if other != name}
        for name in members
        for side in SIDES
        if rng.random() < 0.5
    }


@pytest.fixture(name="infer")
def infer_fixture() -> Callable[..., Inference]:
    return infer


@pytest.fixture(name="request_for")
def request_for_fixture() -> Callable[..., VisitRequest]:
    return request_for


@pytest.fixture(name="travel_everywhere")
def travel_everywhere_fixture() -> Callable[..., dict[tuple[Spot, Spot], float]]:
    return travel_everywhere


@pytest.fixture(name="random_request")
def random_request_fixture() -> Callable[..., VisitRequest]:
    return random_request


@pytest.fixture(name="rich_request")
def rich_request_fixture() -> Callable[..., VisitRequest]:
    return rich_request


@pytest.fixture(name="agenda_request")
def agenda_request_fixture() -> Callable[..., VisitRequest]:
    return agenda_request


@pytest.fixture(name="hall")
def hall_fixture() -> Callable[..., VisitRequest]:
    return hall


@pytest.fixture(name="with_agendas")
def with_agendas_fixture() -> Callable[..., VisitRequest]:
    return with_agendas


@pytest.fixture(name="corridor")
def corridor_fixture() -> Callable[..., VisitRequest]:
    return corridor_of_three


@pytest.fixture(name="line")
def line_fixture() -> type[Line]:
    return Line


@pytest.fixture
def with_skips() -> Callable[[VisitRequest, Mapping[str, float]], VisitRequest]:
    """Ways without culture, and prices in metres for leaving some people out."""

    def priced(request: VisitRequest, prices: Mapping[str, float]) -> VisitRequest:
        visitees = tuple(replace(each, skip_m=prices.get(each.name)) for each in request.visitees)
        ways = {
            (None if start == START else start.place, end.place): length
            for (start, end), length in request.travel.items()
        }
        return replace(request, visitees=visitees, ways_m=ways)

    return priced
