"""Acts completed for a person, and their occasion: a farewell has words and gestures, too."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity.testing.amounts.course import runs
from comity.testing.trials.visits import spoken_to
from comity_domain.plans.actions import GREETINGS, LEAVE, OFFER
from comity_domain.problem.agenda import Say
from comity_executor.memory.visit_context import SAY_ACT
from comity_sim2d.robot.acts import VERBS

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import TraceEvent

_OCCASIONS: Mapping[str, str] = {
    **dict.fromkeys(GREETINGS, "at the greeting"),
    Say.action: "as it tells them something",
    OFFER: "as it brings them something",
    LEAVE: "at the farewell",
}
"""Occasion by the name of the tree node that triggers the acts."""
_OTHERWISE = "on its way"
_TICK_S = 1e-3


@dataclass(frozen=True, slots=True)
class Done:
    """One completed act."""

    act: str
    occasion: str

    @property
    def is_greeting(self) -> bool:
        """Whether it was part of a greeting."""
        return self.occasion == _OCCASIONS[GREETINGS[0]]

    def __str__(self) -> str:
        return f"{VERBS.get(self.act, 'speaks' if self.act == SAY_ACT else self.act)}, but {self.occasion}"


def done_for(episode: Episode, person: str) -> tuple[Done, ...]:
    """Acts completed for a person, or for their company, in order of time."""
    stood_before = spoken_to(episode.visits, person)
    spans = list(_spans(episode.events, stood_before))
    return tuple(
        Done(act.act, next((told for start, end, told in spans if start <= act.t_start < end), _OTHERWISE))
        for act in episode.acts
        if act.person == stood_before and not act.stopped
    )


def _spans(events: Sequence[TraceEvent], person: str) -> Iterator[tuple[float, float, str]]:
    """Start [s], end [s] and occasion of each span; the tick in which one ends belongs to the next."""
    theirs = (event for event in events if event.person == person and event.action in _OCCASIONS)
    for took, start, node in runs(theirs):
        yield start - _TICK_S, start + took - _TICK_S, _OCCASIONS[node.action]
