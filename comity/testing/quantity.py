"""Numbers that a sentence may bound: of the plan, metrics of the episode, ways, and parameters of people."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.testing import causes
from comity.testing.course import of_course
from comity.testing.whereabouts import OF_VISIT, REACHED, WALKED, of_visit, walked_m
from comity_fis import InputError, closest
from comity_sim2d.metrics import EPISODE, VISIT, Definition, of_episode, of_person

if TYPE_CHECKING:
    from comity.testing.amount import Amount
    from comity.testing.trial import Trial
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
_EITHER_SIGN = ("min_clearance_m", "stop_distance_error_m", "bearing_error_deg")
"""Metrics that may be less than nothing: a gap where bodies overlap, errors to either side."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of one case."""

    name: str
    number: float
    unit: str | None
    because: Callable[[], Iterable[str]]


def quantities(trial: Trial, name: str, person: str | None) -> Iterator[Quantity]:
    """Of the plan, the episode or a visit, how far people went, or a parameter of somebody or of all visited.

    Raises:
        InputError: if there is no such number.
    """
    of_all, of_one = _by_bare_name(EPISODE), _by_bare_name(VISIT)
    if name in PLAN and person is None:
        plan = trial.prepared.plan
        number = plan.cost / 100.0 if name == "plan_cost" else plan.gap
        yield Quantity(name, number, PLAN[name], lambda: of_course(trial))
        return
    if name in of_all and person is None:
        found = of_episode(trial.episode.metrics)
        if of_all[name] in found:
            unit = EPISODE[of_all[name]].unit
            yield Quantity(name, found[of_all[name]], unit, lambda: of_course(trial))
        return
    if name == WALKED:
        told = f"{name} of {person}" if person else name
        yield Quantity(told, walked_m(trial, person), "m", lambda: of_course(trial))
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
        values = trial.values(one)
        require_parameter(name, values, (*PLAN, WALKED, *OF_VISIT, *of_all, *of_one))
        value = values[name]
        if isinstance(value.value, str):
            raise InputError(
                expected="a parameter that is a number",
                got=f"{name}, which is a word",
                remedy=f"Write `{name} is {value.value}`.",
            )
        yield Quantity(f"{name} of {one}", value.value, value.unit, _lines(values, name, one))


def require_possible(name: str, most: Amount) -> None:
    """Refuse that something is at most less than nothing, where it never is.

    Raises:
        InputError: if nothing can fulfil that.
    """
    metrics = {**_by_bare_name(EPISODE), **_by_bare_name(VISIT)}
    sizes = (*PLAN, WALKED, REACHED, *(each for each, key in metrics.items() if key not in _EITHER_SIGN))
    if most.number < 0 and name in sizes:
        raise InputError(
            expected=f"0 or more: {name} is never less",
            got=str(most),
            remedy="Leave the minus out, or write another sentence.",
        )


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


def _lines(values: Inference, name: str, whose: str) -> Callable[[], Iterable[str]]:
    return lambda: causes.of_value(values, name, whose)


def _of_visits(trial: Trial, name: str, key: str, person: str | None) -> Iterator[Quantity]:
    """A metric of each visit, or of one, where it has a value in this episode."""
    trial.require_goal(*((person,) if person else ()))
    for one in (person,) if person else trial.wanted:
        found = of_person(trial.episode.metrics, one)
        if key in found:
            yield Quantity(f"{name} of {one}", found[key], VISIT[key].unit, _course(trial, one))


def _of_docking(trial: Trial, name: str, person: str | None) -> Iterator[Quantity]:
    """When and where the robot stood, of each visit in which it came to that, or of one."""
    trial.require_goal(*((person,) if person else ()))
    for one in (person,) if person else trial.wanted:
        if (number := of_visit(trial, name, one)) is not None:
            of_whom = None if name == REACHED else one  # the visits before take their time, too
            yield Quantity(f"{name} of {one}", number, OF_VISIT[name], _course(trial, of_whom))


def _course(trial: Trial, person: str | None) -> Callable[[], Iterable[str]]:
    return lambda: of_course(trial, person)


def _by_bare_name(definitions: Mapping[str, Definition]) -> dict[str, str]:
    """The metrics as sentences call them, without the unit, and with it."""
    bare = {key.removesuffix(_ENDS.get(each.unit, "")): key for key, each in definitions.items()}
    return bare | {key: key for key in definitions}
