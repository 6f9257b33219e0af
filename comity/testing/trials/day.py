"""The day on which a test takes facts, in words: for a failure in which one of them depends on it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity.testing.trials.case import DAY, Across

if TYPE_CHECKING:
    from comity.testing.trials.case import Case


def day_taken(case: Case | Across) -> str:
    """Which day it is, and who says so; empty where nothing depends on it."""
    cases = case.cases if isinstance(case, Across) else (case,)
    if not any(depends for one in cases for depends in _depending(one)):
        return ""
    if at := case.file.scenario.at:
        return f"{at}, the scenario's `at`"
    return f"{DAY}, as `comity test` takes it where the scenario has no `at`"


def _depending(case: Case) -> Iterator[bool]:
    """Of everybody, whether a fact is another on another day, and what meetings taught worth less or more."""
    cast = case.cast
    for name, declared in cast.declared.items():
        embedded = case.file.scenario.people[name].learnt is not None and name not in case.profiles
        yield declared.profile.depends_on_date or (name in cast.learnt and not embedded)
