"""What the robot says to somebody, and what it does not."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts import causes
from comity.testing.amounts.words import holds
from comity.testing.expectation import Expectation, Finding
from comity_executor.memory.meeting import SAY_ACT

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
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

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Each person to whom the words were not said, or were although they never should be."""
        for person, of_group in _members(trial, self.hearer):
            said = _said_to(trial, person)
            having = [act for act in said if _has(act, self.words)]
            if self.never and having:
                yield self._said(trial, person, of_group, having)
            elif not self.never and all(act.stopped for act in having):
                yield self._not_said(trial, person, of_group, said)

    def _not_said(self, trial: Trial, person: str, of_group: str, said: Sequence[ActEvent]) -> Finding:
        spoken_to = _spoken_to(trial, person)
        counted = Counter(_quoted(act) for act in said)
        heard = " ".join(
            words if count == 1 else f"{words}, {count} times" for words, count in counted.items()
        )
        because = (
            *(() if person in trial.goals else (_ASKED.format(person),)),
            *((_WITH.format(person, spoken_to),) if spoken_to != person else ()),
            *(() if said else _why_silent(trial, person, spoken_to)),
            *causes.of_node(trial, f"{SAY_ACT}({spoken_to})"),
            *causes.of_parameter(trial, "greeting_modality", person),
        )
        return Finding(f"“{self.words}” to {person}{of_group}", heard or "not a word", because)

    def _said(self, trial: Trial, person: str, of_group: str, said: Sequence[ActEvent]) -> Finding:
        spoken_to = _spoken_to(trial, person)
        because = (
            *((_WITH.format(person, spoken_to),) if spoken_to != person else ()),
            *(f"t={act.t_start:.2f}..{act.t_end:.2f} s  {act.act}({act.person})" for act in said),
            *causes.of_node(trial, f"{said[0].act}({said[0].person})", ended_s=said[0].t_end),
        )
        heard = " ".join(dict.fromkeys(_quoted(act) for act in said))
        return Finding(f"never “{self.words}” to {person}{of_group}", heard, because)


def _members(trial: Trial, who: str) -> Iterator[tuple[str, str]]:
    """The person, or everybody of a group, with the words that say so."""
    scenario = trial.prepared.file.scenario
    if who in scenario.people:
        yield who, ""
    else:
        for member in scenario.groups[who]:
            yield member, f", of {who}"


def _spoken_to(trial: Trial, person: str) -> str:
    """Before whom the robot stands when it greets them."""
    visit = trial.visit(person)
    return (visit.together_with if visit else None) or person


def _said_to(trial: Trial, person: str) -> list[ActEvent]:
    """All utterances that are meant for somebody."""
    spoken_to = _spoken_to(trial, person)
    return [
        act
        for act in trial.episode.acts
        if act.text and (act.person == person or (act.person == spoken_to and act.act == SAY_ACT))
    ]


def _why_silent(trial: Trial, person: str, spoken_to: str) -> Iterator[str]:
    """What came of the visit, and how the greeting was planned: words may be ruled out, as by noise."""
    yield from causes.of_visit(trial, person)
    yield from causes.of_step(trial, "Greet", spoken_to)


def _has(act: ActEvent, words: str) -> bool:
    """Whether an utterance has words in it, in its own script or in Latin letters."""
    return any(holds(text, words) for text in (act.text, act.latin) if text)


def _quoted(act: ActEvent) -> str:
    latin = f" ({act.latin})" if act.latin else ""
    return f"“{act.text}”{latin}{' (broken off)' if act.stopped else ''}"
