"""The file that defines a session: consent, facts, stop distances and questionnaires."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, model_validator

from comity.people.fact import Number, Word
from comity.study.people_table import FACTS
from comity.study.questionnaires.questionnaire_file import (
    QuestionnaireFile,
    load_questionnaire,
    shipped_questionnaires,
)
from comity_fis import unknown_word
from comity_fis.errors import WrongValueError
from comity_fis.validation.yaml_file import YamlFile, read_yaml
from comity_sim2d.maps.file import Name

CONSENT, FACT, DISTANCE = "consent", "facts", "stop distance"
"""Values of the column `questionnaire` besides the names of questionnaires."""
Radius = Annotated[Number, Field(gt=0, le=2)]


class CollectionFile(BaseModel):
    """What each session asks; `comity schema collection` prints this as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity collection")

    schema_version: Literal[1]
    name: Name
    about: str = ""
    medium: Literal["robot", "clip", "paper"] = Field(
        description="What participants meet: a robot, films of one, or pictures and words."
    )
    consent: str = Field(
        min_length=1,
        max_length=20_000,
        description="What they agree to, as it is read or handed to them; another text asks again.",
    )
    facts: tuple[Word, ...] = Field(
        default=(),
        max_length=50,
        description="By the keys of a profile, such as culture; each may be left open.",
    )
    conditions: Mapping[Name, str] = Field(
        default_factory=dict, description="Of the allocation: what the experimenter shows or does under each."
    )
    trials: Annotated[int, Field(strict=True, ge=0, le=50)] = Field(
        default=3, description="Stop distances under each condition."
    )
    stop_says: Literal["showed_nothing", "asked_farther"] | None = Field(
        default=None,
        description="What `stop` means by your instruction: the nearest distance that is still comfortable "
        "(showed_nothing), or the first that is not (asked_farther). Needed with trials.",
    )
    measured: Literal["surface", "centre"] = Field(
        default="surface", description="Between which points of the two bodies distances are measured."
    )
    robot_radius_m: Radius = 0.25
    person_radius_m: Radius = 0.20
    questionnaires: tuple[Name, ...] = Field(
        default=(), max_length=50, description="Under each condition: shipped ones, or files beside this one."
    )

    @model_validator(mode="after")
    def _stop_means_something(self) -> CollectionFile:
        if self.trials and self.stop_says is None:
            raise WrongValueError(
                expected="`stop_says` beside stop distances",
                got="none",
                remedy="Write showed_nothing where they say stop at the nearest distance that is still "
                "comfortable, asked_farther at the first that is not, or `trials: 0`.",
            )
        return self

    @property
    def radii_m(self) -> float:
        """Difference between a distance of centres and one of surfaces [m]."""
        return self.robot_radius_m + self.person_radius_m


@dataclass(frozen=True, slots=True)
class Collection:
    """A collection with its questionnaires."""

    file: YamlFile
    written: CollectionFile
    questionnaires: Mapping[str, QuestionnaireFile]
    """Questionnaires by the names in their files."""

    def require_conditions(self, allocated: tuple[str, ...]) -> None:
        """Refuse a condition that the allocation does not have.

        Raises:
            InputError: with the line.
        """
        for name in self.written.conditions:
            if name not in allocated:
                raise unknown_word(
                    "a condition of the allocation",
                    name,
                    allocated,
                    where=self.file.where(("conditions", name)),
                )


def load_collection(path: Path) -> Collection:
    """The collection of a file, and the questionnaires that it names.

    Raises:
        InputError: with file and line, for whatever cannot be used.
    """
    file = read_yaml(path)
    written = file.check(CollectionFile)
    for i, fact in enumerate(written.facts):
        if fact not in FACTS or fact in written.facts[:i]:
            raise unknown_word("facts of a profile, each once", fact, FACTS, where=file.where(("facts", i)))
    found: dict[str, QuestionnaireFile] = {}
    for i, name in enumerate(written.questionnaires):
        with file.placing("questionnaires", i):
            one = load_questionnaire(name if name in shipped_questionnaires() else str(path.parent / name))
            if one.name in (*found, CONSENT, FACT, DISTANCE):
                raise WrongValueError(
                    expected="questionnaires of different names",
                    got=repr(one.name),
                    remedy=f"Change its `name`; {CONSENT}, {FACT} and {DISTANCE} are taken.",
                )
            found[one.name] = one
    return Collection(file, written, found)
