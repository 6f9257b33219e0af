"""The date of a test in words, for failures with a fact that depends on it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity.testing.trials.case import DAY, Across

if TYPE_CHECKING:
    from comity.testing.trials.case import Case


def day_taken(case: Case | Across) -> str:
    """The date and its source; empty if nothing depends on it."""
    cases = case.cases if isinstance(case, Across) else (case,)
    if not any(depends for one in cases for depends in _depending(one)):
        return ""
    if at := case.file.scenario.at:
        return f"{at}, the scenario's `at`"
    return f"{DAY}, as `comity test` takes it where the scenario has no `at`"


def _depending(case: Case) -> Iterator[bool]:
    """For everybody, whether a fact, or the weight of what meetings taught, depends on the date."""
    cast = case.cast
    for name, declared in cast.declared.items():
        embedded = case.file.scenario.people[name].learnt is not None and name not in case.profiles
        yield declared.profile.depends_on_date or (name in cast.learnt and not embedded)
