"""Validates a robot's reports on goals and acts."""

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
"""Fields of a report on a goal, and of one on an act."""


class StateError(ValueError):
    """A robot reports an invalid state of a goal."""


class GoalLostError(Exception):
    """A goal will not be reached: the base rejected or aborted it, was stopped, or stopped reporting."""


def known_motion(robot: Robot | MapRobot) -> Motion:
    """The progress of the newest motion goal.

    Raises:
        StateError: The report lacks a field, or its state is unknown.
    """
    motion = robot.motion()
    _check("motion", motion, MotionStatus)
    return motion


def known_performance(robot: Robot | MapRobot, act: GoalId) -> GoalStatus:
    """The progress of an act.

    Raises:
        StateError: The report lacks a field, or its state is unknown.
    """
    status = robot.performance(act)
    _check("performance", status, ActStatus)
    return status


def missing_in(status: object, form: type[MotionStatus | ActStatus]) -> Sequence[str]:
    """The fields missing from a robot's report."""
    return [name for name in FORMS[form] if not hasattr(status, name)]


def has_stopped(robot: Robot, told_s: float = -inf) -> bool:
    """Whether the base reports that it stands without a goal; a base that cannot report counts as moving.

    Args:
        robot: The robot.
        told_s: Time of the stop command, by the robot's clock [s]. Reports before the stated latency has
            passed do not count: they may precede the newest goal and the stop.
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
