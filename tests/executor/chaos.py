"""A robot that does late, partly or not at all what it is told, by a script that a seed writes.

Commands take effect in their order, but each later than the call: goals after up to 0.4 s, cancels after up
to 0.5 s. Some stops are lost, goals are refused or given up, the feedback stops for a while, calls raise
while a service restarts, localisation jumps, people are not seen, and the stop is pressed. Time is a count of
ticks.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import replace
from random import Random

from comity_executor import ActGoal, ActStatus, CapabilityValues, Execution, GoalId, MotionGoal, MotionStatus
from comity_executor.robots.scripted import ScriptedReading
from tests.executor.conftest import CONTROL_S, LEASE_S, Hall, Stander, infer, plan_for

LATENCY_S = 0.5
UNTIL_S = 40.0
"""Nothing goes wrong after that."""
SERVICES = ("go", "renew", "motion", "stop", "perform", "performance", "read", "choose_pose", "emergency")
LOST, REFUSED, GIVEN_UP = 0.1, 0.1, 0.15
"""Of stops, of goals, of goals and acts."""


class Windows:
    """Spans of time in which something is so."""

    def __init__(self, dice: Random, most: int, longest_s: float) -> None:
        starts = [dice.uniform(0.0, UNTIL_S) for _ in range(dice.randint(0, most))]
        self.spans = [(start, start + dice.uniform(0.05, longest_s)) for start in starts]

    def holds(self, now_s: float) -> bool:
        return any(start <= now_s < end for start, end in self.spans)


class Chaos(Hall):
    """Two people, and whatever may happen on the way to them."""

    def __init__(self, seed: int) -> None:
        can = CapabilityValues(latency_s=LATENCY_S, lease_s=LEASE_S)
        super().__init__({"johanna": Stander(3.0, 0.0), "alice": Stander(3.0, 2.0)}, can)
        self._dice = dice = Random(seed)
        self._out = {name: Windows(dice, 1, 2.0) for name in SERVICES}
        self._unseen = {person: Windows(dice, 2, 3.0) for person in self.people}
        self._jumps = Windows(dice, 2, 2.0)
        self._jump_m = dice.uniform(-2.0, 6.0)
        self._silent = Windows(dice, 3, 3.0)
        self.pressed = Windows(dice, 2, 4.0)
        self._due: deque[tuple[int, Callable[[], None]]] = deque()
        self._given_up: list[tuple[int, int]] = []
        """In which tick the base gives a goal up by itself."""
        self._given = 0
        self._base_id: int | None = None
        """The newest goal that the base has heard of."""
        self._lost: str | None = None
        """What became of it, if it is lost."""
        self._told = MotionStatus(None, "stopped", is_at_rest=True)
        self.begun: list[str] = []
        """Every goal and act that was asked for, by kind."""

    # What the tree calls.

    def emergency(self) -> object:
        self._answer("emergency")
        return "the button" if self.pressed.holds(self.now_s()) else False

    def read(self, person: str) -> ScriptedReading | None:
        self._answer("read")
        if self._unseen[person].holds(self.now_s()):
            return None
        reading = super().read(person)
        if reading is None or not self._jumps.holds(self.now_s()):
            return reading
        return replace(
            reading,
            distance_m=reading.distance_m + self._jump_m,
            centre_distance_m=reading.centre_distance_m + self._jump_m,
        )

    def choose_pose(self, person: str, **wish: object) -> object:
        self._answer("choose_pose")
        return super().choose_pose(person, **wish)

    def go(self, goal: MotionGoal) -> int:
        self.begun.append(goal.kind)
        self._given += 1
        number = self._given
        refused = self._dice.random() < REFUSED
        self._later(0.4, lambda: self._take(goal, number, refused=refused))
        self._answer("go")  # it has begun all the same
        return number

    def renew(self, goal: GoalId) -> None:
        self._answer("renew")
        if goal == self._base_id:
            self._renewed_s = self.now_s()

    def motion(self) -> MotionStatus:
        self._answer("motion")
        if not self._silent.holds(self.now_s()):
            now = replace(super().motion(), goal=self._base_id)
            if self._lost or (self._goal is None and self._base_id):
                now = replace(now, state=self._lost or "stopped")
            self._told = now
        return self._told

    def perform(self, act: ActGoal) -> str:
        self.begun.append(act.act)
        self._answer("perform")
        name = super().perform(act)
        if self._dice.random() < GIVEN_UP:
            self._later(1.0, lambda: self._give_act_up(name))
        return name

    def performance(self, act: GoalId) -> ActStatus:
        self._answer("performance")
        return super().performance(act)

    def stop(self, goal: GoalId | None = None) -> None:
        self._answer("stop")
        if isinstance(goal, str):
            super().stop(goal)
        elif self._dice.random() >= LOST:
            self._later(LATENCY_S, lambda: self._cancel(goal))

    # What becomes of it.

    @property
    def moves(self) -> bool:
        return self.speed > 0.0 or self._turns

    def step(self) -> None:
        while self._due and self._due[0][0] <= self.ticks:
            self._due.popleft()[1]()
        for tick, number in self._given_up:
            if tick == self.ticks:
                self._give_up(number)
        super().step()

    def _answer(self, service: str) -> None:
        if self._out[service].holds(self.now_s()):
            raise ConnectionError(f"{service} does not answer")

    def _later(self, longest_s: float, do: Callable[[], None]) -> None:
        """In the order of the calls."""
        tick = self.ticks + round(self._dice.uniform(0.0, longest_s) / CONTROL_S)
        self._due.append((max(tick, self._due[-1][0] if self._due else 0), do))

    def _take(self, goal: MotionGoal, number: int, *, refused: bool) -> None:
        self._base_id, self._goal, self._lost = number, None, "rejected" if refused else None
        if refused:
            return
        super().go(goal)
        if self._dice.random() < GIVEN_UP:
            tick = self.ticks + round(self._dice.uniform(0.2, 3.0) / CONTROL_S)
            self._due = deque(
                sorted((*self._due, (tick, lambda: self._give_up(number))), key=lambda due: due[0])
            )

    def _cancel(self, goal: GoalId | None) -> None:
        if goal in (None, self._base_id):
            self._goal, self.speed = None, 0.0

    def _give_up(self, number: int) -> None:
        if self._base_id == number and self._goal is not None:
            self._goal, self._lost = None, "aborted"

    def _give_act_up(self, name: str) -> None:
        if self._acts.pop(name, None):
            self._states[name] = "aborted"


def run(seed: int) -> tuple[Chaos, Execution]:
    """An episode to its end, held against the laws in every tick; somebody resumes a while after a stop."""
    hall = Chaos(seed)
    execution = Execution(plan_for(*hall.people), hall, {person: infer() for person in hall.people})
    dice, held_s, rested = Random(seed), 0.0, False
    while hall.now_s() < 400.0:
        begun = len(hall.begun)
        status = execution.tick()
        is_held = execution.stopped_by is not None
        if is_held:
            assert len(hall.begun) == begun, f"{hall.begun[begun:]} begins while stopped, seed {seed}"
            rested = rested or execution.is_at_rest
        if status != "running":
            break
        hall.step()
        held_s = held_s + CONTROL_S if is_held else 0.0
        assert not (held_s > 1.0 and hall.moves), f"moves {held_s:.2f} s after the press, seed {seed}"
        assert not (is_held and rested and hall.moves), f"moves after it was said to rest, seed {seed}"
        if is_held and not hall.pressed.holds(hall.now_s()) and dice.random() < 0.1 and execution.resume():
            rested = False
    return hall, execution


def rest(hall: Chaos, execution: Execution) -> None:
    """After the end: some more ticks bring everything to rest, and nothing moves again."""
    for _ in range(round((10.0 + UNTIL_S) / CONTROL_S)):
        if execution.is_at_rest and not hall.acts_under_way:
            break
        execution.tick()
        hall.step()
    assert execution.is_at_rest
    assert not hall.acts_under_way
    for _ in range(round(2 * (LEASE_S + 1.0) / CONTROL_S)):
        hall.step()
        assert not hall.moves
