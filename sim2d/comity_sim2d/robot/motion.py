"""Reports of a robot: the progress of its motion, and its readings of people."""

from __future__ import annotations

from math import inf
from typing import NamedTuple, Protocol, runtime_checkable

from comity_sim2d.navigation.docking import PoseBeside


class PersonEstimate(NamedTuple):
    """What the robot knows about one person: its sensors' filtered estimate."""

    distance_m: float
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    person_facing_error_deg: float
    speed_m_s: float
    stamp_s: float
    is_seen: bool = True
    """False if the person is assumed to be where they were last seen."""


class MotionProgress(NamedTuple):
    """Progress of the newest motion goal."""

    state: str
    """`running`, `succeeded`, `declined` by the person, `aborted` after a bump, or `stopped`."""
    text: str = ""
    blocked_by: tuple[str, ...] = ()
    """The obstructing people."""
    is_blocked: bool = False
    """Whether it makes no progress, for the reason in the text."""
    goal: int | None = None
    """Number of the goal, from 1; None before the first."""
    stamp_s: float = 0.0
    """Time of the tick [s]; the simulated base reports at every tick."""
    remaining_m: float | None = None
    """Length of the remaining path [m]; None without a goal or route."""
    is_at_rest: bool = False
    """Whether the base stands and does not turn."""


def blocked(text: str, by: tuple[str, ...] = ()) -> MotionProgress:
    """A motion that makes no progress, and the obstructing people."""
    return MotionProgress("running", text, by, is_blocked=True)


class BaseCapabilities(NamedTuple):
    """Tolerance, latency and dynamics with which the base follows its commands."""

    tolerance_m: float = 0.0
    """Maximum distance from the commanded pose at rest [m]."""
    latency_s: float = 0.0
    braking_m_s2: float = 1.0
    feedback_hz: float = 10.0
    lease_s: float = inf


@runtime_checkable
class MotionRequest(Protocol):
    """A motion goal; the executor's goals have this form."""

    @property
    def kind(self) -> str:
        """`navigate`, `dock`, `face` or `go_to`."""
        ...

    @property
    def to(self) -> str:
        """A person; for `go_to` a place."""
        ...

    @property
    def pose(self) -> PoseBeside | None:
        """Docking pose next to the person, for `navigate` and `dock`."""
        ...

    @property
    def speed_m_s(self) -> float:
        """Maximum speed [m/s]."""
        ...

    @property
    def near_m_s(self) -> float:
        """Maximum speed within 1.5 m of the person's body, for `navigate` [m/s]."""
        ...

    @property
    def detour_m(self) -> float:
        """Maximum additional length of the route around people [m]."""
        ...
