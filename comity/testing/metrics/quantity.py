"""Numbers that a sentence may bound: of the plan, metrics of the episode, ways, and parameters of people."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from comity.testing.metrics import causes
from comity.testing.metrics.amount import Bounds, told_apart
from comity.testing.metrics.course import of_course, of_plan
from comity.testing.metrics.moments import Moment, intrusion, moment_of, of_moment, of_stay, worst_stay
from comity.testing.metrics.standing import standing
from comity.testing.metrics.touching import CONTACTS, of_contacts
from comity.testing.metrics.whereabouts import (
    DOCKING_ERROR,
    OF_VISIT,
    REACHED,
    WALKED,
    of_visit,
    of_walk,
    walked_m,
)
from comity_fis import InputError, closest
from comity_sim2d.metrics import EPISODE, VISIT, Definition, of_episode, of_person

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
    from comity_fis import Inference

_ENDS = {
    "m/s^3": "_m_s3",
    "m/s^2": "_m_s2",
    "m/s": "_m_s",
    "m": "_m",
    "s": "_s",
    "deg": "_deg",
    "rad": "_rad",
}
"""By unit, the end of a metric's name, which a sentence leaves out."""
PLAN: Mapping[str, str | None] = {"plan_cost": "m", "plan_gap": None}
"""Of the plan, with their units: its cost, and the share of it that a better one could at most save."""
_EITHER_SIGN = ("min_clearance_m", "stop_distance_error_m")
"""Metrics that may be less than nothing: a gap where bodies overlap, an error to either side."""
_OUTSIDE_VISITS = "compliance_share"
"""The figure of a person for which visits to them do not count."""
_HALF_TURN_DEG = 180.0
_SHARES = ("plan_gap", "success_weighted_by_path_length")
"""In [0, 1], beside those whose name ends in `_share`."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of one case."""

    name: str
    number: float
    unit: str | None
    because: Callable[[], Iterable[str]]
    at: Moment | None = None
    """Of what is the least or the most of an episode, when that was, and with whom."""


@dataclass(frozen=True, slots=True)
class Missing:
    """No number of a person for whom there should be one."""

    name: str
    unit: str | None
    got: str
    because: Sequence[str]


def quantities(trial: Trial, name: str, person: str | None) -> Iterator[Quantity | Missing]:
    """Of the plan, the episode or a visit, how far people went, or a parameter of somebody or of all visited.

    Raises:
        InputError: if there is no such number.
    """
    of_all, of_one = by_bare_name(EPISODE), by_bare_name(VISIT)
    if name in PLAN and person is None:
        plan = trial.prepared.plan
        number = plan.cost / 100.0 if name == "plan_cost" else plan.gap
        yield Quantity(name, number, PLAN[name], lambda: of_plan(trial))
        return
    if name in of_all and person is None:
        yield from _of_episode(trial, name, of_all[name])
        return
    if person is not None and of_all.get(name) == "longest_intrusion_s":
        stay = intrusion(trial).longest(trial.episode.frames, person)
        at = Moment(stay.start_s, person, "beside") if stay else None
        because = partial(of_stay, trial, stay) if stay else partial(of_course, trial)
        yield Quantity(f"{name} of {person}", stay.length_s if stay else 0.0, "s", because, at)
        return
    if name == WALKED:
        told = f"{name} of {person}" if person else name
        yield Quantity(told, walked_m(trial, person), "m", lambda: of_walk(trial, person))
        return
    if name in (*PLAN, *of_all):
        raise InputError(
            expected="a number of one person",
            got=f"{name}, which is of the whole run",
            remedy="Leave `of` out.",
        )
    if name in OF_VISIT:
        yield from _of_docking(trial, name, person)
        return
    if name in of_one:
        yield from _of_visits(trial, name, of_one[name], person)
        return
    for one in (person,) if person else trial.wanted:
        values = trial.values(one, name)
        require_parameter(name, values, (*PLAN, WALKED, *OF_VISIT, *of_all, *of_one))
        value = values[name]
        if isinstance(value.value, str):
            raise InputError(
                expected="a parameter that is a number",
                got=f"{name}, which is a word",
                remedy=f"Write `{name} is {value.value}`.",
            )
        yield Quantity(f"{name} of {one}", value.value, value.unit, _lines(trial, name, one))


def is_figure(name: str) -> bool:
    """Whether it is a number of the plan, the episode, a visit or a walk, and no parameter."""
    return name in (*PLAN, WALKED, *OF_VISIT, *by_bare_name(EPISODE), *by_bare_name(VISIT))


def require_possible(name: str, bounds: Bounds) -> None:
    """Refuse bounds outside of all that a metric can be.

    Raises:
        InputError: if nothing can keep them, or they measure something else.
    """
    lowest, highest, unit = _possible(name)
    if (lowest, highest) != (None, None):
        bounds.require_possible(name, lowest, highest, unit)


def require_breakable(name: str, bounds: Bounds) -> None:
    """Refuse bounds that every value of a metric keeps.

    Raises:
        InputError: if nothing can break them, or they measure something else.
    """
    lowest, highest, unit = _possible(name)
    if (lowest, highest) != (None, None):
        bounds.require_breakable(name, lowest, highest, unit)


def _possible(name: str) -> tuple[float | None, float | None, str | None]:
    """The least and the most that a metric can be, None where there is none, and its unit."""
    metrics = {**EPISODE, **VISIT}
    key = {**by_bare_name(EPISODE), **by_bare_name(VISIT)}.get(name, name)
    if key == "chosen_bearing":
        return -_HALF_TURN_DEG, _HALF_TURN_DEG, "deg"
    if key in _SHARES or (key in metrics and key.endswith("_share")):
        return 0.0, 1.0, None
    if key in metrics:
        unit = None if metrics[key].unit == "1" else metrics[key].unit
        return (None if key in _EITHER_SIGN else 0.0), (_HALF_TURN_DEG if unit == "deg" else None), unit
    sizes = {**PLAN, **OF_VISIT, WALKED: "m"}
    return (0.0, None, sizes[key]) if key in sizes and key != "chosen_distance" else (None, None, None)


def require_parameter(name: str, values: Inference, others: Iterable[str] = ()) -> None:
    """Refuse what is no parameter of the rulebook."""
    if name not in values.parameters:
        known = [*values.parameters, *others]
        raise InputError(
            expected=f"a parameter of the rulebook {values.rulebook}"
            + (", or one of the other words that may stand here" if others else ""),
            got=repr(name),
            remedy=closest(name, known),
        )


def _lines(trial: Trial, name: str, whose: str) -> Callable[[], Iterable[str]]:
    return lambda: causes.of_parameter(trial, name, whose)


def _of_episode(trial: Trial, name: str, key: str) -> Iterator[Quantity]:
    found = of_episode(trial.episode.metrics)
    if key not in found:
        return
    unit, moment = EPISODE[key].unit, moment_of(trial, key)
    if key == "longest_intrusion_s" and (stay := intrusion(trial).longest(trial.episode.frames)):
        yield Quantity(name, found[key], unit, partial(of_stay, trial, stay), moment)
    elif moment is not None:
        yield Quantity(name, found[key], unit, lambda: of_moment(trial, moment), moment)
    elif key in CONTACTS:
        yield Quantity(name, found[key], unit, lambda: [*of_contacts(trial, key)] or of_course(trial))
    else:
        yield Quantity(name, found[key], unit, lambda: of_course(trial, moving=unit != "s"))


def _of_visits(trial: Trial, name: str, key: str, person: str | None) -> Iterator[Quantity | Missing]:
    """A metric of each visit, or of one, where it has a value in this episode."""
    trial.require_goal(*((person,) if person else ()))
    for one in (person,) if person else trial.wanted:
        found = of_person(trial.episode.metrics, one)
        if key in found:
            because = _of_stay if key == _OUTSIDE_VISITS else _of_visit_alone
            yield Quantity(f"{name} of {one}", found[key], VISIT[key].unit, partial(because, trial, one))
        elif person or one in trial.approached:
            yield _missing(trial, name, one, VISIT[key].unit)


def _of_visit_alone(trial: Trial, person: str) -> Iterator[str]:
    return of_course(trial, person, moving=True)


def _of_stay(trial: Trial, person: str) -> Iterator[str]:
    """Of the longest stay beside somebody who was not visited then."""
    stay = worst_stay(trial, person)
    return of_moment(trial, stay) if stay else _of_visit_alone(trial, person)


def _of_docking(trial: Trial, name: str, person: str | None) -> Iterator[Quantity | Missing]:
    """When and where the robot stood, of each visit in which it came to that, or of one."""
    trial.require_goal(*((person,) if person else ()))
    for one in (person,) if person else trial.wanted:
        if (number := of_visit(trial, name, one)) is not None:
            at = None
            if name == DOCKING_ERROR and (stood := standing(trial, one)):
                because, at = partial(_of_docked, trial, one), Moment(stood.t)
            elif name == REACHED:  # the visits before take their time, too
                because = partial(of_course, trial, until=(one, number))
            else:
                because = partial(of_course, trial, one, moving=True)
            yield Quantity(f"{name} of {one}", number, OF_VISIT[name], because, at)
        elif person or one in trial.approached:
            yield _missing(trial, name, one, OF_VISIT[name])


def _missing(trial: Trial, name: str, person: str, unit: str | None) -> Missing:
    return Missing(
        f"{name} of {person}",
        unit,
        "none: nothing happened to measure it by",
        tuple(causes.of_visit(trial, person)),
    )


def _of_docked(trial: Trial, person: str) -> Iterator[str]:
    """Why the robot stood where it docked, and what the distance goes by."""
    visit, stood = trial.visit(person), standing(trial, person)
    docked_s = visit.docked_s if visit else None
    if stood is not None:
        target = trial.episode.values_at(person, stood.t)["conversational_distance"]
        target_m, actual_m = told_apart((target.number, stood.distance_m), "m")
        yield f"distance  target {target_m}, actual {actual_m}"
    yield from causes.of_node(trial, f"docked?({person})", "success", ended_s=docked_s)
    yield from causes.of_visit(trial, person)
    yield from causes.of_parameter(trial, "conversational_distance", person, docked_s)


def by_bare_name(definitions: Mapping[str, Definition]) -> dict[str, str]:
    """The metrics as sentences call them, without the unit, and with it."""
    bare = {key.removesuffix(_ENDS.get(each.unit, "")): key for key, each in definitions.items()}
    return bare | {key: key for key in definitions}
