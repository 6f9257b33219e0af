"""After a failure: another plan at once, a pause and then another plan, or the end.

What broke may mend, who stood in the way may go, a door may be opened again: so the robot asks more than
once, and waits twice as long each time. Where something changes meanwhile it asks at once. A cap on all of it
ends the run; it counts from when somebody was last served. New plans because the world changed have a cap of
the same size to themselves: a door that flaps uses up no attempt to go on after a failure.
"""

from __future__ import annotations

from dataclasses import dataclass

from comity_executor.cause import Cause
from comity_executor.fault import FaultError
from comity_executor.limits import Limits
from comity_executor.revision import Course, NoRevision, Planner, Revision

LONGEST_PAUSE_S = 30.0
"""Nobody is made to wait longer than this for a robot that could go on by now (our choice)."""


@dataclass(frozen=True, slots=True)
class Later:
    """There is no other plan yet; it is asked for again."""

    because: tuple[Cause, ...]


class Recovery:
    """Counts the attempts of one execution.

    Args:
        planner: Whom to ask.
        limits: How often, and how long to wait.
    """

    def __init__(self, planner: Planner, limits: Limits) -> None:
        self._planner = planner
        self._limits = limits
        self._attempts = 0
        self._changes = 0
        self._ask_s: float | None = None

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

    def count_failure(self) -> None:
        """A new plan takes over because the tree had failed."""
        self._attempts += 1

    def count_change(self) -> None:
        """A new plan takes over because the world changed."""
        self._changes += 1

    def begin_again(self) -> None:
        """Somebody was served: all attempts are left."""
        self._attempts = self._changes = 0

    def after_failure(self, course: Course) -> Revision | Later | NoRevision:
        """The tree has just failed."""
        if not self.is_left:
            cap = f"the limit of {self._limits.replans} new plans without anything being done is reached"
            return NoRevision((Cause("condition", cap, float(self._limits.replans)),))
        return self._later(course, course.failed) if self._attempts else self._ask(course)

    def look(self, course: Course) -> Revision | Later | NoRevision | None:
        """Ask where it is time, or where something changed; None where neither is so."""
        assert self._ask_s is not None
        if course.t >= self._ask_s - 1e-9:
            return self._ask(course)
        if not self._planner.has_news(course.t):
            return None
        revision = another(course, self._planner)
        if isinstance(revision, NoRevision):
            return None  # it is asked again when the pause is over
        self._ask_s = None
        return revision

    def _ask(self, course: Course) -> Revision | Later | NoRevision:
        self._ask_s = None
        revision = another(course, self._planner)
        if isinstance(revision, Revision):
            return revision
        self._attempts += 1
        if self.is_left and (course.failures or revision.may_pass):
            return self._later(course, revision.because)
        return revision  # whoever is left could not be served from the start

    def _later(self, course: Course, because: tuple[Cause, ...]) -> Later:
        pause_s = min(self._limits.replan_pause_s * 2.0 ** (self._attempts - 1), LONGEST_PAUSE_S)
        self._ask_s = course.t + pause_s
        again = Cause("condition", f"another plan is asked for in {pause_s:g} s", pause_s)
        return Later((*because, again))


def another(course: Course, planner: Planner) -> Revision | NoRevision:
    """Another plan; a planner that breaks down has none."""
    try:
        return planner.replan(course)
    except Exception as error:
        return NoRevision(broken(error), may_pass=True)


def broken(error: Exception) -> tuple[Cause, ...]:
    """What is to say about a planner that broke down."""
    if isinstance(error, FaultError):
        return (Cause("fault", str(error)), Cause("condition", "the planner broke down"))
    return (Cause("condition", f"the planner broke down: {type(error).__name__}: {error}"),)
