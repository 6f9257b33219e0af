"""Schema of a file of wordings in one language."""

from __future__ import annotations

from datetime import date
from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, field_validator, model_validator

from comity_executor.speech.script import read_script, read_tag
from comity_executor.speech.utterance import Spelling
from comity_executor.speech.wording import NAME, Occasion, Register, Use, Wording
from comity_fis.errors import WrongValueError
from comity_fis.validation.day import read_day
from comity_fis.validation.one_line import one_line

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
Text = Annotated[str, AfterValidator(one_line), Field(min_length=1, max_length=300)]


class WordingEntry(BaseModel):
    """One wording."""

    model_config = _FILE

    use: Use = Field(description="What it is said for.")
    register_: Register = Field(
        alias="register",
        description="How formal it is; `plain` is the plainest word with the name, which a real robot says "
        "where nothing else is reviewed.",
    )
    occasion: Occasion | None = Field(default=None, description="When alone it is said; without it, always.")
    text: Text = Field(description="In the language's script, with {name} where the person is named.")
    latin: Text | None = Field(default=None, description="The same in Latin letters, where the text is not.")
    reviewed_by: Annotated[str, AfterValidator(one_line), Field(max_length=200)] | None = Field(
        default=None, description="Who speaks the language and has read it; nobody without it."
    )
    reviewed_on: date | None = Field(default=None, description="The day of the review: 2026-11-27.")

    @field_validator("reviewed_on", mode="before")
    @classmethod
    def _as_written(cls, said: object) -> date | None:
        return None if said is None else read_day(said)

    @field_validator("reviewed_on")
    @classmethod
    def _been(cls, day: date | None) -> date | None:
        if day is not None and day > date.today():
            raise WrongValueError(
                expected="the day of a review that has been",
                got=f"{day}, in the future",
                remedy="Write the day on which it was read, or leave the review out.",
            )
        return day

    def wording(self, language: str, script: str) -> Wording:
        """The wording with the language and script of the file.

        Raises:
            WrongValueError: Its fields are inconsistent.
        """
        return Wording(
            language=language,
            script=script,
            use=self.use,
            register=self.register_,
            text=self.text,
            latin=self.latin,
            occasion=self.occasion,
            reviewed_by=self.reviewed_by,
            reviewed_on=self.reviewed_on,
        )


class SpellingEntry(BaseModel):
    """Words in two scripts."""

    model_config = _FILE

    text: Annotated[str, Field(max_length=100)]
    latin: Annotated[str, Field(max_length=100)] | None = None

    def spelling(self) -> Spelling:
        """As used by `Utterance`."""
        return Spelling(self.text, self.latin if self.latin is not None else self.text)


class NameForm(SpellingEntry):
    """Form of a name in one register, for people who have not stated a form of address."""

    register_: Literal["informal", "neutral", "formal"] = Field(alias="register")

    @model_validator(mode="after")
    def _names(self) -> NameForm:
        for words in (self.text, self.latin):
            if words is not None and words.count(NAME) != 1:
                raise WrongValueError(
                    expected=f"{NAME} once", got=repr(words), remedy=f"Write for example '{NAME}-san'."
                )
        return self


class WordingsFile(BaseModel):
    """Wordings in one language; `comity schema wordings` prints this as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity wordings")

    schema_version: Literal[1]
    language: Annotated[str, AfterValidator(read_tag)] = Field(
        description="By its BCP 47 tag: ar, sv, de-AT."
    )
    code: Annotated[str, Field(pattern="^[a-z]{3}$")] = Field(
        description="By its ISO 639-3 code, as `greeting_language` of a rulebook names it."
    )
    script: Annotated[str, AfterValidator(read_script)] = Field(description="By its ISO 15924 code.")
    names: tuple[NameForm, ...] = Field(
        default=(), description="How names are said by register; without it as they are."
    )
    joined: SpellingEntry | None = Field(
        default=None, description="Between the last two names of several; a comma without it."
    )
    wordings: tuple[WordingEntry, ...] = Field(min_length=1, max_length=500)
