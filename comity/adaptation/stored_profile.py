"""A stored person for programs: what was observed of them at real meetings is added, and taken back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from comity.adaptation.observers_words import distance, signal_in_words
from comity.adaptation.observing import ObservedSignal, observe
from comity.parameters.which_rulebook import EVIDENCE
from comity.people.dated import day_given
from comity.people.remembered import undo
from comity.people.store import Store
from comity_fis import load_rulebook

if TYPE_CHECKING:
    from comity.people.fact import Fact
    from comity.people.learnt_file import Observation


@dataclass(frozen=True, slots=True)
class StoredProfile:
    """A stored person, for programs: `comity.profile("amal")`.

    What is observed is kept for later meetings, in the store; it needs the person's consent to `learn`.
    """

    name: str
    rulebook: str = EVIDENCE
    """What runs with a stored person go by."""

    def __post_init__(self) -> None:
        Store().require(self.name)

    def observe(
        self,
        signal: str,
        distance_m: float,
        *,
        at: date | str | None = None,
        situation: Mapping[str, Fact] | None = None,
    ) -> Observation:
        """Write down what a person did when the robot stood before them.

        Args:
            signal: `stepped_back`, `turned_away`, `leaned_in` or `showed_nothing` is seen, `asked_farther`
                and `asked_closer` are said.
            distance_m: Where the robot stood, between the nearest points of the bodies, 0 to 20.
            at: The day, as a date or YYYY-MM-DD; None for today.
            situation: What held then, as in `{"posture": "seated"}`; None for the person's usual one.

        Returns:
            What was written down, with what culture and situation alone gave then.

        Raises:
            InputError: if the person did not agree to it, asks for a distance of their own, is a child, or
                something given cannot be used; nothing is written.
        """
        sight = ObservedSignal(
            self.name, signal_in_words(signal), distance(distance_m), day_given(at), situation
        )
        (seen,) = observe([sight], load_rulebook(self.rulebook))
        return seen

    def undo(self) -> tuple[Observation, ...]:
        """Forget what was written down last; again for what was before. What runs saw stays."""
        return undo(self.name)
