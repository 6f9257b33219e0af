"""The margin that the robot keeps from each person: full, or reduced from people who let it pass.

Permission holds for one person, at their current place, and for one passage. It begins while the robot waits
for the person, and ends when the robot has passed or the person moves, is not seen, or turns away before it
comes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from typing import Protocol

from comity_fis.proxemics import FACES_DEG, PERSON_MARGIN_M
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.people.said import GO_AHEAD, Said
from comity_sim2d.pose import XY, direction_to, wrap_angle
from comity_sim2d.robot.reduced_margin import PassageFacts, reasons_against
from comity_sim2d.robot.standing import STANDS_S
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody

WAITED_S = 2.0
"""Minimum time that the robot has stood before a person [s] (our choice: the executor asks after the same
time)."""
MOVED_M = 0.1
"""Distance at which a person counts as moved, sensor noise apart [m] (our choice)."""
PASSED_M = 1.5
"""Gap at which the robot has passed a person [m]: the speed limit near people ends there, too."""


class KnownPeople(Protocol):
    """Believed positions of people, and the margins kept from them."""

    @property
    def present(self) -> tuple[Person, ...]:
        """People whose positions are known."""
        ...

    @property
    def walkers(self) -> tuple[Walker, ...]:
        """Those of them who walk."""
        ...

    def person(self, name: str) -> Person:
        """One person at their believed pose."""
        ...

    def heading_rad(self, name: str) -> float | None:
        """A person's heading [rad]; None if unknown."""
        ...

    def sees(self, name: str) -> bool:
        """Whether it currently sees a person and recognises them."""
        ...

    def walks(self, name: str) -> bool:
        """Whether a person is believed to be walking."""
        ...

    def keep(self, name: str, margin_m: float) -> None:
        """Change the margin to a person [m]."""
        ...


class Ticks(Protocol):
    """Simulated time in ticks."""

    @property
    def now_s(self) -> float:
        """Time since the start [s]."""
        ...

    @property
    def step_s(self) -> float:
        """Length of a tick [s]."""
        ...


@dataclass(frozen=True, slots=True)
class MarginDecision:
    """Whether a person who answered a request for passage is passed at the reduced margin."""

    t: float
    """Time of the decision [s]."""
    person: str
    clearance_m: float
    reasons: tuple[str, ...]
    """Reasons against the reduced margin; empty if permission was given."""
    end_s: float | None = None
    """End of the permission [s]; None if it has not ended, or was never given."""


@dataclass(slots=True)
class _Leave:
    """Permission to pass one person."""

    decision: int
    """Index of the decision."""
    person: Person
    """The person as they stood then."""
    to: str
    asked_s: float
    """End of the request that was answered [s]."""
    came: bool = False
    """Whether the robot has been nearer than the full margin."""


@dataclass(slots=True)
class _Waiting:
    """A person for whom the robot waits."""

    place: XY
    """Their position [m]."""
    since_s: float
    """Since when they have stood there [s]."""
    waited_s: float = 0.0
    asked_s: float | None = None
    """End of the last request for passage [s]."""
    asked_xy: XY = (0.0, 0.0)
    """Their position at that time [m]."""
    told: tuple[str, ...] = ()
    """The reasons of the last decision."""


class Margins:
    """Decides on the margins to people in the path of one robot, and withdraws permissions.

    Args:
        spec: The robot's body, with the margin set by the scenario.
        senses: Believed positions of people.
        clock: Simulated time.
        said: What people say.
        least_m: Smallest margin that the robot can keep [m].
    """

    def __init__(
        self, spec: RobotBody, senses: KnownPeople, clock: Ticks, said: Sequence[Said], least_m: float
    ) -> None:
        self._spec, self._senses, self._clock, self._said = spec, senses, clock, said
        self._least_m = least_m
        self._noise_m = 3.0 * spec.sensor.sigma_m
        self._to = ""
        self._waiting: dict[str, _Waiting] = {}
        self._leave: dict[str, _Leave] = {}
        self.decisions: list[MarginDecision] = []
        """All decisions so far, in order."""

    @property
    def let_by(self) -> tuple[Person, ...]:
        """People who currently let the robot pass, as they stood when permission was given."""
        return tuple(leave.person for leave in self._leave.values())

    def note_asked(self, names: Collection[str]) -> None:
        """Note that requests for passage have ended."""
        for name in names:
            if name in self._waiting:
                waiting = self._waiting[name]
                waiting.asked_s = self._clock.now_s
                waiting.asked_xy = self._senses.person(name).xy

    def look(self, robot: XY, to: str, blocked_by: Collection[str], keeps_all: Callable[[], bool]) -> None:
        """Give and withdraw permissions; call it in every tick of an approach.

        Args:
            robot: Position of the robot's centre [m].
            to: The person or place that it approaches.
            blocked_by: People for whom it waits.
            keeps_all: Returns whether a route of any length keeps the full margin from all people.
        """
        if self._spec.margin_m >= PERSON_MARGIN_M:
            return
        if to != self._to:
            self._to = to
            self._waiting.clear()
        for name, leave in list(self._leave.items()):
            if not self._goes_on(leave, robot):
                self._take_back(name, leave)
        known = {person.name for person in self._senses.present}
        for name in blocked_by:
            if name in known and name not in self._leave and name != to:
                self._wait_before(name, robot, keeps_all)

    def _wait_before(self, name: str, robot: XY, keeps_all: Callable[[], bool]) -> None:
        person, now_s = self._senses.person(name), self._clock.now_s
        waiting = self._waiting.setdefault(name, _Waiting(person.xy, now_s))
        waiting.waited_s += self._clock.step_s
        if math.dist(person.xy, waiting.place) > MOVED_M / 2.0 + self._noise_m:
            waiting.place, waiting.since_s = person.xy, now_s
        if waiting.asked_s is None:
            return
        facts = self._facts(person, robot, waiting)
        if facts.walks or not (facts.said_yes or facts.has_stepped_aside):
            return  # no answer yet
        reasons = reasons_against(facts)
        if not reasons and keeps_all():
            reasons = reasons_against(replace(facts, has_other_route=True))
        self._decide(person, waiting, reasons)

    def _facts(self, person: Person, robot: XY, waiting: _Waiting) -> PassageFacts:
        now_s = self._clock.now_s
        moved_m = math.dist(person.xy, waiting.asked_xy)
        heading_rad = self._senses.heading_rad(person.name)
        towards_rad = direction_to(person.xy, robot)
        words = self._words_since(waiting.asked_s or 0.0, person.name)
        return PassageFacts(
            asked_m=self._spec.margin_m,
            least_m=self._least_m,
            declared=person.margin_facts,
            is_known=self._senses.sees(person.name),
            radius_m=person.radius_m,
            posture=person.posture,
            walks=self._senses.walks(person.name) or now_s - waiting.since_s < STANDS_S - 1e-9,
            bearing_deg=None if heading_rad is None else math.degrees(wrap_angle(towards_rad - heading_rad)),
            has_stepped_aside=moved_m > MOVED_M + self._noise_m,
            said_yes=words == GO_AHEAD,
            said_otherwise=words not in (None, GO_AHEAD),
            has_waited=waiting.waited_s >= WAITED_S - 1e-9,
            has_other_route=False,
        )

    def _words_since(self, asked_s: float, name: str) -> str | None:
        """The last words of a person since they were asked; None if they were silent.

        Of several at one time others than the yes count.
        """
        heard_s = self._clock.now_s - self._spec.sensor.delay_s
        said = [one for one in self._said if one.person == name and asked_s <= one.t <= heard_s]
        return max(said, key=lambda one: (one.t, one.text != GO_AHEAD)).text if said else None

    def _decide(self, person: Person, waiting: _Waiting, reasons: tuple[str, ...]) -> None:
        if reasons and reasons == waiting.told:
            return
        waiting.told = reasons
        clearance_m = PERSON_MARGIN_M if reasons else self._spec.margin_m
        self.decisions.append(MarginDecision(self._clock.now_s, person.name, clearance_m, reasons))
        if not reasons:
            self._leave[person.name] = _Leave(
                len(self.decisions) - 1, person, self._to, waiting.asked_s or 0.0
            )
            self._senses.keep(person.name, clearance_m)

    def _goes_on(self, leave: _Leave, robot: XY) -> bool:
        """Whether a permission holds: the person stands there, said nothing else, and was not passed yet."""
        then = leave.person
        if leave.to != self._to or not self._senses.sees(then.name):
            return False
        if self._words_since(leave.asked_s, then.name) not in (None, GO_AHEAD):
            return False
        now = self._senses.person(then.name)
        gap_m = now.gap_m(robot, self._spec.radius_m)
        leave.came = leave.came or gap_m < PERSON_MARGIN_M
        if leave.came and gap_m > PASSED_M:
            return False
        walks = any(walker.person.name == then.name for walker in self._senses.walkers)
        if walks or math.dist(now.xy, then.xy) > MOVED_M + self._noise_m:
            return False
        heading_rad = self._senses.heading_rad(then.name)
        if leave.came or heading_rad is None:
            return leave.came
        return math.degrees(abs(wrap_angle(heading_rad - then.heading_rad))) <= FACES_DEG

    def _take_back(self, name: str, leave: _Leave) -> None:
        del self._leave[name]
        self._waiting.pop(name, None)
        self._senses.keep(name, PERSON_MARGIN_M)
        decision = self.decisions[leave.decision]
        self.decisions[leave.decision] = replace(decision, end_s=self._clock.now_s)
