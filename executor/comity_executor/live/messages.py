"""What Comity and the process of a watchdog say to each other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from comity_executor.robots.capabilities import CapabilityValues


@dataclass(frozen=True, slots=True)
class Begin:
    """Make the robot."""

    robot: str
    """`MODULE:CLASS`."""
    arguments: tuple[object, ...]
    path: list[str]
    """Where modules are looked for."""
    lease_s: float


@dataclass(frozen=True, slots=True)
class Ready:
    """It is made."""

    name: str
    capabilities: CapabilityValues
    more: tuple[str, ...]
    """Calls of the robot that not every robot has."""
    gesture_reach_m: Mapping[str, float] | None = None
    """How far its gestures reach, where it states that."""
    call: int = 0


@dataclass(frozen=True, slots=True)
class Call:
    """Do something."""

    call: int
    """Its number: answers carry it."""
    name: str
    arguments: tuple[object, ...]
    named: dict[str, object]


@dataclass(frozen=True, slots=True)
class CallResult:
    """What came of a call."""

    call: int
    value: object


@dataclass(frozen=True, slots=True)
class Failed:
    """A call raised."""

    call: int
    text: str
