"""The simulated robot's motion over time: its goals, and its manoeuvres to make way for people."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_sim2d.pose import XY

DREW_BACK = "it drew back from "
PAST = {
    "giving way to ": "it gave way to ",
    "backing out before ": "it backed out before ",
    "drawing back from ": DREW_BACK,
}
"""How the report of a manoeuvre begins, and how its account begins; the person's name follows."""


@dataclass(frozen=True, slots=True)
class MotionSpan:
    """A time in which the motion had one goal and one manoeuvre, or none."""

    start_s: float
    end_s: float
    goal: XY | None
    """Where it was to go [m]; None if nowhere."""
    manoeuvre: str
    """In words, `it gave way to omar`; empty if there was none."""


class MotionLog:
    """The spans of one robot so far, in order."""

    def __init__(self) -> None:
        self.spans: list[MotionSpan] = []

    def note(self, report: str, goal: XY | None, start_s: float, end_s: float) -> None:
        """Note a tick.

        Args:
            report: What the robot reports of its motion.
            goal: Where it is to go [m].
            start_s: Begin of the tick [s].
            end_s: Its end [s].
        """
        begins = next((words for words in PAST if report.startswith(words)), None)
        manoeuvre = "" if begins is None else report.replace(begins, PAST[begins], 1)
        span = MotionSpan(start_s, end_s, goal, manoeuvre)
        if self.spans and self.spans[-1] == replace(span, start_s=self.spans[-1].start_s, end_s=start_s):
            span = replace(self.spans.pop(), end_s=end_s)
        self.spans.append(span)
