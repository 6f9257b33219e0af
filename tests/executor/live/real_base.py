"""A base in a process of its own that moves by the real clock, and a program that drives it.

    python -m tests.executor.live.real_base ADDRESS KEY [watchdog]

is such a program: it goes to a person far away, directly or through a watchdog.
"""

from __future__ import annotations

import os
import sys
import threading
import time
from multiprocessing.managers import BaseManager

from comity_executor import CapabilityValues, Execution, Loop, ScriptedRobot, Watchdog

STEP_S = 0.02
PEOPLE = {"johanna": 60.0}


class RealTimeRobot(ScriptedRobot):
    """It steps by itself; `lease_s` is whether it stops by itself, too."""

    def __init__(self, people: dict[str, float] = PEOPLE, lease_s: float = 0.3) -> None:
        self._lease_s = lease_s
        super().__init__(people, step_s=STEP_S, act_s=0.3)
        self._last_moved_s = 0.0
        threading.Thread(target=self._live, daemon=True).start()

    def _live(self) -> None:
        while True:
            time.sleep(STEP_S)
            self.step()
            if self._speed_m_s > 0.0:
                self._last_moved_s = time.monotonic()

    @property
    def capabilities(self) -> CapabilityValues:
        return CapabilityValues(lease_s=self._lease_s)

    def can(self) -> CapabilityValues:
        return self.capabilities

    def last_moved_s(self) -> float:
        """When it moved last, by the clock of the machine."""
        return self._last_moved_s

    def goals(self) -> int:
        return self._goals


class Manager(BaseManager):
    """Serves one robot to several processes."""


class Remote:
    """A robot that is in the manager's process: a connection to a base as a driver would have it."""

    def __init__(self, address: str, key: bytes) -> None:
        Manager.register("robot")
        manager = Manager(address=address, authkey=key)
        manager.connect()
        self._robot = manager.robot()  # type: ignore[attr-defined]
        self.name = "robot"
        self.capabilities = self._robot.can()

    def __getattr__(self, name: str) -> object:
        return getattr(self._robot, name)


def main() -> None:
    from tests.executor.conftest import infer, plan_for

    address, key = sys.argv[1], bytes.fromhex(sys.argv[2])
    through = sys.argv[3:] == ["watchdog"]
    robot = Watchdog(f"{__spec__.name}:Remote", address, key) if through else Remote(address, key)
    print("ready", os.getpid(), flush=True)
    report = Loop(Execution(plan_for(*PEOPLE), robot, {person: infer() for person in PEOPLE})).run()
    print(report.status, report.interrupted_by, flush=True)


if __name__ == "__main__":
    main()
