"""The acts of a greeting: an utterance or a gesture."""

from __future__ import annotations

from comity_domain.problem.bound_parameters import ABOUT_GESTURES, ABOUT_SPEECH, ABOUT_WORDS
from comity_executor.leaves.body_act import BodyAct
from comity_executor.memory.visit_context import SAY_ACT, VisitContext
from comity_executor.nodes.cause import Account
from comity_executor.nodes.identity import NodeId
from comity_executor.robots.goals import ActGoal, speech
from comity_executor.speech.utterance import Utterance


class Act(BodyAct):
    """Speak or gesture once; the visit's memory records a completed act.

    Args:
        meeting: Context of the visit.
        act: `say`, or the name of a gesture.
    """

    def __init__(self, meeting: VisitContext, act: str) -> None:
        super().__init__(NodeId.of(act, meeting.person), meeting, act, meeting.greet_grounds)
        self._meeting = meeting.seen_by(self, reads=("greet", "values"), writes=("performed", "performed_s"))

    def words(self) -> Utterance | None:
        """The utterance; None for a gesture."""
        meeting = self._meeting
        return (
            meeting.speaker.greeting(meeting.greet.people, meeting.values) if self._act == SAY_ACT else None
        )

    def goal(self) -> ActGoal:
        """The act, in the manner that suits the person."""
        meeting, words = self._meeting, self.words()
        if words is None:
            return ActGoal(self._act, meeting.person, manner=meeting.manner)
        return speech(self._act, meeting.person, words, manner=meeting.manner)

    def remember(self) -> None:
        """Record the act in the visit's memory."""
        self._meeting.note_done(self._act)

    def explain(self) -> Account | None:
        """Whether the act is over, or was aborted."""
        if self._act == SAY_ACT:
            others = self.told((*ABOUT_SPEECH, *ABOUT_WORDS))
            return Account(
                self.how_it_went(), parameter="greeting_modality", others=others, fault=self.trouble()
            )
        return Account(self.how_it_went(), parameter="greeting_gesture", others=self.told(ABOUT_GESTURES))
