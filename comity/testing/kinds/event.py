"""Number of events and their causes: a node returns a result or is halted, the robot replans."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.amount import AT_LEAST_ONCE, NEVER, Times, times
from comity.testing.amounts.words import holds
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.nodes import events_of, nodes_named
from comity_fis import InputError

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_executor import Node, TraceEvent

PLAN = "plan_holds?"
"""The node whose events report plan validity."""
STATUS: Mapping[str, str] = {
    "succeeds": "success",
    "fails": "failure",
    "halted": "halted",
    "replans": "replanned",
    "updates parameters": "rebound",
    "finds no other plan": "not_replanned",
}
"""Status of the counted events, by verb of the sentence."""
MOST = 6
"""Maximum number of events shown by a failure: if a cause recurs, the first ones suffice."""


@dataclass(frozen=True, slots=True)
class Event(Expectation):
    """Number of events of the nodes of a name; with words, only those with the words in their causes."""

    RULE: ClassVar[str] = (
        "(NAME [NEVER] (SUCCEEDS | FAILS) | NAME _IS [NEVER] HALTED"
        " | [NEVER] (REPLANS | UPDATES_PARAMETERS | FINDS_NO_OTHER_PLAN))"
        " [_BECAUSE NAME] [times] [PER_PERSON]"
    )
    EXAMPLE: ClassVar[str] = "docked? succeeds because 'distance 0.64 m' exactly once"

    node: str
    verb: str
    words: str | None
    often: Times
    per_person: bool

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a node or None, `never` or None, a verb, words, a count, and `per person` or None."""
        *node, never, verb, words, often, per_person = parts
        if never and often:
            raise InputError(
                expected="`never` or a count", got=f"never, {often}", remedy="Leave one of them out."
            )
        if per_person and not node:
            raise InputError(
                expected="events of a node, for a count per person",
                got="those of the plan, which is for everyone",
                remedy="Leave `per person` out.",
            )
        often = NEVER if never else often or AT_LEAST_ONCE
        return cls(node[0] if node else PLAN, " ".join(verb.lower().split()), words, often, bool(per_person))

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """A wrong count, with the events and their causes."""
        nodes = nodes_named(episode, self.node)
        events = events_of(nodes, episode.events)
        happened = [event for event in events if event.status == STATUS[self.verb]]
        counted = [event for event in happened if self.words is None or _holds(event, self.words)]
        for whose, group in self._groups(nodes, counted):
            if not self.often.holds(len(group)):
                others = [event for event in happened if event not in counted]
                shown = group if self.often.exceeded_by(len(group)) else others or group or events[-1:]
                because = tuple(self._because(episode, nodes, shown[:MOST]))
                yield Finding(self._expected(whose), self._got(group, happened), because)

    def _groups(
        self, nodes: Sequence[Node], counted: Sequence[TraceEvent]
    ) -> Iterator[tuple[str, Sequence[TraceEvent]]]:
        """All events, or those of each person: `nod(anna)` and `nod(ben)` are nodes of different people."""
        if not self.per_person:
            yield self.node, counted
            return
        names = dict.fromkeys(node.name for node in nodes)
        for name in names or (self.node,):
            yield name, [event for event in counted if event.node == name]

    def _expected(self, whose: str) -> str:
        is_halted = "is halted" if self.verb == "halted" else self.verb
        subject = (
            "" if self.node == PLAN and self.verb not in ("succeeds", "fails", "halted") else f"{whose} "
        )
        because = f" because of “{self.words}”" if self.words else ""
        return f"{subject}{is_halted}{because} {self.often}"

    def _got(self, group: Sequence[TraceEvent], happened: Sequence[TraceEvent]) -> str:
        return times(len(group)) + ("" if self.words is None else f", of {len(happened)} in all")

    def _because(self, episode: Episode, nodes: Sequence[Node], shown: Sequence[TraceEvent]) -> Iterator[str]:
        """The counted or alternative events; without any, why the nodes never ran or do not exist."""
        if not nodes:
            yield causes.absent(self.node)
            yield from causes.of_absence(episode, self.node)
        for event in shown:
            yield from causes.of_event(event)
        if nodes and not shown:
            yield from causes.of_last(episode.history, nodes)
        if not shown:
            yield from causes.of_unserved(episode)


def _holds(event: TraceEvent, words: str) -> bool:
    return any(holds(cause.words, words) for cause in event.because)
