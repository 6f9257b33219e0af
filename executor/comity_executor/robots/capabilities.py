"""What a base can do, as its maker states it: how exactly it stops, how late and how fast."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf
from typing import Protocol

LONGEST_LEASE_S = 0.3
"""A base that hears nothing for longer is to stand (our choice)."""


class Capabilities(Protocol):
    """Numbers of 0 or more; `CapabilityValues` has them for robots without a class of their own."""

    @property
    def tolerance_m(self) -> float:
        """How far from the commanded pose the base may come to rest."""
        ...

    @property
    def latency_s(self) -> float:
        """From a call until the base acts on it, at most."""
        ...

    @property
    def braking_m_s2(self) -> float:
        """How hard the base brakes when it is told to stop; above 0."""
        ...

    @property
    def feedback_hz(self) -> float:
        """How often the base says how its goal goes; above 0."""
        ...

    @property
    def lease_s(self) -> float:
        """So long the base goes on with a motion goal that is not renewed, by its own clock; then it stops.

        Above 0, and 0.3 s at most.
        """
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class MarginStatement:
    """What the maker of a base states, so that it may pass people nearer than 0.30 m.

    To state it is to say, too, that the base keeps to `MapGoal.passages`. Nothing is taken for granted: there
    are no defaults.
    """

    latency_s: float
    """From the measurement of a person's place, or its own, to the motion that answers it, at most [s]."""
    braking_m_s2: float
    """How hard the base surely brakes before a person [m/s^2]; above 0."""
    tracker_sd_m: float
    """Standard deviation of the place of a person who stands, as the tracker says it [m]."""
    path_sd_m: float
    """Standard deviation of the base's own place across its path: localisation and path following [m]."""


@dataclass(frozen=True, slots=True)
class CapabilityValues:
    """The numbers of a base that is exact and acts at once, but for those that are given.

    A lease is never taken for granted: without one that is stated, an execution refuses the robot.
    """

    tolerance_m: float = 0.0
    latency_s: float = 0.0
    braking_m_s2: float = 1.0
    feedback_hz: float = 10.0
    lease_s: float = inf
    reduced_margin: MarginStatement | None = None
    """None: the base passes nobody nearer than 0.30 m. Other classes may leave this attribute out."""
