"""Numbers that a sentence may bound: metrics of the episode, and parameters of people."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from comity.testing import causes
from comity_fis import InputError, closest
from comity_sim2d import Metrics

if TYPE_CHECKING:
    from comity.testing.trial import Trial
    from comity_fis import Inference

_UNITS = {"_m_s": "m/s", "_m": "m", "_s": "s", "_deg": "deg"}
"""By the end of a metric's name."""


@dataclass(frozen=True, slots=True)
class Quantity:
    """One number of one case."""

    name: str
    number: float
    unit: str | None
    because: Callable[[], Iterable[str]]


def metric_names() -> Sequence[str]:
    """The metrics as sentences call them, without the unit."""
    return [_bare(field.name)[0] for field in fields(Metrics)]


def quantities(trial: Trial, name: str, person: str | None) -> Iterator[Quantity]:
    """A metric, or a parameter of one person or of everybody who is to be visited.

    Raises:
        InputError: if there is no such number.
    """
    metrics = {_bare(field.name)[0]: field.name for field in fields(Metrics)}
    key = _bare(name)[0] if name not in metrics else name
    if key in metrics and person is None:
        yield _metric(trial, metrics[key])
        return
    for one in (person,) if person else trial.wanted:
        values = trial.values(one)
        require_parameter(name, values, metrics)
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


def _metric(trial: Trial, field: str) -> Quantity:
    name, unit = _bare(field)
    number = float(getattr(trial.episode.metrics, field))
    return Quantity(name, number, unit, lambda: _of_plan(trial))


def _of_plan(trial: Trial) -> Iterator[str]:
    for step in trial.prepared.plan.steps:
        yield f"step      {step.action}({', '.join(step.arguments)}), cost {step.cost}"


def _bare(name: str) -> tuple[str, str | None]:
    """A metric's name without its unit, and the unit."""
    for end, unit in _UNITS.items():
        if name.endswith(end):
            return name.removesuffix(end), unit
    return name, None
