"""What another choice would cost: another side, another greeting, another time to fetch something."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.testing.expectation import Finding
from comity.testing.metrics.amount import around, passed_end, told_beside, told_beyond, told_range
from comity.testing.metrics.shaping import shaping_price
from comity.testing.metrics.words import holds
from comity_domain.choices.greeting import NO_GESTURE
from comity_domain.explanation.agenda_reason import AFTER, BEFORE
from comity_domain.explanation.company_reason import ONE_BY_ONE
from comity_fis import InputError, closest

if TYPE_CHECKING:
    from comity.testing.trials.trial import Trial
    from comity_domain import PlanStep

_SIDES = ("front", "left", "right")
_CHOICE = "_VISITING NAME (_FROM (FRONT | LEFT | RIGHT) | _WITH NAME)"


@dataclass(frozen=True, slots=True)
class _Instead:
    """What the first plan would cost more with one choice made otherwise, from one number to another."""

    person: str
    choice: str
    """A side, a word of a greeting, or what else stands behind a step under `Instead`."""
    low_m: float
    high_m: float | None
    """In metres of way; None: however much more."""

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,)

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """Another price, or no such choice."""
        require_choice(trial, self.person, self.choice)
        steps = trial.prepared.plan.steps
        prices = [
            (other.extra_cost, step, other.because)
            for step in steps
            if not _is_meant(step, step.arguments, self.person, self.choice)
            for other in step.why.alternatives
            if _is_meant(step, other.arguments, self.person, self.choice)
        ]
        if not prices:
            yield Finding(self._expected(), self._why_none(steps), tuple(_told(trial, steps, self.person)))
            return
        extra_cm, step, because = min(prices, key=lambda price: price[0])
        extra_m = extra_cm / 100
        end_m = passed_end(extra_m, self.low_m, self.high_m)
        if end_m is not None:
            shown = told_beside(extra_m, self.low_m, self.high_m, "m")
            yield Finding(
                self._expected(extra_m),
                f"{shown} more, {told_beyond(extra_m, end_m, 'm')}",
                (*([because] if because else []), *_told(trial, (step,), self.person)),
            )

    def _expected(self, *beside_m: float) -> str:
        cost = told_range(self.low_m, self.high_m, "m", *beside_m)
        return f"visiting {self.person} {_chosen(self.choice)} to cost {cost} more"

    def _why_none(self, steps: Sequence[PlanStep]) -> str:
        """That it is planned so, is ruled out, or is no choice."""
        if any(_is_meant(step, step.arguments, self.person, self.choice) for step in steps):
            return f"{self.choice} is what the plan has for {self.person}"
        reason = next(_reasons(steps, self.person, self.choice), None)
        return f"it is ruled out: {reason}" if reason else "no such choice at any step"


def require_choice(trial: Trial, person: str, choice: str) -> None:
    """Refuse a choice that no plan has: it would fail without a word about its slip.

    Raises:
        InputError: where no goal names the person, or no step of any plan can be done so.
    """
    trial.require_goal(person)
    ways = (
        trial.prepared.rulebook.parameters.get(name) for name in ("greeting_modality", "greeting_gesture")
    )
    words = [category.name for way in ways for category in getattr(way, "categories", ())]
    planned = [word for step in trial.prepared.plan.steps for word in step.arguments[2:]]
    known = (*_SIDES, *words, NO_GESTURE, ONE_BY_ONE, BEFORE, AFTER, *planned)
    if choice not in known:
        raise InputError(
            expected="a side, a way to greet, or another choice of a plan",
            got=repr(choice),
            remedy=closest(choice, dict.fromkeys(known)),
        )


def _is_meant(step: PlanStep, arguments: Sequence[str], person: str, choice: str) -> bool:
    """Whether a way to do a step is this choice for somebody: a greeting of a company is one for each member.

    On which side the robot stands is a matter of the one alone before whom it does.
    """
    whose = arguments[1:2] if choice in _SIDES else (*arguments[1:2], *step.people)
    return person in whose and choice in arguments[2:]


def _reasons(steps: Sequence[PlanStep], person: str, choice: str) -> Iterator[str]:
    """Why a choice is ruled out, wherever it is."""
    for step in steps:
        for out in step.why.ruled_out:
            if _is_meant(step, out.arguments, person, choice):
                yield out.reason


def _chosen(choice: str) -> str:
    return f"from the {choice}" if choice in _SIDES else f"with {choice}"


def _told(trial: Trial, steps: Sequence[PlanStep], person: str) -> Iterator[str]:
    """The steps for somebody, and what the plan goes by: where the others want the robot moves the price."""
    for step in steps:
        if person in step.people:
            yield f"step      {step.action}({', '.join(step.arguments)}), cost {step.cost}: {step.why.text}"
    yield from shaping_price(trial, person)


@dataclass(frozen=True, slots=True)
class InsteadCostly(_Instead):
    """At least so much more."""

    RULE: ClassVar[str] = f"{_CHOICE} _WOULD_COST _AT_LEAST amount _MORE"
    EXAMPLE: ClassVar[str] = "visiting johanna from the left would cost at least 30 cm more"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a person, a choice and an amount."""
        person, choice, least = parts
        return cls(person, _plain(choice), least.size("m"), None)


@dataclass(frozen=True, slots=True)
class InsteadPriced(_Instead):
    """So much more."""

    RULE: ClassVar[str] = f"{_CHOICE} _WOULD_COST amount _MORE [_WITHIN amount]"
    EXAMPLE: ClassVar[str] = "visiting johanna with a wave would cost 40 cm more within 1 cm"

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a person, a choice, an amount and how far off it may be."""
        person, choice, middle, within = parts
        low, high = around(middle, within)
        return cls(person, _plain(choice), low.to("m"), high.to("m"))


@dataclass(frozen=True, slots=True)
class InsteadRuledOut:
    """Not open, whatever it would cost."""

    RULE: ClassVar[str] = f"{_CHOICE} _IS _RULED_OUT [_BECAUSE NAME]"
    EXAMPLE: ClassVar[str] = "visiting johanna with a handshake is ruled out because 'touch consent'"

    person: str
    choice: str
    words: str
    """Of the reason; empty where any will do."""

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """From a person, a choice and words of a reason."""
        person, choice, words = parts
        return cls(person, _plain(choice), words or "")

    @property
    def people(self) -> Sequence[str]:
        """The one whom it names."""
        return (self.person,)

    def judge(self, trial: Trial) -> Iterator[Finding]:
        """That it is open, or out for another reason."""
        require_choice(trial, self.person, self.choice)
        steps = trial.prepared.plan.steps
        reasons = list(_reasons(steps, self.person, self.choice))
        if not any(holds(reason, self.words) for reason in reasons):
            because = f" because of “{self.words}”" if self.words else ""
            got = f"it is ruled out: {reasons[0]}" if reasons else "it is not ruled out"
            expected = f"visiting {self.person} {_chosen(self.choice)} ruled out{because}"
            yield Finding(expected, got, tuple(_told(trial, steps, self.person)))


def _plain(choice: str) -> str:
    return choice.lower() if choice.lower() in _SIDES else choice
