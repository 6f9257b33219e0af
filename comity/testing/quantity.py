"""Numbers that a sentence may bound: of the plan, metrics of the episode, and parameters of people."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.testing import causes
from comity.testing.course import of_course
from comity_fis import InputError, closest
from comity_sim2d.metrics import EPISODE, VISIT, Definition, of_episode, of_person

if TYPE_CHECKING:
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


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of one case."""

    name: str
    number: float
    unit: str | None
    because: Callable[[], Iterable[str]]


def quantities(trial: Trial, name: str, person: str | None) -> Iterator[Quantity]:
    """Of the plan, a metric of the episode or of a visit, or a parameter of somebody or of all visited.

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
        yield from _metric(trial, name, of_all[name], found, name)
        return
    for one in (person,) if person else trial.wanted:
        if name in of_one:
            found = of_person(trial.episode.metrics, one)
            yield from _metric(trial, name, of_one[name], found, f"{name} of {one}")
            continue
        values = trial.values(one)
        require_parameter(name, values, (*PLAN, *of_all, *of_one))
        value = values[name]
        if isinstance(value.value, str):
            raise InputError(
                expected="a parameter that is a number",
                got=f"{name}, which is a word",
                remedy=f"Write `{name} is {value.value}`.",
            )
        yield Quantity(f"{name} of {one}", value.value, value.unit, _lines(values, name))


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


def _lines(values: Inference, name: str) -> Callable[[], Iterable[str]]:
    return lambda: causes.of_value(values, name)


def _metric(trial: Trial, name: str, key: str, found: Mapping[str, float], called: str) -> Iterator[Quantity]:
    """The metric, where it has a value in this episode."""
    if key in found:
        unit = {**EPISODE, **VISIT}[key].unit
        yield Quantity(called, found[key], unit, lambda: of_course(trial))


def _by_bare_name(definitions: Mapping[str, Definition]) -> dict[str, str]:
    """The metrics as sentences call them, without the unit, and with it."""
    bare = {key.removesuffix(_ENDS.get(each.unit, "")): key for key, each in definitions.items()}
    return bare | {key: key for key in definitions}
