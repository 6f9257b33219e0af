"""Contact needs consent: what `touch: none` rules out, and wishes for contact that rest without it.

In a meeting, consent is what the person says there. What their profile says was said on another day and to
another person: it is shown by `infer` and `explain`, and moves no hand.
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
"""By parameter."""

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
"""Gestures of contact by name, as far as that is certain: a rulebook that has one requires consent for it."""


def in_this_meeting(
    situation: Mapping[str, Fact | Interval | None], profile: Profile, day: date | None
) -> tuple[dict[str, Fact | Interval | None], tuple[str, ...]]:
    """What holds here and now, without a consent to touch that the profile alone states; and a note of that.

    Args:
        situation: What is said to hold here and now, by variable.
        profile: What the person declared.
        day: On which dated facts are taken.
    """
    if CONSENT in situation or profile.facts(day).get(CONSENT) != "given":
        return dict(situation), ()
    return {**situation, CONSENT: UNKNOWN}, (STORED_NOTE,)


def refuse_unguarded_contact(rulebook: Rulebook) -> None:
    """Refuse a rulebook that lets the robot touch people who did not consent.

    Raises:
        InputError: for the first gesture of contact without the requirement.
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
    """The gestures of a rulebook that need consent to touch."""
    return frozenset(
        category.name
        for category in _gestures(rulebook)
        if category.requires and any(is_.name == CONSENT for is_ in literals(category.requires))
    )


def _gestures(rulebook: Rulebook) -> tuple[Category, ...]:
    gesture = rulebook.parameters.get("greeting_gesture")
    return gesture.categories if isinstance(gesture, NominalParameter) else ()


def asks_for_no_touch(wishes: Wishes, rulebook: Rulebook) -> bool:
    """Whether a person asked not to be touched, of whom a rulebook could otherwise think they consent."""
    return wishes.get(TOUCH) == NO_TOUCH and CONSENT in rulebook.variables


def asked_for_no_touch(values: Inference) -> bool:
    """Whether a person's values were inferred so."""
    return NO_TOUCH_NOTE in values.notes


def refuse_contact_without_touch(wishes: Wishes, rulebook: Rulebook) -> None:
    """Refuse wishes of which one could only be dropped: a gesture of contact, and no touch.

    Raises:
        InputError: where both are asked for.
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
    """The wishes whose requirement is not met, above all consent, with what was wished for.

    Consent can be withdrawn, or not be disclosed, at any time. What was wished for then rests until it is
    given again; it is no error, and the rules speak instead.

    Args:
        wishes: Those that the rulebook judges.
        people: The inputs of the person in each of their cultures; a wish is met in all of them or rests.
        rulebook: The rules.
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
    """What is said of a wish that rests."""
    requirement = str(category.requires).replace("_", " ")
    return (
        f"{name} {category.name}: {_RESTS}, because it requires that {requirement}, which is not known or "
        "not so; state it once they say so, of a meeting in its scenario."
    )


_RESTS = "it was asked for and rests"


def wishes_at_rest(values: Inference) -> dict[str, str]:
    """What a person asked for and cannot have now, with why, by parameter."""
    resting = (note for note in values.notes if f": {_RESTS}, " in note)
    return {note.split(" ", 1)[0]: note.replace("_", " ").rstrip(".") for note in resting}


def refuse_resting(asked: Iterable[str], rests: Mapping[str, Category]) -> None:
    """Refuse to promise a person what could not be granted on the day on which they ask for it.

    Args:
        asked: The parameters that they ask for now.
        rests: What rests, with why.

    Raises:
        InputError: for the first that would rest.
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
    """The categories asked for that require something, by parameter."""
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
