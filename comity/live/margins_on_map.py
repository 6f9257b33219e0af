"""The margin that a real robot keeps from each person: decided as in simulation, and sent with its goal.

The base keeps the margin; this module decides who lets it pass, and for how long. Anything unknown counts
against it: a track's identity, a person's orientation, whether they stand.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from contextlib import suppress
from dataclasses import dataclass, replace
from math import hypot, isfinite
from typing import TYPE_CHECKING

from comity.live.reduced_margin_check import kept_margin_m, tracker_sd_m
from comity_executor import ReducedPassage
from comity_sim2d import Said
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.people.said import GO_AHEAD
from comity_sim2d.robot.margins import MarginDecision, Margins
from comity_sim2d.senses.sensing import DRIFTS_M_S

if TYPE_CHECKING:
    from comity.live.known_world import KnownWorld
    from comity_executor import MapRobot
    from comity_sim2d import Person, Pose


class MarginsOnMap:
    """Decides about the people who obstruct one real robot.

    Args:
        base: The robot, with speech recognition if it has any.
        known: The robot's knowledge of the world.
    """

    def __init__(self, base: MapRobot, known: KnownWorld) -> None:
        self._base, self._known = base, known
        self._clock = _LookTicks()
        self._said: list[Said] = []
        body = known.scene.robot
        # Speech arrives with its own timestamp, so no sensor delay is subtracted.
        spec = replace(body, sensor=replace(body.sensor, sigma_m=tracker_sd_m(base), delay_s=0.0))
        self._margins = Margins(spec, _PeopleOnMap(known), self._clock, self._said, kept_margin_m(base))

    @property
    def decisions(self) -> tuple[MarginDecision, ...]:
        """All decisions so far, in order."""
        return tuple(self._margins.decisions)

    @property
    def passages(self) -> tuple[ReducedPassage, ...]:
        """The people who let the robot pass now, for the base."""
        margin_m = self._known.scene.robot.margin_m
        return tuple(ReducedPassage(one.name, *one.xy, margin_m) for one in self._margins.let_by)

    def note_asked(self, person: str) -> None:
        """Note that a request for passage has ended."""
        self._margins.note_asked((person,))

    def look(self, to: str, blocked_by: Collection[str], keeps_all: Callable[[], bool]) -> None:
        """Grant and revoke reduced margins; called in every tick of an approach.

        Args:
            to: The person or place that the robot approaches.
            blocked_by: People that the robot waits for.
            keeps_all: Returns whether some route, however long, keeps the full margin from everybody.
        """
        self._clock.take(self._known.now_s())
        self._listen({*blocked_by, *(person.name for person in self._margins.let_by)})
        self._margins.look(self._here.xy, to, blocked_by, keeps_all)

    @property
    def _here(self) -> Pose:
        return self._known.here

    def _listen(self, people: Collection[str]) -> None:
        """Record what these people said; errors of speech recognition count as silence."""
        self._said.clear()
        heard = getattr(self._base, "heard", None)
        if heard is None:
            return
        for name in people:
            with suppress(Exception):
                self._said += [
                    Said(self._known.own_time_s(words.t), name, _yes_or_other(words.text))
                    for words in heard(name)
                    if isfinite(words.t)
                ]


def _yes_or_other(text: str) -> str:
    """The words of consent in their own form, whatever the case; all others as they are."""
    return GO_AHEAD if text.strip().casefold() == GO_AHEAD.casefold() else text


@dataclass(slots=True)
class _LookTicks:
    """The time of the newest check, and since the previous one."""

    now_s: float = 0.0
    step_s: float = 0.0

    def take(self, now_s: float) -> None:
        self.step_s, self.now_s = max(0.0, now_s - self.now_s), now_s


class _PeopleOnMap:
    """Knowledge about people in the form that `Margins` needs."""

    def __init__(self, known: KnownWorld) -> None:
        self._known = known

    @property
    def present(self) -> tuple[Person, ...]:
        return tuple(one for one in self._known.people if one.name not in self._known.missing)

    @property
    def walkers(self) -> tuple[Walker, ...]:
        return self._known.walkers

    def person(self, name: str) -> Person:
        return self._known.person(name)

    def heading_rad(self, name: str) -> float | None:
        seen = self._known.seen(name)
        return seen.person.heading_rad if seen.has_heading else None

    def sees(self, name: str) -> bool:
        is_sure = self._known.is_blind is None and name not in self._known.uncertain
        return is_sure and self._known.seen(name).is_seen

    def walks(self, name: str) -> bool:
        return hypot(*self._known.seen(name).velocity) >= DRIFTS_M_S

    def keep(self, name: str, margin_m: float) -> None:
        self._known.keep(name, margin_m)
