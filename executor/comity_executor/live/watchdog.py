"""A robot in a separate process, for bases that keep moving until told otherwise.

    Comity  --calls-->  watchdog process  --calls-->  base

The watchdog process holds the connection to the base. If it has heard no `renew` within the lease, because
Comity hangs, was stopped or is gone, it stops the base itself, repeating the command until the base rests.
"""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from multiprocessing.connection import Listener
from secrets import token_bytes
from types import TracebackType
from typing import cast

from comity_executor.live.messages import Begin, Call, CallResult, Failed, Ready
from comity_executor.robots.capabilities import LONGEST_LEASE_S, Capabilities
from comity_executor.robots.goals import ActGoal, GoalId, GoalStatus, Motion, MotionGoal, RelativePose
from comity_executor.robots.map_robot import MapGoal
from comity_executor.robots.robot import Reading, Words
from comity_fis.defuzzification.curve import Curve

ANSWER_S = 0.5
"""Time after which a call without an answer has failed [s]; an unreadable stop counts as pressed (our
choice)."""
START_S = 30.0
"""Maximum time for the robot's class to connect [s]."""


class WatchdogError(Exception):
    """The robot behind a watchdog does not answer, or its call raised; the text is the reason."""


class Watchdog:
    """A `Robot` or `MapRobot` that forwards calls to a robot in a separate process.

    The base needs no lease of its own. `stop` and `motion` of the robot are called in a second thread there
    when the base has to be stopped, also while another call is under way.

    Args:
        robot: `MODULE:CLASS` of the robot; anything importable that makes one.
        arguments: What it is made with; they are pickled.

    Raises:
        WatchdogError: The robot could not be made; with its reason.
    """

    def __init__(self, robot: str, *arguments: object) -> None:
        key = token_bytes(32)
        with Listener(authkey=key) as listener:
            self._process = _start(listener, key)
            self._connection = listener.accept()
        self._calls = 0
        self._one_at_a_time = threading.Lock()
        self._connection.send(Begin(robot, arguments, sys.path, LONGEST_LEASE_S))
        ready = self._receive(START_S)
        if isinstance(ready, Failed):
            self.close()
            raise WatchdogError(f"{robot} could not be made: {ready.text}")
        ready = cast("Ready", ready)
        self.name, self._more, can = ready.name, ready.more, ready.capabilities
        if ready.gesture_reach_m is not None:
            self.gesture_reach_m = ready.gesture_reach_m
        self.capabilities: Capabilities = replace(can, lease_s=LONGEST_LEASE_S)

    def close(self) -> None:
        """Let the watchdog stop the base and end."""
        self._connection.close()
        self._process.wait()

    def __enter__(self) -> Watchdog:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def now_s(self) -> float:
        """Forwarded to the robot."""
        return cast("float", self._call("now_s"))

    def read(self, person: str) -> Reading | None:
        """Forwarded to the robot."""
        return cast("Reading | None", self._call("read", person))

    def heard(self, person: str) -> Sequence[Words]:
        """Forwarded to the robot."""
        return cast("Sequence[Words]", self._call("heard", person))

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> RelativePose | None:
        """Forwarded to the robot."""
        return cast(
            "RelativePose | None",
            self._call(
                "choose_pose",
                person,
                distance_m=distance_m,
                bearing_deg=bearing_deg,
                distance_desirability=distance_desirability,
                direction_desirability=direction_desirability,
            ),
        )

    def go(self, goal: MotionGoal | MapGoal) -> GoalId:
        """Have the robot set out; the goal holds while it is renewed."""
        return cast("GoalId", self._call("go", goal))

    def renew(self, goal: GoalId) -> None:
        """Tell the watchdog that all is well."""
        self._call("renew", goal)

    def motion(self) -> Motion:
        """As the robot says; `aborted` where the watchdog has stopped it."""
        return cast("Motion", self._call("motion"))

    def perform(self, act: ActGoal) -> GoalId:
        """Have the robot begin."""
        return cast("GoalId", self._call("perform", act))

    def performance(self, act: GoalId) -> GoalStatus:
        """Forwarded to the robot."""
        return cast("GoalStatus", self._call("performance", act))

    def stop(self, goal: GoalId | None = None) -> None:
        """Have the robot stop."""
        self._call("stop", goal)

    def emergency(self) -> str | bool:
        """Forwarded to the robot."""
        return cast("str | bool", self._call("emergency"))

    def __getattr__(self, name: str) -> Callable[..., object]:
        """A call that only some robots have, such as `localisation` or `carried`, where this one has it."""
        if name.startswith("_") or name not in self._more:
            raise AttributeError(f"the robot behind this watchdog has no {name}")
        return partial(self._call, name)

    def _call(self, name: str, *arguments: object, **named: object) -> object:
        """Have it done there, and wait for the answer.

        Raises:
            WatchdogError: There is none in time, the process is gone, or the robot's call raised.
        """
        with self._one_at_a_time:  # the stop is read in a thread of its own
            self._calls += 1
            try:
                self._connection.send(Call(self._calls, name, arguments, named))
                answer = self._receive(ANSWER_S)
            except (OSError, EOFError) as error:
                raise WatchdogError(f"{name}: the watchdog's process is gone") from error
        if isinstance(answer, Failed):
            raise WatchdogError(f"{name}: {answer.text}")
        return cast("CallResult", answer).value

    def _receive(self, within_s: float) -> object:
        """The answer to the newest call: one that comes too late is not taken for another's."""
        ends_s = time.monotonic() + within_s
        while self._connection.poll(max(0.0, ends_s - time.monotonic())):
            answer = self._connection.recv()
            if answer.call == self._calls:
                return answer
        raise WatchdogError(f"the robot has not answered within {within_s:g} s")


def _start(listener: Listener, key: bytes) -> subprocess.Popen[bytes]:
    """The process, in a session of its own: what the terminal sends to Comity does not end or hold it."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    process = subprocess.Popen(
        [sys.executable, "-m", "comity_executor.live.watched", str(listener.address)],
        stdin=subprocess.PIPE,
        env=environment,
        start_new_session=True,
    )
    assert process.stdin is not None
    process.stdin.write(key.hex().encode() + b"\n")
    process.stdin.flush()
    return process
