"""The questionnaire file: items, their subscales, and the scale of answers."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, model_validator

from comity.people.fact import Number
from comity.specification.matrix import Word
from comity_fis import Where, unknown_word
from comity_fis.errors import WrongValueError
from comity_fis.listing import listed
from comity_fis.validation.name_or_path import looks_like_a_file
from comity_fis.validation.yaml_file import read_yaml
from comity_sim2d.maps.file import Name

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
_SUFFIX = ".questionnaire.yaml"
Point = Annotated[int, Field(strict=True, ge=-1000, le=1000)]
OWN_COLUMNS = ("participant", "condition", "questionnaire", "item", "answer")
"""Headings of a table of answers that are not items."""


class AnswerScale(BaseModel):
    """The whole numbers between which an answer lies."""

    model_config = _FILE

    from_: Point = Field(alias="from")
    to: Point

    @model_validator(mode="after")
    def _upwards(self) -> AnswerScale:
        if self.from_ >= self.to:
            raise WrongValueError(
                expected="`from` below `to`",
                got=f"{self.from_} and {self.to}",
                remedy="Swap them; an item is turned round by `reversed: true`.",
            )
        return self

    def __str__(self) -> str:
        return f"{self.from_} to {self.to}"

    def holds(self, answer: float) -> bool:
        """Whether an answer is one of the scale's numbers."""
        return answer == int(answer) and self.from_ <= answer <= self.to


class QuestionnaireItem(BaseModel):
    """One item."""

    model_config = _FILE

    subscales: tuple[Name, ...] = Field(
        min_length=1, max_length=100, description="To which it belongs; an item may count in several."
    )
    reversed: bool = Field(
        default=False, strict=True, description="Whether its lowest answer says most of what is measured."
    )
    scale: AnswerScale | None = Field(default=None, description="Where it is not the questionnaire's.")
    text: str = Field(default="", description="As your licence has it; `comity study collect` shows it.")


class QuestionnaireFile(BaseModel):
    """How answers are scored; `comity schema questionnaire` prints this as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity questionnaire")

    schema_version: Annotated[int, Field(strict=True, ge=1, le=1)]
    name: Name
    about: str = ""
    source: Word = Field(description="Who published it, or `design choice`.")
    scale: AnswerScale
    answered_at_least: Number = Field(
        default=0.5,
        gt=0,
        le=1,
        description="Share of the items of a subscale that an answer sheet must have for a score.",
    )
    items: Mapping[Name, QuestionnaireItem] = Field(min_length=1, max_length=1000)

    @model_validator(mode="after")
    def _scales_agree(self) -> QuestionnaireFile:
        for own in OWN_COLUMNS:
            if own in self.items:
                raise WrongValueError(
                    expected=f"items of other names than {', '.join(OWN_COLUMNS)}",
                    got=own,
                    remedy="These are columns of the answers: rename the item.",
                )
        for subscale, items in self.subscales.items():
            if len(scales := {str(self.scale_of(item)) for item in items}) > 1:
                raise WrongValueError(
                    expected=f"one scale for all items of {subscale}, whose answers are averaged",
                    got=listed(sorted(scales)),
                    remedy="Give them one scale, or put them into subscales of their own.",
                )
        return self

    @property
    def subscales(self) -> dict[str, tuple[str, ...]]:
        """Items of each subscale, both in the order of the file."""
        found: dict[str, list[str]] = {}
        for item, one in self.items.items():
            for subscale in dict.fromkeys(one.subscales):
                found.setdefault(subscale, []).append(item)
        return {subscale: tuple(items) for subscale, items in found.items()}

    def scale_of(self, item: str) -> AnswerScale:
        """The answer scale of an item."""
        return self.items[item].scale or self.scale

    def keyed(self, item: str, answer: float) -> float:
        """An answer coded so that higher means more of the construct: reversed items are inverted."""
        scale = self.scale_of(item)
        return scale.from_ + scale.to - answer if self.items[item].reversed else answer


def shipped_questionnaires() -> dict[str, Path]:
    """The questionnaires that ship with Comity, without the texts of their items."""
    return {one.name.removesuffix(_SUFFIX): one for one in sorted(Path(__file__).parent.glob(f"*{_SUFFIX}"))}


def questionnaire_path(name: str) -> Path:
    """The file behind a shipped name or a path.

    Raises:
        InputError: if it is neither.
    """
    known = shipped_questionnaires()
    if name in known:
        return known[name]
    if looks_like_a_file(name, Path(name)):
        return Path(name)
    raise unknown_word("a questionnaire: a shipped name or a file", name, known, where=Where("QUESTIONNAIRE"))


def load_questionnaire(name: str) -> QuestionnaireFile:
    """Load a questionnaire by its shipped name or path.

    Raises:
        InputError: with file and line, for whatever cannot be used.
    """
    return read_yaml(questionnaire_path(name), name).check(QuestionnaireFile)
