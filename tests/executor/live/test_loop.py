"""The loop in real time: a rate, an account of what was late, and one way out."""

from __future__ import annotations

import os
import signal
import threading
import time

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity_executor import Execution, Loop
from tests.executor.conftest import CONTROL_S, Hall, Stander, infer, plan_for

PERIOD_S = 0.05


class RealHall(Hall):
    """A hall whose world goes on while the loop sleeps, and whose calls may take their time."""

    def __init__(self) -> None:
        super().__init__({"johanna": Stander(3.0, 0.0)})
        self.slow: dict[str, float] = {}
        """How long the next call of a name takes, once [s]."""
        self._owed_s = 0.0

    def sleep(self, seconds: float) -> None:
        self._owed_s += seconds
        while self._owed_s >= CONTROL_S - 1e-9:
            self._owed_s -= CONTROL_S
            self.step()

    def clock(self) -> float:
        return self.now_s() + self._owed_s

    def _fail(self, call: str) -> None:
        super()._fail(call)
        self.sleep(self.slow.pop(call, 0.0))


def loop_of(hall: Hall) -> tuple[Execution, Loop]:
    execution = Execution(plan_for("johanna"), hall, {"johanna": infer()})
    return execution, Loop(execution, rate_hz=1 / PERIOD_S, clock=hall.clock, sleep=hall.sleep)


def test_it_ticks_at_its_rate_to_the_end() -> None:
    hall = RealHall()
    _, loop = loop_of(hall)
    report = loop.run()
    assert (report.status, report.overruns, report.interrupted_by) == ("success", (), None)
    assert report.ticks == pytest.approx(hall.now_s() / PERIOD_S, abs=2)
    assert hall.at_rest


@settings(max_examples=20)
@given(takes_s=st.floats(0.1, 3.0), call=st.sampled_from(("read", "motion", "emergency", "say")))
def test_a_tick_that_takes_longer_than_its_share_is_told(takes_s: float, call: str) -> None:
    hall = RealHall()
    _, loop = loop_of(hall)
    hall.slow[call] = takes_s
    report = loop.run()
    assert report.status == "success"
    assert [one.took_s for one in report.overruns] == pytest.approx([takes_s], abs=CONTROL_S)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("rests", [True, False])
def test_a_signal_stops_the_base_and_says_whether_it_rests(number: signal.Signals, rests: bool) -> None:
    hall = RealHall()
    _, loop = loop_of(hall)
    before = signal.getsignal(number)
    ticks = iter(range(1000))

    def each() -> None:
        if next(ticks) == 30:
            assert hall.speed > 0.0
            hall.goes_on_until_s = 0.0 if rests else 1e9
            signal.raise_signal(number)

    report = loop.run(each)
    assert report.status == ("stopped" if rests else "stop_unconfirmed")
    assert report.interrupted_by == number.name
    assert hall.at_rest
    assert signal.getsignal(number) is before


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="the system cannot break a call off")
@pytest.mark.parametrize("call", ["motion", "read"])
def test_a_call_that_does_not_return_holds_no_signal_up(call: str) -> None:
    """It hangs in mid-motion; the signal ends the loop all the same, and the base is told to stop."""
    hall = RealHall()
    execution, loop = loop_of(hall)
    before, answer, ticks = signal.getsignal(signal.SIGALRM), getattr(hall, call), iter(range(1000))

    def hang_once(*given: str) -> object:
        setattr(hall, call, answer)
        threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT)).start()
        time.sleep(60.0)
        return answer(*given)

    def each() -> None:
        if next(ticks) == 30:
            setattr(hall, call, hang_once)

    began_s = time.monotonic()
    report = loop.run(each)
    assert time.monotonic() - began_s < 30.0
    assert (execution.status, report.interrupted_by) == ("stopped", "SIGINT")
    assert hall.at_rest
    assert signal.getsignal(signal.SIGALRM) is before


def test_an_error_stops_the_base_on_its_way_out() -> None:
    hall = RealHall()
    execution, loop = loop_of(hall)

    def each() -> None:
        if hall.speed > 0.0:
            raise ValueError("of the user's own")

    with pytest.raises(ValueError, match="of the user's own"):
        loop.run(each)
    assert hall.at_rest
    assert execution.status == "stopped"


def test_it_runs_in_any_thread() -> None:
    hall = RealHall()
    _, loop = loop_of(hall)
    reports = []
    thread = threading.Thread(target=lambda: reports.append(loop.run()))
    thread.start()
    thread.join(60.0)
    assert reports[0].status == "success"


@pytest.mark.parametrize("rate_hz", [0.0, -1.0, float("nan")])
def test_a_rate_that_is_none_is_refused(rate_hz: float) -> None:
    with pytest.raises(ValueError, match="rate_hz"):
        Loop(loop_of(RealHall())[0], rate_hz=rate_hz)
