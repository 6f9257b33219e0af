"""The ways to greet a person: how suitable each is, and what rules the others out."""

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
    """A modality, and the gesture that goes with it."""

    modality: str
    gesture: str
    """`none` where the greeting is words only."""
    desirability: float
    """The lesser of the modality's and the gesture's, in [0, 1] (the minimum is the rules' own "and")."""
    departures: int
    """How many of the two differ from the inferred value, 0 to 2. A gesture with inferred words is none."""
    unusual: int = 0
    """How many of the two differ from the neutral value, 0 to 2."""

    @property
    def tie_break(self) -> int:
        """What decides between plans of equal cost, as `ties` says."""
        return tie_break(self.desirability, self.departures)

    @property
    def rank(self) -> tuple[int, int, str, str]:
        """What decides between greetings of equal cost; the least one is chosen."""
        return (self.tie_break, self.unusual, self.modality, self.gesture)

    @property
    def way(self) -> tuple[str, str]:
        """What is done, for any person."""
        return self.modality, self.gesture

    @property
    def words(self) -> str:
        """As a reader says it."""
        return self.modality if self.gesture == NO_GESTURE else f"{self.modality} with {self.gesture}"


def greetings(values: Inference, now: Circumstances = QUIET_AND_FREE) -> tuple[Greeting, ...]:
    """The greetings that are possible for a person now, the inferred one first.

    Words alone take no gesture. For a person who asked for a gesture and not for a modality, the words stay
    and the gesture comes with them: `both` is then as desirable as the words are.
    """
    return tuple(greeting for greeting, reason in _all(values, now).items() if reason is None)


def ruled_out(values: Inference, now: Circumstances = QUIET_AND_FREE) -> Mapping[Greeting, str]:
    """The other greetings of the rulebook that the person did not exclude, with what is against each."""
    return {greeting: reason for greeting, reason in _all(values, now).items() if reason is not None}


def _all(values: Inference, now: Circumstances) -> dict[Greeting, str | None]:
    """Every greeting, the inferred one first, with what is against it now."""
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
    """Whether a gesture that the person asked for comes with the words that were inferred for them."""
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
    """Refuse wishes of which one could only be dropped: a gesture, in greetings of words alone.

    Args:
        settings: What a person asked for, by parameter.

    Raises:
        InputError: where both are asked for.
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
