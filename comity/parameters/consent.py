"""Consent to contact: what `touch: none` excludes, and settings suspended without consent.

In an encounter, consent is what the person says there. The consent in a profile was given on another day to
someone else: `infer` and `explain` show it, but the robot does not act on it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from comity.people.dated import UNKNOWN
from comity_fis import Choice, InputError, NominalParameter
from comity_fis.rules.rule import literals

if TYPE_CHECKING:
    from datetime import date

    from comity.people.fact import Fact
    from comity.people.profile import Profile
    from comity_fis import Inference, Interval, Rulebook
    from comity_fis.rulebook.rulebook import Inputs
    from comity_fis.variables.parameter import Category

Wishes = Mapping[str, float | str]
"""Settings by parameter."""

CONSENT = "touch_consent"
TOUCH, NO_TOUCH = "touch", "none"
NO_TOUCH_NOTE = (
    "touch none: it was asked for, so that consent to touch counts as withheld, whatever was said."
)


STORED_NOTE = (
    "touch consent: given in the profile, and not in this meeting, where only `situation: {touch_consent: "
    "given}`, or an operator's `consents`, counts."
)
TOUCHING = frozenset(
    {
        "cheek_kiss",
        "elbow_bump",
        "embrace",
        "fist_bump",
        "hand_kiss",
        "handshake",
        "high_five",
        "hug",
        "kiss",
        "pat",
        "shake_hands",
        "touch",
    }
)
"""Names of gestures of contact, as far as they are unambiguous: rulebooks must require consent for them."""


def in_this_meeting(
    situation: Mapping[str, Fact | Interval | None], profile: Profile, day: date | None
) -> tuple[dict[str, Fact | Interval | None], tuple[str, ...]]:
    """The current situation, without a consent to touch stated only in the profile; and a note on that.

    Args:
        situation: Facts stated for the encounter, by variable.
        profile: The person's profile.
        day: Day of dated facts.
    """
    if CONSENT in situation or profile.facts(day).get(CONSENT) != "given":
        return dict(situation), ()
    return {**situation, CONSENT: UNKNOWN}, (STORED_NOTE,)


def refuse_unguarded_contact(rulebook: Rulebook) -> None:
    """Reject a rulebook that lets the robot touch people without consent.

    Raises:
        InputError: With the first gesture of contact that lacks the requirement.
    """
    guarded = gestures_of_contact(rulebook)
    for category in _gestures(rulebook):
        if category.name in TOUCHING - guarded:
            raise InputError(
                expected=f"consent to touch as a requirement of greeting_gesture {category.name}",
                got="none",
                remedy=f"Write `requires: {{{category.name}: touch_consent is given}}` for greeting_gesture, "
                "with a variable touch_consent of the categories given and withheld.",
            )


def gestures_of_contact(rulebook: Rulebook) -> frozenset[str]:
    """Gestures of a rulebook that require consent to touch."""
    return frozenset(
        category.name
        for category in _gestures(rulebook)
        if category.requires and any(is_.name == CONSENT for is_ in literals(category.requires))
    )


def _gestures(rulebook: Rulebook) -> tuple[Category, ...]:
    gesture = rulebook.parameters.get("greeting_gesture")
    return gesture.categories if isinstance(gesture, NominalParameter) else ()


def asks_for_no_touch(wishes: Wishes, rulebook: Rulebook) -> bool:
    """Whether a person asked not to be touched, where the rulebook could assume consent."""
    return wishes.get(TOUCH) == NO_TOUCH and CONSENT in rulebook.variables


def asked_for_no_touch(values: Inference) -> bool:
    """Whether the values were inferred with a request not to be touched."""
    return NO_TOUCH_NOTE in values.notes


def refuse_contact_without_touch(wishes: Wishes, rulebook: Rulebook) -> None:
    """Reject contradictory settings: a gesture of contact together with no touch.

    Raises:
        InputError: Both are set.
    """
    if wishes.get(TOUCH) != NO_TOUCH:
        return
    for name, category in _guarded(wishes, rulebook).items():
        needed = literals(category.requires) if category.requires else ()
        if name != TOUCH and any(is_.name == CONSENT for is_ in needed):
            raise InputError(
                expected=f"no wish for contact beside {TOUCH}: {NO_TOUCH}",
                got=f"{name}: {category.name} with {TOUCH}: {NO_TOUCH}",
                remedy=f"Ask for another {name}, or take the wish about {TOUCH} back.",
            )


def resting(wishes: Wishes, people: Iterable[Inputs], rulebook: Rulebook) -> dict[str, Category]:
    """Settings whose requirement, usually consent, is not met, each with the requested category.

    Consent can be withdrawn or unknown at any time. Such a setting is then suspended until consent is given
    again; this is not an error, and the rules decide instead.

    Args:
        wishes: Settings that the rulebook defines.
        people: Inputs of the person in each of their cultures; the requirement must be met in all of them.
        rulebook: The rulebook.
    """
    guarded = _guarded(wishes, rulebook)
    if not guarded:
        return {}
    others = {name: wish for name, wish in wishes.items() if name not in guarded}
    answers = [rulebook.infer(inputs, settings=others) for inputs in people]
    return {
        name: category
        for name, category in guarded.items()
        if not all(_permits(answer, name, category.name) for answer in answers)
    }


def note_of_rest(name: str, category: Category) -> str:
    """A note about a suspended setting."""
    requirement = str(category.requires).replace("_", " ")
    return (
        f"{name} {category.name}: {_RESTS}, because it requires that {requirement}, which is not known or "
        "not so; state it once they say so, of a meeting in its scenario."
    )


_RESTS = "it was asked for and rests"


def wishes_at_rest(values: Inference) -> dict[str, str]:
    """Suspended settings of a person, each with the reason, by parameter."""
    resting = (note for note in values.notes if f": {_RESTS}, " in note)
    return {note.split(" ", 1)[0]: note.replace("_", " ").rstrip(".") for note in resting}


def refuse_resting(asked: Iterable[str], rests: Mapping[str, Category]) -> None:
    """Reject a new setting that could not be granted on the day it is made.

    Args:
        asked: Parameters of the new settings.
        rests: Settings that would be suspended, with their categories.

    Raises:
        InputError: With the first setting that would be suspended.
    """
    for name in asked:
        if name in rests:
            raise InputError(
                expected=f"`{rests[name].requires}` before {name} can be {rests[name].name}",
                got="a person of whom that is not known or not so",
                remedy="State it if the person said so; what is not disclosed, above all consent, is never "
                "presumed.",
            )


def _guarded(wishes: Wishes, rulebook: Rulebook) -> dict[str, Category]:
    """The requested categories that have a requirement, by parameter."""
    return {
        name: category
        for name, wish in wishes.items()
        if isinstance(parameter := rulebook.parameters.get(name), NominalParameter)
        for category in parameter.categories
        if category.name == wish and category.requires is not None
    }


def _permits(answer: Inference, name: str, category: str) -> bool:
    desirability = answer[name].desirability
    return isinstance(desirability, Choice) and category in desirability.memberships
