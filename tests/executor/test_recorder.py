"""The recorder against the truth: a hook on every begin and every assignment of a status, on random trees."""

from __future__ import annotations

import random
from collections import defaultdict
from collections.abc import Callable, Iterator

import py_trees
import pytest
from py_trees.behaviour import Behaviour
from py_trees.common import ParallelPolicy, Status
from py_trees.composites import Parallel, Selector, Sequence
from py_trees.trees import BehaviourTree

from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout
from comity_executor.tracing.recorder import Recorder

TICKS = 60
Told = dict[tuple[int, int], list[str]]
"""Per tick and node, what happened to it, in order."""


class Hooked(Behaviour):
    """Writes down every assignment of its status; a leaf its begins, too."""

    assignments: list[tuple[Behaviour, Status, Status | None]]
    """Node, status before, status after; None where a leaf begins."""

    @property
    def status(self) -> Status:
        return self.__dict__.get("hooked_status", Status.INVALID)

    @status.setter
    def status(self, new: Status) -> None:
        if "assignments" in self.__dict__:
            self.assignments.append((self, self.status, new))
        self.__dict__["hooked_status"] = new


class Dice(Hooked):
    """A leaf that comes out at random, and mostly goes on as before."""

    def __init__(self, name: str, dice: random.Random) -> None:
        super().__init__(name)
        self.dice = dice
        self.inertia = dice.choice((0.0, 0.5, 0.9))

    def initialise(self) -> None:
        self.assignments.append((self, self.status, None))

    def update(self) -> Status:
        if self.status is not Status.INVALID and self.dice.random() < self.inertia:
            return self.status
        return self.dice.choice((Status.RUNNING, Status.SUCCESS, Status.FAILURE))


class HookedSequence(Hooked, Sequence): ...


class HookedSelector(Hooked, Selector): ...


class HookedParallel(Hooked, Parallel): ...


class HookedRetry(Hooked, Retry): ...


class HookedActTimeout(Hooked, ActTimeout): ...


class HookedTimeout(Hooked, SimulatedTimeout): ...


class HookedInverter(Hooked, py_trees.decorators.Inverter): ...


class HookedRepeat(Hooked, py_trees.decorators.Repeat): ...


class Restless(Hooked, py_trees.decorators.Decorator):
    """A decorator of a user's own: one time in three, it stops its child and has it begin again at once."""

    def __init__(self, name: str, child: Behaviour, dice: random.Random) -> None:
        super().__init__(name, child)
        self.dice = dice

    def tick(self) -> Iterator[Behaviour]:
        if self.decorated.status is Status.RUNNING and self.dice.random() < 0.3:
            self.decorated.stop(Status.INVALID)
        yield from super().tick()

    def update(self) -> Status:
        return self.decorated.status


class HookedFailureIsRunning(Hooked, py_trees.decorators.FailureIsRunning): ...


class RandomTree:
    """A tree of random shape with up to four levels below the root, over a clock that counts ticks."""

    def __init__(self, seed: int) -> None:
        self.dice = random.Random(seed)
        self.now = 0
        self.assignments: list[tuple[Behaviour, Status, Status | None]] = []
        self.root = self._composite(4)
        for node in self.root.iterate():
            node.__dict__["assignments"] = self.assignments

    def _node(self, depth: int) -> Behaviour:
        chance = self.dice.random()
        if depth == 0 or chance < 0.3:
            return Dice("leaf", self.dice)
        return self._decorator(depth) if chance < 0.5 else self._composite(depth)

    def _composite(self, depth: int) -> Behaviour:
        children = [self._node(depth - 1) for _ in range(self.dice.randint(1, 4))]
        memory = self.dice.random() < 0.5
        match self.dice.randrange(3):
            case 0:
                return HookedSequence("sequence", memory, children)
            case 1:
                return HookedSelector("selector", memory, children)
        policies = (
            ParallelPolicy.SuccessOnAll(synchronise=memory),
            ParallelPolicy.SuccessOnOne(),
            ParallelPolicy.SuccessOnSelected(children=children[:1], synchronise=memory),
        )
        return HookedParallel("parallel", self.dice.choice(policies), children)

    def _decorator(self, depth: int) -> Behaviour:
        child, dice = self._node(depth - 1), self.dice
        timed = {"child": child, "clock": lambda: self.now}
        kinds: tuple[Callable[[], Behaviour], ...] = (
            lambda: HookedRetry("retry", attempts=dice.randint(1, 4), pause_s=1.0, **timed),
            lambda: HookedActTimeout(
                "act", duration_s=dice.randint(1, 8), pause_s=dice.randint(0, 3), **timed
            ),
            lambda: HookedTimeout("timeout", duration_s=dice.randint(1, 5), **timed),
            lambda: HookedInverter("inverter", child),
            lambda: HookedRepeat("repeat", child, num_success=dice.randint(1, 3)),
            lambda: HookedFailureIsRunning("failure is running", child),
            lambda: Restless("restless", child, dice),
        )
        return dice.choice(kinds)()

    def record(self) -> tuple[Told, Told]:
        """Tick it; what the hook saw and what the recorder wrote."""
        recorder = Recorder(lambda: float(self.now))
        recorder.watch(self.root)
        tree = BehaviourTree(self.root)
        tree.add_visitor(recorder)
        paths = {node: path for path, node in enumerate(_preorder(self.root))}
        truth: Told = defaultdict(list)
        seen: dict[Behaviour, Status] = {}
        for self.now in range(TICKS):
            self._end_attempts(seen)
            self.assignments.clear()
            tree.tick()
            for node, old, new in self.assignments:
                if new is None:
                    seen.pop(node, None)
                elif new is Status.INVALID:
                    if old is Status.RUNNING:
                        truth[self.now, paths[node]].append("halted")
                        del seen[node]
                        self._end_attempt(node, seen)
                elif seen.get(node) is not new:
                    seen[node] = new
                    truth[self.now, paths[node]].append(new.value.lower())
        told: Told = defaultdict(list)
        for event in recorder.events:
            told[int(event.t), event.path].append(event.status)
            assert (event.status == "halted") == (event.halt is not None)
        return dict(truth), dict(told)

    def _end_attempts(self, seen: dict[Behaviour, Status]) -> None:
        """What is tried again starts anew: nothing of an attempt that ended counts any more."""
        for node in {node for node, *_ in self.assignments}:
            if node.status is not Status.RUNNING:
                self._end_attempt(node, seen)

    def _end_attempt(self, node: Behaviour, seen: dict[Behaviour, Status]) -> None:
        if isinstance(node.parent, Retry | ActTimeout):
            for below in _preorder(node):
                seen.pop(below, None)


def _preorder(node: Behaviour) -> Iterator[Behaviour]:
    yield node
    for child in node.children:
        yield from _preorder(child)


@pytest.fixture(
    params=[60, pytest.param(500, marks=pytest.mark.study)],
    ids=lambda trees: f"{trees} trees",
)
def trees(request: pytest.FixtureRequest) -> int:
    return int(request.param)


def test_no_event_is_missed_and_none_invented(trees: int) -> None:
    """Every change and halt of a node and every begin of a leaf is in the trace once, in the node's order."""
    halts = 0
    for seed in range(trees):
        truth, told = RandomTree(seed).record()
        assert told == truth, f"seed {seed}"
        halts += sum(statuses.count("halted") for statuses in truth.values())
    assert halts > 20 * trees, "the trees must halt often, or this shows nothing"


@pytest.mark.parametrize("kind", ["retry", "act"])
def test_every_attempt_is_in_the_trace_also_one_that_fails_in_its_first_tick(kind: str) -> None:
    """Four attempts, four failures of all that was tried, each with its own time."""
    clock = [0.0]
    leaf = py_trees.behaviours.Failure("leaf")
    tried = Selector("tried", memory=False, children=[leaf])
    root: Behaviour = Retry("root", tried, attempts=4, pause_s=1.0, clock=lambda: clock[0])
    if kind == "act":
        root = ActTimeout("root", tried, duration_s=4.0, pause_s=1.0, clock=lambda: clock[0])
    recorder = Recorder(lambda: clock[0])
    recorder.watch(root)
    tree = BehaviourTree(root)
    tree.add_visitor(recorder)
    while root.status in (Status.INVALID, Status.RUNNING):
        tree.tick()
        clock[0] += 1.0
    told = [(event.t, event.node, event.status) for event in recorder.events]
    for node in ("leaf", "tried"):
        assert [(t, status) for t, name, status in told if name == node] == [
            (float(attempt), "failure") for attempt in range(4)
        ]
    assert [status for _, name, status in told if name == "root"] == ["running", "failure"]
