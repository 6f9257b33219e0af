"""What the robot says to a person who blocks its way; our own texts, which no speaker has reviewed.

As with greetings (`wording`), they follow formality, directness and language, and mention no gender or title.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_executor.speech.wording import (
    IMPLICIT,
    Wordings,
    by_formality,
    name_of,
    number_of,
    spoken_language,
)
from comity_fis.inference.value import Inference


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """One language's ways to ask."""

    asked: Wordings
    implicit: str
    """Where directness is low: the wish is hinted at, and nothing is asked for."""


STRANGER = "Excuse me, may I pass?"
"""To somebody of whom nothing is known, their name neither; in the robot's own language."""


REQUESTS: Mapping[str, Request] = {
    "eng": Request(
        asked=Wordings(
            "Hey {name}, can I get through?",
            "Excuse me, {name}, may I pass?",
            "Pardon me, {name}, would you kindly let me pass?",
        ),
        implicit="Excuse me, {name}, I am on my way over there.",
    ),
    "deu": Request(
        asked=Wordings(
            "Hallo {name}, darf ich mal durch?",
            "Entschuldigung, {name}, darf ich vorbei?",
            "Verzeihung, {name}, dürfte ich bitte vorbei?",
        ),
        implicit="Entschuldigung, {name}, ich bin auf dem Weg dorthin.",
    ),
    "swe": Request(
        asked=Wordings(
            "Hej {name}, får jag komma förbi?",
            "Ursäkta, {name}, får jag komma förbi?",
            "Förlåt, {name}, skulle jag kunna få passera?",
        ),
        implicit="Ursäkta, {name}, jag är på väg dit bort.",
    ),
    "ara": Request(
        asked=Wordings(
            "{name}, mumkin amurr?",
            "Afwan, {name}, hal yumkinuni al-murur?",
            "Al-ma'dhira, {name}, hal tasmahuna li bil-murur?",
        ),
        implicit="Afwan, {name}, ana fi tariqi ila hunak.",
    ),
    "jpn": Request(
        asked=Wordings(
            "{name}-san, chotto tooru ne.",
            "Sumimasen, {name}-san, toorasete kudasai.",
            "Osore irimasu, {name}-sama, toorasete itadakemasu ka?",
        ),
        implicit="Sumimasen, {name}-san, achira e mairimasu.",
    ),
}
"""By ISO 639-3 code, for the languages of `wording.PHRASES`."""


def passing_text(person: str, values: Inference | None) -> str:
    """What the robot says to one who is in its way.

    Args:
        person: Who it is.
        values: Their parameters; None where nothing is known of them: then nobody is called by a name.

    Raises:
        InputError: where a rulebook means something else by one of these parameters.
    """
    if values is None:
        return STRANGER
    request, directness = REQUESTS[spoken_language(values)], number_of(values, "verbal_directness")
    hinted = directness is not None and directness < IMPLICIT
    return (request.implicit if hinted else by_formality(request.asked, values)).format(name=name_of(person))
