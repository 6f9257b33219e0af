"""What was learnt in encounters with a person: the observations, and what follows from them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from datetime import date
from itertools import groupby
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag

from comity.people.dated import Day
from comity.people.fact import Fact, Number, Word
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import Learnt
from comity_fis.learning.signals import AWAY, SAID, SIGNALS, WORDS, Signal

if TYPE_CHECKING:
    from comity_fis.learning.comfort import ComfortPosterior


_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
_Metres = Annotated[Number, Field(ge=0, le=20)]


class _Dated(BaseModel):
    """An observation made on one day in one situation."""

    model_config = _FILE

    day: Day
    situation: Mapping[Word, Fact] = Field(
        description="What held then, by the name of a rulebook's variable."
    )
    model_m: _Metres = Field(description="What culture and situation alone gave then.")


class Observation(_Dated):
    """A person's reaction to the robot's approach, once."""

    distance_m: _Metres = Field(
        description="Where the robot stood, between the nearest points of the bodies."
    )
    signal: Signal
    simulated: bool = Field(
        default=False,
        description="True where a simulated person showed it: of `comity visits --keep`, or of a scenario "
        "that states their `comfort`.",
    )
    entry: Annotated[int, Field(strict=True, ge=1)] | None = Field(
        default=None,
        description="Number of the `comity profile observe` that wrote it down, so that it can be undone; "
        "none where a run saw it.",
    )

    @property
    def how(self) -> Literal["said", "seen"]:
        """Whether the person said it, or it was observed."""
        return "said" if self.signal in WORDS else "seen"

    def added_to(self, known: ComfortPosterior) -> ComfortPosterior:
        """The posterior of the person's comfort interval, updated by this."""
        return known.after(self.signal, self.distance_m - self.model_m)

    @property
    def caution(self) -> tuple[bool, str, float, float]:
        """Sort key within a day: the most cautious counts last, as a step back outweighs an invitation."""
        return self.signal in AWAY, self.signal, self.distance_m, self.model_m


class Stated(_Dated):
    """A person's answer to the question how near they like the robot, weighed like other observations."""

    likes_m: _Metres = Field(description="The distance that they named, between the bodies.")

    @property
    def how(self) -> Literal["said", "seen"]:
        """The person said it."""
        return "said"

    def added_to(self, known: ComfortPosterior) -> ComfortPosterior:
        """The posterior of the person's comfort interval, updated by this."""
        return known.after_answer(self.likes_m - self.model_m)

    @property
    def caution(self) -> tuple[bool, str, float, float]:
        """Sort key: between an invitation and a step back; the larger distance counts last."""
        return True, "", self.likes_m, self.model_m


def _kind(data: Any) -> str:
    """The type of a stored observation: only answers have a preferred distance."""
    asked = "likes_m" in data if isinstance(data, Mapping) else isinstance(data, Stated)
    return "stated" if asked else "shown"


Learning = Annotated[
    Annotated[Observation, Tag("shown")] | Annotated[Stated, Tag("stated")], Discriminator(_kind)
]
"""An observation: what a person showed, or answered when asked."""


class LearntFile(BaseModel):
    """`learnt.yaml`: all observations; what is learnt is computed from them and not stored."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, title="What Comity learnt with one person"
    )

    schema_version: Literal[1] = 1
    person: Word
    conversational_distance: tuple[Learning, ...] = ()

    def also(self, seen: Iterable[Learning]) -> LearntFile:
        """A copy with further observations."""
        return self.model_copy(update={DISTANCE: (*self.conversational_distance, *seen)})

    def with_entry(self, seen: Iterable[Observation]) -> LearntFile:
        """A copy with observations written down together, under the next entry number."""
        number = 1 + max((one.entry or 0 for one in self._shown), default=0)
        return self.also(one.model_copy(update={"entry": number}) for one in seen)

    @property
    def last_entry(self) -> tuple[Observation, ...]:
        """The observations written down last; empty if there are none."""
        number = max((one.entry or 0 for one in self._shown), default=0)
        return tuple(one for one in self._shown if number and one.entry == number)

    def without_last_entry(self) -> LearntFile:
        """A copy without the observations written down last."""
        last = self.last_entry
        left = tuple(one for one in self.conversational_distance if one not in last)
        return self.model_copy(update={DISTANCE: left})

    @property
    def _shown(self) -> Iterator[Observation]:
        return (one for one in self.conversational_distance if isinstance(one, Observation))

    def without_answers(self, situation: Mapping[str, object], day: date | None = None) -> LearntFile:
        """A copy without the person's answers in a situation, on one day or (None) on any."""
        kept = (
            one
            for one in self.conversational_distance
            if not (isinstance(one, Stated) and one.situation == situation and day in (None, one.day))
        )
        return self.model_copy(update={DISTANCE: tuple(kept)})

    def in_situation(self, situation: Mapping[str, object]) -> tuple[Learning, ...]:
        """The observations made in a situation: only they count there."""
        return tuple(seen for seen in self.conversational_distance if seen.situation == situation)


class LearntValue(BaseModel):
    """The learnt correction of one parameter, as stored in a run."""

    model_config = _FILE

    offset: Number = Field(description="From what culture and situation give, in the parameter's unit.")
    spread: Annotated[Number, Field(ge=0)]
    text: str

    def as_learnt(self) -> Learnt:
        """For use in inference."""
        return Learnt(self.offset, self.spread, self.text)


def comfort_on(day: date, observations: Iterable[Learning], spread: float) -> ComfortPosterior:
    """The posterior of a person's comfort interval on a day; it depends only on the arguments.

    The order of observations within one day does not matter: if they contradict each other, an invitation
    does not outweigh a step back.

    Args:
        day: Preferences drift until this day; later observations are ignored.
        observations: Observations in one situation, in any order.
        spread: Standard deviation between individuals around the model's value [m].
    """
    from comity_fis.learning.comfort import ComfortPosterior

    known, last = ComfortPosterior.before_meeting(spread), None
    in_order = sorted(
        (seen for seen in observations if seen.day <= day), key=lambda seen: (seen.day, seen.caution)
    )
    for then, seen_then in groupby(in_order, key=lambda seen: seen.day):
        known = known.later((then - last).days if last else 0)
        for seen in seen_then:
            known = seen.added_to(known)
        last = then
    return known.later((day - last).days if last else 0)


def learnt_on(day: date, observations: tuple[Learning, ...], spread: float) -> Learnt | None:
    """The correction of the model's value on a day; None without observations up to then."""
    seen = tuple(one for one in observations if one.day <= day)
    if not seen:
        return None
    known = comfort_on(day, seen, spread)
    return Learnt(float(known.offset), float(known.deviation), in_words(seen))


def in_words(learnt: Iterable[Learning]) -> str:
    """`4 visits, last on 2026-03-01: stepped back twice, showed nothing twice`, and the person's answers."""
    everything = tuple(learnt)
    shown = tuple(one for one in everything if isinstance(one, Observation))
    said = tuple(one for one in everything if isinstance(one, Stated))
    return "; ".join(([_shown_in_words(shown)] if shown else []) + ([_said_in_words(said)] if said else []))


def _shown_in_words(shown: tuple[Observation, ...]) -> str:
    times = {signal: sum(seen.signal == signal for seen in shown) for signal in SIGNALS}
    signals = ", ".join(f"{SAID[signal]}{_times(n)}" for signal in SIGNALS if (n := times[signal]))
    count, last = len(shown), max(seen.day for seen in shown)
    simulated = sum(seen.simulated for seen in shown)
    invented = f", {simulated} of them simulated" if simulated else ""
    return f"{count} visit{'s' if count > 1 else ''}{invented}, last on {last.isoformat()}: {signals}"


def _said_in_words(said: tuple[Stated, ...]) -> str:
    last = max(said, key=lambda one: (one.day, one.caution))
    day = last.day.isoformat()
    when = f"on {day}" if len(said) == 1 else f"{_times(len(said)).strip()}, last on {day},"
    return f"said {when} to like {last.likes_m:.2f} m best"


def _times(count: int) -> str:
    return {1: "", 2: " twice"}.get(count, f" {count} times")
