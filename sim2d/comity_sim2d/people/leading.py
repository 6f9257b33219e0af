"""People who are led by changes or faults: of several that lead one person, the latest one counts.

People who are led neither walk nor step back by themselves: two that move one person at once would push them
to and fro.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_sim2d.pose import XY

if TYPE_CHECKING:
    from comity_sim2d.people.pedestrians import Pedestrians


@dataclass(frozen=True, slots=True, eq=False)
class Lead:
    """A person is led: two leads are never the same one."""

    person: str
    to_m: XY
    """Where they belong when it is over."""
    heading_rad: float | None
    """How they stand there; None: as they came."""
    stays: bool = True
    """Whether they stay where it ends; else they go on with a walk of their own, where they have one."""


class Leads:
    """The people who are led now.

    Args:
        traffic: People who walk by themselves while nothing leads them.
    """

    def __init__(self, traffic: Pedestrians | None) -> None:
        self._traffic = traffic
        self._leads: dict[str, Lead] = {}

    def of(self, name: str) -> Lead | None:
        """What leads a person just now."""
        return self._leads.get(name)

    def holds(self, lead: Lead) -> bool:
        """Whether it leads its person still."""
        return self._leads.get(lead.person) is lead

    def begin(self, lead: Lead) -> bool:
        """Lead a person from now on; says whether something else did until now, which is over with that."""
        was_led = lead.person in self._leads
        self._leads[lead.person] = lead
        if self._traffic:
            self._traffic.hold(lead.person)
        return was_led

    def end(self, lead: Lead) -> None:
        """Let its person go; nothing happens where something else leads them by now."""
        if self.holds(lead):
            del self._leads[lead.person]
            if self._traffic:
                self._traffic.let_go(lead.person, stays=lead.stays)
