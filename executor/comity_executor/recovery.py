"""Recovery from a failure: replan at once or after a pause, wait for the path, or end.

Faults may be repaired and obstructing people may leave, so the robot replans more than once, doubling the
pause each time. A cap on new plans ends the run; it counts from when a person was last served. New plans
because of changes of the world have a separate cap of the same size: a door that keeps opening and shutting
uses up no attempt to recover from a failure.

If the path is known to be shut, the robot waits for it to open. That uses up a limited waiting time
(`patience_s`), and no attempts.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from comity_executor.nodes.cause import Cause
from comity_executor.nodes.fault import FaultError
from comity_executor.nodes.limits import Limits
from comity_executor.plan_update import ExecutionState, NoPlanUpdate, Planner, PlanUpdate
from comity_executor.robots.raised import raised

LONGEST_PAUSE_S = 30.0
"""Maximum pause: people should not wait longer for a robot that could continue [s] (our choice)."""


@dataclass(frozen=True, slots=True)
class Later:
    """There is no other plan yet; ask again later."""

    because: tuple[Cause, ...]
    look_for: str | None = None
    """Person to whose believed place the robot turns meanwhile."""


class Recovery:
    """Counts the attempts of one execution, and how long it has waited.

    Args:
        planner: Asked for another plan.
        limits: How often, and how long to wait.
    """

    def __init__(self, planner: Planner, limits: Limits) -> None:
        self._planner = planner
        self._limits = limits
        self._attempts = 0
        self._changes = 0
        self._ask_s: float | None = None
        self._waits_since_s: float | None = None
        """Start of the wait for the path [s]; None while not waiting."""
        self._looks = 0
        """Number of looks in this wait."""
        self._waited_s = 0.0
        """Total time of earlier waits [s]."""

    @property
    def is_waiting(self) -> bool:
        """Whether the tree has failed and is to be tried again."""
        return self._ask_s is not None

    @property
    def is_left(self) -> bool:
        """Whether another attempt would be within the cap."""
        return self._attempts < self._limits.replans

    @property
    def may_change(self) -> bool:
        """Whether another plan because of a change would be within the cap."""
        return self._changes < self._limits.replans

    def count_change(self) -> None:
        """A new plan takes over because the world changed."""
        self._changes += 1

    def begin_again(self) -> None:
        """A person was served: all attempts and all patience are left."""
        self._attempts = self._changes = 0
        self._waited_s = 0.0

    def after_failure(self, course: ExecutionState) -> PlanUpdate | Later | NoPlanUpdate:
        """The tree has just failed."""
        if self._attempts and self.is_left:
            return self._later(course, course.failed)
        return self._ask(course)

    def look(self, course: ExecutionState) -> PlanUpdate | Later | NoPlanUpdate | None:
        """Ask where it is time, or where something changed; None where neither is so."""
        assert self._ask_s is not None
        if course.t >= self._ask_s - 1e-9:
            waited = self._waits_since_s
            answer = self._ask(course)
            # A wait that goes on is no news.
            return None if isinstance(answer, Later) and waited == self._waits_since_s is not None else answer
        if not self._planner.has_news(course.t):
            return None
        revision = another(replace(course, in_pause=True), self._planner)
        if isinstance(revision, NoPlanUpdate):
            return None  # it is asked again when the pause is over
        return self._go_on(course, revision)

    def _ask(self, course: ExecutionState) -> PlanUpdate | Later | NoPlanUpdate:
        self._ask_s = None
        revision = another(course, self._planner) if self._limits.replans else NoPlanUpdate(())
        if isinstance(revision, NoPlanUpdate) and revision.awaits is not None:
            return self._wait(course, revision)
        if not self.is_left:
            return self._cap()
        if isinstance(revision, PlanUpdate):
            return self._go_on(course, revision)
        self._end_wait(course)
        self._attempts += 1
        if self.is_left and (course.failures or revision.may_pass):
            return self._later(course, revision.because)
        return revision  # the people who are left could not be served from the start

    def _go_on(self, course: ExecutionState, revision: PlanUpdate) -> PlanUpdate:
        """Another plan takes over: an attempt, unless it only follows a way that has opened."""
        self._ask_s = None
        if not self._end_wait(course):
            self._attempts += 1
        return revision

    def _wait(self, course: ExecutionState, revision: NoPlanUpdate) -> Later | NoPlanUpdate:
        """Wait for the way, as long as there is patience."""
        if self._waits_since_s is None:
            self._waits_since_s, self._looks = course.t, 0
        left_s = self._limits.patience_s - self._waited_s - (course.t - self._waits_since_s)
        if left_s <= 1e-9:
            over = f"{self._limits.patience_s:g} s of waiting for the way are over"
            return NoPlanUpdate((*revision.because, Cause("condition", over, self._limits.patience_s)))
        self._ask_s = course.t + min(left_s, self._pause_s(self._looks))
        self._looks += 1
        until_s = min(course.t + left_s, self._limits.ends_s)
        waits = f"the way is waited for until t={until_s:.2f} s at most: {revision.awaits}"
        return Later((*revision.because, Cause("condition", waits, until_s - course.t)), revision.look_for)

    def _end_wait(self, course: ExecutionState) -> bool:
        """Charge the wait against the patience; whether there was one.

        The least charge is a pause, so that a way that opens and shuts in every tick has an end, too.
        """
        if self._waits_since_s is None:
            return False
        self._waited_s += max(course.t - self._waits_since_s, self._limits.replan_pause_s)
        self._waits_since_s = None
        return True

    def _later(self, course: ExecutionState, because: tuple[Cause, ...]) -> Later:
        pause_s = self._pause_s(self._attempts - 1)
        self._ask_s = course.t + pause_s
        again = Cause("condition", f"another plan is asked for in {pause_s:g} s", pause_s)
        return Later((*because, again))

    def _pause_s(self, times: int) -> float:
        """How long to wait after so many pauses."""
        return min(self._limits.replan_pause_s * 2.0**times, LONGEST_PAUSE_S)

    def _cap(self) -> NoPlanUpdate:
        cap = f"the limit of {self._limits.replans} new plans without anything being done is reached"
        return NoPlanUpdate((Cause("condition", cap, float(self._limits.replans)),))


def another(course: ExecutionState, planner: Planner) -> PlanUpdate | NoPlanUpdate:
    """Another plan; a planner that breaks down has none."""
    try:
        return planner.replan(course)
    except Exception as error:
        return NoPlanUpdate(broken(error), may_pass=True)


def broken(error: Exception) -> tuple[Cause, ...]:
    """What is to say about a planner that broke down."""
    if isinstance(error, FaultError):
        return (Cause("fault", str(error), None), Cause("condition", "the planner broke down", None))
    return (Cause("condition", f"the planner broke down: {raised(error)}", None),)
