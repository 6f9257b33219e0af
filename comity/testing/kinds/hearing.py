"""What the robot says to somebody."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics import causes

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial


_ASKED = "no goal names {}: they are only asked to make way, where they are in it"


@dataclass(frozen=True, slots=True)
class Hearing:
    """A part of what was said to them, to its end, in one utterance."""

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
        """The one who hears it."""
        return (self.person,)

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """The words were not said, or broken off."""
        said = [act for act in trial.episode.acts if act.person == self.person and act.text]
        if not any(self.words in (act.text or "") and not act.stopped for act in said):
            heard = " ".join(f"“{act.text}”{' (broken off)' if act.stopped else ''}" for act in said)
            asked = () if self.person in trial.goals else (_ASKED.format(self.person),)
            because = (
                *asked,
                *causes.of_node(trial, f"utter({self.person})"),
                *causes.of_parameter(trial, "greeting_modality", self.person),
            )
            yield Finding(f"“{self.words}” to {self.person}", heard or "not a word", because)
