"""What the robot says to a person, and what it does not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.words import holds
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import goals_of, spoken_to
from comity_executor.memory.visit_context import SAY_ACT

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.scenario import Scenario
    from comity_sim2d import ActEvent

_ASKED = "no goal names {}: they are only asked to make way, where they are in it"
_WITH = "{} is greeted together with {}, to whom the robot speaks for all of them"


@dataclass(frozen=True, slots=True)
class Hearing(Expectation):
    """Words in one utterance to the person, not broken off; to a group, to each of its members.

    A person who is greeted together with another one hears what is said to that one. `never`: in no
    utterance, not even in one that was broken off, because it is not known how far it came.
    """

    RULE: ClassVar[str] = "NAME [NEVER] _HEARS NAME"
    EXAMPLE: ClassVar[str] = "anna hears 'tea from the kitchen'"

    hearer: str
    """A person or a group."""
    never: bool
    words: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a name, `never` or None, and quoted words."""
        hearer, never, words = parts
        return cls(hearer, never is not None, words)

    @property
    def hearers(self) -> Sequence[str]:
        """The person or the group."""
        return (self.hearer,)

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Each person to whom the words were not said, or were although they never should be."""
        for person, of_group in _members(episode.prepared.file.scenario, self.hearer):
            said = _said_to(episode, person)
            having = [act for act in said if _has(act, self.words)]
            if self.never and having:
                yield self._said(episode, person, of_group, having)
            elif not self.never and all(act.stopped for act in having):
                yield self._not_said(episode, person, of_group, said)

    def _not_said(self, episode: Episode, person: str, of_group: str, said: Sequence[ActEvent]) -> Finding:
        stood_before = spoken_to(episode.visits, person)
        counted = Counter(_quoted(act) for act in said)
        heard = " ".join(
            words if count == 1 else f"{words}, {count} times" for words, count in counted.items()
        )
        because = (
            *(() if person in goals_of(episode.prepared.file.scenario) else (_ASKED.format(person),)),
            *((_WITH.format(person, stood_before),) if stood_before != person else ()),
            *(() if said else _why_silent(episode, person, stood_before)),
            *causes.of_node(episode.history, f"{SAY_ACT}({stood_before})"),
            *causes.of_parameter(episode, "greeting_modality", person),
        )
        return Finding(f"“{self.words}” to {person}{of_group}", heard or "not a word", because)

    def _said(self, episode: Episode, person: str, of_group: str, said: Sequence[ActEvent]) -> Finding:
        stood_before = spoken_to(episode.visits, person)
        because = (
            *((_WITH.format(person, stood_before),) if stood_before != person else ()),
            *(f"t={act.t_start:.2f}..{act.t_end:.2f} s  {act.act}({act.person})" for act in said),
            *causes.of_node(episode.history, f"{said[0].act}({said[0].person})", ended_s=said[0].t_end),
        )
        heard = " ".join(dict.fromkeys(_quoted(act) for act in said))
        return Finding(f"never “{self.words}” to {person}{of_group}", heard, because)


def _members(scenario: Scenario, who: str) -> Iterator[tuple[str, str]]:
    """The person, or everybody of a group, with the words that say so."""
    if who in scenario.people:
        yield who, ""
    else:
        for member in scenario.groups[who]:
            yield member, f", of {who}"


def _said_to(episode: Episode, person: str) -> list[ActEvent]:
    """All utterances that are meant for a person."""
    stood_before = spoken_to(episode.visits, person)
    return [
        act
        for act in episode.acts
        if act.text and (act.person == person or (act.person == stood_before and act.act == SAY_ACT))
    ]


def _why_silent(episode: Episode, person: str, stood_before: str) -> Iterator[str]:
    """What came of the visit, and how the greeting was planned: words may be ruled out, as by noise."""
    yield from causes.of_visit(episode, person)
    yield from causes.of_step(episode, "Greet", stood_before)


def _has(act: ActEvent, words: str) -> bool:
    """Whether an utterance has words in it, in its own script or in Latin letters."""
    return any(holds(text, words) for text in (act.text, act.latin) if text)


def _quoted(act: ActEvent) -> str:
    latin = f" ({act.latin})" if act.latin else ""
    return f"“{act.text}”{latin}{' (broken off)' if act.stopped else ''}"
