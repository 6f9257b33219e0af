"""The state of something, as a word: the outcome, the plan, a person's visit, a parameter."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self, get_args

from comity.episode import Outcome
from comity.monitoring.lateness import late_s
from comity.testing.amounts import causes
from comity.testing.amounts.course import of_lateness, of_plan
from comity.testing.amounts.quantity import is_figure, require_parameter
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import outcome_of, require_goal, to_visit, values_when_judged, visit_of
from comity_executor import PROPER_OUTCOMES
from comity_fis import InputError, NominalParameter, NumericParameter, unknown_word

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity_fis.inference.value import ParameterValue

OUTCOME, PLAN = "outcome", "plan"
FARES = ("greeted", "unfinished", "declined", "unreached", "not_greeted", "skipped", "unreachable")
"""Outcomes of a person's visit."""
PROOFS = ("proven", "unproven")
"""Whether the first plan is proven optimal."""


@dataclass(frozen=True, slots=True)
class State(Expectation):
    """`outcome is partial`, `plan is proven`, `vera is unreachable`, `greeting_gesture of yumi is bow`."""

    RULE: ClassVar[str] = "NAME [_OF NAME] _IS NAME"
    EXAMPLE: ClassVar[str] = "outcome is success"

    subject: str
    person: str | None
    word: str

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a subject, a person or None, and a word."""
        subject, person, word = parts
        if subject == OUTCOME and word not in get_args(Outcome):
            raise unknown_word("an outcome", word, get_args(Outcome))
        if subject == PLAN and word not in PROOFS:
            raise unknown_word("what a plan may be", word, PROOFS)
        return cls(subject, person, word)

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """A different state."""
        if self.subject == OUTCOME:
            yield from judge_outcome(episode, self.word)
        elif self.subject == PLAN:
            yield from _judge_plan(episode, self.word)
        elif self.subject in episode.prepared.file.scenario.people:
            yield from self._fares(episode)
        else:
            yield from self._parameter(episode)

    def _fares(self, episode: Episode) -> Iterator[Finding]:
        require_goal(episode.prepared.file.scenario, self.subject)
        if self.word not in FARES:
            raise unknown_word(f"what may come of {self.subject}'s visit", self.word, FARES)
        got = outcome_of(episode, self.subject)
        if got != self.word:
            because = tuple(causes.of_visit(episode, self.subject))
            yield Finding(f"{self.subject} {self.word}", got, because)

    def _parameter(self, episode: Episode) -> Iterator[Finding]:
        if is_figure(self.subject):
            raise InputError(
                expected=f"a number: {self.subject} is one",
                got=repr(self.word),
                remedy=f"Write `{self.subject} at most` or `at least`, a number and its unit.",
            )
        for person in self.people or to_visit(episode):
            values = values_when_judged(episode, person, self.subject)
            require_parameter(self.subject, values, (OUTCOME, PLAN, *episode.prepared.file.scenario.people))
            self._require_word(episode.prepared.rulebook.parameters[self.subject], values[self.subject])
            got = values[self.subject].value
            if got != self.word:
                because = tuple(causes.of_parameter(episode, self.subject, person))
                yield Finding(f"{self.subject} {self.word} for {person}", str(got), because)

    def _require_word(self, parameter: NumericParameter | NominalParameter, value: ParameterValue) -> None:
        if isinstance(parameter, NumericParameter):
            raise InputError(
                expected=f"a number: {self.subject} is one",
                got=repr(self.word),
                remedy=f"Write it like `{self.subject} is {_rounded(value)}`.",
            )
        words = [category.name for category in parameter.categories]
        if self.word not in words:
            raise unknown_word(f"a word that {self.subject} may be", self.word, words)


def _rounded(value: ParameterValue) -> str:
    unit = None if value.unit in (None, "1") else value.unit
    return f"{value.number:.2f} {unit or ''} within 0.01 {unit or ''}".replace("  ", " ").strip()


def judge_outcome(episode: Episode, wanted: str) -> Iterator[Finding]:
    """A different outcome of the run, with everybody who was not greeted, or too late."""
    got = episode.outcome
    if got != wanted:
        people = episode.prepared.file.scenario.visited()
        fared = [name for name in people if not _served_in_time(episode, name)] or people
        because = (
            line
            for name in fared
            for line in (f"{name:9} {outcome_of(episode, name)}", *_of_visit(episode, name))
        )
        yield Finding(f"outcome {wanted}", got, tuple(because))


def _of_visit(episode: Episode, name: str) -> tuple[str, ...]:
    """Causes of a visit's outcome; for a visit that ended too late, what took the time."""
    visit = visit_of(episode.visits, name)
    return (tuple(of_lateness(episode, visit)) if visit else ()) or tuple(causes.of_visit(episode, name))


def _served_in_time(episode: Episode, name: str) -> bool:
    visit = visit_of(episode.visits, name)
    late = visit is not None and late_s(episode.prepared.visitees, visit)
    return outcome_of(episode, name) in PROPER_OUTCOMES and not late


def _judge_plan(episode: Episode, wanted: str) -> Iterator[Finding]:
    """A plan whose optimality differs, with its planner and what is known of its cost."""
    plan = episode.prepared.plan
    got = PROOFS[0] if plan.optimal else PROOFS[1]
    if got != wanted:
        costs = f"costs {plan.cost / 100:.2f} m, none less than {plan.bound / 100:.2f} m"
        yield Finding(f"plan {wanted}", got, (f"plan      by {plan.engine}: {costs}", *of_plan(episode)))
