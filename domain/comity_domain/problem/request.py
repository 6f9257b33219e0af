"""The planning request: people to visit, along which routes, and how culture weighs against distance."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace

from comity_domain.problem.agenda import Agenda, offers, require_agenda
from comity_domain.problem.bound_parameters import ABOUT_VISITS
from comity_domain.problem.circumstances import QUIET_AND_FREE, Circumstances
from comity_domain.problem.spot import Nearness, Spot, Travel, Way, names_in, place_of
from comity_domain.problem.survey import Survey
from comity_fis.errors import InputError
from comity_fis.inference.value import Inference


@dataclass(frozen=True, slots=True)
class Visitee:
    """A person to visit, with their inferred parameters."""

    name: str
    values: Inference
    now: Circumstances = QUIET_AND_FREE
    """What rules greetings out."""
    priority_m: float = 0.0
    """What it costs, in metres of walking, for each person who is greeted before this one."""
    by_s: float | None = None
    """The latest time at which the greeting may end, in seconds from the start; None: any time will do."""
    skip_m: float | None = None
    """What leaving this person out costs, in metres of walking; None: nobody may leave them out."""
    agenda: Agenda = ()
    """What is to be done once they are greeted, in this order; of a visit under way, what is left."""
    greeted: bool = False
    """The visit is under way: they were greeted, and the agenda is left."""
    in_hand: bool = False
    """The robot holds what is offered first: the person it is for is visited before all others."""
    after: str | None = None
    """The person to be greeted before, if the scenario asks for an order; ignored if nobody visits them."""
    not_from: frozenset[str] = frozenset()
    """Sides that the scenario rules out."""

    def __post_init__(self) -> None:
        require_agenda(self.name, self.agenda)
        if (self.greeted and not self.agenda) or (self.in_hand and not offers(self.agenda)):
            raise ValueError(f"{self.name}: nothing is left to do, or nothing to be handed over")
        require_price(self.name, "priority", self.priority_m)
        require_price(self.name, "skipping", self.skip_m or 0.0)
        if self.by_s is not None and not 0.0 < self.by_s < math.inf:
            raise ValueError(f"{self.name}: a deadline is a time after the start, got {self.by_s!r} s")
        missing = [name for name in ABOUT_VISITS if name not in self.values.parameters]
        if missing:
            raise InputError(
                expected=f"a rulebook with all the parameters of a visit ({', '.join(ABOUT_VISITS)})",
                got=f"{self.values.rulebook!r}, which has no {', '.join(missing)}",
                remedy="Plan with the rulebook bruno2017, or add the parameters to yours.",
            )


@dataclass(frozen=True, slots=True)
class Company:
    """People who stand together and may be greeted at once, by one greeting for all."""

    name: str
    members: tuple[str, ...]
    overlooks: Mapping[Spot, Nearness]
    """The spots of members from which all of them can be greeted, each with how near the others are then."""

    def __post_init__(self) -> None:
        if len(set(self.members)) < 2 or len(set(self.members)) < len(self.members):
            raise ValueError(f"company {self.name!r} needs two different members, got {self.members!r}")
        for spot, nearness in self.overlooks.items():
            if {spot.place, *nearness} != set(self.members):
                raise ValueError(
                    f"company {self.name!r} at {spot}: expected a distance to every other member"
                )

    def without(self, names: Collection[str]) -> Company | None:
        """The same without some people; None where fewer than two are left."""
        members = tuple(name for name in self.members if name not in names)
        overlooks = {
            spot: {name: near for name, near in others.items() if name not in names}
            for spot, others in self.overlooks.items()
            if spot.place not in names
        }
        return replace(self, members=members, overlooks=overlooks) if len(members) > 1 else None


@dataclass(frozen=True, slots=True)
class Weights:
    """What disliked options are worth in metres of detour: metres per unit of -ln(desirability).

    At 1 m the robot goes 0.69 m further rather than choose an option half as desirable, and 5.6 m rather than
    one that is not desirable at all. A design choice, without a source: the project reports how stable plans
    are when the weights go from a quarter to four times.
    """

    side_m: float = 1.0
    greeting_m: float = 1.0

    def __post_init__(self) -> None:
        for name, weight in (("side_m", self.side_m), ("greeting_m", self.greeting_m)):
            if not 0.0 <= weight <= 100.0:
                raise ValueError(f"{name} must be between 0 and 100 metres, got {weight!r}")

    def scaled(self, factor: float) -> Weights:
        """All of them times a factor."""
        return Weights(self.side_m * factor, self.greeting_m * factor)


GREETING_S = 4.0
"""What a greeting takes in the computation of deadlines: a gesture takes 1.5 s, an utterance rarely 4 s."""

ANNOUNCING_S = 6.0
"""What it takes longer before a person who does not see: they are told that the robot comes, and has stopped
(our choice: two short sentences)."""


@dataclass(frozen=True, slots=True)
class VisitRequest:
    """Visit each of these people once, in any order: greet them, one by one or together with their company.

    A person with an agenda is greeted alone, and served to its end before the next one.
    """

    robot: str
    visitees: tuple[Visitee, ...]
    travel: Travel
    weights: Weights = field(default_factory=Weights)
    companies: tuple[Company, ...] = ()
    """Nobody belongs to two."""
    durations_s: Mapping[Way, float] = field(default_factory=dict)
    """From place to place, computed without culture, so that it cannot decide whether a deadline is kept.

    Needed for every pair of places with a route where a person has a deadline.
    """
    ways_m: Mapping[Way, float] = field(default_factory=dict)
    """The same as lengths, needed where a person may be left out: culture has no say in who is."""
    dropped_m: Mapping[str, float] = field(default_factory=dict)
    """People whose visit is dropped, with its price in metres: no plan can serve them, or `dropping` them was
    decided."""
    blocked: Mapping[Spot, str] = field(default_factory=dict)
    """What stands on spots that no way leads to, so far as that is known: it is what is told of them."""
    survey: Survey | None = None
    """What of the ways are bounds so far, and how to measure them; None: nothing."""

    def __post_init__(self) -> None:
        names = [visitee.name for visitee in self.visitees]
        if len(set(names)) < len(names):
            raise ValueError(f"every person is visited once, got {names!r}")
        if sum(visitee.in_hand for visitee in self.visitees) > 1:
            raise ValueError("the robot carries one thing at a time")
        together = [member for company in self.companies for member in company.members]
        if len(set(together)) < len(together) or not set(together) <= set(names):
            raise ValueError(f"members are visited and belong to one company only, got {together!r}")
        kept = {offer.place for visitee in self.visitees for offer in offers(visitee.agenda)}
        if both := kept & {visitee.name for visitee in self.visitees}:
            raise ValueError(f"people and locations need different names, got {sorted(both)!r} for both")
        for (start, end), length_m in self.travel.items():
            if not (math.isfinite(length_m) and length_m >= 0.0):
                raise ValueError(
                    f"a route has a finite length >= 0, got {length_m!r} m from {start} to {end}"
                )
        if self.has_deadlines:
            self._require_durations()

    def without(self, names: Collection[str]) -> VisitRequest:
        """The same without some people."""
        companies = (company.without(names) for company in self.companies)
        return replace(
            self,
            visitees=tuple(visitee for visitee in self.visitees if visitee.name not in names),
            travel={leg: way for leg, way in self.travel.items() if not names_in(leg, names)},
            companies=tuple(company for company in companies if company is not None),
        )

    def dropping(self, names: Collection[str]) -> VisitRequest:
        """The same with some visits dropped at their price."""
        prices = {visitee.name: visitee.skip_m or 0.0 for visitee in self.visitees if visitee.name in names}
        return replace(self.without(names), dropped_m={**prices, **self.dropped_m}) if names else self

    @property
    def has_deadlines(self) -> bool:
        """Whether time matters."""
        return any(visitee.by_s is not None for visitee in self.visitees)

    def _require_durations(self) -> None:
        for start, end in self.travel:
            seconds = self.durations_s.get((place_of(start), end.place))
            if seconds is None or not (math.isfinite(seconds) and seconds >= 0.0):
                raise ValueError(
                    f"deadlines need a duration from {start.place!r} to {end.place!r}, got {seconds}"
                )


def require_price(name: str, what: str, metres: float) -> None:
    """Refuse a price that is no finite number of metres >= 0."""
    if not 0.0 <= metres <= 1e6:
        raise ValueError(f"{name}: {what} must be between 0 and 1e6 metres, got {metres!r}")
