"""The acts that a greeting contains, and those that it does not."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Self

from comity.parameters.consent import TOUCHING
from comity.testing.amounts import causes
from comity.testing.amounts.acting import Done, done_for
from comity.testing.expectation import Expectation, Finding
from comity.testing.trials.visits import outcome_of, require_goal, to_visit
from comity_executor.memory.visit_context import SAY_ACT
from comity_fis import InputError, closest
from comity_sim2d.robot.acts import VERBS

if TYPE_CHECKING:
    from comity.episode import Episode

WORDS = ("words", "speech", "utterance", SAY_ACT)


@dataclass(frozen=True, slots=True)
class Item:
    """An act that is required, or excluded."""

    name: str
    wanted: bool

    def __str__(self) -> str:
        return self.name if self.wanted else f"no {self.name}"

    def among(self, acts: Sequence[str]) -> bool:
        """Whether it is among the completed acts."""
        if self.name in WORDS:
            return SAY_ACT in acts
        if self.name == "touch":
            return bool(TOUCHING & set(acts))
        if self.name == "gesture":
            return any(act != SAY_ACT for act in acts)
        return self.name in acts


@dataclass(frozen=True, slots=True)
class GreetingContent(Expectation):
    """The completed acts of one person's greeting; a farewell's acts are separate."""

    RULE: ClassVar[str] = "_GREETING [_OF NAME] _CONTAINS [NO] NAME (_AND [NO] NAME)*"
    EXAMPLE: ClassVar[str] = "greeting of johanna contains a nod and no touch"

    person: str | None
    items: tuple[Item, ...]

    @classmethod
    def read(cls, parts: Sequence[Any]) -> Self:
        """Create from a name, and pairs of `no` or None and a word."""
        person, *items = parts
        pairs = zip(items[::2], items[1::2], strict=True)
        return cls(person, _possible(tuple(Item(_known(name), no is None) for no, name in pairs)))

    def judge(self, episode: Episode) -> Iterator[Finding]:
        """Each person with a different greeting."""
        require_goal(episode.prepared.file.scenario, *self.people)
        for person in self.people or to_visit(episode):
            done = done_for(episode, person)
            acts = [each.act for each in done if each.is_greeting]
            wrong = [item for item in self.items if item.among(acts) != item.wanted]
            if wrong:
                because = (
                    *causes.of_step(episode, "Greet", person),
                    *causes.of_parameter(episode, "greeting_gesture", person),
                    *causes.of_parameter(episode, "greeting_modality", person),
                )
                got = (
                    " and ".join(WORDS[0] if act == SAY_ACT else act for act in acts)
                    or f"no act ({outcome_of(episode, person)})"
                )
                besides = dict.fromkeys(str(each) for each in _elsewhere(wrong, done))
                expected = f"{' and '.join(map(str, self.items))} for {person}"
                yield Finding(expected, "; ".join((got, *besides)), because)


def _elsewhere(wrong: Sequence[Item], done: Sequence[Done]) -> Iterator[Done]:
    """Acts missing in the greeting that were done on another occasion."""
    missed = [item for item in wrong if item.wanted]
    return (each for each in done if not each.is_greeting and any(item.among((each.act,)) for item in missed))


def _possible(items: tuple[Item, ...]) -> tuple[Item, ...]:
    """Refuse contradictory items: a handshake and no touch."""
    ruled_out = [item for item in items if not item.wanted]
    open_ones = [act for act in (*VERBS, SAY_ACT) if not any(item.among((act,)) for item in ruled_out)]
    for item in items:
        if item.wanted and not item.among(open_ones):
            raise InputError(
                expected="what a greeting can contain at once",
                got=" and ".join(map(str, items)),
                remedy=f"Leave `{item}` out, or what rules it out.",
            )
    return items


def _known(name: str) -> str:
    word = name.lower()
    names: Mapping[str, object] = {**VERBS, **dict.fromkeys((*WORDS, "touch", "gesture"))}
    if word not in names:
        raise InputError(
            expected="words, a gesture, a touch, or a gesture by its name",
            got=repr(name),
            remedy=closest(word, names),
        )
    return word
