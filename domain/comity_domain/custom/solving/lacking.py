"""What of PDDL aries does not take, which is the engine that pip installs for numbers and durations."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from unified_planning.model import Problem


@dataclass(frozen=True, slots=True)
class Lack:
    """Something that it does not take."""

    features: frozenset[str]
    """What unified-planning calls it."""
    what: str
    remedy: str
    """What to write instead."""


COMPUTED = Lack(
    frozenset({"GENERAL_NUMERIC_PLANNING"}),
    "changes of a number by anything but a number that is written out, nor products",
    "Write a number, as in (increase (f) 2), with an action for each case",
)
_LACKS = (
    Lack(frozenset({"CONDITIONAL_EFFECTS"}), "effects on a condition", "Write an action for each case"),
    Lack(frozenset({"FORALL_EFFECTS"}), "effects for all of many things", "Write them out one by one"),
    Lack(
        frozenset({"EXISTENTIAL_CONDITIONS", "UNIVERSAL_CONDITIONS"}),
        "quantifiers in conditions",
        "Write them out one by one",
    ),
    COMPUTED,
    Lack(
        frozenset({"REAL_FLUENTS", "REAL_TYPE_DURATIONS", "REAL_NUMBERS_IN_ACTIONS_COST"}),
        "fractions",
        "Write it in whole numbers",
    ),
)


def lacking(problem: Problem) -> Lack | None:
    """The first thing of a problem that aries does not take; None where it takes all."""
    features = problem.kind.features
    return next((lack for lack in _LACKS if lack.features & features), None)
