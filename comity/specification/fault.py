"""Scheduled faults during an episode, each of one kind, described in plain terms.

A change (`comity.specification.change`) is what people do or ask for, and the robot is to serve it. A fault
obstructs the robot: its parts fail, doors shut, people walk off or stand in its path, software raises
exceptions.
"""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from comity.people.fact import Number
from comity.specification.change import Name, Timed

Count = Annotated[int, Field(strict=True, ge=1, le=1000)]
Seconds = Annotated[Number, Field(gt=0, le=36_000)]


class WheelStuck(Timed):
    """The base stands still, whatever it is told."""

    fault: Literal["wheel stuck"]
    for_s: Seconds


class SpeechFails(Timed):
    """What the robot says breaks off."""

    fault: Literal["speech fails"]
    for_s: Seconds


class SensorBlind(Timed):
    """The robot sees nobody."""

    fault: Literal["sensor blind"]
    for_s: Seconds


class PersonWalksOff(Timed):
    """A person walks away from where the robot is then."""

    fault: Literal["person walks off"]
    person: Name
    by_m: Number = Field(default=1.5, gt=0, le=100, description="How far.")
    facing_deg: Annotated[Number, Field(ge=-360, le=360)] | None = Field(
        default=None, description="How they stand there; without it as they came."
    )
    speed_m_s: Number = Field(default=1.0, gt=0, le=3, description="How fast they walk.")


class PersonInTheWay(Timed):
    """A person goes and stands on the robot's way, as soon as it is under way, and goes back later."""

    fault: Literal["person in the way"]
    person: Name
    for_s: Seconds
    speed_m_s: Number = Field(default=1.0, gt=0, le=3, description="How fast they walk.")


class DoorCloses(Timed):
    """A door is shut, as soon as nobody stands in it."""

    fault: Literal["door closes"]
    door: Name
    for_s: Seconds | None = Field(
        default=None,
        description="It is opened again then, unless it was shut before; without it it stays shut.",
    )


class DoorOpens(Timed):
    """A door is opened."""

    fault: Literal["door opens"]
    door: Name
    for_s: Seconds | None = Field(
        default=None,
        description="It is shut again then, unless it was open before; without it it stays open.",
    )


class PlannerFails(Timed):
    """The next calls of the planner raise an exception; the first plan was made before."""

    fault: Literal["planner fails"]
    calls: Count = Field(default=1, description="How many calls.")


class LeafRaises(Timed):
    """A leaf of the tree raises an exception when it is ticked next."""

    fault: Literal["leaf raises"]
    leaf: Name = Field(description="Its name, `say(johanna)`, or for all that are called so, `say`.")
    times: Count = Field(default=1, description="In so many of its ticks.")


Fault = Annotated[
    WheelStuck
    | SpeechFails
    | SensorBlind
    | PersonWalksOff
    | PersonInTheWay
    | DoorCloses
    | DoorOpens
    | PlannerFails
    | LeafRaises,
    Field(discriminator="fault"),
]


def in_words(fault: Fault) -> str:
    """The fault with its time and duration, as in the trace."""
    return f"fault at t={fault.at_s:g} s: {deed(fault)}"


def deed(fault: Fault) -> str:
    """The fault with its duration."""
    match fault:
        case PersonWalksOff():
            what = f"{fault.person} walks off"
        case PersonInTheWay():
            what = f"{fault.person} in the way"
        case DoorCloses():
            what = f"{fault.door} closes"
        case DoorOpens():
            what = f"{fault.door} opens"
        case LeafRaises():
            what = f"leaf {fault.leaf} raises"
        case _:
            what = fault.fault
    for_s = getattr(fault, "for_s", None)
    return what + (f" for {for_s:g} s" if for_s else "")
