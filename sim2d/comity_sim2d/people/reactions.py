"""Visible reactions of people with a comfort interval: step back, lean in, turn away, speak, or nothing.

A person reacts once to every approach, a moment after the robot has come to rest facing them. The reaction is
drawn from the signal model of `comity_fis.learning.showing`. All times and lengths are our own choice.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import takewhile

import numpy as np

from comity_fis.learning.showing import drawn, shown
from comity_fis.learning.signals import SIGNALS, WORDS, Signal
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.docking import docked
from comity_sim2d.people.said import Said
from comity_sim2d.pose import Pose, direction_to, wrap_angle
from comity_sim2d.scene.comfort import SEATED, Comfort
from comity_sim2d.scene.obstacles import FloorPlan
from comity_sim2d.scene.person import Person

EDGE_M = 0.03
"""Variation of the ends of a person's comfort interval from time to time [m], as in
`comity_fis.learning.comfort`."""
ADDRESSED_M, ADDRESSED_DEG = 2.0, 15.0
"""Distance [m] and facing error [deg] within which the robot addresses a person."""
REST_M_S = 0.02
HESITATION_S = 0.7
"""Time from the robot's coming to rest until the reaction [s]."""
LEFT_M = 1.0
"""Distance by which the robot must withdraw before coming again counts as another approach [m]."""
STEP_BACK_M, LEAN_IN_M, STEP_M_S = 0.20, 0.12, 0.4
TURN_AWAY_RAD, TURN_RAD_S = math.radians(60.0), 2.0


@dataclass(frozen=True, slots=True)
class Shown:
    """The true reaction of a person."""

    t: float
    person: str
    signal: Signal
    distance_m: float
    """Gap between the bodies when it began [m]."""


@dataclass(slots=True)
class _State:
    """State of one person in the current approach."""

    comfort: Comfort
    rested_ticks: int = 0
    reacted_at_m: float | None = None
    left: list[Pose] = field(default_factory=list)
    """Remaining poses, one per tick, the next one last."""


class Reactions:
    """All people who react.

    Args:
        people: All people of the scene; those without a comfort interval stand still.
        robot_radius_m: Radius of the robot's disc [m].
        plan: The static obstacles, which a person must not walk into.
        clock: Simulated time.
        seed: Seed of the reactions, independent of the sensor noise.
        said: What people say; reactions are appended to it.
    """

    def __init__(
        self,
        people: tuple[Person, ...],
        robot_radius_m: float,
        plan: FloorPlan,
        clock: Clock,
        *,
        seed: int,
        said: list[Said],
    ) -> None:
        self._states = {person.name: _State(person.comfort) for person in people if person.comfort}
        self._robot_radius_m = robot_radius_m
        self._plan = plan
        self._clock = clock
        self._rng = np.random.Generator(np.random.PCG64([seed, 1]))
        self.shown: list[Shown] = []
        self._said = said

    def use_plan(self, plan: FloorPlan) -> None:
        """Replace the static obstacles."""
        self._plan = plan

    def break_off(self, name: str) -> None:
        """Cancel the reaction of a person who is moved by something else."""
        if name in self._states:
            self._states[name].left.clear()

    def step(
        self, people: dict[str, Person], robot: Pose, speed_m_s: float, move: Callable[[Person], bool]
    ) -> None:
        """Advance by one tick.

        Args:
            people: All people and their poses.
            robot: Pose of the robot.
            speed_m_s: Its speed [m/s].
            move: Moves a person; returns whether that was possible. If not, they stay where they are.
        """
        for name, state in self._states.items():
            person = people[name]
            if state.left:
                pose = state.left.pop()
                if not move(replace(person, x_m=pose.x_m, y_m=pose.y_m, heading_rad=pose.heading_rad)):
                    state.left.clear()
            elif self._is_addressed(state, person, robot, speed_m_s):
                state.left = self._react(state, person, robot)

    def _is_addressed(self, state: _State, person: Person, robot: Pose, speed_m_s: float) -> bool:
        """Whether it is time to react to the robot that came to rest."""
        stands = docked(robot, self._robot_radius_m, person)
        if state.reacted_at_m is not None:
            if stands.distance_m > state.reacted_at_m + LEFT_M:
                state.reacted_at_m, state.rested_ticks = None, 0
            return False
        near = stands.distance_m <= ADDRESSED_M and stands.facing_error_deg <= ADDRESSED_DEG
        state.rested_ticks = state.rested_ticks + 1 if near and speed_m_s < REST_M_S else 0
        return state.rested_ticks * self._clock.step_s >= HESITATION_S

    def _react(self, state: _State, person: Person, robot: Pose) -> list[Pose]:
        comfort, distance_m = state.comfort, docked(robot, self._robot_radius_m, person).distance_m
        state.reacted_at_m = distance_m
        probabilities = shown(
            distance_m,
            comfort.near_m,
            comfort.far_m,
            chance=comfort.chance,
            edge=EDGE_M,
            repertoire=_repertoire(person, comfort),
        )
        signal = SIGNALS[int(drawn(probabilities, self._rng.random()))]
        self.shown.append(Shown(self._clock.now_s, person.name, signal, distance_m))
        if signal in WORDS:
            self._said.append(Said(self._clock.now_s, person.name, WORDS[signal]))
            return []
        return self._way(signal, person, robot)

    def _way(self, signal: Signal, person: Person, robot: Pose) -> list[Pose]:
        """Poses of a movement, the last one first."""
        if signal == "turn_away":
            steps = math.ceil(TURN_AWAY_RAD / (TURN_RAD_S * self._clock.step_s))
            bearing = wrap_angle(direction_to(person.xy, robot.xy) - person.heading_rad)
            turn = -math.copysign(TURN_AWAY_RAD, bearing) / steps
            return [
                person.pose._replace(heading_rad=person.heading_rad + turn * k) for k in range(steps, 0, -1)
            ]
        length = {"step_back": STEP_BACK_M, "lean_in": -LEAN_IN_M}.get(signal, 0.0)
        steps = math.ceil(abs(length) / (STEP_M_S * self._clock.step_s))
        away = Pose(*person.xy, direction_to(robot.xy, person.xy))
        way = [away.ahead(length * k / steps) for k in range(1, steps + 1)]
        free = takewhile(lambda xy: self._plan.blocker(xy, person.radius_m) is None, way)
        return [Pose(*xy, person.heading_rad) for xy in free][::-1]


def _repertoire(person: Person, comfort: Comfort) -> tuple[Signal, ...]:
    return comfort.shows if person.posture == "standing" else tuple(s for s in comfort.shows if s in SEATED)
