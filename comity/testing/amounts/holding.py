"""History of a parameter's values: a person may ask for another value during the episode."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

from comity.monitoring.parameter_updates import ParameterUpdate
from comity.testing.amounts.amount import told
from comity.testing.trials.visits import visit_of

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import Visit
    from comity_fis import Inference
    from comity_fis.inference.value import ParameterValue


def held(
    start: Inference, updates: Iterable[ParameterUpdate], parameter: str, person: str
) -> tuple[ParameterUpdate, ...]:
    """Every value of a person's parameter, in order of time; the initial one has no text."""
    found = [ParameterUpdate(0.0, person, start, "")]
    for one in updates:
        if one.person == person and _differ(one.values[parameter], found[-1].values[parameter]):
            found.append(one)
    return tuple(found)


def _differ(one: ParameterValue, other: ParameterValue) -> bool:
    return (one.value, one.origin) != (other.value, other.origin)


def of_time(episode: Episode, parameter: str, person: str, judged_s: float) -> Iterator[str]:
    """The values over time, and which one counts; nothing if the value never changed.

    Args:
        episode: What happened.
        parameter: Name of the parameter.
        person: Whose value.
        judged_s: When the value counts [s]; infinite for the end.
    """
    every = held(episode.prepared.values[person], episode.told, parameter, person)
    if len(every) > 1:
        for one in every:
            since = f"from t={one.t:.2f} s on: {one.text}" if one is not every[0] else "from the start"
            yield f"held      {_told(one.values[parameter])} {since}"
        yield f"counts    what held {_moment(episode.visits, person, judged_s)}"


def _told(value: ParameterValue) -> str:
    return f"{told(value.value, value.unit)} ({value.origin})"


def _moment(visits: Iterable[Visit], person: str, judged_s: float) -> str:
    if math.isinf(judged_s):
        return "in the end"
    visit = visit_of(visits, person)
    greeted = visit is not None and visit.greeted_s == judged_s
    docked = visit is not None and visit.docked_s == judged_s
    what = f", when {person} was greeted" if greeted else ", when the robot had docked" if docked else ""
    return f"at t={judged_s:.2f} s{what}"
