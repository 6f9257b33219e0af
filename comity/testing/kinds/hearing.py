"""Words that the robot says to a person, or does not say."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
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
    from comity_executor import History
    from comity_sim2d import ActEvent

_ASKED = "no goal names {}: they are only asked to make way, where they are in it"
_WITH = "{} is greeted together with {}, to whom the robot speaks for all of them"


@dataclass(frozen=True, slots=True)
class Hearing(Expectation):
    """Words in one completed utterance to the person or, for a group, to each of its members.

    A person who is greeted together with another one hears what is said to that one. `never` also covers
    interrupted utterances, because it is unknown which words were spoken.
    """

    RULE: ClassVar[str] = "NAME [NEVER] _HEARS NAME"
    EXAMPLE: ClassVar[str] = "anna hears 'tea from the kitchen'"

    hearer: str
    """A person or a group."""
    never: bool
    words: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a name, `never` or None, and quoted words."""
        hearer, never, words = parts
        return cls(hearer, never is not None, words)

    @property
    def hearers(self) -> Sequence[str]:
        """The named person or group."""
        return (self.hearer,)

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Each person who did not hear the words, or heard words that are excluded."""
        scenario = episode.prepared.file.scenario
        for person, of_group in _members(scenario, self.hearer):
            stood_before = spoken_to(episode.visits, person)
            company = (_WITH.format(person, stood_before),) if stood_before != person else ()
            said = [act for act in episode.acts if _is_to(act, person, stood_before)]
            having = [act for act in said if _has(act, self.words)]
            if self.never and having:
                expected = f"never “{self.words}” to {person}{of_group}"
                heard = " ".join(dict.fromkeys(_quoted(act) for act in having))
                yield Finding(expected, heard, (*company, *_why_said(episode.history, having)))
            elif not self.never and all(act.stopped for act in having):
                because = (
                    *(() if person in goals_of(scenario) else (_ASKED.format(person),)),
                    *company,
                    *(() if said else _why_silent(episode, person, stood_before)),
                    *causes.of_node(episode.history, f"{SAY_ACT}({stood_before})"),
                    *causes.of_parameter(episode, "greeting_modality", person),
                )
                yield Finding(
                    f"“{self.words}” to {person}{of_group}", _counted(said) or "not a word", because
                )


def _why_said(history: History, said: Sequence[ActEvent]) -> Iterator[str]:
    yield from (f"t={act.t_start:.2f}..{act.t_end:.2f} s  {act.act}({act.person})" for act in said)
    yield from causes.of_node(history, f"{said[0].act}({said[0].person})", ended_s=said[0].t_end)


def _members(scenario: Scenario, who: str) -> Iterator[tuple[str, str]]:
    """The person, or each member of a group, with a phrase that names the group."""
    if who in scenario.people:
        yield who, ""
    else:
        for member in scenario.groups[who]:
            yield member, f", of {who}"


def _is_to(act: ActEvent, person: str, stood_before: str) -> bool:
    """Whether the act is an utterance addressed to a person."""
    return bool(act.text) and (act.person == person or (act.person == stood_before and act.act == SAY_ACT))


def _why_silent(episode: Episode, person: str, stood_before: str) -> Iterator[str]:
    """The outcome of the visit, and the planned greeting: speech may be excluded, for example by noise."""
    yield from causes.of_visit(episode, person)
    yield from causes.of_step(episode, "Greet", stood_before)


def _has(act: ActEvent, words: str) -> bool:
    """Whether an utterance contains words, in its own script or in Latin letters."""
    return any(holds(text, words) for text in (act.text, act.latin) if text)


def _counted(said: Iterable[ActEvent]) -> str:
    counts = Counter(_quoted(act) for act in said)
    return " ".join(words if count == 1 else f"{words}, {count} times" for words, count in counts.items())


def _quoted(act: ActEvent) -> str:
    latin = f" ({act.latin})" if act.latin else ""
    return f"“{act.text}”{latin}{' (broken off)' if act.stopped else ''}"
