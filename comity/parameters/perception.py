"""What a person hears and sees: what a greeting can be for them, and where the robot comes from.

Who does not hear is approached within view or not at all, and never greeted in words alone; who does not see
is never greeted by a gesture alone, and is told when the robot comes, stops and leaves. That is this
project's own choice, tried on nobody.
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
"""A person's own words for it; whatever else they say, such as `impaired`, excludes nothing."""
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
    """Whether a person hears, as far as they said.

    Args:
        profile: What they declared.
        day: On which.
        told: What is told here and now, by fact: it goes before the profile.
    """
    return _word(told.get("hearing", profile.hearing), day) not in NOT_HEARING


def sees(profile: Profile, day: date | None, told: Mapping[str, object] = NOTHING) -> bool:
    """Whether a person sees, as far as they said; the arguments are those of `hears`."""
    return _word(told.get("sight", profile.sight), day) not in NOT_SEEING


def lacks_hearing(values: Inference) -> bool:
    """Whether a person does not hear, by the inputs of their values: what was said on the way is in them."""
    return is_read(HEARING, values.inputs.get(HEARING, ""))


def lacks_sight(values: Inference) -> bool:
    """The same of sight."""
    return is_read(SIGHT, values.inputs.get(SIGHT, ""))


def is_read(name: str, fact: object) -> bool:
    """Whether a fact says that a person does not hear or see."""
    return str(fact).strip().casefold() in WORDS_READ.get(name, ())


def hint_of(names: Iterable[str]) -> str:
    """Which words count, as the end of a note about facts that change nothing; empty for other facts.

    Args:
        names: Of the facts.
    """
    return "".join(
        f" Of {name} only the words {', '.join(sorted(WORDS_READ[name]))} count: write `none` for no {name}."
        for name in names
        if name in WORDS_READ
    )


@dataclass(frozen=True, slots=True)
class Clash:
    """A wish that cannot be met for who does not hear, or does not see."""

    said: str
    """The fact and the wish."""
    why: str
    remedy: str

    @property
    def words(self) -> str:
        """As a reason or a note."""
        return f"{self.said}: {self.why}. {self.remedy}"


def clash_of(wishes: Mapping[str, object], *, hears: bool, sees: bool) -> Clash | None:
    """The first wish that can never be met with what a person perceives; None where all can.

    Of a person who neither hears nor sees no wish is at fault: no act reaches them.

    Args:
        wishes: By parameter, what the person asked for.
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
    """What a person asked for outright, by parameter."""
    return {name: value.value for name, value in values.parameters.items() if value.asked_for}


def refuse_clash(profile: Profile, day: date | None) -> None:
    """Refuse a wish that can never be met with what a person hears and sees.

    Raises:
        InputError: with both facts and what to change.
    """
    clash = clash_of(profile.settings, hears=hears(profile, day), sees=sees(profile, day))
    if clash is not None:
        raise InputError(expected=f"wishes that can be met: {clash.why}", got=clash.said, remedy=clash.remedy)


def perceiving(
    values: Inference, profile: Profile, day: date | None, told: Mapping[str, object] = NOTHING
) -> Inference:
    """A person's parameters with what follows from what they do not hear or see, which is among the inputs.

    Args:
        values: What rules and wishes give.
        profile: What they declared.
        day: On which.
        told: What is told here and now, by fact.
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
    """A note where something is to be said to a person who does not hear.

    Args:
        values: The person's parameters, as `perceiving` gives them.
        agenda: What is to be done at the visit.
    """
    is_unheard = lacks_hearing(values) and any(isinstance(task, Say) for task in agenda)
    return (NOTE_OF_SAY,) if is_unheard else ()


def _within_view(values: Inference) -> Inference:
    """The same with no direction from which the robot is not seen; a wish for one stays, unmet."""
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
