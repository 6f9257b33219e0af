"""Types of facts in a profile, each as a single value or with the first day on which it holds."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, BeforeValidator, Field, StringConstraints

from comity.people.dated import Since
from comity.people.language import read_language
from comity_fis.validation.one_line import one_line

Number = Annotated[float, Field(strict=True)]
"""A number; neither text that looks like one nor a Boolean."""

Word = Annotated[str, StringConstraints(min_length=1, max_length=200), AfterValidator(one_line)]
"""Printable text in one line, as it is shown in the terminal."""
Fact = Word | Number
Level = Annotated[int, Field(strict=True, ge=0, le=8)]
Latitude = Annotated[Number, Field(ge=-90, le=90)]
Consent = Annotated[
    Literal["given", "withheld"],
    BeforeValidator(lambda word: word.lower() if isinstance(word, str) else word),
]
Languages = Annotated[
    tuple[Annotated[Word, AfterValidator(read_language)], ...], Field(min_length=1, max_length=50)
]


class WordSince(Since[Word]):
    """A word, and the first day on which it holds."""


class FactSince(Since[Fact]):
    """A word or a number, and the first day on which it holds."""


class LevelSince(Since[Level]):
    """A level of education, and the first day on which it holds."""


class LatitudeSince(Since[Latitude]):
    """A latitude, and the first day on which it holds."""


class ConsentSince(Since[Consent]):
    """Consent or its refusal, and the first day on which it holds."""


class LanguagesSince(Since[Languages]):
    """Languages, and the first day on which they hold."""
