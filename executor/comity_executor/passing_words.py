"""What the robot says to somebody who stands in its way; our own texts, tried on nobody.

As with greetings (`wording`), they follow formality, directness and language, and mention no gender or title.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_executor.wording import FORMAL, IMPLICIT, INFORMAL, OWN_LANGUAGE, number_of, spoken_language
from comity_fis.value import Inference


@dataclass(frozen=True, slots=True, kw_only=True)
class Request:
    """One language's ways to ask."""

    informal: str
    neutral: str
    formal: str
    implicit: str
    """Where directness is low: the wish is hinted at, and nothing is asked for."""


REQUESTS: Mapping[str, Request] = {
    "eng": Request(
        informal="Hey {name}, can I get through?",
        neutral="Excuse me, {name}, may I pass?",
        formal="Pardon me, {name}, would you kindly let me pass?",
        implicit="Excuse me, {name}, I am on my way over there.",
    ),
    "deu": Request(
        informal="Hallo {name}, darf ich mal durch?",
        neutral="Entschuldigung, {name}, darf ich vorbei?",
        formal="Verzeihung, {name}, würden Sie mich bitte vorbeilassen?",
        implicit="Entschuldigung, {name}, ich bin auf dem Weg dorthin.",
    ),
    "swe": Request(
        informal="Hej {name}, får jag komma förbi?",
        neutral="Ursäkta, {name}, får jag komma förbi?",
        formal="Förlåt, {name}, skulle jag kunna få passera?",
        implicit="Ursäkta, {name}, jag är på väg dit bort.",
    ),
    "ara": Request(
        informal="{name}, mumkin amurr?",
        neutral="Afwan, {name}, hal yumkinuni al-murur?",
        formal="Al-ma'dhira, {name}, hal tasmahuna li bil-murur?",
        implicit="Afwan, {name}, ana fi tariqi ila hunak.",
    ),
    "jpn": Request(
        informal="{name}-san, chotto tooru ne.",
        neutral="Sumimasen, {name}-san, toorasete kudasai.",
        formal="Osore irimasu, {name}-sama, toorasete itadakemasu ka?",
        implicit="Sumimasen, {name}-san, achira e mairimasu.",
    ),
}
"""By ISO 639-3 code, for the languages of `wording.PHRASES`."""


def passing_text(person: str, values: Inference | None) -> str:
    """What the robot says to one who is in its way.

    Args:
        person: Who it is.
        values: Their parameters; None where nothing is known of them.

    Raises:
        InputError: where a rulebook means something else by one of these parameters.
    """
    request = REQUESTS[spoken_language(values) if values else OWN_LANGUAGE]
    return _chosen(request, values).format(name=person.replace("_", " ").title())


def _chosen(request: Request, values: Inference | None) -> str:
    directness = number_of(values, "verbal_directness") if values else None
    formality = number_of(values, "formality") if values else None
    if directness is not None and directness < IMPLICIT:
        return request.implicit
    if formality is None or INFORMAL <= formality <= FORMAL:
        return request.neutral
    return request.informal if formality < INFORMAL else request.formal
