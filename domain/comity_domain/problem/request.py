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
    """Circumstances that exclude greetings."""
    priority_m: float = 0.0
    """Cost for each person greeted before this one, in metres of travel."""
    by_s: float | None = None
    """Deadline for the end of the greeting, from the start [s], or None."""
    skip_m: float | None = None
    """Cost of dropping this visit, in metres of travel; None if it must not be dropped."""
    agenda: Agenda = ()
    """Tasks after the greeting, in order; for a visit in progress, the remaining ones."""
    greeted: bool = False
    """Whether the visit is in progress: the person was greeted, the agenda remains."""
    in_hand: bool = False
    """Whether the robot holds the first offered object; this person is then visited first."""
    after: str | None = None
    """The person to greet before this one, if the scenario requires it; ignored if they are not visited."""
    not_from: frozenset[str] = frozenset()
    """Sides that the scenario excludes."""

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
    """A group of people who may be greeted together by one greeting."""

    name: str
    members: tuple[str, ...]
    overlooks: Mapping[Spot, Nearness]
    """Spots of members from which all can be greeted, each with the distances to the others."""

    def __post_init__(self) -> None:
        if len(set(self.members)) < 2 or len(set(self.members)) < len(self.members):
            raise ValueError(f"company {self.name!r} needs two different members, got {self.members!r}")
        for spot, nearness in self.overlooks.items():
            if {spot.place, *nearness} != set(self.members):
                raise ValueError(
                    f"company {self.name!r} at {spot}: expected a distance to every other member"
                )

    def without(self, names: Collection[str]) -> Company | None:
        """The group without some people; None if fewer than two remain."""
        members = tuple(name for name in self.members if name not in names)
        overlooks = {
            spot: {name: near for name, near in others.items() if name not in names}
            for spot, others in self.overlooks.items()
            if spot.place not in names
        }
        return replace(self, members=members, overlooks=overlooks) if len(members) > 1 else None


@dataclass(frozen=True, slots=True)
class Weights:
    """Weights of preference costs: metres of travel per unit of -ln(desirability).

    At 1 m the robot drives 0.69 m further rather than choose an option half as desirable, and 5.6 m rather
    than choose one that is not desirable at all. A design choice without a source: the project reports how
    stable plans are when the weights vary from a quarter to four times their value.
    """

    side_m: float = 1.0
    greeting_m: float = 1.0

    def __post_init__(self) -> None:
        for name, weight in (("side_m", self.side_m), ("greeting_m", self.greeting_m)):
            if not 0.0 <= weight <= 100.0:
                raise ValueError(f"{name} must be between 0 and 100 metres, got {weight!r}")

    def scaled(self, factor: float) -> Weights:
        """All weights times a factor."""
        return Weights(self.side_m * factor, self.greeting_m * factor)


GREETING_S = 4.0
"""Duration of a greeting, as estimated for deadlines [s]: a gesture takes 1.5 s, an utterance rarely 4 s."""

ANNOUNCING_S = 6.0
"""Additional duration for a person who cannot see [s]: the robot announces that it comes and that it has
stopped (our choice: two short sentences)."""


@dataclass(frozen=True, slots=True)
class VisitRequest:
    """A request to greet each of these people once, in any order, one by one or together with their group.

    A person with an agenda is greeted alone, and their agenda is finished before the next visit.
    """

    robot: str
    visitees: tuple[Visitee, ...]
    travel: Travel
    weights: Weights = field(default_factory=Weights)
    companies: tuple[Company, ...] = ()
    """Groups; nobody belongs to two."""
    durations_s: Mapping[Way, float] = field(default_factory=dict)
    """Travel times between places [s], computed without culture, so that it cannot affect deadlines.

    Required for every pair of places with a route if a person has a deadline.
    """
    ways_m: Mapping[Way, float] = field(default_factory=dict)
    """The same as lengths [m]; required if a visit may be dropped, so that culture cannot affect which."""
    dropped_m: Mapping[str, float] = field(default_factory=dict)
    """People whose visit is dropped, with its cost in metres: no plan can serve them, or `dropping` was
    called."""
    blocked: Mapping[Spot, str] = field(default_factory=dict)
    """Obstacles on spots that no route leads to, as far as known, for explanations."""
    survey: Survey | None = None
    """Which routes are only bounds so far, and how to measure them; None if there are none."""

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
        """The request without some people."""
        companies = (company.without(names) for company in self.companies)
        return replace(
            self,
            visitees=tuple(visitee for visitee in self.visitees if visitee.name not in names),
            travel={leg: way for leg, way in self.travel.items() if not names_in(leg, names)},
            companies=tuple(company for company in companies if company is not None),
        )

    def dropping(self, names: Collection[str]) -> VisitRequest:
        """The request with some visits dropped at their cost."""
        prices = {visitee.name: visitee.skip_m or 0.0 for visitee in self.visitees if visitee.name in names}
        return replace(self.without(names), dropped_m={**prices, **self.dropped_m}) if names else self

    @property
    def has_deadlines(self) -> bool:
        """Whether some person has a deadline."""
        return any(visitee.by_s is not None for visitee in self.visitees)

    def _require_durations(self) -> None:
        for start, end in self.travel:
            seconds = self.durations_s.get((place_of(start), end.place))
            if seconds is None or not (math.isfinite(seconds) and seconds >= 0.0):
                raise ValueError(
                    f"deadlines need a duration from {start.place!r} to {end.place!r}, got {seconds}"
                )


def require_price(name: str, what: str, metres: float) -> None:
    """Reject a cost that is not a finite number of metres >= 0."""
    if not 0.0 <= metres <= 1e6:
        raise ValueError(f"{name}: {what} must be between 0 and 1e6 metres, got {metres!r}")
