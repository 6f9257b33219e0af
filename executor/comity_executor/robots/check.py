"""Checks that a robot implements the protocol, before the first tick."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, fields
from functools import partial
from itertools import pairwise
from math import isfinite
from numbers import Real
from typing import cast

from comity_executor.robots.capabilities import LONGEST_LEASE_S, CapabilityValues
from comity_executor.robots.goals import STATES, ActGoal, MotionGoal, MotionStatus, PlannedPose
from comity_executor.robots.robot import Robot
from comity_executor.robots.senses import COLUMNS
from comity_executor.robots.status import missing_in
from comity_executor.robots.stop_button import is_false
from comity_fis.inference.value import Inference

CALLS: Mapping[str, tuple[tuple[object, ...], Mapping[str, object]]] = {
    "now_s": ((), {}),
    "emergency": ((), {}),
    "read": (("anna",), {}),
    "heard": (("anna",), {}),
    "choose_pose": (
        ("anna",),
        dict.fromkeys(("distance_m", "bearing_deg", "distance_desirability", "direction_desirability")),
    ),
    "go": ((MotionGoal("dock", "anna", PlannedPose(0.8, 0.0), 0.4),), {}),
    "renew": ((1,), {}),
    "motion": ((), {}),
    "perform": ((ActGoal("say", "anna", "Hello."),), {}),
    "performance": ((1,), {}),
    "stop": ((1,), {}),
}
"""Calls that the tree makes, with their arguments."""
NO_LEASE = (
    f"capabilities.lease_s: expected a time above 0, and {LONGEST_LEASE_S:g} s at most, after which the base "
    "stops by itself when its goal is not renewed, got {got!r}; put a base without such a timeout behind "
    "comity_executor.Watchdog"
)
POSITIVE = ("braking_m_s2", "feedback_hz")


class RobotError(ValueError):
    """A robot that cannot be driven; the text names every missing or malformed call."""


@dataclass(frozen=True, slots=True)
class RobotCheck:
    """What `check_robot` found."""

    problems: tuple[str, ...]
    """Each names a call, what was expected and what it returned; empty if the robot can be driven."""
    tolerance_m: float
    """The tolerance that the robot states [m]; 0 if none."""
    distinct_below_m: float | None
    """Tolerance above which people's distances cannot be distinguished [m]; None if all are equal."""
    indistinct: tuple[tuple[str, str], ...]
    """Pairs of people whose distances this robot's tolerance cannot tell apart."""

    def __str__(self) -> str:
        lines = list(self.problems) or ["The robot has all that the tree needs."]
        if self.distinct_below_m is not None:
            lines.append(
                f"From a tolerance of {self.distinct_below_m:.3f} m on, one person's distance cannot be told "
                f"from another's; the robot states {self.tolerance_m:.3f} m."
            )
        lines += [
            f"{near} and {far} are met at distances that this robot cannot tell apart."
            for near, far in self.indistinct
        ]
        return "\n".join(lines)


def check_robot(
    robot: object, people: Iterable[str] = (), values: Mapping[str, Inference] | None = None
) -> RobotCheck:
    """Check a robot against the protocol: its calls, their arguments, and their current results.

    Nothing is commanded. A call that raises now may work later and is not reported.

    Args:
        robot: The robot.
        people: The people it is to read.
        values: The parameters of people, by name: whose distances are compared.
    """
    problems = [problem for name in CALLS if (problem := call_problem(robot, name, *CALLS[name]))]
    if not problems:
        problems = [problem for problem in form_problems(robot, people) if problem]
    problems += capability_problems(robot)
    stated = getattr(getattr(robot, "capabilities", None), "tolerance_m", 0.0)
    tolerance_m = float(stated) if isinstance(stated, Real) else 0.0
    distances = sorted((_distance_m(each), name) for name, each in (values or {}).items())
    gaps = [(far[0] - near[0], near[1], far[1]) for near, far in pairwise(distances) if far[0] > near[0]]
    return RobotCheck(
        tuple(problems),
        tolerance_m,
        min((gap for gap, _, _ in gaps), default=None),
        tuple((near, far) for gap, near, far in gaps if not problems and gap <= tolerance_m),
    )


def require_robot(robot: object, people: Iterable[str]) -> None:
    """Reject a robot that cannot be driven.

    Raises:
        RobotError: Listing everything that is missing or malformed.
    """
    check = check_robot(robot, people)
    if check.problems:
        raise RobotError("this robot cannot be driven:\n  " + "\n  ".join(check.problems))


def _distance_m(inference: Inference) -> float:
    return float(inference["conversational_distance"].number)


def call_problem(
    robot: object, name: str, arguments: tuple[object, ...], named: Mapping[str, object]
) -> str | None:
    """What is wrong with calling a method with these arguments; None if nothing is."""
    call = getattr(robot, name, None)
    shown = ", ".join([*(type(each).__name__ for each in arguments), *named])
    if not callable(call):
        got = "no such attribute" if call is None else repr(call)
        return f"{name}: expected a method {name}({shown}), got {got}"
    try:
        inspect.signature(call).bind(*arguments, **named)
    except TypeError as error:
        return f"{name}: expected a method that takes ({shown}), got {name}{inspect.signature(call)}: {error}"
    except ValueError:  # a method of an extension module, whose signature is unknown
        return None
    return None


def form_problems(robot: object, people: Iterable[str] = ()) -> list[str | None]:
    """What is wrong with the returned values; a call that raises now may work later."""
    robot = cast("Robot", robot)
    return [
        _checked(robot.emergency, _emergency_problem),
        _checked(robot.motion, _motion_problem),
        *(_checked(partial(robot.read, person), _reading_problem) for person in people),
    ]


def _checked(call: Callable[[], object], check: Callable[[object], str | None]) -> str | None:
    try:
        said = call()
    except Exception:
        return None
    return check(said)


def _emergency_problem(said: object) -> str | None:
    if isinstance(said, str | bool) or is_false(said):
        return None
    return f"emergency: expected False while the stop is not pressed, or why it is, got {said!r}"


def _motion_problem(said: object) -> str | None:
    if missing := missing_in(said, MotionStatus):
        return f"motion: expected an object like MotionStatus, with {', '.join(missing)}, got {said!r}"
    if (state := getattr(said, "state", None)) not in STATES:
        return f"motion: expected as state one of {', '.join(STATES)}, got {state!r}"
    return None


def _reading_problem(said: object) -> str | None:
    if said is None:
        return None
    wanted = [name for name in COLUMNS if name != "t"] + ["person_facing_error_deg"]
    wrong = [name for name in wanted if not isinstance(getattr(said, name, None), Real)]
    if not wrong:
        return None
    return f"read: expected None or an object with the numbers {', '.join(wrong)}, got {said!r}"


def capability_problems(robot: object) -> list[str]:
    """What is wrong with the numbers that a robot states."""
    stated = getattr(robot, "capabilities", None)
    found = []
    for field in fields(CapabilityValues):
        if field.name == "reduced_margin":
            continue  # checked where a scenario requires it
        value = getattr(stated, field.name, None)
        if field.name == "lease_s":
            found += _lease_problem(value)
            continue
        least = "above 0" if field.name in POSITIVE else "of 0 or more"
        number = float(value) if isinstance(value, Real) and not isinstance(value, bool) else -1.0
        if not isfinite(number) or number < 0.0 or (field.name in POSITIVE and number == 0.0):
            found.append(f"capabilities.{field.name}: expected a number {least}, got {value!r}")
    return found


def _lease_problem(value: object) -> list[str]:
    number = float(value) if isinstance(value, Real) and not isinstance(value, bool) else 0.0
    return [] if 0.0 < number <= LONGEST_LEASE_S else [NO_LEASE.format(got=value)]
