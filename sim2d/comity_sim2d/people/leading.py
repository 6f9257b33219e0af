"""People led by changes or faults: if several lead one person, the latest counts.

A led person neither walks nor steps back on their own: two movements at once would push them to and fro.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from comity_sim2d.people.pedestrians import Pedestrians


@dataclass(frozen=True, slots=True, eq=False)
class Lead:
    """A lead of one person; compared by identity."""

    person: str
    to_m: XY
    """Their place afterwards [m]."""
    heading_rad: float | None
    """Their heading there [rad]; None: as they arrived."""
    stays: bool = True
    """Whether they stay where it ends; otherwise they resume their own walk, if they have one."""


class Leads:
    """The people who are currently led.

    Args:
        traffic: The pedestrians, who walk by themselves while not led.
    """

    def __init__(self, traffic: Pedestrians | None) -> None:
        self._traffic = traffic
        self._leads: dict[str, Lead] = {}

    def of(self, name: str) -> Lead | None:
        """The current lead of a person; None if not led."""
        return self._leads.get(name)

    def holds(self, lead: Lead) -> bool:
        """Whether a lead is still in force."""
        return self._leads.get(lead.person) is lead

    def begin(self, lead: Lead) -> bool:
        """Start a lead; returns whether it replaces another one."""
        was_led = lead.person in self._leads
        self._leads[lead.person] = lead
        if self._traffic:
            self._traffic.hold(lead.person)
        return was_led

    def end(self, lead: Lead) -> None:
        """End a lead; no effect if another one has replaced it."""
        if self.holds(lead):
            del self._leads[lead.person]
            if self._traffic:
                self._traffic.let_go(lead.person, stays=lead.stays)
