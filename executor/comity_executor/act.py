"""The acts of a greeting: an utterance or a gesture."""

from __future__ import annotations

from collections.abc import Sequence

from py_trees.common import Status

from comity_executor.cause import Account
from comity_executor.leaf import Action
from comity_executor.meeting import UTTER, Meeting


class Act(Action):
    """Speak or gesture once; the visit remembers an act that came to its end.

    Args:
        meeting: Whose branch it belongs to.
        act: `utter`, or the name of a gesture.
    """

    def __init__(self, meeting: Meeting, act: str) -> None:
        super().__init__(f"{act}({meeting.person})", meeting.greet_grounds)
        self._meeting = meeting
        self._act = act
        self._done: bool | None = None

    def begin(self) -> None:
        """Start the act; only an utterance has a text."""
        self._done = None
        text = greeting_text(self._meeting.greet.people) if self._act == UTTER else None
        self._meeting.robot.start_act(self._act, self._meeting.person, text)

    def step(self) -> Status:
        """SUCCESS when the robot says it is done, FAILURE when it was broken off from elsewhere."""
        self._done = self._meeting.robot.act_done(self._act, self._meeting.person)
        if self._done is None:
            return Status.FAILURE
        if not self._done:
            return Status.RUNNING
        self._meeting.memory.performed.append(self._act)
        return Status.SUCCESS

    def end(self) -> None:
        """Break the act off unless it is over."""
        if not self._done:
            self._meeting.robot.stop_act(self._act, self._meeting.person)

    def explain(self) -> Account | None:
        """That the act is over, or was broken off."""
        text = f"{self._act} {'is done' if self._done else 'was broken off'}"
        parameter = "greeting_modality" if self._act == UTTER else "greeting_gesture"
        return Account(text, parameter=parameter)


def greeting_text(people: Sequence[str]) -> str:
    """What the robot says; neutral wording, as the paper's rules choose the modality and not the words."""
    *others, last = (person.replace("_", " ").title() for person in people)
    return f"Hello, {', '.join(others)} and {last}." if others else f"Hello, {last}."
