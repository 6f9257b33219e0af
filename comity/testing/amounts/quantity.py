"""Numbers that an expectation may bound: metrics of the run and of people, and parameters of the rulebook."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from comity.testing.amounts import causes
from comity.testing.amounts.amount import Bounds, told_apart
from comity.testing.amounts.course import of_course, of_plan
from comity.testing.amounts.happened import walking
from comity.testing.amounts.moments import Moment, intrusion, moment_of, of_moment, of_stay
from comity.testing.amounts.standing import DockedPose, standing
from comity.testing.amounts.touching import CONTACTS, of_contacts
from comity.testing.trials.visits import approached, require_goal, to_visit, values_when_judged
from comity_fis import InputError, unknown_word
from comity_sim2d.metrics import EPISODE, VISIT, Metric, by_short_name, of_episode, of_person

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_fis import Inference

OF_RUN: Mapping[str, Metric] = by_short_name(EPISODE)
OF_PERSON: Mapping[str, Metric] = by_short_name(VISIT)

_NOTHING = "no `walks`, no `reacts`, no `comfort`, no fault, and no change with `moves_to_m`"
_STAYS = f"stays: the scenario has {_NOTHING} for them"
_STAY = f"walks: the scenario has {_NOTHING} for anybody"


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of one case."""

    name: str
    number: float
    unit: str | None
    because: Callable[[], Iterable[str]]
    at: Moment | None = None
    """When and near whom it occurred, for a minimum or maximum of an episode."""


@dataclass(frozen=True, slots=True)
class NoQuantity:
    """A missing number of a person who should have one."""

    name: str
    unit: str | None
    got: str
    because: Sequence[str]


def quantities(episode: Episode, name: str, person: str | None) -> Iterator[Quantity | NoQuantity]:
    """A metric of the run, or a metric or a parameter of a person or of everyone to visit.

    Raises:
        InputError: if there is no such number.
    """
    if person is None and name in OF_RUN:
        yield from _of_run(episode, name, OF_RUN[name])
    elif name in OF_PERSON:
        yield from _of_people(episode, name, OF_PERSON[name], person)
    elif name in OF_RUN:
        raise InputError(
            expected="a number of one person",
            got=f"{name}, which is of the whole run",
            remedy="Leave `of` out.",
        )
    else:
        yield from _of_parameter(episode, name, person)


def is_figure(name: str) -> bool:
    """Whether the name is a metric, not a parameter."""
    return name in OF_RUN or name in OF_PERSON


def require_sensible(name: str, person: str | None, bounds: Bounds) -> None:
    """Refuse bounds outside a metric's range, and bounds that every value satisfies.

    A single person's number may be missing, so any bound on it can be violated.

    Raises:
        InputError: if no value can satisfy them, or violate them, or they measure something else.
    """
    metric = OF_RUN.get(name) if person is None else None
    metric = metric or OF_PERSON.get(name) or OF_RUN.get(name)
    if metric is None or (metric.least is None and metric.most is None):
        return
    unit = None if metric.unit == "1" else metric.unit
    bounds.require_possible(name, metric.least, metric.most, unit)
    if person is None:
        bounds.require_breakable(name, metric.least, metric.most, unit)


def require_parameter(name: str, values: Inference, others: Iterable[str] = ()) -> None:
    """Refuse a name that is no parameter of the rulebook."""
    if name not in values.parameters:
        known = [*values.parameters, *others]
        raise unknown_word(
            f"a parameter of the rulebook {values.rulebook}"
            + (", or one of the other words that may stand here" if others else ""),
            name,
            known,
        )


def _of_parameter(episode: Episode, name: str, person: str | None) -> Iterator[Quantity]:
    for one in (person,) if person else to_visit(episode):
        values = values_when_judged(episode, one, name)
        require_parameter(name, values, (*OF_RUN, *OF_PERSON))
        value = values[name]
        if isinstance(value.value, str):
            raise InputError(
                expected="a parameter that is a number",
                got=f"{name}, which is a word",
                remedy=f"Write `{name} is {value.value}`.",
            )
        because = partial(causes.of_parameter, episode, name, one)
        yield Quantity(f"{name} of {one}", value.value, value.unit, because)


def _of_run(episode: Episode, name: str, metric: Metric) -> Iterator[Quantity]:
    found = of_episode(episode.metrics)
    if metric.name in found:
        moment, because = _behind_run(episode, metric)
        yield Quantity(name, found[metric.name], metric.unit, because, moment)


def _behind_run(episode: Episode, metric: Metric) -> tuple[Moment | None, Callable[[], Iterable[str]]]:
    """When a metric of the run took its value, and what contributed to it."""
    if metric.name.startswith("plan_"):
        return None, partial(of_plan, episode)
    if metric.name == "walked_m":
        return None, partial(_of_walk, episode, None)
    if metric.name == "longest_intrusion_s" and (stay := intrusion(episode).longest(episode.frames)):
        return Moment(stay.start_s, stay.person, "beside"), partial(of_stay, episode, stay)
    moment = moment_of(episode.frames, metric.name)
    if moment is not None:
        return moment, partial(of_moment, episode, moment)
    if metric.name in CONTACTS:
        people = episode.frames.entities[1:]
        return None, lambda: [*of_contacts(episode.history, people, metric.name)] or of_course(episode)
    return None, partial(of_course, episode, moving=metric.unit != "s")


def _of_people(
    episode: Episode, name: str, metric: Metric, person: str | None
) -> Iterator[Quantity | NoQuantity]:
    """A metric of one person or of everyone to visit; NoQuantity where an approached person has none."""
    if person and metric.per == "visit":
        require_goal(episode.prepared.file.scenario, person)
    for one in (person,) if person else to_visit(episode):
        number = of_person(episode.metrics, one).get(metric.name)
        told, unit = f"{name} of {one}", None if metric.unit == "1" else metric.unit
        if number is not None:
            moment, because = _behind_person(episode, metric, one, number)
            yield Quantity(told, number, unit, because, moment)
        elif person or one in approached(episode.prepared.plan):
            got = "none: nothing happened to measure it by"
            yield NoQuantity(told, unit, got, tuple(causes.of_visit(episode, one)))


def _behind_person(
    episode: Episode, metric: Metric, person: str, number: float
) -> tuple[Moment | None, Callable[[], Iterable[str]]]:
    """When a metric of a person took its value, and what contributed to it."""
    if metric.name in ("longest_intrusion_s", "compliance_share"):
        stay = intrusion(episode).longest(episode.frames, person)
        if stay is not None:
            at = Moment(stay.start_s, person, "beside") if metric.unit == "s" else None
            return at, partial(of_stay, episode, stay)
    if metric.name == "walked_m":
        return None, partial(_of_walk, episode, person)
    if metric.name == "docking_time_s":  # includes the time of earlier visits
        return None, partial(of_course, episode, until=(person, number))
    if metric.name == "docking_error_m" and (stood := standing(episode.frames, episode.visits, person)):
        return Moment(stood.t), partial(_of_docked, episode, person, stood)
    return None, partial(of_course, episode, person, moving=True)


def _of_docked(episode: Episode, person: str, stood: DockedPose) -> Iterator[str]:
    """Why the robot stood where it docked, and where the distance comes from."""
    target = episode.values_at(person, stood.t)["conversational_distance"]
    target_m, actual_m = told_apart((target.number, stood.distance_m), "m")
    yield f"distance  target {target_m}, actual {actual_m}"
    yield from causes.of_node(episode.history, f"docked?({person})", "success", ended_s=stood.t)
    yield from causes.of_visit(episode, person)
    yield from causes.of_parameter(episode, "conversational_distance", person, stood.t)


def _of_walk(episode: Episode, person: str | None) -> Iterator[str]:
    """What makes a person (or anybody) walk, then the course; no course if they stayed."""
    keys = walking(episode.prepared.file.scenario, person)
    metrics = episode.metrics
    moved = (metrics.walked_by_person_m[person] if person else metrics.walked_m) > 0
    if keys:
        yield f"walks     {', '.join(keys)}"
    elif not moved:
        yield f"walks     {person or 'nobody'} {_STAYS if person else _STAY}"
    if keys or moved:
        yield from of_course(episode)
