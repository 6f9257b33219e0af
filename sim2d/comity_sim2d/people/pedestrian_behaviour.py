"""Current goals of pedestrians: continue their walk, rest in a pause, or react to the robot."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from comity_sim2d.people.itinerary import Itinerary, Leg
from comity_sim2d.people.social_force import RELAXATION_S, Numbers, Vectors
from comity_sim2d.people.stepping_out import PAST_M, STAYS, SteppingOut
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.robot_reaction import (
    LASTS_S,
    SEEN_M,
    Intent,
    RobotReaction,
    RobotSeen,
    comes_up,
    intent,
    is_seen,
    off_rad,
)

BEND_M, STOP_M = 0.4, 0.1
"""Distance from a bend at which the next leg begins, and from a pause at which it is reached [m]."""
WATCH_S = 1.0
NEARER_M = 0.05
"""A person who has advanced by less than this since the last check is blocked [m]."""
PATIENCE = 3
"""Number of times a person is blocked before they look for another path, or accept being near."""
NEAR_M = 1.0
GOES_ON_S = 10.0
"""Time for which a walker does not stop for a robot that has asked them to let it pass [s] (our choice)."""
STAYS_S = 2.0
"""Time for which a walker who stopped for the robot stays after it has turned away or left [s] (our choice):
a differential drive turns away for a moment to reach its place before them."""
FACING_RAD, LOOK_AGAIN_RAD = 0.05, 1.0
"""Tolerance of a turn to the robot, and the bearing at which people turn again [rad] (our choice)."""


@dataclass(frozen=True, slots=True)
class Stroller:
    """A person who may move, with their index among the bodies."""

    index: int
    speed_m_s: float
    itinerary: Itinerary
    reacts: RobotReaction = "regular"
    stops: bool = False
    """Whether they stop for a robot that approaches them."""
    is_home: bool = False
    """Whether they stand at the end of their walk from the start, and move only because of the robot."""


class PedestrianBehaviour:
    """The goals of all people who may move; arrays are over all bodies.

    Args:
        strollers: People who may move.
        at: Initial positions of all bodies [m], shape (n,).
        plan: The floor plan, which may hide the robot from people.
        step_s: Period of decisions [s].
    """

    def __init__(self, strollers: tuple[Stroller, ...], at: Vectors, plan: FloorPlan, step_s: float) -> None:
        count = len(at)
        self._diverted: set[int] = set()
        self._faced: set[int] = set()
        self._led: set[int] = set()
        self._stepping_out: dict[int, SteppingOut] = {}
        self._strollers = {stroller.index: stroller for stroller in strollers}
        self._watchers = [s for s in strollers if s.stops or s.reacts in SEEN_M]
        self.has_watchers = bool(self._watchers)
        """Whether any person may look at the robot."""
        self._plan = plan
        self._step_s, self._decisions = step_s, 0
        self._legs: dict[int, Leg] = {}
        self._left_s: dict[int, float] = {s.index: LASTS_S for s in self._watchers}
        self._goes_on_s: dict[int, float] = {}
        """How long each walker who was asked will not stop for the robot [s]."""
        self._stays_s: dict[int, float] = {}
        """How long each walker who stopped for the robot stays if it has turned away [s]."""
        self._goal, self._speed = at.copy(), np.zeros(count)
        self._pauses, self._nears = np.zeros(count, dtype=bool), np.full(count, BEND_M)
        self._rest_s, self._someone_rests = np.zeros(count), False
        self._best_m, self._held_up = np.full(count, np.inf), np.zeros(count, dtype=np.intp)
        self._cut = np.zeros(count, dtype=bool)
        self.walks = np.zeros(count, dtype=bool)
        """Whether each body currently moves."""
        self.push = np.zeros(count, dtype=complex)
        """Additional acceleration [m/s^2]."""
        self.looks = np.zeros(count, dtype=bool)
        """Whether each body looks at the robot."""
        for stroller in strollers:
            if not stroller.is_home:
                self._set_out(stroller, at)

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the floor plan, and search for new paths."""
        self._plan = plan
        for stroller in self._strollers.values():
            stroller.itinerary.forget()

    def hold(self, index: int) -> None:
        """Suspend a person's own goals while something else leads them."""
        if index in self._strollers:
            self._led.add(index)
            self._diverted.discard(index)
            self._look_ahead(index)
            self.walks[index], self._rest_s[index], self.push[index] = False, 0.0, 0.0

    def let_go(self, index: int, at: Vectors, *, stays: bool) -> None:
        """Let a person who was led stay where they are, or resume their walk.

        Args:
            index: Index of the person.
            at: Positions of all bodies [m], shape (n,).
            stays: Whether they stay; a person who only stood before reacting to the robot returns there.
        """
        if index not in self._led:
            return
        self._led.discard(index)
        stroller = self._strollers[index]
        if stays:
            stroller.itinerary.stay((float(at[index].real), float(at[index].imag)))
            self._legs.pop(index, None)
        elif stroller.is_home or index in self._legs:
            self._set_out(stroller, at)

    def makes_way(self, index: int) -> bool:
        """Whether a person makes way for a robot that asks them to."""
        return index not in self._led and self._strollers[index].reacts not in STAYS

    def make_way(self, index: int, out: SteppingOut) -> None:
        """Let a person step out of the robot's way; having spoken with it, they are then used to it."""
        self._stepping_out[index] = out
        if index in self._left_s:
            self._left_s[index] = 0.0

    def go_on(self, index: int) -> None:
        """Let a walker who stops for the robot go on: it asks to pass, so it has not come for them."""
        self._goes_on_s[index], self._stays_s[index] = GOES_ON_S, 0.0

    @property
    def speed_m_s(self) -> Numbers:
        """Target speeds [m/s], shape (n,)."""
        return self._speed

    def decide(
        self, at: Vectors, heading: Numbers, robot: RobotSeen, kept_open: tuple[Vectors, Numbers]
    ) -> Vectors:
        """The current target velocities [m/s]; 0 for people who do not walk.

        Args:
            at: Positions of all bodies [m].
            heading: Their headings [rad].
            robot: As people see it.
            kept_open: Centres and radii of the o-spaces of groups [m].
        """
        self._decisions += 1
        self._end_pauses(at)
        apart = self._goal - at
        distance = np.abs(apart)
        arrived = (self.walks & (distance <= self._nears)).nonzero()[0].tolist()
        if arrived:
            for index in arrived:
                self._arrive(index)
            apart = self._goal - at
            distance = np.abs(apart)
        if self._decisions % round(WATCH_S / self._step_s) == 0:
            self._help_the_held_up(at, distance, robot)
            self._lead_around(at, kept_open)
        busy = self._step_out(at, robot) if self._stepping_out else []
        for stroller in self._watchers:
            if stroller.index in self._led or stroller.index in self._stepping_out:
                continue
            if self._mind_the_robot(stroller, at, heading, robot):
                busy.append(stroller.index)
        for i in busy:
            apart[i] = self._goal[i] - at[i]
            distance[i] = abs(apart[i])
        speed = np.where(self._pauses, np.minimum(self._speed, distance * (1 / RELAXATION_S)), self._speed)
        return np.asarray(apart * (speed * self.walks / np.maximum(distance, 1e-9)))

    def _set_out(self, stroller: Stroller, at: Vectors, past: RobotSeen | None = None) -> None:
        place = complex(at[stroller.index])
        disc = None if past is None else (past.at.real, past.at.imag, past.radius_m + PAST_M)
        self._take(stroller, stroller.itinerary.set_out((place.real, place.imag), disc))

    def _take(self, stroller: Stroller, leg: Leg) -> None:
        i = stroller.index
        self._legs[i], self._goal[i], self._speed[i] = leg, leg.goal, stroller.speed_m_s
        self._pauses[i] = leg.pause_s > 0.0
        self._nears[i] = STOP_M if leg.pause_s > 0.0 else BEND_M
        self._best_m[i], self._held_up[i], self.walks[i] = np.inf, 0, True

    def _arrive(self, index: int) -> None:
        stroller, done = self._strollers[index], self._legs[index]
        leg = stroller.itinerary.arrive()
        if leg is None:
            self._stand(index)
        else:
            self._take(stroller, leg)
        if leg is not None and done.pause_s > 0.0:
            self._rest_s[index], self._someone_rests = done.pause_s, True
            self.walks[index] = False

    def _stand(self, index: int) -> None:
        self.walks[index], self._rest_s[index] = False, 0.0
        del self._legs[index]

    def _end_pauses(self, at: Vectors) -> None:
        if not self._someone_rests:
            return
        resting = self._rest_s > 0.0
        self._someone_rests = bool(resting.any())
        self._rest_s[resting] -= self._step_s
        over = resting & (self._rest_s <= 1e-9)
        self._rest_s[over] = 0.0
        self.walks[over] = True

    def _help_the_held_up(self, at: Vectors, distance: Numbers, robot: RobotSeen) -> None:
        nearer = distance < self._best_m - NEARER_M
        self._held_up = np.where(nearer | ~self.walks, 0, self._held_up + 1)
        self._best_m = np.minimum(self._best_m, distance)
        held_up = np.flatnonzero(self._held_up >= PATIENCE).tolist()
        for index in (i for i in held_up if i not in self._diverted):
            if distance[index] <= NEAR_M and self._legs[index].is_stop:
                self._arrive(index)
            else:
                close = abs(at[index] - robot.at) - robot.radius_m <= NEAR_M
                self._set_out(self._strollers[index], at, robot if close else None)

    def _lead_around(self, at: Vectors, kept_open: tuple[Vectors, Numbers]) -> None:
        """Replan, once, the path of a person pushed to where the old one crosses an o-space."""
        cut = np.zeros(len(at), dtype=bool)
        ahead = self._goal - at
        squared = np.maximum(np.abs(ahead) ** 2, 1e-9)
        for middle, radius_m in zip(*kept_open, strict=True):
            share = np.clip(((middle - at) * ahead.conj()).real / squared, 0.0, 1.0)
            outside = np.minimum(np.abs(at - middle), np.abs(self._goal - middle)) >= radius_m
            cut |= outside & (np.abs(at + share * ahead - middle) < radius_m)
        anew = np.flatnonzero(cut & self.walks & ~self._cut).tolist()
        self._cut = cut
        for index in (i for i in anew if i not in self._diverted):
            self._set_out(self._strollers[index], at)

    def _step_out(self, at: Vectors, robot: RobotSeen) -> list[int]:
        """Let people who were asked make way; returns who does."""
        for i, out in list(self._stepping_out.items()):
            if out.is_over(robot, self._step_s):
                del self._stepping_out[i]
                self._diverted.discard(i)
                self._go_on(self._strollers[i], at)
                continue
            self._diverted.add(i)
            self._look_ahead(i)
            self._goal[i], self._speed[i] = out.goal(complex(at[i])), self._strollers[i].speed_m_s
            self._pauses[i], self._nears[i], self.walks[i] = len(out.bends) == 1, -1.0, True
        return list(self._stepping_out)

    def _mind_the_robot(self, stroller: Stroller, at: Vectors, heading: Numbers, robot: RobotSeen) -> bool:
        """Let a person react to the robot; returns whether they do."""
        i = stroller.index
        wish = self._intent(stroller, complex(at[i]), float(heading[i]), robot)
        self.push[i] = wish.push if wish else 0.0
        if wish is None:
            self._look_ahead(i)
            if i in self._diverted:
                self._diverted.remove(i)
                self._go_on(stroller, at)
            return False
        if wish.keeps_walking:
            self._flee(i, at)
            return True
        self._diverted.add(i)
        if wish.goal is None:
            self._look(i, off_rad(robot, complex(at[i]), float(heading[i])))
        else:
            self._look_ahead(i)
        self._goal[i] = at[i] if wish.goal is None else wish.goal
        self._speed[i], self.walks[i] = wish.speed_m_s, wish.goal is not None
        self._pauses[i], self._nears[i] = True, -1.0
        return True

    def _look(self, index: int, off_rad: float) -> None:
        """Turn to the robot, and again only once it is well off to one side."""
        if index not in self._faced or abs(off_rad) > LOOK_AGAIN_RAD:
            self.looks[index] = True
        elif abs(off_rad) < FACING_RAD:
            self.looks[index] = False
        self._faced.add(index)

    def _look_ahead(self, index: int) -> None:
        """Face the direction of motion."""
        self.looks[index] = False
        self._faced.discard(index)

    def _flee(self, index: int, at: Vectors) -> None:
        """Let a standing person be pushed by the robot, without another goal."""
        if index not in self._legs:
            self._goal[index], self._speed[index] = at[index], self._strollers[index].speed_m_s
            self._pauses[index], self._nears[index] = True, -1.0
            self.walks[index] = True
            self._diverted.add(index)

    def _go_on(self, stroller: Stroller, at: Vectors) -> None:
        """Return to the walk, or to the original place."""
        if self._rest_s[stroller.index] > 0.0:
            self.walks[stroller.index] = False
        else:
            self._set_out(stroller, at)

    def _intent(self, stroller: Stroller, at: complex, heading_rad: float, robot: RobotSeen) -> Intent | None:
        goes_on_s = self._goes_on_s.get(stroller.index, 0.0)
        self._goes_on_s[stroller.index] = max(0.0, goes_on_s - self._step_s)
        if stroller.stops and not goes_on_s:
            comes = comes_up(robot, at) and self._in_sight(at, robot)
            stays_s = STAYS_S if comes else max(0.0, self._stays_s.get(stroller.index, 0.0) - self._step_s)
            self._stays_s[stroller.index] = stays_s
            if stays_s:
                return Intent()
        reach = SEEN_M.get(stroller.reacts)
        if reach is None or self._left_s[stroller.index] <= 0.0:
            return None
        if not is_seen(robot, at, heading_rad, reach) or not self._in_sight(at, robot):
            return None
        self._left_s[stroller.index] -= self._step_s
        return intent(stroller.reacts, robot, at, 0.0)

    def _in_sight(self, at: complex, robot: RobotSeen) -> bool:
        ends = ((at.real, at.imag), (robot.at.real, robot.at.imag))
        return self._plan.wall_between(*ends) is None
