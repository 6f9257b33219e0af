"""A stored person, for use by programs: add and undo observations of real encounters."""

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

    Observations are stored for later encounters; this requires the person's consent to `learn`.
    """

    name: str
    rulebook: str = EVIDENCE
    """The rulebook of runs with a stored person."""

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
        """Store a person's reaction to the robot in front of them.

        Args:
            signal: Observed: `stepped_back`, `turned_away`, `leaned_in` or `showed_nothing`; said:
                `asked_farther` or `asked_closer`.
            distance_m: Distance of the robot, between the nearest points of the bodies, 0 to 20 [m].
            at: The day, as a date or YYYY-MM-DD; None: today.
            situation: The situation, such as `{"posture": "seated"}`; None: the person's usual one.

        Returns:
            The stored observation, with the value by culture and situation alone.

        Raises:
            InputError: The person does not consent, has a setting for the distance, or is a child, or an
                argument is invalid; nothing is written.
        """
        sight = ObservedSignal(
            self.name, signal_in_words(signal), distance(distance_m), day_given(at), situation
        )
        (seen,) = observe([sight], load_rulebook(self.rulebook))
        return seen

    def undo(self) -> tuple[Observation, ...]:
        """Remove the last stored entry; repeatable. Observations from runs are kept."""
        return undo(self.name)
