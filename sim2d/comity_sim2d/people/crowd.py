"""All people who may move, in arrays: forces, collision-free velocities, steps.

Positions and velocities are complex numbers, x + iy. The robot is the last body; people take it into account,
but it is not moved here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from comity_sim2d.people.contact import within_shares
from comity_sim2d.people.headway import within_headway
from comity_sim2d.people.near import Near
from comity_sim2d.people.neighbours import Indices, NeighbourList
from comity_sim2d.people.outlines import Outlines, WallList
from comity_sim2d.people.pedestrian_behaviour import PedestrianBehaviour, Stroller
from comity_sim2d.people.social_force import FASTEST, Numbers, Vectors, between, from_wall, towards_goal
from comity_sim2d.people.stepping_out import SteppingOut
from comity_sim2d.people.yielding import Yielding
from comity_sim2d.scene.robot_reaction import RobotSeen

PEOPLE_M, PEOPLE_SKIN_M = 5.0, 1.0
"""Distance beyond which people are ignored [m], and skin of the neighbour list [m]. At that distance a tenth
of the force remains, head on at full speed."""
WALLS_M, WALLS_SKIN_M = 1.0, 1.0
"""The same for walls and furniture: farther away they push with less than a thousandth of the force at
contact."""
TIGHT_M = 0.3
"""Additional search distance beyond what two people who walk towards each other cover [m]."""
ROBOT_GAP_M = 0.05
"""Gap that people keep from the robot's body, which moves on between two decisions [m] (our choice)."""
AROUND_RAD = 0.2
"""Angle of the push by a robot that a person takes for an object [rad]: otherwise they would stop (our
choice)."""
TURN = 2 * np.pi
TURN_RAD_S = np.pi
"""Turning rate of people [rad/s], as in HuNavSim's `agent_manager.cpp`."""
STILL_M_S = 0.1
"""Below this speed people keep their facing [m/s]."""
SIDEWAYS_M_S = (0.3, 0.6)
"""A person pushed aside more slowly than the lower speed [m/s] steps sideways and faces where they want to
go, as in the headed social force model (Farina et al. 2017, PLoS ONE 12(1): e0169734). Above the higher speed
people face their direction of motion. The speeds are our choice."""
SLACK_M = 1e-6


@dataclass(frozen=True, slots=True)
class Bodies:
    """Discs with a heading; each array has shape (n,)."""

    at: Vectors
    heading: Numbers
    """Heading [rad]."""
    radius_m: Numbers


class Crowd:
    """The people of one world in motion.

    Args:
        bodies: All bodies at the start, the robot last.
        strollers: The people who may move.
        strolling: Their goals.
        outlines: The static obstacles.
        step_s: A tick [s]; a led person is moved once in each.
        decision_s: Period of decisions [s].
        side: 1 where people keep to the right, -1 to the left.
        seed: Seed of who goes first if two people block each other.
    """

    def __init__(
        self,
        bodies: Bodies,
        strollers: tuple[Stroller, ...],
        strolling: PedestrianBehaviour,
        outlines: Outlines,
        *,
        step_s: float,
        decision_s: float,
        side: float = 1.0,
        seed: int = 0,
    ) -> None:
        count = len(bodies.at)
        self.at, self.heading, self.radius_m = bodies.at, bodies.heading.copy(), bodies.radius_m
        """Headings may leave (-pi, pi] between two decisions [rad]."""
        self.velocity = np.zeros(count, dtype=complex)
        """Velocities of all people and the robot [m/s]."""
        self._led: dict[int, complex] = {}
        """Displacement of each led person in this tick [m]."""
        self._turn = np.zeros(count)
        self._strolling, self._side = strolling, side
        self._step_s, self._decision_s = step_s, decision_s
        self._moves = np.zeros(count, dtype=bool)
        self._moves[[stroller.index for stroller in strollers]] = True
        self._movers = np.flatnonzero(self._moves)
        impassive = [stroller.index for stroller in strollers if stroller.reacts == "impassive"]
        self._takes_for_thing = np.zeros(count, dtype=bool)
        self._takes_for_thing[impassive] = True
        self._has_impassive = bool(impassive)
        self._yielding = Yielding(count, seed, decision_s)
        self._neighbours = NeighbourList(PEOPLE_M, PEOPLE_SKIN_M, self._moves)
        self._width = np.empty(0)
        """Sum of the radii of every pair of neighbours [m]."""
        self.use_outlines(outlines)
        self.o_spaces: tuple[Vectors, Numbers] = (np.empty(0, dtype=complex), np.empty(0))
        """Centres and radii of the o-spaces of groups, which people walk around [m]."""

    def is_walking(self, index: int) -> bool:
        """Whether a person moves just now."""
        return bool(self._strolling.walks[index])

    def put(self, index: int, at: complex, heading_rad: float) -> None:
        """Move a body to a pose."""
        if index in self._led:
            self._led[index] += at - complex(self.at[index])
        self.at[index], self.heading[index] = at, heading_rad

    def hold(self, index: int) -> None:
        """Suspend a body's own behaviour: it stands where it is put, while others see how it is moved."""
        self._led.setdefault(index, 0j)
        self.velocity[index], self._turn[index] = 0.0, 0.0
        self._strolling.hold(index)

    def let_go(self, index: int, *, stays: bool) -> None:
        """Let a body stay there, or resume its own behaviour."""
        self._led.pop(index, None)
        self._strolling.let_go(index, self.at, stays=stays)

    def makes_way(self, index: int) -> bool:
        """Whether a person makes way for a robot that asks them to."""
        return self._strolling.makes_way(index)

    def make_way(self, index: int, out: SteppingOut) -> None:
        """Let a person step out of the robot's way."""
        self._strolling.make_way(index, out)

    def go_on(self, index: int) -> None:
        """Let a walker go on who stopped for the robot."""
        self._strolling.go_on(index)

    def use_outlines(self, outlines: Outlines) -> None:
        """Replace the static obstacles."""
        self._walls = WallList(outlines, self._movers, self.radius_m, WALLS_M, WALLS_SKIN_M)

    def advance(self) -> None:
        """Move all people at their velocities for one tick."""
        self.at[:-1] += self.velocity[:-1] * self._step_s
        self.heading += self._turn * self._step_s
        for index in self._led:
            self._led[index] = 0j

    def decide(self, robot: RobotSeen) -> None:
        """Update the velocities of all people."""
        self.at[-1], self.velocity[-1], self.heading[-1] = robot.at, robot.velocity, robot.heading_rad
        wanted = self._strolling.decide(self.at, self.heading, robot, self.o_spaces)
        walks = self._strolling.walks
        near = self._near()
        goes = within_headway(wanted, self._facing, near)
        goes = self._yielding.decide(goes, self.velocity, near)
        force = towards_goal(goes, self.velocity) + self._strolling.push + self._from_all(near, self._seen)
        velocity = self._limited((self.velocity + force * self._decision_s) * walks)
        velocity = self._without_contact(velocity, near)
        velocity[-1] = self.velocity[-1]
        self.velocity = velocity
        self._turn = self._turning(robot, wanted)

    def _near(self) -> Near:
        """The people and obstacles near each person now."""
        pairs, walls = self._neighbours, self._walls
        if pairs.update(self.at):
            self._width = self.radius_m[pairs.one] + self.radius_m[pairs.other]
        apart = self.at[pairs.other] - self.at[pairs.one]
        distance = np.abs(apart)
        away, wall_gap_m = walls.update(self.at)
        width = self._width
        return Near(
            pairs.one, pairs.other, apart / distance, distance - width, width, walls.who, away, wall_gap_m
        )

    @property
    def _seen(self) -> Vectors:
        """The velocities that others see; led people as they are moved."""
        if not self._led:
            return self.velocity
        seen = self.velocity.copy()
        seen[list(self._led)] = np.array(list(self._led.values())) / self._step_s
        return seen

    @property
    def _facing(self) -> Vectors:
        """Unit vectors of the facing of people who walk or are led; 0 for those who stand."""
        on_their_way = self._strolling.walks | (self._seen != 0.0) if self._led else self._strolling.walks
        return np.asarray(np.exp(1j * self.heading) * on_their_way)

    def _from_all(self, near: Near, seen: Vectors) -> Vectors:
        """Accelerations due to other people, obstacles and o-spaces [m/s^2]."""
        closing = seen[near.one] - seen[near.other]
        push = between(near.towards, near.gap_m, closing, self._side)
        if self._has_impassive:
            things = self._takes_for_thing[near.one] & (near.other == len(self.at) - 1)
            around = -near.towards[things] * np.exp(-1j * self._side * AROUND_RAD)
            push[things] = from_wall(around, near.gap_m[things])
        who = np.concatenate([near.one, near.other, near.who])
        pushes = np.concatenate([push, -push, from_wall(near.away, near.wall_gap_m)])
        total = _summed(who, pushes, len(self.at))
        for middle, radius in zip(*self.o_spaces, strict=True):
            apart = middle - self.at
            distance = np.abs(apart)
            gap_m = distance - radius - self.radius_m
            total += between(apart / distance, gap_m, self.velocity, self._side)
        return total

    def _limited(self, velocity: Vectors) -> Vectors:
        speed = np.abs(velocity)
        most = FASTEST * self._strolling.speed_m_s
        return np.asarray(velocity * np.minimum(1.0, most / np.maximum(speed, 1e-9)))

    def _without_contact(self, velocity: Vectors, near: Near) -> Vectors:
        fastest_m = float(np.abs(velocity).max()) * self._decision_s
        robot_m = abs(self.velocity[-1]) * self._decision_s + ROBOT_GAP_M
        nearest_m = near.gap_m.min(initial=np.inf), near.wall_gap_m.min(initial=np.inf)
        if nearest_m[0] > 2 * fastest_m + robot_m and nearest_m[1] > fastest_m + SLACK_M:
            return velocity
        most_m = 2 * fastest_m + TIGHT_M
        tight = (near.gap_m < most_m).nonzero()[0]
        tight_wall = (near.wall_gap_m < most_m).nonzero()[0]
        one, other, towards = near.one[tight], near.other[tight], near.towards[tight]
        share = self._shares(one, other, towards, near.gap_m[tight])
        wall_share = np.maximum(near.wall_gap_m[tight_wall] - SLACK_M, 0.0)
        return within_shares(
            velocity,
            np.concatenate([one, other, near.who[tight_wall]]),
            np.concatenate([towards, -towards, -near.away[tight_wall]]),
            np.concatenate([share, share, wall_share]) * (1.0 / self._decision_s),
        )

    def _shares(self, one: Indices, other: Indices, towards: Vectors, gap_m: Numbers) -> Numbers:
        """Distance by which each of a pair may approach the other [m]."""
        walks, robot = self._strolling.walks, other == len(self.at) - 1
        if self._led:
            walks = walks | (self._seen != 0.0)
        share = np.where(walks[one] & walks[other], 0.5, 1.0) * (gap_m - SLACK_M)
        if robot.any():
            coming = np.maximum(-(self.velocity[-1] * towards.conj()).real, 0.0) * self._decision_s
            share = np.where(robot, gap_m - ROBOT_GAP_M - coming, share)
        return np.asarray(np.maximum(share, 0.0))

    def _turning(self, robot: RobotSeen, wanted: Vectors) -> Numbers:
        """Turning rates towards the direction of motion, or towards the robot that they look at [rad/s]."""
        looks, speed = self._strolling.looks, np.abs(self.velocity)
        ahead: Vectors = _ahead(self.velocity, speed, wanted)
        turns = (speed >= STILL_M_S) & (ahead != 0.0)
        if self._strolling.has_watchers:
            ahead = np.asarray(np.where(looks, robot.at - self.at, ahead))
            turns |= looks
        off: Numbers = np.arctan2(ahead.imag, ahead.real) - self.heading
        off -= TURN * np.rint(off * (1.0 / TURN))
        most = TURN_RAD_S * self._decision_s
        turn = np.minimum(np.maximum(off, -most), most) * (turns * (1.0 / self._decision_s))
        turn[-1] = 0.0
        return np.asarray(turn, dtype=float)


def _ahead(velocity: Vectors, speed: Numbers, wanted: Vectors) -> Vectors:
    """Direction that people face for a current and a target velocity, as a vector; 0 to keep the facing."""
    low, high = SIDEWAYS_M_S
    along = np.minimum(np.maximum((speed - low) * (1.0 / (high - low)), 0.0), 1.0)
    pace = np.maximum(np.abs(wanted), 1e-9)
    return np.asarray(velocity * (along * pace) + wanted * ((1.0 - along) * speed))


def _summed(who: Indices, vectors: Vectors, count: int) -> Vectors:
    total = np.empty(count, dtype=complex)
    total.real = np.bincount(who, vectors.real, count)
    total.imag = np.bincount(who, vectors.imag, count)
    return total
