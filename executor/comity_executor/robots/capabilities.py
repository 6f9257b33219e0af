"""Capabilities of a base, as stated by its maker: tolerance, latency, braking, lease."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Protocol

LONGEST_LEASE_S = 0.3
"""Maximum lease [s]: a base without renewal for longer must stop (our choice)."""


class Capabilities(Protocol):
    """Numbers of at least 0; `CapabilityValues` implements this for robots without a class of their own."""

    @property
    def tolerance_m(self) -> float:
        """Maximum distance from the commanded pose at rest [m]."""
        ...

    @property
    def latency_s(self) -> float:
        """Maximum latency from a call until the base acts on it [s]."""
        ...

    @property
    def braking_m_s2(self) -> float:
        """Deceleration when commanded to stop, above 0 [m/s^2]."""
        ...

    @property
    def feedback_hz(self) -> float:
        """Rate of the base's reports on its goal, above 0 [Hz]."""
        ...

    @property
    def lease_s(self) -> float:
        """Time for which the base follows a motion goal without renewal, by its own clock [s]; then it stops.

        Above 0, and 0.3 s at most.
        """
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class MarginStatement:
    """Statement of a base's maker that allows it to pass people nearer than 0.30 m.

    It also asserts that the base respects `MapGoal.passages`. There are no defaults: nothing is assumed.
    """

    latency_s: float
    """Maximum latency from measuring a person's position, or its own, to the resulting motion [s]."""
    braking_m_s2: float
    """Guaranteed deceleration before a person, above 0 [m/s^2]."""
    tracker_sd_m: float
    """Standard deviation of the tracked position of a standing person [m]."""
    path_sd_m: float
    """Standard deviation of the base's own position across its path, from localisation and path following
    [m]."""


@dataclass(frozen=True, slots=True)
class CapabilityValues:
    """Default values: an exact base without latency, except for the values given.

    There is no default lease: an execution rejects a robot that does not state one.
    """

    tolerance_m: float = 0.0
    latency_s: float = 0.0
    braking_m_s2: float = 1.0
    feedback_hz: float = 10.0
    lease_s: float = inf
    reduced_margin: MarginStatement | None = None
    """None: the base passes no one nearer than 0.30 m. Other classes may omit this attribute."""
