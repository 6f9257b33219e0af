"""Goals of a scenario: one per line, each about one person."""

from __future__ import annotations

import unicodedata
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, StringConstraints, model_validator

from comity.people.fact import Number
from comity_domain import Agenda, Offer, Say, TakeLeave, Task, Wait
from comity_fis.errors import WrongValueError
from comity_fis.listing import listed
from comity_sim2d.maps.file import Name

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence


def _speakable(text: str) -> str:
    if not text.strip():
        raise WrongValueError(expected="text that is not blank", got=repr(text), remedy="Write what to say.")
    for place, character in enumerate(text, 1):
        if unicodedata.category(character) in UNSPEAKABLE and character not in JOINERS:
            name = unicodedata.name(character, "a control character").lower()
            raise WrongValueError(
                expected="text without control characters, line breaks and marks of direction",
                got=f"U+{ord(character):04X} ({name}) as character {place}",
                remedy="Remove it; for a break, write a `say` of its own.",
            )
    return text


UNSPEAKABLE = ("Cc", "Cf", "Cs", "Zl", "Zp")
"""Unicode categories refused in speech: control and format characters, lone surrogates, line and paragraph
ends."""
JOINERS = ("\u200c", "\u200d")
"""Allowed format characters, which occur in the spelling of words and in emoji."""


@dataclass(frozen=True, slots=True)
class _Kind:
    """The keys of a goal of one kind."""

    person: str
    """The key that names the person."""
    task: Callable[[Goal], Task] | None = None
    """Task after the greeting; None for the greeting itself."""
    needed: tuple[str, ...] = ()
    """Keys required besides the kind's own."""
    others: tuple[str, ...] = ()
    """Optional keys."""
    names: Literal["thing", "text"] | None = None
    """What the kind's key names besides people; it gets a pseudonym in shared runs."""


KINDS: Mapping[str, _Kind] = {
    "greet": _Kind("greet", others=("priority", "by_s", "skip", "after", "not_from")),
    "say": _Kind("to", lambda goal: Say(str(goal.say)), ("to",), names="text"),
    "offer": _Kind("to", lambda goal: Offer(str(goal.offer), str(goal.from_)), ("to", "from"), names="thing"),
    "wait_s": _Kind("with", lambda goal: Wait(goal.wait_s or 0.0, goal.until), ("with",), ("until",)),
    "take_leave": _Kind("take_leave", lambda _: TakeLeave()),
}
"""Kinds by their key."""
FIELDS = {"from": "from_", "with": "with_"}
"""Attribute names of keys that are reserved words in Python."""
WRITTEN = {field: key for key, field in FIELDS.items()}
Text = Annotated[str, StringConstraints(max_length=500), AfterValidator(_speakable)]


class Goal(BaseModel):
    """One thing the robot is asked to do: `greet`, `say`, `offer`, `wait_s` or `take_leave`."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    greet: Name | None = None
    priority: Number | None = Field(
        default=None,
        ge=0,
        le=1000,
        description="With greet: metres of way that each person greeted before costs.",
    )
    by_s: Number | None = Field(
        default=None,
        gt=0,
        le=36_000,
        description="With greet: the greeting must be over by then, in simulated seconds.",
    )
    skip: Number | None = Field(
        default=None,
        ge=0,
        le=1000,
        description="With greet: metres of way that leaving them out with all their goals costs.",
    )
    after: Name | None = Field(
        default=None, description="With greet: who is to be greeted before, also one of the goals."
    )
    not_from: tuple[Literal["front", "left", "right"], ...] | None = Field(
        default=None,
        min_length=1,
        max_length=3,
        description="With greet: the person's sides from which the robot is not to come.",
    )
    say: Text | None = Field(default=None, description="What to tell the person after the greeting.")
    offer: Name | None = Field(default=None, description="What to fetch and to hand over.")
    to: Name | None = Field(default=None, description="With say and offer: to whom.")
    from_: Name | None = Field(
        default=None, alias="from", description="With offer: the furniture or location where it is fetched."
    )
    wait_s: Number | None = Field(
        default=None, gt=0, le=600, description="How long to stay before the person, at most."
    )
    with_: Name | None = Field(default=None, alias="with", description="With wait_s: before whom.")
    until: Literal["speaks", "moves"] | None = Field(
        default=None, description="With wait_s: what the person does that ends it early."
    )
    take_leave: Name | None = Field(default=None, description="Of whom to take leave: the end of the visit.")

    @model_validator(mode="before")
    @classmethod
    def _mapping(cls, value: object) -> object:
        if isinstance(value, dict | Goal):
            return value
        name = value if isinstance(value, str) and value.isidentifier() else "anna"
        raise WrongValueError(
            expected=f"a goal such as `greet: {name}`",
            got=repr(value),
            remedy=f"A goal is one of {', '.join(f'`{kind}`' for kind in KINDS)} with what belongs to it.",
        )

    @model_validator(mode="after")
    def _one_kind(self) -> Goal:
        given = [
            WRITTEN.get(name, name) for name in type(self).model_fields if getattr(self, name) is not None
        ]
        kinds = [name for name in given if name in KINDS]
        if len(kinds) != 1:
            raise WrongValueError(
                expected=f"a goal with one of {', '.join(f'`{kind}`' for kind in KINDS)}",
                got=listed(f"`{kind}`" for kind in kinds) or "none of them",
                remedy="Write each goal as an item of its own." if kinds else "Add `greet:` and a name.",
            )
        (kind,) = kinds
        needed, allowed = KINDS[kind].needed, (*KINDS[kind].needed, *KINDS[kind].others)
        strange = [name for name in given if name != kind and name not in allowed]
        missing = [name for name in needed if name not in given]
        if strange or missing:
            beside = listed(f"`{name}`" for name in allowed) or "nothing"
            raise WrongValueError(
                expected=f"{beside} beside `{kind}`",
                got=f"`{strange[0]}`" if strange else f"no `{missing[0]}`",
                remedy=f"Remove `{strange[0]}`." if strange else f"Add `{missing[0]}:`.",
            )
        return self

    @property
    def kind(self) -> str:
        """The key that says what is to be done."""
        return next(kind for kind in KINDS if getattr(self, kind) is not None)

    @property
    def person_key(self) -> str:
        """The key that names the person."""
        return KINDS[self.kind].person

    @property
    def person(self) -> str:
        """The person it is about."""
        return str(getattr(self, FIELDS.get(self.person_key, self.person_key)))

    @property
    def task(self) -> Task | None:
        """The task after the greeting; None for the greeting itself."""
        task = KINDS[self.kind].task
        return None if task is None else task(self)

    def named(self, what: Literal["thing", "text"]) -> str | None:
        """The thing, or the text, that the goal names."""
        return str(getattr(self, self.kind)) if KINDS[self.kind].names == what else None


def greeted(goals: Sequence[Goal]) -> list[tuple[int, str]]:
    """People whom the goals greet, each with the goal's index."""
    return [(i, goal.greet) for i, goal in enumerate(goals) if goal.greet is not None]


def agenda_of(goals: Sequence[Goal], person: str) -> Agenda:
    """Tasks of a person's visit after the greeting, in the order of the list."""
    return tuple(task for goal in goals if goal.person == person and (task := goal.task) is not None)
