"""The plan step that a user means by `--why STEP`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from comity_fis import InputError, Where, closest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from comity.answers.plan import StepAnswer

MOST_NAMED = 6
GREETING = "greet_"
"""Name prefix of all greetings: a greeting of one person may be that of their company."""
_ASKED = re.compile(r"([^()]*)(?:\((.*)\))?", re.DOTALL)


def asked_step(steps: Sequence[StepAnswer], asked: str, name: Callable[[StepAnswer], str]) -> int:
    """The number of the meant step, from 1.

    Args:
        steps: Steps of the plan.
        asked: A number, an action, a person, or an action with some of its arguments or people in brackets.
        name: Returns the best name to ask for a step.

    Raises:
        InputError: if it matches no step, or several.
    """
    if not steps:
        raise _refused("a plan with steps", asked, "There is nothing to do in this plan.")
    if asked.strip().isdecimal() and 1 <= int(asked) <= len(steps):
        return int(asked)
    found = list(_meant(steps, asked))
    if len(found) == 1:
        return found[0]
    if found:
        listed = ", ".join(f"{i} is {name(steps[i - 1])}" for i in found[:MOST_NAMED])
        more = f", and {len(found) - MOST_NAMED} more" if len(found) > MOST_NAMED else ""
        raise _refused("one step", f"{asked!r}, which is {len(found)} of them", f"Say which: {listed}{more}.")
    expected = f"a step of the plan: 1 to {len(steps)}, or an action with its person"
    raise _refused(expected, repr(asked), _nearest(steps, asked, name))


def _meant(steps: Sequence[StepAnswer], asked: str) -> list[int]:
    """Numbers of the steps that match the words, directly or as the greeting of a company."""
    action, words = _parsed(asked)
    for is_action in (_same, _both_greet):
        fits = [i for i, step in _numbered(steps) if is_action(step.action, action) and words <= _words(step)]
        whole = [i for i in fits if _bare(",".join(steps[i - 1].arguments)) == _bare(_inside(asked))]
        if whole or fits:
            return whole or fits
    return [i for i, step in _numbered(steps) if not words and action in map(_bare, step.people)]


def _nearest(steps: Sequence[StepAnswer], asked: str, name: Callable[[StepAnswer], str]) -> str:
    """Another step for the same person, or the one with the most similar name."""
    _, words = _parsed(asked)
    for i, step in _numbered(steps):
        if words and words <= {_bare(person) for person in step.people} and "(" in asked:
            return f"Step {i} is for them: {name(step)}."
    return closest(asked, [name(step) for step in steps])


def _numbered(steps: Sequence[StepAnswer]) -> Iterator[tuple[int, StepAnswer]]:
    return enumerate(steps, start=1)


def _parsed(asked: str) -> tuple[str, set[str]]:
    """The action, and the words in its brackets."""
    found = _ASKED.match(asked)
    action = found[1] if found else ""
    return _bare(action), {_bare(word) for word in _inside(asked).split(",") if word.strip()}


def _inside(asked: str) -> str:
    found = _ASKED.match(asked)
    return (found[2] or "") if found else ""


def _words(step: StepAnswer) -> set[str]:
    return {_bare(word) for word in (*step.arguments, *step.people)}


def _same(action: str, asked: str) -> bool:
    return _bare(action) == asked


def _both_greet(action: str, asked: str) -> bool:
    return action.lower().startswith(GREETING) and asked.startswith(GREETING)


def _bare(word: str) -> str:
    """The word without spaces, in lower case."""
    return "".join(word.lower().split())


def _refused(expected: str, got: str, remedy: str) -> InputError:
    return InputError(expected=expected, got=got, remedy=remedy, where=Where("--why"))
