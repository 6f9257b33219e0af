"""Whatever late, lost and dying calls come together, the laws of a stop and of an end hold."""

from __future__ import annotations

import threading
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor

import pytest

from comity_executor import Execution, Heartbeat, Loop
from tests.executor.chaos import Chaos, rest, run
from tests.executor.conftest import CONTROL_S, infer, plan_for

FEW, ALL, IN_REAL_TIME = 30, 500, 20


def holds(seed: int) -> str:
    hall, execution = run(seed)
    assert execution.status in ("success", "failure", "stopped", "stop_unconfirmed")
    for visit in execution.visits:
        assert visit.outcome != "pending"
        assert visit.failure or visit.outcome == "greeted"
    rest(hall, execution)
    done = Counter(hall.finished)
    assert all(done[act, person] <= 1 for act in ("say", "nod") for person in hall.people)
    return execution.status


@pytest.mark.parametrize("seed", range(FEW))
def test_every_episode_ends_at_rest_and_nothing_begins_while_stopped(seed: int) -> None:
    holds(seed)


@pytest.mark.parametrize("seed", range(5))
def test_the_same_seed_gives_the_same_trace(seed: int) -> None:
    assert run(seed)[1].trace_sha256() == run(seed)[1].trace_sha256()


@pytest.mark.study
def test_in_500_runs_the_laws_hold_and_half_of_them_serve_everybody() -> None:
    outcomes = Counter(holds(seed) for seed in range(ALL))
    print(dict(outcomes))
    assert outcomes["success"] > 0.4 * ALL


class InRealTime:
    """A robot whose world goes on by itself, in another thread than those that call it."""

    def __init__(self, hall: Chaos) -> None:
        self._hall = hall
        self._lock = threading.RLock()
        self._is_over = threading.Event()
        threading.Thread(target=self._live, daemon=True).start()

    def _live(self) -> None:
        while not self._is_over.wait(CONTROL_S):
            with self._lock:
                self._hall.step()

    def end(self) -> None:
        self._is_over.set()

    def __getattr__(self, name: str) -> object:
        found = getattr(self._hall, name)
        if not callable(found):
            return found

        def locked(*arguments: object, **named: object) -> object:
            with self._lock:
                return found(*arguments, **named)

        return locked


def in_real_time(seed: int) -> str:
    hall = Chaos(seed)
    robot = InRealTime(hall)
    with Heartbeat(robot.emergency) as heartbeat:
        values = {person: infer() for person in hall.people}
        execution = Execution(plan_for(*hall.people), robot, values, emergency=heartbeat.read)
        began_s, begun = time.monotonic(), 0

        def each() -> None:
            nonlocal begun
            if execution.stopped_by is not None:
                assert len(hall.begun) == begun, f"something begins while stopped, seed {seed}"
                execution.resume()
            begun = len(hall.begun)
            assert time.monotonic() - began_s < 300.0

        report = Loop(execution).run(each)
    time.sleep(2.0)
    assert execution.is_at_rest or report.status == "stop_unconfirmed"
    assert not hall.moves
    robot.end()
    return report.status


@pytest.mark.study
def test_20_runs_in_real_threads_and_real_time_end_at_rest() -> None:
    with ThreadPoolExecutor(IN_REAL_TIME) as pool:
        outcomes = Counter(pool.map(in_real_time, range(IN_REAL_TIME)))
    print(dict(outcomes))
    assert outcomes["success"] > 0
