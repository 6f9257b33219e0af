"""What a robot says of its goals, held against the words that it may use."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import fields
from math import inf

from comity_executor.robots.goals import (
    DECLINED,
    LOST,
    STATES,
    ActStatus,
    GoalId,
    GoalStatus,
    Motion,
    MotionStatus,
)
from comity_executor.robots.map_robot import MapRobot
from comity_executor.robots.robot import Robot

FORMS = {form: tuple(field.name for field in fields(form)) for form in (MotionStatus, ActStatus)}
"""What an answer about a goal, and one about an act, has."""


class StateError(ValueError):
    """A robot says of a goal what it may not."""


class GoalLostError(Exception):
    """A goal that will not be reached: the base refused it, gave it up, was stopped or is silent."""


def known_motion(robot: Robot | MapRobot) -> Motion:
    """How the newest motion goal goes.

    Raises:
        StateError: The answer lacks something, or its state is an unknown word.
    """
    motion = robot.motion()
    _check("motion", motion, MotionStatus)
    return motion


def known_performance(robot: Robot | MapRobot, act: GoalId) -> GoalStatus:
    """How an act goes.

    Raises:
        StateError: The answer lacks something, or its state is an unknown word.
    """
    status = robot.performance(act)
    _check("performance", status, ActStatus)
    return status


def missing_in(status: object, form: type[MotionStatus | ActStatus]) -> Sequence[str]:
    """What the answer of a robot lacks of a form."""
    return [name for name in FORMS[form] if not hasattr(status, name)]


def has_stopped(robot: Robot, told_s: float = -inf) -> bool:
    """Whether the base says that it stands and has no goal any more; one that cannot say is taken to move.

    Args:
        robot: The robot.
        told_s: When it was told to stop, by its own clock [s]. What it said before the latency that it states
            is over does not count: it may not have heard of the newest goal then, nor of the stop.
    """
    try:
        motion = robot.motion()
        heard_s = told_s + robot.capabilities.latency_s
        stands = bool(motion.is_at_rest) and (motion.goal is None or motion.state in (*LOST, DECLINED))
        return stands and motion.stamp_s >= heard_s - 1e-9
    except Exception:
        return False


def _check(call: str, status: GoalStatus, form: type[MotionStatus | ActStatus]) -> None:
    if missing := missing_in(status, form):
        wanted = f"an object like {form.__name__}, with {', '.join(missing)}"
        raise StateError(f"{call}: expected {wanted}, got {status!r}")
    if status.state not in STATES:
        raise StateError(f"{call}: expected one of {', '.join(STATES)}, got {status.state!r}")
