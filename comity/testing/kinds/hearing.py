"""What the robot says to somebody."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes
from comity.testing.metrics.words import holds
from comity_executor.memory.meeting import UTTER

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial

_ASKED = "no goal names {}: they are only asked to make way, where they are in it"
_WITH = "{} is greeted together with {}, to whom the robot speaks for all of them"


@dataclass(frozen=True, slots=True)
class Hearing:
    """A part of what was said to them, to its end, in one utterance; to a group, to each of its members.

    Whoever is greeted together with somebody hears what is said to that one.
    """

    RULE: ClassVar[str] = "NAME _HEARS NAME"
    EXAMPLE: ClassVar[str] = "anna hears 'tea from the kitchen'"

    person: str
    words: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a name and quoted words."""
        person, words = parts
        return cls(person, words)

    @property
    def people(self) -> Sequence[str]:
        """Nobody who must be a person: it may be a group."""
        return ()

    @property
    def hearers(self) -> Sequence[str]:
        """The person or the group."""
        return (self.person,)

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Everybody to whom the words were not said, or broken off."""
        scenario = trial.prepared.file.scenario
        if self.person in scenario.people:
            yield from self._judge(trial, self.person)
        else:
            for member in scenario.groups[self.person]:
                yield from self._judge(trial, member, f", of {self.person}")

    def _judge(self, trial: Trial, person: str, of_whom: str = "") -> Iterator[Finding]:
        visit = trial.visit(person)
        spoken_to = (visit.together_with if visit else None) or person
        said = [
            act
            for act in trial.episode.acts
            if act.text and (act.person == person or (act.person == spoken_to and act.act == UTTER))
        ]
        if any(holds(act.text or "", self.words) and not act.stopped for act in said):
            return
        counted = Counter(f"“{act.text}”{' (broken off)' if act.stopped else ''}" for act in said)
        heard = " ".join(
            words if count == 1 else f"{words}, {count} times" for words, count in counted.items()
        )
        because = (
            *(() if person in trial.goals else (_ASKED.format(person),)),
            *((_WITH.format(person, spoken_to),) if spoken_to != person else ()),
            *(() if said else causes.of_visit(trial, person)),
            *causes.of_node(trial, f"{UTTER}({spoken_to})"),
            *causes.of_parameter(trial, "greeting_modality", person),
        )
        yield Finding(f"“{self.words}” to {person}{of_whom}", heard or "not a word", because)
