"""Whether the robot repeats what it has done."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics.amount import times
from comity_executor.memory.meeting import UTTER
from comity_fis import InputError, closest
from comity_sim2d.robot.acts import VERBS

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial

ACTS = {verb.replace(" ", "_"): act for act, verb in VERBS.items()} | {"speaks": UTTER, "utters": UTTER}
"""By verb, what the robot does."""
_OTHERWISE = {word: verb for verb, act in ACTS.items() for word in (act, f"{act}s")}
"""Verbs that people make of the names of acts, with those that are meant."""


@dataclass(frozen=True, slots=True)
class Repetition:
    """An act that is done twice to its end for the same person."""

    RULE: ClassVar[str] = "_NEVER NAME TWICE"
    EXAMPLE: ClassVar[str] = "never waves twice"

    act: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a verb."""
        verb = parts[0].lower()
        if verb not in ACTS:
            raise InputError(
                expected="something that the robot does",
                got=repr(parts[0]),
                remedy=closest(verb, ACTS, _OTHERWISE),
            )
        return cls(ACTS[verb])

    @property
    def people(self) -> Sequence[str]:
        """Nobody."""
        return ()

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Everybody for whom it was done more than once."""
        done = [act for act in trial.episode.acts if act.act == self.act and not act.stopped]
        for person, count in Counter(act.person for act in done).items():
            if count > 1:
                because = tuple(
                    f"t={act.t_start:.2f}..{act.t_end:.2f} s  {act.act}"
                    for act in done
                    if act.person == person
                )
                yield Finding(f"{self.act} at most once for {person}", times(count), because)
