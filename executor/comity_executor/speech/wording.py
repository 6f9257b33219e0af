"""What the robot says: the words follow formality, directness, style and language.

The texts are our own and no speaker has reviewed them. Arabic and Japanese are written in Latin letters, so
that every terminal and font shows them. No text mentions or presumes a religion, a gender or a title.
None puts a formal pronoun beside what may be a first name, and none welcomes: that is for the host to do.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from comity_fis.errors import InputError, closest
from comity_fis.inference.value import Inference

ABOUT_WORDS = ("greeting_language", "formality", "rhetorical_style", "verbal_directness")
"""The parameters that choose among wordings, in the order in which a text follows them."""

INFORMAL, FORMAL = 0.3, 0.7
"""Of formality: below the one, above the other; where the terms of the rulebook `evidence` cross."""
RHETORICAL = 0.5
IMPLICIT, EXPLICIT = 0.45, 0.55
"""Of directness; in between the robot adds nothing. Our choice, around where the two terms cross."""


@dataclass(frozen=True, slots=True)
class Wordings:
    """The same in three degrees of formality."""

    informal: str
    neutral: str
    formal: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Phrases:
    """What the robot says before people in one language."""

    salutation: Wordings
    rhetorical: str
    """At a first meeting only."""
    implicit: str
    explicit: str
    offer: str
    """May name the thing, which is called as in the scenario: in English words."""
    farewell: Wordings
    joined: str
    """Between the last two names, where several people are greeted at once."""


PHRASES: Mapping[str, Phrases] = {
    "eng": Phrases(
        salutation=Wordings("Hi, {name}.", "Hello, {name}.", "Good day, {name}."),
        rhetorical="It is an honour to meet you.",
        implicit="I am here, should anything be needed.",
        explicit="What can I do for you?",
        offer="{name}, I have brought you {thing}.",
        farewell=Wordings("Bye, {name}.", "Goodbye, {name}.", "Goodbye, {name}, and thank you."),
        joined=" and ",
    ),
    "deu": Phrases(
        salutation=Wordings("Hallo, {name}.", "Guten Tag, {name}.", "Guten Tag, {name}."),
        rhetorical="Es ist mir eine Ehre.",
        implicit="Ich bin da, falls etwas gebraucht wird.",
        explicit="Was kann ich tun?",
        offer="Bitte schön, {name}.",
        farewell=Wordings(
            "Tschüss, {name}.", "Auf Wiedersehen, {name}.", "Auf Wiedersehen, {name}, und vielen Dank."
        ),
        joined=" und ",
    ),
    "swe": Phrases(
        salutation=Wordings("Tjena, {name}.", "Hej, {name}.", "God dag, {name}."),
        rhetorical="Det är en ära.",
        implicit="Jag finns här, om något behövs.",
        explicit="Vad kan jag göra?",
        offer="Varsågod, {name}.",
        farewell=Wordings("Hej då, {name}.", "Hej då, {name}.", "På återseende, {name}, och tack."),
        joined=" och ",
    ),
    "ara": Phrases(
        salutation=Wordings("Marhaba, {name}.", "Marhaban, {name}.", "Marhaban, {name}."),
        rhetorical="Tasharraftu bi-liqaikum.",
        implicit="Ana huna.",
        explicit="Kayfa usaidukum?",
        offer="Tafaddalu, {name}.",
        farewell=Wordings("Ila al-liqa, {name}.", "Ila al-liqa, {name}.", "Ila al-liqa, {name}, wa shukran."),
        joined=" wa ",
    ),
    "jpn": Phrases(
        salutation=Wordings("Konnichiwa, {name}-san.", "Konnichiwa, {name}-san.", "Konnichiwa, {name}-sama."),
        rhetorical="Oai dekite kouei desu.",
        implicit="Koko ni orimasu.",
        explicit="Nani o shimashou ka?",
        offer="Douzo, {name}-san.",
        farewell=Wordings(
            "Mata ne, {name}-san.", "Dewa mata, {name}-san.", "Shitsurei shimasu, {name}-sama."
        ),
        joined="-san to ",
    ),
}
"""By ISO 639-3 code."""

OWN_LANGUAGE = "eng"


def greeting_text(people: Sequence[str], values: Inference) -> str:
    """What the robot says to one person or a company; where a rulebook says nothing of the words, just hello.

    Args:
        people: Whom it greets.
        values: The parameters of the one it stands before.

    Raises:
        InputError: where a rulebook means something else by one of these parameters.
    """
    phrases = PHRASES[spoken_language(values)]
    *others, last = map(name_of, people)
    names = phrases.joined.join(filter(None, (", ".join(others), last)))
    parts = (
        by_formality(phrases.salutation, values).format(name=names),
        _style(phrases, values),
        _offer(phrases, values),
    )
    return " ".join(filter(None, parts))


def offer_text(person: str, thing: str, values: Inference) -> str:
    """What the robot says when it hands something over; the thing is called as in the scenario."""
    return PHRASES[spoken_language(values)].offer.format(name=name_of(person), thing=thing)


def farewell_text(person: str, values: Inference) -> str:
    """What the robot says when it leaves, as formal as its greeting was."""
    return by_formality(PHRASES[spoken_language(values)].farewell, values).format(name=name_of(person))


def name_of(person: str) -> str:
    """How somebody is called: with the capitals that their name has, or else with one for each word."""
    name = person.replace("_", " ")
    return name.title() if name.islower() else name


def without_names(text: str, people: Iterable[str]) -> str:
    """The same words to somebody of whom it is not sure who they are.

    Args:
        text: One of ours.
        people: Whose names are not to be said, with whatever joins or follows them.
    """
    names = "|".join(re.escape(name_of(person)) for person in sorted(people, key=len, reverse=True))
    joins = "|".join(re.escape(phrases.joined) for phrases in PHRASES.values())
    name = rf"(?:{names})(?:-san|-sama)?"
    return re.sub(rf",? {name}(?:(?:, |{joins}){name})*", "", text)


def by_formality(wordings: Wordings, values: Inference) -> str:
    """The wording that is as formal as suits; the neutral one where a rulebook says nothing of formality."""
    formality = number_of(values, "formality")
    if formality is None or INFORMAL <= formality <= FORMAL:
        return wordings.neutral
    return wordings.informal if formality < INFORMAL else wordings.formal


def _style(phrases: Phrases, values: Inference) -> str:
    """The rhetorical sentence, which suits a first meeting alone: with a stranger, where that is known."""
    style = number_of(values, "rhetorical_style")
    first = values.inputs.get("familiarity") == "stranger"
    return phrases.rhetorical if first and style is not None and style > RHETORICAL else ""


def _offer(phrases: Phrases, values: Inference) -> str:
    directness = number_of(values, "verbal_directness")
    if directness is None or IMPLICIT <= directness <= EXPLICIT:
        return ""
    return phrases.implicit if directness < IMPLICIT else phrases.explicit


def spoken_language(values: Inference) -> str:
    """The language in which somebody is spoken to, as a code of `PHRASES`."""
    if "greeting_language" not in values.parameters:
        return OWN_LANGUAGE
    language = str(values["greeting_language"].value)
    if language not in PHRASES:
        raise InputError(
            expected=f"greeting_language as one that the robot speaks ({', '.join(PHRASES)})",
            got=repr(language),
            remedy=closest(language, PHRASES),
        )
    return language


def number_of(values: Inference, parameter: str) -> float | None:
    """A parameter of the words; None where the rulebook has none of the name."""
    if parameter not in values.parameters:
        return None
    value = values[parameter].value
    if isinstance(value, str):
        raise InputError(
            expected=f"{parameter} as a number",
            got=repr(value),
            remedy="The robot's words follow it; give the rulebook's another name, or this meaning.",
        )
    return value
