"""What meetings with one person taught: the observations themselves, and what follows from them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from datetime import date
from itertools import groupby
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field

from comity.dated import Day
from comity.fact import Fact, Number, Word
from comity_fis import Learnt
from comity_fis.signal import AWAY, SAID, SIGNALS, Signal

if TYPE_CHECKING:
    from comity_fis.comfort import Comfort

PARAMETER = "conversational_distance"
"""What is learnt about, so far."""

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
_Metres = Annotated[Number, Field(ge=0, le=20)]


class Observation(BaseModel):
    """How a person took the robot's coming, once."""

    model_config = _FILE

    day: Day
    situation: Mapping[Word, Fact] = Field(
        description="What held then, by the name of a rulebook's variable."
    )
    model_m: _Metres = Field(description="What culture and situation alone gave then.")
    distance_m: _Metres = Field(
        description="Where the robot stood, between the nearest points of the bodies."
    )
    signal: Signal
    simulated: bool = Field(
        default=False, description="True where a simulated person of `comity visits --keep` showed it."
    )


class LearntFile(BaseModel):
    """`learnt.yaml`: every observation; what is learnt is computed from them and stands nowhere."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, title="What Comity learnt with one person"
    )

    schema_version: Literal[1] = 1
    person: Word
    conversational_distance: tuple[Observation, ...] = ()

    def also(self, seen: Iterable[Observation]) -> LearntFile:
        """The same with further observations."""
        return self.model_copy(update={PARAMETER: (*self.conversational_distance, *seen)})

    def in_situation(self, situation: Mapping[str, object]) -> tuple[Observation, ...]:
        """The observations that were made in a situation: only those count there."""
        return tuple(seen for seen in self.conversational_distance if seen.situation == situation)


class LearntValue(BaseModel):
    """What was learnt about one parameter, as a run embeds it."""

    model_config = _FILE

    offset: Number = Field(description="From what culture and situation give, in the parameter's unit.")
    spread: Annotated[Number, Field(ge=0)]
    text: str

    def as_learnt(self) -> Learnt:
        """For the inference."""
        return Learnt(self.offset, self.spread, self.text)


def comfort_on(day: date, observations: Iterable[Observation], spread: float) -> Comfort:
    """What is known of a person's comfort interval on a day; it depends on nothing else.

    Observations of one day count alike in whatever order they stand: where they contradict each other, an
    invitation does not outweigh a step back.

    Args:
        day: Preferences drift until then; what was observed later is left out.
        observations: In one situation, in any order.
        spread: Of people around the model's value [m].
    """
    from comity_fis.comfort import Comfort

    known, last = Comfort.before_meeting(spread), None
    in_order = sorted((seen for seen in observations if seen.day <= day), key=_by_day_and_caution)
    for then, seen_then in groupby(in_order, key=lambda seen: seen.day):
        known = known.later((then - last).days if last else 0)
        for seen in seen_then:
            known = known.after(seen.signal, seen.distance_m - seen.model_m)
        last = then
    return known.later((day - last).days if last else 0)


def learnt_on(day: date, observations: tuple[Observation, ...], spread: float) -> Learnt | None:
    """What is added to the model's value on a day; None where the person was never observed until then."""
    seen = tuple(one for one in observations if one.day <= day)
    if not seen:
        return None
    known = comfort_on(day, seen, spread)
    return Learnt(float(known.offset), float(known.deviation), in_words(seen))


def in_words(observations: tuple[Observation, ...]) -> str:
    """`4 visits, last on 2026-03-01: stepped back twice, showed nothing twice`."""
    times = {signal: sum(seen.signal == signal for seen in observations) for signal in SIGNALS}
    shown = ", ".join(f"{SAID[signal]}{_times(n)}" for signal in SIGNALS if (n := times[signal]))
    count = len(observations)
    last = max(seen.day for seen in observations)
    simulated = sum(seen.simulated for seen in observations)
    invented = f", {simulated} of them simulated" if simulated else ""
    return f"{count} visit{'s' if count > 1 else ''}{invented}, last on {last.isoformat()}: {shown}"


def _times(count: int) -> str:
    return {1: "", 2: " twice"}.get(count, f" {count} times")


def _by_day_and_caution(seen: Observation) -> tuple[date, bool, str, float, float]:
    return seen.day, seen.signal in AWAY, seen.signal, seen.distance_m, seen.model_m
