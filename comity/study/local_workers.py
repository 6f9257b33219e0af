"""Worker processes on this machine, each with its own pipe, so that a lost one and its episode are known."""

from __future__ import annotations

import signal
from collections import deque
from collections.abc import Generator, Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from multiprocessing import get_context
from multiprocessing.connection import Connection, wait
from typing import TYPE_CHECKING, Any

from comity.study.carrying import MOST_LOSSES, Ended, EpisodeRunner
from comity.study.worker import StudyTask, TaskDone, carried_out, installation, lost_rows

if TYPE_CHECKING:
    from multiprocessing.context import SpawnProcess

MOST_PROCESSES = 60
"""Maximum number of processes: Windows can wait for no more at once."""


def local_carrier(jobs: int) -> EpisodeRunner:
    """A runner with this number of newly started processes."""
    return EpisodeRunner(installation(), lambda tasks: _carried(tasks, min(jobs, MOST_PROCESSES)))


@dataclass(slots=True)
class _Attempt:
    """An episode that is run by a process, or was when the process was lost."""

    task: StudyTask
    losses: int = 0


@dataclass(slots=True, eq=False)
class _Process:
    """A process and our end of the pipe."""

    connection: Any
    process: SpawnProcess
    attempt: _Attempt | None = None

    @classmethod
    def started(cls) -> _Process:
        context = get_context("spawn")
        here, there = context.Pipe()
        process = context.Process(target=_serve, args=(there,), daemon=True)
        process.start()
        there.close()  # so that the pipe closes when the process ends
        return cls(here, process)

    def begin(self, attempt: _Attempt) -> None:
        self.attempt = attempt
        with suppress(OSError):  # a lost process is detected when its pipe is waited for
            self.connection.send(attempt.task)

    def end(self) -> None:
        self.connection.close()
        self.process.kill()
        self.process.join()


@dataclass(slots=True)
class _Queue:
    """Queue of episodes; those of lost processes come first."""

    tasks: Iterator[StudyTask]
    again: deque[_Attempt] = field(default_factory=deque)

    def next(self) -> _Attempt | None:
        if self.again:
            return self.again.popleft()
        task = next(self.tasks, None)
        return None if task is None else _Attempt(task)


def _carried(tasks: Iterator[StudyTask], jobs: int) -> Generator[Ended]:
    queue, processes = _Queue(tasks), list[_Process]()
    try:
        while len(processes) < jobs and (attempt := queue.next()):
            processes.append(_Process.started())
            processes[-1].begin(attempt)
        while busy := {one.connection: one for one in processes if one.attempt}:
            ready = [busy[connection] for connection in wait(list(busy))]
            ended = [_received(process, processes, queue) for process in ready]
            done = tuple(one for one, _ in ended if one is not None)
            yield Ended(done, sum(is_lost for _, is_lost in ended))
    finally:
        for process in processes:
            process.end()


def _received(process: _Process, processes: list[_Process], queue: _Queue) -> tuple[TaskDone | None, bool]:
    """The result of a process, and whether it was lost; it, or its replacement, gets the next episode."""
    attempt, done, is_lost = process.attempt, None, False
    assert attempt is not None
    try:
        done = process.connection.recv()
    except (EOFError, OSError):
        is_lost = True
        process.end()
        processes.remove(process)
        attempt.losses += 1
        if attempt.losses < MOST_LOSSES:
            queue.again.append(attempt)
        else:
            done = TaskDone(attempt.task.key, lost_rows(attempt.task, attempt.losses), 0.0)
    process.attempt = None
    if (following := queue.next()) is not None:
        if is_lost:
            process = _Process.started()
            processes.append(process)
        process.begin(following)
    return done, is_lost


def _serve(connection: Connection) -> None:
    """Run episodes until the command closes the pipe, or has ended."""
    import comity.system.garbage
    import comity.system.threads  # noqa: F401

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches all processes: the command ends them
    try:
        while True:
            connection.send(carried_out(connection.recv()))
    except (EOFError, OSError):
        return
