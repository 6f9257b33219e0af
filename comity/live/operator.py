"""The operator's commands: approve plans, skip people, adjust distances, pass on consent, mark events.

Commands may come from any thread and are executed in order between two ticks; the trace records each with its
result. None overrides the safety floor, the robot's speed limit, or what a person asked for or has shown.
Consent to touch is the person's alone: `consents` passes on that they gave it in this encounter, and no other
command counts as consent.
"""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, get_args

from comity_fis import InputError

if TYPE_CHECKING:
    from comity_domain import Plan

Order = Literal["approve", "skip", "nearer", "farther", "consents", "withdraws", "mark", "stop", "resume"]
OF_PEOPLE = ("skip", "nearer", "farther", "consents", "withdraws")
NUDGE_M = 0.10
"""Default adjustment of a distance [m] (our choice)."""
USAGE = (
    "approve | skip PERSON | nearer PERSON [M] | farther PERSON [M] | consents PERSON | withdraws PERSON | "
    "mark TEXT | stop | resume"
)
STOPPED = "the operator stopped the robot"
UNAPPROVED = "the plan waits for the operator's approval"


@dataclass(frozen=True, slots=True)
class OperatorCommand:
    """One command of the operator."""

    order: Order
    about: str = ""
    """A person; for `mark`, the text."""
    metres: float = NUDGE_M
    """Adjustment for `nearer` and `farther` [m]."""


def word_of(line: str) -> OperatorCommand:
    """Parse a line typed by the operator.

    Raises:
        InputError: It is not a command.
    """
    order, _, rest = line.strip().partition(" ")
    found = next((each for each in get_args(Order) if each == order), None)
    about, metres = rest.strip(), NUDGE_M
    if found in ("nearer", "farther") and len(words := about.split()) == 2:
        about = words[0]
        metres = _metres(words[1], line)
    needs = found in (*OF_PEOPLE, "mark")
    if found is None or needs != bool(about):
        raise InputError(expected=USAGE, got=repr(line.strip()), remedy="Write one of these in a line.")
    return OperatorCommand(found, about, metres)


def _metres(text: str, line: str) -> float:
    try:
        metres = float(text)
    except ValueError:
        metres = -1.0
    if not 0.0 < metres <= 1.0:
        raise InputError(
            expected="a length above 0 m, and 1 m at most",
            got=repr(line.strip()),
            remedy="Write `farther guest 0.2`.",
        )
    return metres


class Operator:
    """The commands of one episode's operator.

    Args:
        approves: Whether every new plan requires approval.
        tell: Shows a plan to the operator.
    """

    def __init__(self, *, approves: bool = False, tell: Callable[[str], None] = lambda _: None) -> None:
        self._said: queue.SimpleQueue[OperatorCommand] = queue.SimpleQueue()
        self._approves = approves
        self._tell = tell
        self._approved = self._plans = 0
        self._stopped = False
        self.has_left = False
        """Whether no more commands will come."""

    def approve(self) -> None:
        """Approve the current plan, if it requires approval."""
        self.say(OperatorCommand("approve"))

    def skip(self, person: str) -> None:
        """Drop a person's visit."""
        self.say(OperatorCommand("skip", person))

    def nearer(self, person: str, metres: float = NUDGE_M) -> None:
        """Decrease the distance to a person, within what they asked for and showed."""
        self.say(OperatorCommand("nearer", person, metres))

    def farther(self, person: str, metres: float = NUDGE_M) -> None:
        """Increase the distance to a person, unless they asked for a distance."""
        self.say(OperatorCommand("farther", person, metres))

    def consents(self, person: str) -> None:
        """Pass on a person's consent to touch in this encounter: they were asked, and agreed."""
        self.say(OperatorCommand("consents", person))

    def withdraws(self, person: str) -> None:
        """Pass on that a person does not consent to touch, or no longer does."""
        self.say(OperatorCommand("withdraws", person))

    def mark(self, text: str) -> None:
        """Record an event."""
        self.say(OperatorCommand("mark", text))

    def stop(self) -> None:
        """Stop the robot until `resume`."""
        self.say(OperatorCommand("stop"))

    def resume(self) -> None:
        """Resume after a released stop."""
        self.say(OperatorCommand("resume"))

    def say(self, word: OperatorCommand) -> None:
        """Issue a command, from any thread."""
        self._said.put(word)

    def words(self) -> Iterator[OperatorCommand]:
        """The commands since the last call; stop and resume take effect here."""
        while True:
            try:
                word = self._said.get_nowait()
            except queue.Empty:
                return
            if word.order == "stop":
                self._stopped = True
            elif word.order == "resume":
                self._stopped = False
            elif word.order == "approve":
                self._approved = self._plans
            yield word

    def note_plan(self, plan: Plan) -> None:
        """Note a plan, which may require approval."""
        self._plans += 1
        if self._approves:
            self._tell(plan_words(plan))

    def holds(self) -> str | bool:
        """Why the operator holds the robot; False if it may move."""
        if self._stopped:
            return STOPPED
        return UNAPPROVED if self._approves and self._approved < self._plans else False


def plan_words(plan: Plan) -> str:
    """A plan in one line, for approval by the operator."""
    steps = "; ".join(f"{step.action}({', '.join(step.arguments)})" for step in plan.steps)
    return f"Plan: {steps or 'nothing'}. Type `approve`, or any of: {USAGE}"


def listen(lines: Iterable[str], operator: Operator, refuse: Callable[[str], None]) -> None:
    """Read commands from lines in a separate thread, until the lines end.

    Args:
        lines: Lines, such as standard input.
        operator: Receives the commands.
        refuse: Receives the error message for an invalid line.
    """

    def take() -> None:
        for line in lines:
            if line.strip():
                try:
                    operator.say(word_of(line))
                except InputError as error:
                    refuse(str(error))
        operator.has_left = True

    threading.Thread(target=take, name="operator", daemon=True).start()
