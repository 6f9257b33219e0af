"""Comity is killed or stopped in mid-motion, and the base comes to rest: by its lease, or by the watchdog."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import pytest

from comity_executor import Execution, Loop, Watchdog
from tests.executor.conftest import infer, plan_for
from tests.executor.live.real_base import PEOPLE, Manager, RealTimeRobot, Remote

pytestmark = [
    pytest.mark.integration,
    pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX"),
]
KEY = b"a base"
REST_S = 0.5
"""So long after Comity has fallen silent the base stands; this one needs no time to brake."""


@pytest.fixture(params=["its own lease", "the watchdog"])
def base(request, tmp_path) -> Iterator[tuple[Remote, list[str]]]:
    """A base, and what makes a program drive it."""
    through = request.param == "the watchdog"
    robot = RealTimeRobot
    Manager.register("robot", callable=_Once(robot, PEOPLE, float("inf") if through else 0.3))
    manager = Manager(address=str(tmp_path / "base"), authkey=KEY)
    manager.start()
    remote = Remote(manager.address, KEY)
    program = [sys.executable, "-m", "tests.executor.live.real_base", manager.address, KEY.hex()]
    yield remote, [*program, "watchdog"] if through else program
    manager.shutdown()


class _Once:
    """Makes the robot when it is asked for first."""

    def __init__(self, make: Callable[..., object], *arguments: object) -> None:
        self._make, self._arguments, self._made = make, arguments, None

    def __call__(self) -> object:
        self._made = self._made or self._make(*self._arguments)
        return self._made


def until(holds: Callable[[], bool], within_s: float = 30.0) -> None:
    ends_s = time.monotonic() + within_s
    while not holds():
        assert time.monotonic() < ends_s
        time.sleep(0.01)


def moves(base: Remote) -> bool:
    return time.monotonic() - base.last_moved_s() < 0.1


@pytest.fixture
def comity(base) -> Iterator[subprocess.Popen[str]]:
    """The program, once the base moves."""
    remote, program = base
    with subprocess.Popen(program, stdout=subprocess.PIPE, text=True) as process:
        until(lambda: moves(remote))
        time.sleep(0.5)
        yield process
        process.kill()


def test_a_killed_program_leaves_no_moving_base(base, comity) -> None:
    remote, _ = base
    killed_s = time.monotonic()
    comity.kill()
    time.sleep(2.0)
    assert remote.last_moved_s() - killed_s <= REST_S


def test_a_stopped_program_leaves_no_moving_base_and_goes_on_with_a_new_goal_only(base, comity) -> None:
    remote, _ = base
    stopped_s, goals = time.monotonic(), remote.goals()
    comity.send_signal(signal.SIGSTOP)
    time.sleep(2.0)
    assert remote.last_moved_s() - stopped_s <= REST_S
    comity.send_signal(signal.SIGCONT)
    until(lambda: moves(remote))
    assert remote.goals() > goals


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_program_that_is_told_to_end_has_the_base_confirm_that_it_rests(base, comity, number) -> None:
    remote, _ = base
    told_s = time.monotonic()
    comity.send_signal(number)
    until(lambda: comity.poll() is not None)
    assert remote.last_moved_s() - told_s <= REST_S
    assert remote.motion().state == "stopped"
    assert comity.stdout.read().split()[-2:] == ["stopped", number.name]


def test_a_whole_visit_goes_through_a_watchdog() -> None:
    with Watchdog("tests.executor.live.real_base:RealTimeRobot", {"johanna": 2.0}, float("inf")) as robot:
        execution = Execution(plan_for("johanna"), robot, {"johanna": infer()})
        report = Loop(execution).run()
    assert report.status == "success"
    assert execution.visits[0].greeting == ("say", "nod")
