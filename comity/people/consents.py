"""What a person agreed to: for what, from when until when, who recorded it; and what goes when it ends.

Consent is asked about by the day of the machine's clock. What it does not cover is not kept: where it ended
or was withdrawn, what it covered is deleted with the next use of the person's name.
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
"""What each allows; `remember` goes before all others."""
_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


class Consent(BaseModel):
    """One thing that a person agreed to."""

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
        """Whether what was on a day had been agreed to then, also where that ended since."""
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
    """`consent.yaml`: all that a person agreed to, also what they took back."""

    model_config = ConfigDict(
        frozen=True, extra="forbid", allow_inf_nan=False, title="What a person agreed to"
    )

    schema_version: Literal[1] = 1
    person: Word
    consents: Annotated[tuple[Consent, ...], Field(max_length=1000)] = ()

    def holding(self, day: date) -> frozenset[Scope]:
        """What is in force; without `remember` nothing is."""
        scopes: frozenset[Scope] = frozenset(one.scope for one in self.consents if one.holds(day))
        return scopes if "remember" in scopes else frozenset()


def consents_of(name: str) -> ConsentFile | None:
    """What a person agreed to; None where nothing was ever recorded.

    Raises:
        InputError: if the file in the store was damaged, with its line.
    """
    file = Store().consent_file(name)
    return None if file is None else file.check(ConsentFile)


def is_covered(name: str, scope: Scope) -> bool:
    """Whether a person agrees to something today."""
    known = consents_of(name)
    return known is not None and scope in known.holding(date.today())


def was_covered(name: str, scope: Scope, day: date) -> bool:
    """Whether a person had agreed to something on a day."""
    known = consents_of(name)
    return known is not None and any(one.scope == scope and one.covered(day) for one in known.consents)


def require_consent(name: str, scope: Scope) -> None:
    """Refuse to keep what a person did not agree to, or no more.

    Raises:
        InputError: with how their consent is recorded.
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
    """Record what a person agreed to; who agrees to be remembered is kept from now on.

    Args:
        name: Of the person.
        scopes: What they agreed to.
        by: Who records it.
        day: When they agreed; None for today.
        until: The first day on which it holds no more; None where there is no end.

    Raises:
        InputError: for a name that cannot be kept, an end before the beginning, or no consent to `remember`.
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
    """Take consent back, and delete what it covered.

    Args:
        name: Of the person.
        scopes: What they agree to no more; everything where it is empty, or `remember` is among it.
        day: When they said so; None for today.

    Returns:
        What was deleted, in words.

    Raises:
        InputError: if nobody of that name is kept.
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
    """Delete what a person agreed to no more; nothing where nothing was ever recorded.

    Returns:
        What was deleted, in words.

    Raises:
        InputError: if the file in the store was damaged, or the system does not let us delete.
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
    """Delete what only the other scopes covered."""
    deleted = []
    if "learn" not in holding and Store().forget_learnt(name):
        deleted.append("what was learnt")
    if "touch" not in holding and Store().withhold_touch(name):
        deleted.append("consent to touch")
    return tuple(deleted)


def _consent(scope: Scope, day: date, by: str, until: date | None) -> Consent:
    """One that is checked, with the command line named in complaints."""
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
