"""Scheduled changes during an episode, each of one kind, by its key."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StringConstraints, model_validator

from comity.people.fact import Fact, Number
from comity_fis.errors import WrongValueError
from comity_fis.listing import listed

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)
Metres = Annotated[Number, Field(ge=-1000, le=1000)]
Name = Annotated[str, StringConstraints(min_length=1, max_length=100)]


class Timed(BaseModel):
    """What every entry of a schedule has."""

    model_config = _FILE

    at_s: Number = Field(ge=0, le=36_000, description="When it happens, in simulated seconds.")


class Change(Timed):
    """A person walks elsewhere, says what they want or is in another situation; or the robot is stopped."""

    person: Name | None = Field(default=None, description="Who it is about; nobody for the emergency stop.")
    moves_to_m: tuple[Metres, Metres] | None = Field(
        default=None, description="They walk there, around walls and furniture."
    )
    facing_deg: Annotated[Number, Field(ge=-360, le=360)] | None = Field(
        default=None, description="How they stand there; without it as they came."
    )
    speed_m_s: Number = Field(default=1.0, gt=0, le=3, description="How fast they walk.")
    says: Mapping[str, Fact] | None = Field(
        default=None, min_length=1, description="What they ask for from now on, by parameter, as `settings`."
    )
    situation: Mapping[str, Fact] | None = Field(
        default=None, min_length=1, description="What holds around them from now on, by variable."
    )
    emergency_stop_s: Number | None = Field(
        default=None, gt=0, le=36_000, description="The robot's emergency stop is pressed for so long."
    )

    @model_validator(mode="after")
    def _one_thing(self) -> Change:
        found = [name for name in THINGS if getattr(self, name) is not None]
        if len(found) != 1:
            raise WrongValueError(
                expected=f"one of {', '.join(THINGS)}",
                got=listed(found) or "none of them",
                remedy="Write a change of its own for each.",
            )
        about_somebody = found[0] != "emergency_stop_s"
        if about_somebody != (self.person is not None):
            raise WrongValueError(
                expected="`person` beside what somebody does" if about_somebody else "no `person`",
                got=repr(self.person) if self.person else "none",
                remedy="Add `person: ...`."
                if about_somebody
                else "Remove `person`: it is the robot that stops.",
            )
        return self


THINGS = ("moves_to_m", "says", "situation", "emergency_stop_s")
"""Keys that determine the kind of an entry."""
