"""Timeouts in the world's time, and a limited number of attempts."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from py_trees.behaviours import Running, StatusQueue
from py_trees.common import Status

from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_a_child_that_runs_too_long_fails_and_is_halted() -> None:
    clock = Clock()
    child = Running("child")
    timeout = SimulatedTimeout("timeout", child, duration_s=2.0, clock=clock)
    for clock.now in (10.0, 11.9):
        timeout.tick_once()
        assert timeout.status is Status.RUNNING
        assert timeout.account() is None
    clock.now = 12.0
    timeout.tick_once()
    assert timeout.status is Status.FAILURE
    assert child.status is Status.INVALID
    assert timeout.account().text == "child did not end within 2 s"


def test_every_round_has_its_own_time() -> None:
    clock = Clock()
    timeout = SimulatedTimeout("timeout", Running("child"), duration_s=2.0, clock=clock)
    timeout.tick_once()
    clock.now = 2.0
    timeout.tick_once()
    clock.now = 3.0
    timeout.tick_once()
    assert timeout.status is Status.RUNNING
    assert not timeout.timed_out


def test_a_result_in_the_last_moment_counts() -> None:
    clock = Clock()
    child = StatusQueue("child", queue=[Status.RUNNING], eventually=Status.SUCCESS)
    timeout = SimulatedTimeout("timeout", child, duration_s=2.0, clock=clock)
    timeout.tick_once()
    clock.now = 2.0
    timeout.tick_once()
    assert timeout.status is Status.SUCCESS


@given(st.integers(1, 5), st.integers(0, 7))
def test_attempts_are_counted(attempts: int, failures: int) -> None:
    """So many failures are forgiven, less one; the next success counts."""
    child = StatusQueue("child", queue=[Status.FAILURE] * failures, eventually=Status.SUCCESS)
    retry = Retry("retry", child, attempts=attempts, pause_s=1.0, clock=lambda: 0.0)
    ticks = 0
    while retry.status in (Status.INVALID, Status.RUNNING):
        retry.tick_once()
        ticks += 1
    assert retry.status is (Status.SUCCESS if failures < attempts else Status.FAILURE)
    assert ticks == min(attempts, failures + 1), "one attempt a tick"


def test_no_attempt_is_no_retry() -> None:
    with pytest.raises(ValueError, match="at least one attempt"):
        Retry("retry", Running("child"), attempts=0, pause_s=1.0, clock=lambda: 0.0)
