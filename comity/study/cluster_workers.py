"""Runner on a Dask cluster, by the address of its scheduler."""

from __future__ import annotations

import logging
from collections.abc import Generator, Iterator
from dataclasses import dataclass, field
from queue import Empty, SimpleQueue
from time import monotonic
from typing import Any

from comity.study.carrying import MOST_LOSSES, Ended, EpisodeRunner
from comity.study.worker import (
    Installation,
    StudyTask,
    TaskDone,
    carried_out,
    installation,
    lost_rows,
)
from comity_fis import InputError, Where
from comity_fis.errors import ComityError

FOR_EACH = 3
"""Episodes queued per worker thread, so that no thread waits."""
PATIENCE_S = 30.0
"""Time without an answer after which the cluster counts as lost [s]."""
POLL_S = 1.0


class ClusterLost(ComityError):  # noqa: N818 - it says what happened; the family's base carries the suffix
    """The cluster cannot be reached any more."""

    def __init__(self, address: str) -> None:
        super().__init__(
            f"expected a cluster that answers at {address}, got none. What had ended is kept: run the same "
            "command again to go on."
        )


def cluster_carrier(address: str) -> EpisodeRunner:
    """A runner on all workers of a cluster; more may join later.

    Args:
        address: Address of the scheduler, such as `tcp://127.0.0.1:8786`.

    Raises:
        InputError: if Dask is not installed, there is no cluster, or its workers have other code.
    """
    client = _connected(address)
    try:
        return EpisodeRunner(
            _installed(client, address), lambda tasks: _Cluster(client, address).carried(tasks)
        )
    except BaseException:
        client.close()
        raise


def _connected(address: str) -> Any:
    where = Where("--scheduler")
    try:
        from dask.config import set as set_dask
        from distributed import Client
    except ImportError:
        raise InputError(
            expected="Dask for a cluster",
            got="none installed",
            remedy="Install it: pip install 'comity[study]'.",
            where=where,
        ) from None
    for logger in ("distributed", "distributed.client"):
        logging.getLogger(logger).setLevel(logging.CRITICAL)  # reported once, by us
    set_dask({"distributed.comm.timeouts.connect": f"{PATIENCE_S:g}s"})
    try:
        make: Any = Client
        client = make(address, timeout=PATIENCE_S, set_as_default=False)
        client.wait_for_workers(1, timeout=PATIENCE_S)
    except (OSError, TimeoutError, ValueError) as error:
        raise InputError(
            expected=f"a Dask scheduler with a worker at {address}",
            got=str(error).splitlines()[0] if str(error) else "no answer",
            remedy="Start `dask scheduler` and `dask worker ADDRESS --nthreads 1`, or check the address.",
            where=where,
        ) from None
    return client


def _installed(client: Any, address: str) -> Installation:
    """The installation common to all workers: the command's own code, and identical libraries."""
    try:
        found = set(client.run(installation).values())
    except ImportError as error:
        raise _other(address, f"a worker without it ({error})") from None
    if len(found) > 1:
        fingerprints = "; ".join(sorted({one.fingerprint for one in found}))
        raise _other(address, f"workers that differ: {fingerprints}")
    one: Installation = found.pop()
    if one.code != installation().code:
        raise _other(address, "other code")
    return one


def _other(address: str, got: str) -> InputError:
    return InputError(
        expected=f"the same Comity on the workers of {address} as here",
        got=got,
        remedy="Install the same version, Python and libraries on all of them.",
        where=Where("--scheduler"),
    )


@dataclass(slots=True)
class _Cluster:
    """A cluster while a study runs on it."""

    client: Any
    address: str
    ended: SimpleQueue[Any] = field(default_factory=SimpleQueue)
    under_way: dict[Any, tuple[StudyTask, int]] = field(default_factory=dict)
    """By future: the task, and the number of workers lost on it."""

    def carried(self, tasks: Iterator[StudyTask]) -> Generator[Ended]:
        """Run episodes; they may end in any order."""
        workers = set(self.client.nthreads())
        try:
            self._fill(tasks)
            while self.under_way:
                done = tuple(one for future in self._next() if (one := self._result(future)))
                self._fill(tasks)
                if done:
                    yield Ended(done)
            yield Ended((), lost=len(workers - set(self.client.nthreads())))
        finally:
            self.client.close()

    def _fill(self, tasks: Iterator[StudyTask]) -> None:
        room = FOR_EACH * max(1, sum(self.client.nthreads().values()))
        while len(self.under_way) < room and (task := next(tasks, None)) is not None:
            self._submit(task, 0)

    def _submit(self, task: StudyTask, losses: int) -> None:
        future = self.client.submit(
            _carried_there, task, key=f"comity-{task.key}-{losses}", pure=False, retries=0
        )
        self.under_way[future] = (task, losses)
        future.add_done_callback(self.ended.put)

    def _next(self) -> list[Any]:
        """Futures that have ended; waits for at least one.

        Raises:
            ClusterLost: if the scheduler gives no answer.
        """
        silent_since = None
        while True:
            try:
                found = [self.ended.get(timeout=POLL_S)]
            except Empty:
                now_s = monotonic()
                silent_since = None if self.client.status == "running" else (silent_since or now_s)
                if self.client.status == "closed" or (silent_since and now_s - silent_since > PATIENCE_S):
                    raise ClusterLost(self.address) from None
                continue
            while not self.ended.empty():
                found.append(self.ended.get())
            return found

    def _result(self, future: Any) -> TaskDone | None:
        """The result of an episode; None if it is run again."""
        from distributed import KilledWorker

        task, losses = self.under_way.pop(future)
        if future.status == "finished":
            done: TaskDone = future.result()
            return done
        if future.status == "cancelled":
            raise ClusterLost(self.address)
        error = future.exception()
        if not isinstance(error, KilledWorker):
            raise error
        losses += int(getattr(error, "allowed_failures", 0)) + 1
        if losses >= MOST_LOSSES:
            return TaskDone(task.key, lost_rows(task, losses), 0.0)
        self._submit(task, losses)
        return None


def _carried_there(task: StudyTask) -> TaskDone:
    """Run a task on a worker; checks the installation, as one that joined later may differ."""
    if installation() != task.installed:
        raise _other("the cluster", "a worker that joined later, with another")
    return carried_out(task)
