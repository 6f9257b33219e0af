"""The operator of a robot: approves plans, skips people, nudges distances, marks events.

Words are given in any thread and carried out between two ticks, in their order; each is told in the trace
with what came of it. None passes the safety floor, the robot's speed limit, or what a person asked for or has
shown. Consent to touch is the person's alone: `consents` passes on that they gave it, in this meeting, and
no other word counts as that.
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
"""Where no length is given (our choice)."""
USAGE = (
    "approve | skip PERSON | nearer PERSON [M] | farther PERSON [M] | consents PERSON | withdraws PERSON | "
    "mark TEXT | stop | resume"
)
STOPPED = "the operator stopped the robot"
UNAPPROVED = "the plan waits for the operator's approval"


@dataclass(frozen=True, slots=True)
class OperatorCommand:
    """One thing that the operator said."""

    order: Order
    about: str = ""
    """A person; of `mark` the text."""
    metres: float = NUDGE_M
    """Of `nearer` and `farther`."""


def word_of(line: str) -> OperatorCommand:
    """A line that the operator typed.

    Raises:
        InputError: It is none.
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
    """What the operator of one episode has said.

    Args:
        approves: Whether every new plan waits for approval.
        tell: Shows the operator a plan.
    """

    def __init__(self, *, approves: bool = False, tell: Callable[[str], None] = lambda _: None) -> None:
        self._said: queue.SimpleQueue[OperatorCommand] = queue.SimpleQueue()
        self._approves = approves
        self._tell = tell
        self._approved = self._plans = 0
        self._stopped = False
        self.has_left = False
        """Whether no more words will come."""

    def approve(self) -> None:
        """Let the plan under way begin, where it waits for that."""
        self.say(OperatorCommand("approve"))

    def skip(self, person: str) -> None:
        """Leave a person out from now on."""
        self.say(OperatorCommand("skip", person))

    def nearer(self, person: str, metres: float = NUDGE_M) -> None:
        """Come nearer to a person, within what they asked for and showed."""
        self.say(OperatorCommand("nearer", person, metres))

    def farther(self, person: str, metres: float = NUDGE_M) -> None:
        """Stay farther from a person, unless they asked for their distance."""
        self.say(OperatorCommand("farther", person, metres))

    def consents(self, person: str) -> None:
        """Pass on that a person consents to touch in this meeting: they were asked, and said so."""
        self.say(OperatorCommand("consents", person))

    def withdraws(self, person: str) -> None:
        """Pass on that a person does not consent to touch, or no longer."""
        self.say(OperatorCommand("withdraws", person))

    def mark(self, text: str) -> None:
        """Put an event on record."""
        self.say(OperatorCommand("mark", text))

    def stop(self) -> None:
        """Stop, until `resume`."""
        self.say(OperatorCommand("stop"))

    def resume(self) -> None:
        """Go on after a stop that is released."""
        self.say(OperatorCommand("resume"))

    def say(self, word: OperatorCommand) -> None:
        """Say one word, from any thread."""
        self._said.put(word)

    def words(self) -> Iterator[OperatorCommand]:
        """What was said since the last call; a stop and what ends one are noted here."""
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
        """Know of a plan that waits for approval, where plans do."""
        self._plans += 1
        if self._approves:
            self._tell(plan_words(plan))

    def holds(self) -> str | bool:
        """Why the robot has to stand on the operator's account; False while it need not."""
        if self._stopped:
            return STOPPED
        return UNAPPROVED if self._approves and self._approved < self._plans else False


def plan_words(plan: Plan) -> str:
    """A plan in a line, for the operator who approves it."""
    steps = "; ".join(f"{step.action}({', '.join(step.arguments)})" for step in plan.steps)
    return f"Plan: {steps or 'nothing'}. Type `approve`, or any of: {USAGE}"


def listen(lines: Iterable[str], operator: Operator, refuse: Callable[[str], None]) -> None:
    """Take the operator's words from lines, in a thread of its own, until there are no more.

    Args:
        lines: Such as standard input.
        operator: Who says them.
        refuse: Told what was none.
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
