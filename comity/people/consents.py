"""A person's consents: scope, period, who recorded them; and deletion when they end.

Consent is checked for today by the machine's clock. Data without consent are not stored: once consent has
ended or was withdrawn, the data it covered are deleted at the next use of the person's name.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from datetime import date
from typing import Annotated, Any, Literal, get_args

from pydantic import BaseModel, ConfigDict, Field, model_serializer, model_validator

from comity.people.dated import Day, require_some_time
from comity.people.fact import Word
from comity.people.store import Store, refuse_name
from comity_fis import InputError, Where
from comity_fis.validation.yaml_file import YamlFile

Scope = Literal["remember", "learn", "record", "touch"]
SCOPES: tuple[Scope, ...] = get_args(Scope)
COVERS: Mapping[Scope, str] = {
    "remember": "their profile is kept",
    "learn": "what they show and say at meetings is kept",
    "record": "runs with them are written",
    "touch": "`touch_consent: given` may stand in their profile",
}
"""What each scope allows; `remember` is required for all others."""
_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Consent(BaseModel):
    """One consent of a person."""

    model_config = _FILE

    scope: Scope
    from_: Day = Field(alias="from", description="The day on which they agreed.")
    recorded_by: Word = Field(description="Who wrote it down.")
    until: Day | None = Field(default=None, description="The first day on which it holds no more.")
    withdrawn: Day | None = Field(default=None, description="The day on which they took it back.")

    @model_validator(mode="after")
    def _some_time(self) -> Consent:
        require_some_time(self.from_, self.until)
        return self

    @model_serializer
    def _as_written(self) -> dict[str, Any]:
        days = {"from": self.from_, "until": self.until, "withdrawn": self.withdrawn}
        told = {name: day.isoformat() for name, day in days.items() if day}
        return {"scope": self.scope, "from": told.pop("from"), "recorded_by": self.recorded_by, **told}

    def holds(self, day: date) -> bool:
        """Whether it is in force on a day."""
        return self.from_ <= day and not (self.until and day >= self.until) and self.withdrawn is None

    def covered(self, day: date) -> bool:
        """Whether data from a day were covered by consent then, even if it has ended since."""
        ends = [end for end in (self.until, self.withdrawn) if end]
        return self.from_ <= day < min(ends, default=date.max)

    def in_words(self, day: date) -> str:
        """`since 2026-11-27, recorded by Kim, until 2027-01-01`."""
        since = f"since {self.from_}" if self.from_ <= day else f"from {self.from_} on"
        end = f", until {self.until}" if self.until else ""
        ended = f", withdrawn on {self.withdrawn}" if self.withdrawn else ""
        over = ", over" if self.until and day >= self.until and not self.withdrawn else ""
        return f"{since}, recorded by {self.recorded_by}{end}{ended}{over}"


class ConsentFile(BaseModel):
    """`consent.yaml`: all consents of a person, including withdrawn ones."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, title="What a person agreed to"
    )

    schema_version: Literal[1] = 1
    person: Word
    consents: Annotated[tuple[Consent, ...], Field(max_length=1000)] = ()

    def holding(self, day: date) -> frozenset[Scope]:
        """The scopes in force; none without `remember`."""
        scopes: frozenset[Scope] = frozenset(one.scope for one in self.consents if one.holds(day))
        return scopes if "remember" in scopes else frozenset()


def consents_of(name: str) -> ConsentFile | None:
    """A person's consents; None if none were ever recorded.

    Raises:
        InputError: The stored file is damaged; with the line.
    """
    file = Store().consent_file(name)
    return None if file is None else file.check(ConsentFile)


def is_covered(name: str, scope: Scope) -> bool:
    """Whether a person's consent to a scope is in force today."""
    known = consents_of(name)
    return known is not None and scope in known.holding(date.today())


def was_covered(name: str, scope: Scope, day: date) -> bool:
    """Whether a person's consent to a scope was in force on a day."""
    known = consents_of(name)
    return known is not None and any(one.scope == scope and one.covered(day) for one in known.consents)


def require_consent(name: str, scope: Scope) -> None:
    """Reject storing data without consent.

    Raises:
        InputError: There is no consent; with how to record it.
    """
    if is_covered(name, scope):
        return
    scopes = "remember" if scope == "remember" else f"remember {scope}"
    command = f"comity profile consent {name} {scopes} --by YOUR_NAME"
    raise InputError(
        expected=f"the consent of {name} to {scope}: with it {COVERS[scope]}",
        got="none that holds today",
        remedy=f"Ask them; if they agree, `{command}` records it.",
        where=Where("consent"),
    )


def give(
    name: str, scopes: Iterable[Scope], *, by: str, day: date | None = None, until: date | None = None
) -> ConsentFile:
    """Record consents; a person who consents to `remember` is stored from now on.

    Args:
        name: Name of the person.
        scopes: What they consented to.
        by: Name of whoever records it.
        day: Day of the consent; None: today.
        until: First day on which it is no longer in force; None: no end.

    Raises:
        InputError: The name cannot be stored, the end is before the beginning, or `remember` is missing.
    """
    refuse_name(name)
    lapse(name)
    given = [_consent(scope, day or date.today(), by, until) for scope in dict.fromkeys(scopes)]

    def changed(file: YamlFile | None) -> Mapping[str, Any]:
        known = file.check(ConsentFile) if file else ConsentFile(person=name)
        all_ = known.model_copy(update={"consents": (*known.consents, *given)})
        if not any(one.scope == "remember" and one.withdrawn is None for one in all_.consents):
            raise InputError(
                expected="consent to remember, which goes before all others",
                got=", ".join(one.scope for one in given),
                remedy=f"If they agree: `comity profile consent {name} remember ...`.",
                where=Where("profile consent"),
            )
        return all_.model_dump(mode="json")

    file = Store().change_consent(name, changed)
    return file.check(ConsentFile)


def withdraw(name: str, scopes: Collection[Scope], day: date | None = None) -> tuple[str, ...]:
    """Withdraw consents, and delete the data they covered.

    Args:
        name: Name of the person.
        scopes: The scopes to withdraw; everything if empty or if `remember` is included.
        day: Day of the withdrawal; None: today.

    Returns:
        What was deleted, in words.

    Raises:
        InputError: No person of that name is stored.
    """
    Store().require(name)
    if not scopes or "remember" in scopes:
        Store().delete(name)
        return (f"everything that was kept of {name}",)
    when = day or date.today()

    def changed(file: YamlFile | None) -> Mapping[str, Any]:
        known = file.check(ConsentFile) if file else ConsentFile(person=name)
        ended = tuple(
            one.model_copy(update={"withdrawn": when}) if one.scope in scopes and not one.withdrawn else one
            for one in known.consents
        )
        return known.model_copy(update={"consents": ended}).model_dump(mode="json")

    Store().change_consent(name, changed)
    return _deleted(name, frozenset(SCOPES) - frozenset(scopes))


def lapse(name: str) -> tuple[str, ...]:
    """Delete a person's data without consent in force; nothing if no consent was ever recorded.

    Returns:
        What was deleted, in words.

    Raises:
        InputError: The stored file is damaged, or the system prevents deletion.
    """
    known = consents_of(name)
    today = date.today()
    if known is None or not any(one.scope == "remember" and one.from_ <= today for one in known.consents):
        return ()
    holding = known.holding(today)
    if "remember" not in holding:
        Store().delete(name)
        return (f"everything that was kept of {name}",)
    return _deleted(name, holding)


def _deleted(name: str, holding: Collection[Scope]) -> tuple[str, ...]:
    """Delete the data covered only by scopes no longer in force."""
    deleted = []
    if "learn" not in holding and Store().forget_learnt(name):
        deleted.append("what was learnt")
    if "touch" not in holding and Store().withhold_touch(name):
        deleted.append("consent to touch")
    return tuple(deleted)


def _consent(scope: Scope, day: date, by: str, until: date | None) -> Consent:
    """A validated consent; errors refer to the command line."""
    from pydantic import ValidationError

    if until is not None and until <= day:
        raise InputError(
            expected=f"an end after {day}, the day on which they agreed",
            got=str(until),
            remedy="Give a later --until, or with --at the day on which they agreed.",
            where=Where("--until"),
        )
    try:
        return Consent.model_validate({"scope": scope, "from": day, "recorded_by": by, "until": until})
    except ValidationError:
        raise InputError(
            expected="who records it: 1 to 200 characters on one line",
            got=repr(by),
            remedy="Write for example --by Kim.",
            where=Where("--by"),
        ) from None
