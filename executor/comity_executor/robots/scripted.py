"""The smallest robot that satisfies the protocol: no physics and no room, only how far away people are.

It is an example for whoever connects a real robot, and enough to try a plan's tree: it comes straight up to
people at the speed it was told, turns at once, and does every act in a fixed time.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf

from comity_executor.robots.carrier import HAND_OVER, PICK_UP
from comity_executor.robots.robot import DockingPose, PlannedPose, Words
from comity_executor.speech.manner import NORMAL, Manner
from comity_fis.defuzzification.curve import Curve

CLOSE_M = 0.5
"""So much before the pose, navigation has arrived."""
BODIES_M = 0.45
"""The two radii together: what lies between centre distance and distance."""


@dataclass(frozen=True, slots=True)
class ScriptedReading:
    """What it knows of a person; it is always right."""

    distance_m: float
    centre_distance_m: float
    bearing_deg: float
    facing_error_deg: float
    person_facing_error_deg: float
    speed_m_s: float
    stamp_s: float


@dataclass(frozen=True, slots=True)
class ScriptedMotion:
    """How the last motion command goes."""

    state: str
    text: str = ""
    blocked_by: tuple[str, ...] = ()


class ScriptedRobot:
    """A robot that is only numbers; `step` is its world.

    Args:
        people: How far away each person is at the start, between the bodies [m].
        name: As in the plan.
        step_s: The length of a step.
        act_s: How long every utterance and gesture takes.
    """

    def __init__(
        self, people: Mapping[str, float], *, name: str = "robot", step_s: float = 0.1, act_s: float = 1.5
    ) -> None:
        self._name = name
        self._step_s = step_s
        self._act_steps = round(act_s / step_s)
        self._steps = 0
        self._away_m = dict(people)
        self._bearing_deg = dict.fromkeys(people, 0.0)
        self._goal: tuple[str, DockingPose, float] | None = None
        self._speed_m_s = 0.0
        self._close_m = 0.0
        self._faces: str | None = None
        self._acts: dict[tuple[str, str], int] = {}
        self._load: tuple[str, str] | None = None
        self._receiver: str | None = None
        self.in_the_way: str | None = None
        """Somebody who blocks every way; whoever scripts the robot says who, and until when."""
        self.emergency_stop: str | None = None
        """Why the emergency stop is pressed; None while it is not."""

    def step(self) -> None:
        """Let a step of time pass."""
        self._steps += 1
        self._speed_m_s = 0.0
        if self._goal is None or self.in_the_way or self.emergency_stop:
            return
        person, pose, speed_m_s = self._goal
        rest_m = self._away_m[person] - pose.distance_m
        stride_m = max(-speed_m_s * self._step_s, min(speed_m_s * self._step_s, rest_m))
        self._away_m[person] -= stride_m
        self._speed_m_s = abs(stride_m) / self._step_s
        if abs(rest_m) <= CLOSE_M:
            self._bearing_deg[person] = pose.bearing_deg

    @property
    def name(self) -> str:
        """Its name in the plan."""
        return self._name

    def now_s(self) -> float:
        """Steps times their length."""
        return self._steps * self._step_s

    def read(self, person: str) -> ScriptedReading | None:
        """What is so; None for a stranger."""
        if person not in self._away_m:
            return None
        away_m, bearing_deg = self._away_m[person], self._bearing_deg[person]
        return ScriptedReading(
            distance_m=away_m,
            centre_distance_m=away_m + BODIES_M,
            bearing_deg=bearing_deg,
            facing_error_deg=0.0 if self._faces == person else 180.0,
            person_facing_error_deg=abs(bearing_deg),
            speed_m_s=self._speed_m_s,
            stamp_s=self.now_s(),
        )

    def heard(self, person: str) -> Sequence[Words]:
        """Nothing: nobody speaks here."""
        return ()

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> DockingPose | None:
        """The wanted pose: nothing is ever in the way."""
        return PlannedPose(distance_m, bearing_deg)

    def navigate(self, person: str, pose: DockingPose, *, speed_m_s: float, detour_m: float = inf) -> None:
        """Come closer."""
        self._set_out(person, pose, speed_m_s, close_m=CLOSE_M)

    def dock(self, person: str, pose: DockingPose, *, speed_m_s: float) -> None:
        """Come to the distance, and stay at it."""
        self._set_out(person, pose, speed_m_s, close_m=1e-9)

    def face(self, person: str) -> None:
        """Turn, in no time."""
        self._goal, self._faces = None, person

    def motion(self) -> ScriptedMotion:
        """Arrived where the way that is left is short enough."""
        if self._goal is None:
            return ScriptedMotion("arrived" if self._faces else "idle")
        person, pose, _ = self._goal
        if self.in_the_way:
            return ScriptedMotion("blocked", f"{self.in_the_way} is in the way", (self.in_the_way,))
        rest_m = abs(self._away_m[person] - pose.distance_m)
        state = "arrived" if rest_m <= self._close_m else "moving"
        return ScriptedMotion(state, f"{rest_m:.2f} m of way left to {person}")

    def stop(self) -> None:
        """Stand, at once."""
        self._goal, self._speed_m_s = None, 0.0

    def emergency(self) -> str | bool:
        """What the script says."""
        return self.emergency_stop or False

    def start_act(self, act: str, person: str, text: str | None = None, *, manner: Manner = NORMAL) -> None:
        """Note when it began."""
        self._acts[act, person] = self._steps

    def act_done(self, act: str, person: str) -> bool | None:
        """True once its time is over; None where it never began or was broken off."""
        begun = self._acts.get((act, person))
        return None if begun is None else self._steps - begun >= self._act_steps

    def stop_act(self, act: str, person: str) -> None:
        """Forget that it began, unless it is over."""
        if not self.act_done(act, person):
            self._acts.pop((act, person), None)

    def go_to(self, place: str, *, speed_m_s: float, detour_m: float = inf) -> None:
        """Be there, in no time: it knows no places."""
        self._goal, self._faces = None, place

    def pick_up(self, thing: str, place: str) -> None:
        """Begin to take something up."""
        self._load, self._receiver = (thing, place), None
        self._acts[PICK_UP, place] = self._steps

    def hand_over(self, thing: str, person: str, *, manner: Manner = NORMAL) -> None:
        """Begin to hand it over."""
        self._receiver = person
        self._acts[HAND_OVER, person] = self._steps

    def carried(self) -> str | None:
        """What it has taken up and not handed over."""
        if self._load is None or not self.act_done(PICK_UP, self._load[1]):
            return None
        given = self._receiver is not None and self.act_done(HAND_OVER, self._receiver)
        return None if given else self._load[0]

    def _set_out(self, person: str, pose: DockingPose, speed_m_s: float, *, close_m: float) -> None:
        self._goal, self._faces, self._close_m = (person, pose, speed_m_s), person, close_m
