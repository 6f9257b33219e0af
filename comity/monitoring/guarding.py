"""Safe defaults for people whose identity is uncertain.

A person who may be one of several is treated in a way acceptable to all of them: like a stranger, and farther
away and more slowly if any of them wants that. Permissions (a wish for less distance, consent to touch,
learnt values, a name) wait until the robot is sure.
"""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from comity.parameters.values import infer_for
from comity.people.profile import NOBODY, Profile
from comity_domain.problem.bound_parameters import DISTANCE, SPEED
from comity_fis import InputError
from comity_fis.listing import listed

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode
    from comity.schedule import Listener
    from comity_executor import FaultError
    from comity_fis import Inference


class Guarding:
    """Wraps a planner, and filters parameters while identities are uncertain.

    Args:
        prepared: The scenario, with everybody's parameters.
        planner: The wrapped planner.
    """

    def __init__(self, prepared: PlannedEpisode, planner: Listener) -> None:
        self._prepared = prepared
        self._planner = planner
        self._own = dict(prepared.values)
        """Everyone's own parameters, as last updated."""
        self._uncertain: frozenset[str] = frozenset()
        self.was_uncertain: set[str] = set()
        """People whose identity was uncertain at some time: nothing noticed is learnt about them."""

    def tell(self, person: str, values: Inference, text: str) -> None:
        """Update a person's parameters: at once if their identity is certain, or the update protects them."""
        self._own[person] = values
        if person not in self._uncertain:
            self._planner.tell(person, values, text)
        for name in self._uncertain:
            self._planner.tell(name, self._guarded(name), text)

    def own(self, person: str) -> Inference:
        """A person's own parameters, whether or not the robot is sure who they are."""
        return self._own[person]

    def note(self, about: str, text: str, fault: str | None) -> None:
        """To the planner."""
        self._planner.note(about, text, fault)

    def break_down(self, error: FaultError, calls: int) -> None:
        """To the planner."""
        self._planner.break_down(error, calls)

    def doubt(self, uncertain: frozenset[str]) -> None:
        """Update the set of people with uncertain identity."""
        if uncertain == self._uncertain:
            return
        sure, self._uncertain = self._uncertain - uncertain, uncertain
        self.was_uncertain |= uncertain
        for name in sorted(sure):
            self._planner.tell(name, self._own[name], f"the robot has made sure who {name} is")
        others = listed((*sorted(uncertain), "a stranger"), "or")
        for name in sorted(uncertain):
            text = f"whom the robot takes for {name} may be {others}: what holds for each of them is kept"
            self._planner.tell(name, self._guarded(name), text)

    def _guarded(self, name: str) -> Inference:
        """A stranger's parameters, as far and as slow as anybody wants who they may be."""
        stranger = self._inferred(name, {})
        candidates = [stranger, *(self._own[each] for each in sorted(self._uncertain))]
        farthest_m = max(each[DISTANCE].number for each in candidates)
        slowest_m_s = min(each[SPEED].number for each in candidates)
        wishes = {DISTANCE: farthest_m} if farthest_m > stranger[DISTANCE].number else {}
        if slowest_m_s < stranger[SPEED].number:
            wishes[SPEED] = slowest_m_s
        return self._inferred(name, wishes) if wishes else stranger

    def _inferred(self, name: str, wishes: Mapping[str, float]) -> Inference:
        """What holds of a stranger in this person's place, with such wishes."""
        prepared, scenario = self._prepared, self._prepared.file.scenario
        stranger = replace(NOBODY, profile=Profile(name="a stranger", settings=dict(wishes)))
        situation = {"posture": scenario.people[name].posture}
        with suppress(InputError):
            return infer_for(stranger, prepared.rulebook, situation=situation, at=prepared.day)
        return infer_for(stranger, prepared.rulebook, at=prepared.day)
