"""Reach of gestures beyond the robot's body: anything nearer would be hit."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

REACH_M: Mapping[str, float] = MappingProxyType(
    {
        "none": 0.0,
        "nod": 0.0,  # the head stays above the body
        "palms_together": 0.15,  # hands before the chest
        "bow": 0.25,  # half an upper body of 0.5 m, bent by 30 degrees
        "bow_and_nod": 0.25,
        "wave": 0.30,  # a forearm, raised beside the body
        "handshake": 0.60,  # a stretched arm
    }
)
"""Reach in front of and beside a human-sized robot that does not state its own [m] (our choice). None of the
gestures without contact reaches a person at the safety floor of 0.30 m."""
FORWARDS = frozenset({"palms_together", "bow", "bow_and_nod", "handshake"})
"""Gestures that reach forwards only, as wide as the body; others also reach sideways (our choice)."""
STRETCHED_M = 0.60
"""Reach of any other gesture [m]: it may stretch out an arm (our choice)."""


def reach_of(gesture: str, stated: Mapping[str, float]) -> float:
    """Reach of a gesture beyond the robot's body [m].

    Args:
        gesture: Name of the gesture.
        stated: Reach that the robot states, by gesture [m].
    """
    return stated.get(gesture, REACH_M.get(gesture, STRETCHED_M))
