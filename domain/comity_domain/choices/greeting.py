"""The possible greetings of a person: desirability of each, and reasons against excluded ones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import product

from comity_domain.choices.earshot import drowned, unheard
from comity_domain.choices.ties import tie_break
from comity_domain.problem.circumstances import QUIET_AND_FREE, Circumstances
from comity_domain.problem.setting import is_setting
from comity_fis.defuzzification.curve import Choice
from comity_fis.errors import InputError
from comity_fis.inference.value import Inference, ParameterValue

VERBAL, GESTURAL, BOTH = "verbal", "gestural", "both"
NO_GESTURE = "none"


@dataclass(frozen=True, slots=True)
class Greeting:
    """A modality with its gesture."""

    modality: str
    gesture: str
    """The gesture; `none` if the greeting is words only."""
    desirability: float
    """The smaller desirability of modality and gesture, in [0, 1] (the rules' own "and" is the minimum)."""
    departures: int
    """Number of the two that differ from the inferred value, 0 to 2; a gesture with inferred words is
    none."""
    unusual: int = 0
    """Number of the two that differ from the neutral value, 0 to 2."""

    @property
    def tie_break(self) -> int:
        """Tie-break between plans of equal cost, see `ties`."""
        return tie_break(self.desirability, self.departures)

    @property
    def rank(self) -> tuple[int, int, str, str]:
        """Tie-break between greetings of equal cost; the smallest is chosen."""
        return (self.tie_break, self.unusual, self.modality, self.gesture)

    @property
    def way(self) -> tuple[str, str]:
        """Modality and gesture, independent of the person."""
        return self.modality, self.gesture

    @property
    def words(self) -> str:
        """The greeting in words."""
        return self.modality if self.gesture == NO_GESTURE else f"{self.modality} with {self.gesture}"


def greetings(values: Inference, now: Circumstances = QUIET_AND_FREE) -> tuple[Greeting, ...]:
    """The greetings currently possible for a person, the inferred one first.

    Words alone have no gesture. For a person who asked for a gesture but not for a modality, the words stay
    and the gesture is added: `both` is then as desirable as the words are.
    """
    return tuple(greeting for greeting, reason in _all(values, now).items() if reason is None)


def ruled_out(values: Inference, now: Circumstances = QUIET_AND_FREE) -> Mapping[Greeting, str]:
    """Excluded greetings of the rulebook that the person did not exclude themselves, with the reasons."""
    return {greeting: reason for greeting, reason in _all(values, now).items() if reason is not None}


def _all(values: Inference, now: Circumstances) -> dict[Greeting, str | None]:
    """Every greeting, the inferred one first, with the reason against it now, if any."""
    modality, gesture = values["greeting_modality"], values["greeting_gesture"]
    modalities, gestures = _permitted(modality), _permitted(gesture)
    inferred = modality.value
    if keeps_words(values):
        modalities[BOTH] = max(modalities[BOTH], modalities[VERBAL])
        inferred = BOTH if inferred == VERBAL else inferred
    if not is_setting(gesture):
        gestures |= dict.fromkeys(now.withheld, 0.0)
    pairs = [pair for pair in product(modalities, gestures) if pair[0] != VERBAL]
    if VERBAL in modalities and (is_setting(modality) or not is_setting(gesture)):
        pairs.insert(0, (VERBAL, NO_GESTURE))
    found = [
        Greeting(
            m,
            g,
            desirability=min(modalities[m], gestures.get(g, 1.0)),
            departures=(m != inferred) + (g not in (gesture.value, NO_GESTURE)),
            unusual=(m != modality.neutral) + (g not in (gesture.neutral, NO_GESTURE)),
        )
        for m, g in pairs
    ]
    found.sort(key=lambda greeting: (greeting.departures, greeting.modality != inferred))
    against = _against_each(found, now, drowned(values, now))
    if None in against.values():
        return against
    return _against_each(found, now, unheard(values, now))


def keeps_words(values: Inference) -> bool:
    """Whether a requested gesture is combined with the inferred words."""
    modality, gesture = values["greeting_modality"], values["greeting_gesture"]
    if is_setting(modality) or not is_setting(gesture):
        return False
    return _permitted(modality).keys() >= {VERBAL, BOTH}


def _against_each(
    found: list[Greeting], now: Circumstances, silent: str | None
) -> dict[Greeting, str | None]:
    return {
        greeting: _against(greeting, now, None if greeting.modality == GESTURAL else silent)
        for greeting in found
    }


def _against(greeting: Greeting, now: Circumstances, silent: str | None) -> str | None:
    speaks, shows = greeting.modality != GESTURAL, greeting.gesture != NO_GESTURE
    unnoticed = now.against_modality(speaks=speaks, shows=shows)
    against = (now.against_gesture(greeting.gesture), silent, unnoticed, now.against_coming())
    reasons = [reason for reason in (*against, now.hits.get(greeting.gesture)) if reason]
    return ", and ".join(reasons) or None


def refuse_gesture_in_words(settings: Mapping[str, float | str]) -> None:
    """Reject contradictory wishes: a gesture together with greetings in words alone.

    Args:
        settings: The person's requests, by parameter.

    Raises:
        InputError: If both are requested.
    """
    gesture = settings.get("greeting_gesture")
    if gesture is not None and settings.get("greeting_modality") == VERBAL:
        raise InputError(
            expected="a gesture only in greetings that are not words alone",
            got=f"greeting_gesture: {gesture} with greeting_modality: {VERBAL}",
            remedy="Ask for `greeting_modality: both`, or for no gesture.",
        )


def _permitted(value: ParameterValue) -> dict[str, float]:
    if is_setting(value):
        return {value.word: 1.0}
    if not isinstance(value.desirability, Choice):
        raise TypeError(f"{value.name} is numeric: it needs a desirability per category")
    return dict(value.desirability.memberships)
