"""What one person declared about themselves: all of it optional, none of it inferred."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Literal

import yaml
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    field_validator,
    model_validator,
)

from comity.people.address import FormOfAddress, Said
from comity.people.consents import lapse
from comity.people.culture import Belonging, Cultures, belongings
from comity.people.dated import OLDEST, UNKNOWN, Day, age_on, held, in_order, is_dated, undated
from comity.people.fact import (
    Consent,
    ConsentSince,
    Fact,
    FactSince,
    Languages,
    LanguagesSince,
    Latitude,
    LatitudeSince,
    Level,
    LevelSince,
    Number,
    Word,
    WordSince,
)
from comity.people.store import Store
from comity.system import library
from comity_fis import InputError, Interval, Where
from comity_fis.errors import WrongValueError
from comity_fis.inference.scalar import scalar
from comity_fis.listing import listed
from comity_fis.validation.one_line import one_line
from comity_fis.validation.yaml_file import YamlFile, dump_yaml, parse_yaml, read_yaml

ProfileGiven = str | Mapping[str, Any]
"""A profile by name or file, or its content."""
PROFILES_KEPT = 64
"""Number of parsed profile files to cache: tests load the same few many times."""


PERSONAL = ("hearing", "sight", "mobility", "form_of_address")
"""Facts that every rulebook accepts, whether or not it reads them."""


def _without_key(name: str) -> str:
    if name in (*Profile.model_fields, "language") and name not in PERSONAL:
        raise WrongValueError(
            expected="a fact that has no key of its own in `other`",
            got=repr(name),
            remedy=f"Write `{'languages' if name == 'language' else name}: ...` beside `other`.",
        )
    return name


class Profile(BaseModel):
    """A person's declared facts; a missing key, or `unknown`, means unknown."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity profile")

    schema_version: Literal[1] = 1
    name: Annotated[str, AfterValidator(one_line)] = Field(min_length=1, max_length=100)
    about: str = Field(default="", description="A sentence for the reader; it stays in the store.")
    culture: Cultures | None = Field(
        default=None,
        description="Self-declared: a country by ISO 3166 code or English name, or a region such as "
        "'Arab countries'; several with weights, as a mapping or as a list with roles and dates.",
    )
    region: Word | None = Field(
        default=None,
        description="The region that the person lets stand for a culture without a score of its own.",
    )
    gender: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="Self-declared; a rulebook may know only some."
    )
    age: Annotated[Number, Field(ge=0, le=OLDEST)] | None = Field(default=None, description="Years.")
    birth_year: Annotated[int, Field(strict=True, ge=1800, le=2200)] | None = Field(
        default=None, description="Instead of the age, which then follows from the date."
    )
    birth_date: Day | None = Field(default=None, description="Instead of the age or the year of birth.")
    education: Level | tuple[LevelSince, ...] | None = Field(
        default=None, description="Highest level completed, as ISCED 2011 numbers them."
    )
    income: Fact | tuple[FactSince, ...] | None = Field(
        default=None, description="A word or a number, as the rulebook's variable has it."
    )
    languages: Languages | tuple[LanguagesSince, ...] | None = Field(
        default=None,
        description="By code (ara, sv, de-AT) or name (Swedish), the best liked first; a rulebook's variable "
        "`language` is the first that it knows.",
    )
    latitude: Latitude | tuple[LatitudeSince, ...] | None = Field(
        default=None, description="Of where the person grew up [deg], north positive."
    )
    touch_consent: Consent | tuple[ConsentSince, ...] | None = Field(
        default=None, description="Whether greetings that touch are welcome; never presumed."
    )
    familiarity: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="How well person and robot know each other: stranger, acquaintance, close."
    )
    posture: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="standing or seated; what a scenario says goes before it."
    )
    robot_experience: Word | tuple[WordSince, ...] | None = Field(default=None, description="low or high.")
    formality: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="informal or formal: how this person wants to be met."
    )
    hearing: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="In the person's own words: none, impaired, hearing aid."
    )
    sight: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="In the person's own words: none, impaired, glasses."
    )
    mobility: Word | tuple[WordSince, ...] | None = Field(
        default=None, description="In the person's own words: wheelchair, walking frame."
    )
    form_of_address: FormOfAddress | Said | None = Field(
        default=None,
        description="How the person wants to be addressed: a name, or name, title, order and pronunciation.",
    )
    other: Mapping[Annotated[str, AfterValidator(_without_key)], Fact | tuple[FactSince, ...]] = Field(
        default_factory=dict,
        description="Further facts by any name; a rulebook reads those that it has a variable for.",
    )
    settings: Mapping[str, Fact] = Field(
        default_factory=dict,
        description="What the person explicitly asked for, by parameter; replaces inference.",
    )

    @model_validator(mode="before")
    @classmethod
    def _kept_back(cls, data: Any) -> Any:
        """Drop `unknown`, which is allowed for every fact."""
        if not isinstance(data, Mapping):
            return data
        told = {key: value for key, value in data.items() if value != UNKNOWN or key == "name"}
        for key in ("culture", "settings"):
            if isinstance(inside := told.get(key), Mapping):
                told[key] = {name: value for name, value in inside.items() if value != UNKNOWN}
        if data.get("culture") and not told.get("culture"):
            told.pop("culture", None)
        return told

    @field_validator("*")
    @classmethod
    def _in_order(cls, value: Any) -> Any:
        return in_order(value)

    @model_validator(mode="after")
    def _one_age(self) -> Profile:
        said = [name for name in ("age", "birth_year", "birth_date") if getattr(self, name) is not None]
        if len(said) > 1:
            raise WrongValueError(
                expected="one of age, birth_year and birth_date", got=listed(said), remedy="Keep one."
            )
        if twice := [name for name in PERSONAL if name in self.other and getattr(self, name) is not None]:
            raise WrongValueError(
                expected=f"{twice[0]} once", got="it as a key and in `other`", remedy="Keep the key."
            )
        if self.region is not None and self.culture is None:
            raise WrongValueError(
                expected="a culture that the region stands for",
                got="a region alone",
                remedy=f"Write `culture: {self.region}`.",
            )
        return self

    @property
    def depends_on_date(self) -> bool:
        """Whether any fact changes with the day."""
        if self.birth_year is not None or self.birth_date is not None:
            return True
        if isinstance(self.culture, tuple) and any(one.dated for one in self.culture):
            return True
        return any(is_dated(value) for value in (*self._plain().values(), *self.other.values()))

    def cultures(self, day: date | None = None) -> tuple[Belonging, ...]:
        """The cultures on a day, which is required if facts depend on it.

        Raises:
            InputError: The day is required and missing.
        """
        self._require(day)
        return tuple(belongings(self.culture, self.region, day))

    def facts(self, day: date | None = None) -> dict[str, Any]:
        """All other known facts on a day, by key; `age` also if only a birth is stated.

        Raises:
            InputError: The day is missing and facts depend on it.
            WrongValueError: The day is before the person's birth.
        """
        self._require(day)
        dated = {name: held(value, day)[0] for name, value in {**self._plain(), **self.other}.items()}
        known = {name: value for name, value in dated.items() if value is not None}
        if (age := self._age(day)) is not None:
            known["age"] = age
        return known

    def location(self, fact: str, day: date | None = None) -> tuple[str | int, ...]:
        """Location of a fact in a profile's file."""
        if fact == "age" and self.age is None:
            return ("birth_date",) if self.birth_date is not None else ("birth_year",)
        fact = "languages" if fact == "language" else fact
        place = ("other", fact) if fact in self.other else (fact,)
        number = held(self.other.get(fact, getattr(self, fact, None)), day)[1]
        return place if number is None else (*place, number, "value")

    def _plain(self) -> dict[str, Any]:
        """Facts that are values or dated values."""
        fields = Profile.model_fields.keys() - _NO_FACTS - _OF_THEIR_OWN
        given = {name: getattr(self, name) for name in Profile.model_fields if name in fields}
        return {name: value for name, value in given.items() if value is not None}

    def _age(self, day: date | None) -> float | Interval | None:
        if self.birth_date is None and self.birth_year is None:
            return self.age
        assert day is not None
        return age_on(day, self.birth_date or self.birth_year or 0)

    def _require(self, day: date | None) -> None:
        if day is None and self.depends_on_date:
            raise undated(self.name)


_NO_FACTS = frozenset({"schema_version", "name", "about", "other", "settings"})
_OF_THEIR_OWN = frozenset({"culture", "region", "age", "birth_year", "birth_date"})
"""Keys that are handled separately from plain facts."""


@dataclass(frozen=True, slots=True)
class Declared:
    """A profile and its file, or part of one, so that errors name a line."""

    profile: Profile
    file: YamlFile | None
    """None if there is no file: nobody in particular."""
    kept_as: str | None = None
    """Name of the person in the store; None if not stored."""


NOBODY = Declared(Profile(name="nobody in particular"), None)


def load_profile(name: str, *, beside: Path | None = None, where: Where | None = None) -> Declared:
    """Load a profile by name, or from a file.

    Shipped names take precedence, so that shipped scenarios mean the same everywhere; then stored people;
    then files, which a path such as `./amal` denotes unambiguously. The note `about` of a stored person is
    never loaded. A person whose consent to be remembered has ended is deleted.

    Args:
        name: A shipped or stored name, or a path.
        beside: Base folder of a relative path; None: the current folder.
        where: Location of the name, for messages.

    Raises:
        InputError: There is no such profile, or the file is not a profile.
    """
    lapse(name)
    kept = Store().path(name)
    if kept is not None and name not in library.shipped("profile"):
        file = read_yaml(kept)
        profile = file.check(Profile).model_copy(update={"about": ""})  # it never leaves the store
        return Declared(profile, file, kept_as=name)
    if kept is not None:
        raise InputError(
            expected=f"one profile of the name {name}",
            got=f"one that ships with Comity and one in {kept.parent}",
            remedy="Rename that folder.",
            where=where,
        )
    path, called = library.find("profile", name, beside=beside, where=where, more=Store().names)
    file = read_yaml(path, called)
    return Declared(_checked(file), file)


def declared_by(given: ProfileGiven, *, called: str, where: Where | None = None) -> Declared:
    """A profile by name or file, or from its content.

    Args:
        given: The name, the file, or the content as in a profile's file.
        called: The person's name, if the profile has none.
        where: Location of the name, for messages.

    Raises:
        InputError: It is not a profile; for content, lines refer to its YAML.
    """
    return load_profile(given, where=where) if isinstance(given, str) else _written_out(given, called)


def _written_out(said: Mapping[str, Any], called: str) -> Declared:
    source = f"the profile of {called}"
    if not isinstance(said, Mapping):
        raise InputError(
            expected="a profile: a name, a file, or a mapping such as {'culture': 'SWE'}",
            got=repr(said),
            remedy="Write one of the three.",
        )
    try:
        text = dump_yaml(_plain({"name": called, **said}))
    except yaml.YAMLError as error:
        odd = error.args[-1]
        raise InputError(
            expected="a profile of words, numbers, lists and mappings",
            got=f"{odd!r}, of type {type(odd).__name__}",
            remedy="Turn other objects into these first.",
            where=Where(source),
        ) from None
    file = parse_yaml(text, Path(), source)
    return Declared(file.check(Profile), file)


def _plain(value: Any) -> Any:
    """Content with scalars of numpy and pandas converted to plain Python."""
    if isinstance(value, Mapping):
        return {key: _plain(each) for key, each in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(each) for each in value]
    plain = scalar(value)
    return float(plain) if isinstance(plain, float) else plain  # numpy's float64 is a float, but not for YAML


@lru_cache(maxsize=PROFILES_KEPT)
def _checked(file: YamlFile) -> Profile:
    """The validated profile of a file, cached by its text."""
    return file.check(Profile)


def day_for(at: date | None, *profiles: Profile) -> date | None:
    """The given day; otherwise today if some fact depends on the day (the only use of the clock)."""
    if at is None and any(profile.depends_on_date for profile in profiles):
        return date.today()
    return at
