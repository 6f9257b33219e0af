"""The acts of a greeting: an utterance or a gesture."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from py_trees.common import Status

from comity_executor.cause import Account
from comity_executor.leaf import Action
from comity_executor.manner import ABOUT_GESTURES, ABOUT_SPEECH
from comity_executor.meeting import UTTER, Meeting
from comity_executor.wording import ABOUT_WORDS, greeting_text


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

    @property
    def ports(self) -> Mapping[str, str]:
        """Which act."""
        return {"act": self._act}

    def begin(self) -> None:
        """Start the act; only an utterance has a text."""
        self._done = None
        meeting = self._meeting
        text = greeting_text(meeting.greet.people, meeting.values) if self._act == UTTER else None
        meeting.robot.start_act(self._act, meeting.person, text, manner=meeting.manner)

    def step(self) -> Status:
        """SUCCESS when the robot says it is done, FAILURE when it was broken off from elsewhere."""
        self._ask()
        if self._done is None:
            return Status.FAILURE
        return Status.SUCCESS if self._done else Status.RUNNING

    def end(self) -> None:
        """Break the act off unless it is over; it may have ended since the last tick."""
        if not self._done:
            self._ask()
        if not self._done:
            self._meeting.robot.stop_act(self._act, self._meeting.person)

    def _ask(self) -> None:
        """Ask the robot how it goes; what is over is remembered."""
        self._done = self._meeting.robot.act_done(self._act, self._meeting.person)
        if self._done:
            self._meeting.memory.performed.append(self._act)

    def explain(self) -> Account | None:
        """That the act is over, or was broken off."""
        text = f"{self._act} {'is done' if self._done else 'was broken off'}"
        if self._act == UTTER:
            return Account(
                text, parameter="greeting_modality", others=self._told((*ABOUT_SPEECH, *ABOUT_WORDS))
            )
        return Account(text, parameter="greeting_gesture", others=self._told(ABOUT_GESTURES))

    def _told(self, names: Iterable[str]) -> tuple[str, ...]:
        """Those parameters of the manner and the words that say more than their neutral value."""
        values = self._meeting.values
        return tuple(name for name in names if name in values.parameters and values[name].origin != "neutral")
