"""The tick in plain calls against py_trees' own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from hypothesis import given
from hypothesis import strategies as st
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence

from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.node import preorder
from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout
from comity_executor.nodes.ticking import ticked

RESULTS = (Status.RUNNING, Status.SUCCESS, Status.FAILURE)
Log = list[tuple[Any, ...]]


class Scripted(Behaviour):
    """Comes out as its script says, and writes down what py_trees asks of it."""

    def __init__(self, name: str, script: tuple[Status, ...], log: Log) -> None:
        super().__init__(name)
        self._script, self._log, self._asked = script, log, 0

    def initialise(self) -> None:
        self._log.append(("initialise", self.name))

    def update(self) -> Status:
        self._asked += 1
        self._log.append(("update", self.name))
        return self._script[self._asked % len(self._script)]

    def terminate(self, new_status: Status) -> None:
        self._log.append(("terminate", self.name, self.status, new_status))


class Twice(Scripted):
    """Ticks in its own way."""

    def tick(self) -> Iterator[Behaviour]:
        self._log.append(("own tick", self.name))
        yield from super().tick()


scripts = st.lists(st.sampled_from(RESULTS), min_size=1, max_size=5).map(tuple)
policies = st.sampled_from(
    (
        lambda children: ParallelPolicy.SuccessOnAll(synchronise=False),
        lambda children: ParallelPolicy.SuccessOnAll(synchronise=True),
        lambda children: ParallelPolicy.SuccessOnOne(),
        lambda children: ParallelPolicy.SuccessOnSelected(children[:1], synchronise=False),
    )
)
leaves = st.tuples(st.sampled_from(("leaf", "own")), scripts)


def _branches(below: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    children = st.lists(below, min_size=1, max_size=4)
    return st.one_of(
        st.tuples(st.sampled_from(("sequence", "selector")), st.booleans(), children),
        st.tuples(st.just("parallel"), policies, children),
        st.tuples(st.sampled_from(("retry", "timeout", "act timeout")), st.integers(1, 3), below),
    )


trees = st.recursive(leaves, _branches, max_leaves=12)


def _build(plan: Any, log: Log, now: Callable[[], float], names: Iterator[int]) -> Behaviour:
    kind, first, *rest = plan
    name = f"{kind} {next(names)}"
    if kind in ("leaf", "own"):
        return (Scripted if kind == "leaf" else Twice)(name, first, log)
    below = [_build(each, log, now, names) for each in (rest[0] if isinstance(rest[0], list) else rest)]
    if kind == "retry":
        return Retry(name, below[0], attempts=first)
    if kind == "timeout":
        return SimulatedTimeout(name, below[0], duration_s=float(first), clock=now)
    if kind == "act timeout":
        return ActTimeout(name, below[0], duration_s=2.0 * first, pause_s=2.0, clock=now)
    if kind == "parallel":
        return Parallel(name, first(below), below)
    return (Sequence if kind == "sequence" else Selector)(name, first, below)


def _state(root: Behaviour) -> Log:
    current = [getattr(node, "current_child", None) for node in preorder(root)]
    return [
        (node.name, node.status, child.name if child else None)
        for node, child in zip(preorder(root), current, strict=True)
    ]


def _told(plan: Any, halts: set[int], *, ours: bool) -> Log:
    """All that happens in a dozen ticks: hooks, visits and the state of every node after each."""
    log: Log = []
    time = [0.0]
    root = _build(plan, log, lambda: time[0], iter(range(1000)))
    one = ticked(root, {}, lambda node: log.append(("visit", node.name, node.status)))
    for tick in range(12):
        time[0] = float(tick)
        if ours:
            one.tick()
        else:
            for node in root.tick():
                log.append(("visit", node.name, node.status))
        log += _state(root)
        if tick in halts:
            (one if ours else root).stop(Status.INVALID)
            log += _state(root)
    return log


@given(trees, st.sets(st.integers(0, 11), max_size=2))
def test_every_tree_is_ticked_as_py_trees_ticks_it(plan: Any, halts: set[int]) -> None:
    """The same hooks in the same order, the same visits, the same state of all nodes after every tick."""
    assert _told(plan, halts, ours=True) == _told(plan, halts, ours=False)
