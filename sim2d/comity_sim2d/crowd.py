"""Everybody who may move, in arrays: forces, velocities that touch nobody, steps.

Places and velocities are complex numbers, x + iy. The robot is the last body; people mind it, and it is not
moved here.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from comity_sim2d.contact import within_shares
from comity_sim2d.neighbours import Indices, NeighbourList
from comity_sim2d.outlines import Outlines, WallList
from comity_sim2d.robot_reaction import RobotSeen
from comity_sim2d.social_force import FASTEST, Numbers, Vectors, between, from_wall, towards_goal
from comity_sim2d.strolling import Stroller, Strolling

PEOPLE_M, PEOPLE_SKIN_M = 5.0, 1.0
"""Who is farther away is not minded: a tenth of the strength is left there, head on at full speed."""
WALLS_M, WALLS_SKIN_M = 1.0, 1.0
"""Things farther away push with less than a thousandth of what they do at contact."""
TIGHT_M = 0.3
"""What two people who go towards one another do not cover is looked at up to so much farther."""
ROBOT_GAP_M = 0.05
"""People keep this far from the robot's body, which moves on between two decisions (our choice)."""
AROUND_RAD = 0.2
"""A robot that is a thing to somebody pushes so much aside, or they would stand before it (our choice)."""
TURN_RAD_S = np.pi
"""How fast people turn, as in HuNavSim's `agent_manager.cpp`."""
STILL_M_S = 0.1
"""Who goes slower keeps facing where they face."""
SLACK_M = 1e-6


@dataclass(frozen=True, slots=True)
class Bodies:
    """Discs with a face, each array of shape (n,)."""

    at: Vectors
    heading: Numbers
    """[rad]"""
    radius_m: Numbers


class Crowd:
    """The people of one world in motion.

    Args:
        bodies: Everybody at the start, the robot last.
        strollers: Who of them may move.
        strolling: Where they go.
        outlines: What stands still.
        decision_s: From one decision to the next.
        side: 1 where people keep to the right, -1 to the left.
    """

    def __init__(
        self,
        bodies: Bodies,
        strollers: tuple[Stroller, ...],
        strolling: Strolling,
        outlines: Outlines,
        *,
        decision_s: float,
        side: float = 1.0,
    ) -> None:
        count = len(bodies.at)
        self.at, self.heading, self.radius_m = bodies.at, bodies.heading, bodies.radius_m
        self.velocity = np.zeros(count, dtype=complex)
        self._turn = np.zeros(count)
        self._strolling, self._decision_s, self._side = strolling, decision_s, side
        self._moves = np.zeros(count, dtype=bool)
        self._moves[[stroller.index for stroller in strollers]] = True
        self._movers = np.flatnonzero(self._moves)
        self._takes_for_thing = np.zeros(count, dtype=bool)
        self._takes_for_thing[[s.index for s in strollers if s.reacts == "impassive"]] = True
        self._neighbours = NeighbourList(PEOPLE_M, PEOPLE_SKIN_M, self._moves)
        self._walls = WallList(outlines, WALLS_M, WALLS_SKIN_M)
        self.o_spaces: tuple[Vectors, Numbers] = (np.empty(0, dtype=complex), np.empty(0))
        """Middles and radii of what groups keep open; people walk around it."""

    @property
    def movers(self) -> Indices:
        """Who may move."""
        return self._movers

    def is_walking(self, index: int) -> bool:
        """Whether somebody moves just now."""
        return bool(self._strolling.walks[index])

    def put(self, index: int, at: complex, heading_rad: float) -> None:
        """Put a body somewhere."""
        self.at[index], self.heading[index] = at, heading_rad

    def use_outlines(self, outlines: Outlines) -> None:
        """Meet other things from now on."""
        self._walls = WallList(outlines, WALLS_M, WALLS_SKIN_M)

    def advance(self, step_s: float) -> None:
        """Let everybody go on as they do."""
        self.at[:-1] += self.velocity[:-1] * step_s
        heading = self.heading + self._turn * step_s
        self.heading = np.pi - (np.pi - heading) % (2 * np.pi)

    def decide(self, robot: RobotSeen) -> None:
        """Let everybody choose anew how to go on."""
        self.at[-1], self.velocity[-1], self.heading[-1] = robot.at, robot.velocity, robot.heading_rad
        wanted = self._strolling.decide(self.at, self.heading, robot)
        walks = self._strolling.walks
        self._neighbours.update(self.at)
        to_wall, wall_gap = self._near_walls()
        apart, distance, width = self._near_people()
        force = towards_goal(wanted, self.velocity) + self._strolling.push
        force += self._from_people(apart, distance, width) + self._from_things(to_wall, wall_gap)
        velocity = self._limited((self.velocity + force * self._decision_s) * walks)
        velocity = self._without_contact(velocity, apart, distance - width, to_wall, wall_gap)
        velocity[-1] = self.velocity[-1]
        self.velocity = velocity
        self._turn = self._turning(robot)

    def _near_people(self) -> tuple[Vectors, Numbers, Numbers]:
        one, other = self._neighbours.one, self._neighbours.other
        apart = self.at[other] - self.at[one]
        return apart, np.abs(apart), self.radius_m[one] + self.radius_m[other]

    def _near_walls(self) -> tuple[Vectors, Numbers]:
        away, distance = self._walls.update(self.at[self._movers])
        return -away, distance - self.radius_m[self._movers][self._walls.who]

    def _from_people(self, apart: Vectors, distance: Numbers, width: Numbers) -> Vectors:
        pairs = self._neighbours
        closing = self.velocity[pairs.one] - self.velocity[pairs.other]
        push = between(apart, closing, width, self._side)
        if self._takes_for_thing.any():
            things = self._takes_for_thing[pairs.one] & (pairs.other == len(self.at) - 1)
            away = -apart[things] / distance[things] * np.exp(-1j * self._side * AROUND_RAD)
            push[things] = from_wall(away, distance[things] - width[things])
        return _summed(pairs.both, np.concatenate([push, -push]), len(self.at))

    def _from_things(self, to_wall: Vectors, gap_m: Numbers) -> Vectors:
        who = self._movers[self._walls.who]
        total = _summed(who, from_wall(-to_wall, gap_m), len(self.at))
        middles, radii = self.o_spaces
        for middle, radius in zip(middles, radii, strict=True):
            total += between(middle - self.at, self.velocity, radius + self.radius_m, self._side)
        return total

    def _limited(self, velocity: Vectors) -> Vectors:
        speed = np.abs(velocity)
        most = FASTEST * self._strolling.speed_m_s
        return np.asarray(velocity * np.minimum(1.0, most / np.maximum(speed, 1e-9)))

    def _without_contact(
        self, velocity: Vectors, apart: Vectors, gap_m: Numbers, to_wall: Vectors, wall_gap_m: Numbers
    ) -> Vectors:
        most_m = 2 * float(np.abs(velocity).max()) * self._decision_s + TIGHT_M
        tight, tight_wall = (gap_m < most_m).nonzero()[0], (wall_gap_m < most_m).nonzero()[0]
        if not len(tight) and not len(tight_wall):
            return velocity
        one, other = self._neighbours.one[tight], self._neighbours.other[tight]
        towards = apart[tight] / np.abs(apart[tight])
        share = self._shares(one, other, towards, gap_m[tight])
        who = np.concatenate([one, other, self._movers[self._walls.who[tight_wall]]])
        shares = np.concatenate([share, share, np.maximum(wall_gap_m[tight_wall] - SLACK_M, 0.0)])
        return within_shares(
            velocity,
            who,
            np.concatenate([towards, -towards, to_wall[tight_wall]]),
            shares * (1.0 / self._decision_s),
        )

    def _shares(self, one: Indices, other: Indices, towards: Vectors, gap_m: Numbers) -> Numbers:
        """How much nearer each of a pair may come [m]."""
        walks, robot = self._strolling.walks, other == len(self.at) - 1
        share = np.where(walks[one] & walks[other], 0.5, 1.0) * (gap_m - SLACK_M)
        if robot.any():
            coming = np.maximum(-(self.velocity[-1] * towards.conj()).real, 0.0) * self._decision_s
            share = np.where(robot, gap_m - ROBOT_GAP_M - coming, share)
        return np.asarray(np.maximum(share, 0.0))

    def _turning(self, robot: RobotSeen) -> Numbers:
        """How fast everybody turns, to where they go or to the robot that they look at [rad/s]."""
        looks = self._strolling.looks
        ahead = self.velocity if not looks.any() else np.where(looks, robot.at - self.at, self.velocity)
        off: Vectors = np.asarray(ahead * np.exp(-1j * self.heading))
        turn = np.arctan2(off.imag, off.real) * (1.0 / self._decision_s)
        turn = np.minimum(np.maximum(turn, -TURN_RAD_S), TURN_RAD_S)
        turn[(np.abs(self.velocity) < STILL_M_S) & ~looks] = 0.0
        turn[-1] = 0.0
        return np.asarray(turn)


def _summed(who: Indices, vectors: Vectors, count: int) -> Vectors:
    x = np.bincount(who, vectors.real, count)
    return np.asarray(x + 1j * np.bincount(who, vectors.imag, count))
