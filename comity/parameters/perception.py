"""Hearing and sight of a person: how they can be greeted, and from where the robot approaches.

A person who cannot hear is approached only within view, and never greeted in words alone. A person who cannot
see is never greeted by a gesture alone, and is told when the robot approaches, stops and leaves. These are
our own choices and have not been tested with people.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from types import MappingProxyType
from typing import TYPE_CHECKING

from comity.people.dated import held
from comity_domain import Say
from comity_fis import Choice, Contribution, InputError, Interval
from comity_fis.defuzzification.moved_curve import MovedCurve
from comity_fis.proxemics import FACES_DEG

if TYPE_CHECKING:
    from comity.people.profile import Profile
    from comity_domain import Task
    from comity_fis import Inference

NOT_HEARING = frozenset({"none", "no", "deaf", "deafblind"})
NOT_SEEING = frozenset({"none", "no", "blind", "deafblind"})
"""Words that exclude an option; any other, such as `impaired`, excludes nothing."""
WORDS_READ: Mapping[str, frozenset[str]] = MappingProxyType({"hearing": NOT_HEARING, "sight": NOT_SEEING})
NOTHING: Mapping[str, object] = MappingProxyType({})
HEARING, SIGHT = "hearing", "sight"
DIRECTION, MODALITY = "approach_direction", "greeting_modality"
NOTE_OF_DEAF = "does not hear: never greeted in words alone, and approached within view or not at all"
NOTE_OF_BLIND = (
    "does not see: never greeted by a gesture alone, and told in words when the robot comes, stops and leaves"
)
NOTE_OF_SAY = "does not hear what the robot is to say to them: tell them in another way, too"
NOTE_OF_DEAFBLIND = "neither hears nor sees: no act that is shipped reaches them; let a person go instead"


def hears(profile: Profile, day: date | None, told: Mapping[str, object] = NOTHING) -> bool:
    """Whether a person hears, as far as stated.

    Args:
        profile: The person's profile.
        day: The day in question.
        told: Facts stated for the encounter, which take precedence over the profile.
    """
    return _word(told.get("hearing", profile.hearing), day) not in NOT_HEARING


def sees(profile: Profile, day: date | None, told: Mapping[str, object] = NOTHING) -> bool:
    """Whether a person sees, as far as stated; arguments as for `hears`."""
    return _word(told.get("sight", profile.sight), day) not in NOT_SEEING


def lacks_hearing(values: Inference) -> bool:
    """Whether a person cannot hear, by the inputs of their inference, which include facts stated later."""
    return is_read(HEARING, values.inputs.get(HEARING, ""))


def lacks_sight(values: Inference) -> bool:
    """The same for sight."""
    return is_read(SIGHT, values.inputs.get(SIGHT, ""))


def is_read(name: str, fact: object) -> bool:
    """Whether a fact states that a person cannot hear or see."""
    return str(fact).strip().casefold() in WORDS_READ.get(name, ())


def hint_of(names: Iterable[str]) -> str:
    """Words that have an effect, as the end of a note about facts without effect; empty for other facts.

    Args:
        names: Names of the facts.
    """
    return "".join(
        f" Of {name} only the words {', '.join(sorted(WORDS_READ[name]))} count: write `none` for no {name}."
        for name in names
        if name in WORDS_READ
    )


@dataclass(frozen=True, slots=True)
class Clash:
    """A setting that cannot be met for a person who cannot hear or see."""

    said: str
    """The fact and the setting, in words."""
    why: str
    remedy: str

    @property
    def words(self) -> str:
        """The clash as a reason or a note."""
        return f"{self.said}: {self.why}. {self.remedy}"


def clash_of(wishes: Mapping[str, object], *, hears: bool, sees: bool) -> Clash | None:
    """The first setting that a person's perception makes impossible, or None.

    For a person who can neither hear nor see no setting is to blame: no act reaches them.

    Args:
        wishes: Settings by parameter.
        hears: Whether they hear.
        sees: Whether they see.
    """
    if hears == sees:
        return None
    sense, other, alone = (HEARING, "gestural", "verbal") if not hears else (SIGHT, "verbal", "gestural")
    if wishes.get(MODALITY) == alone:
        remedy = f"Ask for `{MODALITY}: both` or `{other}`, or take one of the two back."
        return Clash(f"{sense}: none with {MODALITY}: {alone}", "no greeting would be noticed", remedy)
    direction = wishes.get(DIRECTION)
    if not hears and isinstance(direction, float | int) and direction > FACES_DEG:
        why = f"the robot comes to who does not hear only within {FACES_DEG:g} deg of where they face"
        remedy = f"Ask for `{DIRECTION}: {FACES_DEG:g}` or less, or take one of the two back."
        return Clash(f"{sense}: none with {DIRECTION}: {direction:g}", why, remedy)
    return None


def wishes_of(values: Inference) -> dict[str, object]:
    """A person's explicit settings, by parameter."""
    return {name: value.value for name, value in values.parameters.items() if value.asked_for}


def refuse_clash(profile: Profile, day: date | None) -> None:
    """Reject a setting that a person's hearing and sight make impossible.

    Raises:
        InputError: With both facts and the remedy.
    """
    clash = clash_of(profile.settings, hears=hears(profile, day), sees=sees(profile, day))
    if clash is not None:
        raise InputError(expected=f"wishes that can be met: {clash.why}", got=clash.said, remedy=clash.remedy)


def perceiving(
    values: Inference, profile: Profile, day: date | None, told: Mapping[str, object] = NOTHING
) -> Inference:
    """A person's parameters adapted to their hearing and sight, which are added to the inputs.

    Args:
        values: The inferred parameters.
        profile: The person's profile.
        day: The day in question.
        told: Facts stated for the encounter.
    """
    hearing, seeing = hears(profile, day, told), sees(profile, day, told)
    if hearing and seeing:
        return values
    note = NOTE_OF_DEAFBLIND if not (hearing or seeing) else NOTE_OF_BLIND if hearing else NOTE_OF_DEAF
    clash = clash_of(wishes_of(values), hears=hearing, sees=seeing)
    lacking = {name: "none" for name, has in ((HEARING, hearing), (SIGHT, seeing)) if not has}
    notes = (*values.notes, note, *([clash.words] if clash else []))
    values = replace(values, inputs={**values.inputs, **lacking}, notes=notes)
    return values if hearing else _within_view(values)


def notes_of_unheard(values: Inference, agenda: Sequence[Task]) -> tuple[str, ...]:
    """A note if the agenda has speech for a person who cannot hear.

    Args:
        values: The person's parameters, from `perceiving`.
        agenda: Tasks of the visit.
    """
    is_unheard = lacks_hearing(values) and any(isinstance(task, Say) for task in agenda)
    return (NOTE_OF_SAY,) if is_unheard else ()


def _within_view(values: Inference) -> Inference:
    """The parameters without directions from which the robot is not seen; a setting for one stays, unmet."""
    direction = values.parameters.get(DIRECTION)
    if direction is None or isinstance(direction.desirability, Choice):
        return values
    curve = MovedCurve(direction.desirability, 0.0, Interval(0.0, FACES_DEG))
    seen = replace(direction, desirability=curve)
    if not direction.asked_for and (over := direction.number - FACES_DEG) > 0.0:
        text = f"they do not hear: the robot comes within {FACES_DEG:g} deg of where they face"
        parts = (*direction.contributions, Contribution("safety", -over, text))
        seen = replace(seen, value=FACES_DEG, origin="safety", contributions=parts)
    return replace(values, parameters={**values.parameters, DIRECTION: seen})


def _word(told: object, day: date | None) -> str:
    word, _ = held(told, day or date.today())
    return "" if word is None else str(word).strip().casefold()
