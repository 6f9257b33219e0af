"""What an alternative to the first plan would cost, or why it is excluded: a side, a greeting, a time."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.amounts.amount import Bounds
from comity.testing.amounts.shaping import shaping_price
from comity.testing.amounts.words import holds
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import require_goal
from comity_domain.choices.greeting import NO_GESTURE
from comity_domain.explanation.agenda_reason import AFTER, BEFORE
from comity_domain.explanation.company_reason import ONE_BY_ONE
from comity_fis import unknown_word

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.preparation import PlannedEpisode
    from comity_domain import PlanStep

SIDES = ("front", "left", "right")


@dataclass(frozen=True, slots=True)
class OtherChoice(Expectation):
    """The first plan with one choice for a person made otherwise."""

    RULE: ClassVar[str] = (
        "_VISITING NAME (_FROM (FRONT | LEFT | RIGHT) | _WITH NAME)"
        " (_WOULD_COST price | _IS EXCLUDED [_BECAUSE NAME])"
    )
    EXAMPLE: ClassVar[str] = "visiting johanna from the left would cost at least 30 cm more"

    person: str
    choice: str
    """A side, a word of a greeting, or what else stands next to a step under `Instead`."""
    price: Bounds | None
    """Additional cost in metres of path; None if the choice is to be excluded."""
    words: str
    """Words of the reason for the exclusion; empty for any."""

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a person, a choice, and bounds, or `excluded` and words of a reason."""
        person, choice, *priced = parts
        choice = choice.lower() if choice.lower() in SIDES else choice
        if isinstance(priced[0], Bounds):
            priced[0].require_possible("what an alternative adds", 0.0, None, "m")
            return cls(person, choice, priced[0], "")
        return cls(person, choice, None, priced[1] or "")

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Another cost, no such choice, or a choice that is not excluded."""
        prepared = episode.prepared
        require_choice(prepared, self.person, self.choice)
        if self.price is None:
            yield from self._judge_excluded(prepared)
        else:
            yield from self._judge_price(prepared, self.price)

    def _judge_price(self, prepared: PlannedEpisode, price: Bounds) -> Iterator[Finding]:
        steps = prepared.plan.steps
        found = [
            (other.extra_cost, step, other.because)
            for step in steps
            if not self._is_meant(step, step.arguments)
            for other in step.why.alternatives
            if self._is_meant(step, other.arguments)
        ]
        if not found:
            expected = f"{self} to cost {price.told('m')} more"
            yield Finding(expected, self._why_none(steps), tuple(self._because(prepared, steps)))
            return
        extra_cm, step, because = min(found, key=lambda each: each[0])
        extra_m = extra_cm / 100
        if not price.holds(extra_m, "m"):
            yield Finding(
                f"{self} to cost {price.told('m', extra_m)} more",
                price.missed_by(extra_m, "m", " more"),
                (*([because] if because else []), *self._because(prepared, (step,))),
            )

    def _judge_excluded(self, prepared: PlannedEpisode) -> Iterator[Finding]:
        steps = prepared.plan.steps
        reasons = list(self._reasons(steps))
        if not any(holds(reason, self.words) for reason in reasons):
            because = f" because of “{self.words}”" if self.words else ""
            got = f"it is excluded: {reasons[0]}" if reasons else "it is not excluded"
            yield Finding(f"{self} excluded{because}", got, tuple(self._because(prepared, steps)))

    def __str__(self) -> str:
        chosen = f"from the {self.choice}" if self.choice in SIDES else f"with {self.choice}"
        return f"visiting {self.person} {chosen}"

    def _why_none(self, steps: Sequence[PlanStep]) -> str:
        """Message that the choice is the planned one, is excluded, or does not exist."""
        if any(self._is_meant(step, step.arguments) for step in steps):
            return f"{self.choice} is what the plan has for {self.person}"
        reason = next(self._reasons(steps), None)
        return f"it is excluded: {reason}" if reason else "no such choice at any step"

    def _reasons(self, steps: Sequence[PlanStep]) -> Iterator[str]:
        """Reasons for the exclusion of the choice, for all steps."""
        for step in steps:
            for out in step.why.ruled_out:
                if self._is_meant(step, out.arguments):
                    yield out.reason

    def _is_meant(self, step: PlanStep, arguments: Sequence[str]) -> bool:
        """Whether these arguments of a step contain this choice for the person.

        A greeting of a group counts for each member; the side only concerns the person before whom the robot
        stands.
        """
        whose = arguments[1:2] if self.choice in SIDES else (*arguments[1:2], *step.people)
        return self.person in whose and self.choice in arguments[2:]

    def _because(self, prepared: PlannedEpisode, steps: Sequence[PlanStep]) -> Iterator[str]:
        """The steps for the person, and the plan's parameters: the places of the others affect the cost."""
        for step in steps:
            if self.person in step.people:
                arguments = ", ".join(step.arguments)
                yield f"step      {step.action}({arguments}), cost {step.cost}: {step.why.text}"
        yield from shaping_price(prepared, self.person)


def require_choice(prepared: PlannedEpisode, person: str, choice: str) -> None:
    """Refuse a choice that no plan has: a typo would otherwise go unnoticed.

    Raises:
        InputError: if no goal names the person, or no step of any plan has this choice.
    """
    require_goal(prepared.file.scenario, person)
    parameters = prepared.rulebook.parameters
    greetings = (parameters.get(name) for name in ("greeting_modality", "greeting_gesture"))
    words = [category.name for each in greetings for category in getattr(each, "categories", ())]
    planned = [word for step in prepared.plan.steps for word in step.arguments[2:]]
    known = (*SIDES, *words, NO_GESTURE, ONE_BY_ONE, BEFORE, AFTER, *planned)
    if choice not in known:
        raise unknown_word(
            "a side, a way to greet, or another choice of a plan", choice, dict.fromkeys(known)
        )
