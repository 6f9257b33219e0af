"""A robot without physics, and plans for it.

`Hall` is a complete implementation of the Robot protocol: it moves in straight lines at the speed it was
told, turns at a constant rate, speaks and gestures in simulated time. People stand where the test puts them
and move when it says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace

import pytest

from comity_domain.plans.plan import Plan, PlanStep, Why
from comity_executor import DockingPose, Execution, Intervention, Limits, Manner, Reading
from comity_executor.robots.scripted import ScriptedMotion, ScriptedReading
from comity_executor.speech.manner import NORMAL
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.inference.value import FiredRule, Inference, ParameterValue
from comity_fis.rules.rule import Is, Rule

ROBOT_RADIUS_M, PERSON_RADIUS_M = 0.25, 0.20
CONTROL_S = 0.05
ACT_S = {"utter": 2.0}
GESTURE_S = 1.5
TURN_DEG_S = 90.0


@dataclass(frozen=True, slots=True)
class Spot:
    distance_m: float
    bearing_deg: float
    pose_free: bool = True
    deviation_reason: str | None = None


@dataclass(frozen=True, slots=True)
class Spoken:
    t: float
    text: str


@dataclass(slots=True)
class Stander:
    """A person: a place and a heading in radians."""

    x: float
    y: float
    heading: float = math.pi


class Hall:
    """An empty hall with people and one robot, which starts at the origin, looking aside."""

    def __init__(self, people: Mapping[str, Stander]) -> None:
        self.people = dict(people)
        self.x = self.y = 0.0
        self.heading = 0.6
        self.speed = 0.0
        self.ticks = 0
        self.name = "robot"
        self.blind: set[str] = set()
        """People whom the robot does not see."""
        self.unreachable: set[str] = set()
        """People near whom there is no place to stand."""
        self.blocked_by: dict[str, str] = {}
        """What blocks the way to a person."""
        self.in_the_way: str | tuple[str, ...] | None = None
        """Somebody, or some, who stand in every way."""
        self.way_round = False
        """There is a way round them, a long one."""
        self.gives_way_s: float | None = None
        """So long after they were asked they make way; None: never."""
        self.detours_m: list[float] = []
        """How far each navigation might go round."""
        self.emergency_stop: object = False
        self.frozen = False
        """The wheels turn and nothing moves."""
        self.faults: dict[str, Exception] = {}
        """What a call raises, by the call's name or an act's."""
        self.table = False
        """A table stands in front of everybody."""
        self.calls: list[str] = []
        self._goal: tuple[str, str, Spot | None, float] | None = None
        self._acts: dict[tuple[str, str], float] = {}
        self.finished: list[tuple[str, str]] = []
        self.manners: dict[tuple[str, str], Manner] = {}
        self.asked_s: list[float] = []
        """When it asked to pass."""
        self.said: dict[str, list[Spoken]] = {}
        """What people have said, by person."""

    # The Robot protocol.

    def now_s(self) -> float:
        return self.ticks * CONTROL_S

    def read(self, person: str) -> ScriptedReading | None:
        self._fail("read")
        if person in self.blind:
            return None
        someone = self.people[person]
        dx, dy = self.x - someone.x, self.y - someone.y
        centre = math.hypot(dx, dy)
        bearing = _wrapped_deg(math.atan2(dy, dx) - someone.heading)
        facing = abs(_wrapped_deg(math.atan2(-dy, -dx) - self.heading))
        gap = centre - ROBOT_RADIUS_M - PERSON_RADIUS_M
        return ScriptedReading(gap, centre, bearing, facing, abs(bearing), self.speed, self.now_s())

    def heard(self, person: str) -> tuple[Spoken, ...]:
        return tuple(self.said.get(person, ()))

    def choose_pose(
        self,
        person: str,
        *,
        distance_m: float,
        bearing_deg: float,
        distance_desirability: Curve,
        direction_desirability: Curve,
    ) -> Spot | None:
        self._fail("choose_pose")
        if person in self.unreachable:
            return None
        if self.table:
            return Spot(distance_m, bearing_deg + 30.0, False, "a table stands in front")
        return Spot(distance_m, bearing_deg)

    def navigate(
        self, person: str, pose: DockingPose, *, speed_m_s: float, detour_m: float = math.inf
    ) -> None:
        self.detours_m.append(detour_m)
        self._command("navigate", person, pose, speed_m_s)

    def dock(self, person: str, pose: DockingPose, *, speed_m_s: float) -> None:
        self._command("dock", person, pose, speed_m_s)

    def face(self, person: str) -> None:
        self._command("face", person, None, 0.0)

    def motion(self) -> ScriptedMotion:
        if self._goal is None:
            return ScriptedMotion("idle")
        verb, person, _, _ = self._goal
        if person in self.blocked_by:
            return ScriptedMotion("blocked", self.blocked_by[person])
        if self._is_hindered:
            names = (self.in_the_way,) if isinstance(self.in_the_way, str) else self.in_the_way or ()
            return ScriptedMotion("blocked", "no way", names)
        if verb == "face":
            return ScriptedMotion("moving")
        return ScriptedMotion(
            "arrived" if self._way()[0] < (0.5 if verb == "navigate" else 1e-4) else "moving"
        )

    def stop(self) -> None:
        self._fail("stop")
        self._goal = None
        self.speed = 0.0

    def emergency(self) -> object:
        self._fail("emergency")
        return self.emergency_stop

    def start_act(self, act: str, person: str, text: str | None = None, *, manner: Manner = NORMAL) -> None:
        self._fail(act)
        self.manners[act, person] = manner
        if act == "ask_to_pass":
            self.asked_s.append(self.now_s())
        self.calls.append(f"{act} {person}" + (f": {text}" if text else ""))
        self._acts[act, person] = self.now_s()

    def act_done(self, act: str, person: str) -> bool | None:
        self._fail("act_done")
        if (act, person) in self._acts:
            return False
        return True if (act, person) in self.finished else None

    def stop_act(self, act: str, person: str) -> None:
        self._fail("stop_act")
        self._acts.pop((act, person), None)

    # The world.

    def step(self) -> None:
        """One control period."""
        self.ticks += 1
        for key, start in sorted(self._acts.items()):
            if self.now_s() - start >= ACT_S.get(key[0], GESTURE_S) - 1e-9:
                self.finished.append(key)
                del self._acts[key]
        self._make_way()
        self.speed = 0.0
        if self._goal is None or self.frozen or self._goal[1] in self.blocked_by or self._is_hindered:
            return
        if self._goal[0] == "face":
            self._turn()
        else:
            self._move()

    def _make_way(self) -> None:
        if self.gives_way_s is None or not self.asked_s:
            return
        if self.now_s() - self.asked_s[0] >= self.gives_way_s:
            self.in_the_way = None

    @property
    def _is_hindered(self) -> bool:
        return self.in_the_way is not None and not (self.way_round and self.detours_m[-1] == math.inf)

    @property
    def acts_under_way(self) -> set[tuple[str, str]]:
        return set(self._acts)

    @property
    def at_rest(self) -> bool:
        return self._goal is None and self.speed == 0.0 and not self._acts

    def _move(self) -> None:
        _, _, _, speed = self._goal or ("", "", None, 0.0)
        rest, x, y = self._way()
        if rest > 0:
            stride = min(rest, speed * CONTROL_S)
            self.x += (x - self.x) / rest * stride
            self.y += (y - self.y) / rest * stride
            self.speed = stride / CONTROL_S

    def _way(self) -> tuple[float, float, float]:
        """How far the goal is, and where."""
        assert self._goal is not None
        _, person, pose, _ = self._goal
        assert pose is not None
        someone = self.people[person]
        reach = pose.distance_m + ROBOT_RADIUS_M + PERSON_RADIUS_M
        direction = someone.heading + math.radians(pose.bearing_deg)
        x, y = someone.x + reach * math.cos(direction), someone.y + reach * math.sin(direction)
        return math.hypot(x - self.x, y - self.y), x, y

    def _turn(self) -> None:
        assert self._goal is not None
        someone = self.people[self._goal[1]]
        error = _wrapped_deg(math.atan2(someone.y - self.y, someone.x - self.x) - self.heading)
        most = TURN_DEG_S * CONTROL_S
        self.heading += math.radians(max(-most, min(most, error)))

    def _command(self, verb: str, person: str, pose: DockingPose | None, speed: float) -> None:
        self._fail(verb)
        self.calls.append(f"{verb} {person}")
        spot = Spot(pose.distance_m, pose.bearing_deg) if pose else None
        self._goal = (verb, person, spot, speed)

    def _fail(self, call: str) -> None:
        if call in self.faults:
            raise self.faults[call]


def _wrapped_deg(angle: float) -> float:
    return math.degrees(math.atan2(math.sin(angle), math.cos(angle)))


@dataclass(frozen=True, slots=True)
class Flat:
    """Everything in the domain is equally desirable."""

    domain: tuple[float, float]

    def __call__(self, x: float) -> float:
        return float(self.domain[0] <= x <= self.domain[1])

    def height(self, low: float, high: float) -> float:
        return float(low <= self.domain[1] and high >= self.domain[0])

    def centroid(self, low: float, high: float) -> float | None:
        return (max(low, self.domain[0]) + min(high, self.domain[1])) / 2


RULE = Rule(
    number=3,
    text="if individualism is LC1 and gender is female then conversational_distance is far",
    antecedent=Is("individualism", "LC1"),
    consequents=(Is("conversational_distance", "far"),),
    sources=(),
    evidence="design",
)


def infer(distance_m: float = 1.01) -> Inference:
    """What a rulebook might say about somebody."""

    def value(
        name: str, value: float | str, unit: str | None, desirability: Curve | Choice
    ) -> ParameterValue:
        fired = (FiredRule(RULE, 0.7),) if name == "conversational_distance" else ()
        return ParameterValue(
            name=name,
            value=value,
            unit=unit,
            spread=None,
            origin="culture",
            contributions=(),
            desirability=desirability,
            fired=fired,
            note="",
        )

    parameters = (
        value("conversational_distance", distance_m, "m", Flat((0.45, 1.2))),
        value("approach_direction", 0.0, "deg", Flat((0.0, 90.0))),
        value("approach_speed", 0.4, "m/s", Flat((0.1, 0.5))),
        value("greeting_modality", "both", None, Choice({"both": 1.0})),
        value("greeting_gesture", "nod", None, Choice({"nod": 1.0})),
    )
    return Inference(
        rulebook="bruno2017",
        mode="exact",
        inputs={"individualism": 67.0, "gender": "female", "age": None},
        parameters={parameter.name: parameter for parameter in parameters},
    )


def plan_for(*people: str, modality: str = "both", gesture: str = "nod", distance_m: float = 1.01) -> Plan:
    """Reach and greet everybody in this order."""
    nothing = Why("", ())
    reach = {
        "conversational_distance": distance_m,
        "approach_direction": 0.0,
        "approach_bearing": 0.0,
        "approach_speed": 0.4,
    }
    greet = {"greeting_modality": modality, "greeting_gesture": gesture}
    steps: list[PlanStep] = []
    for person in people:
        arguments = ("robot", person, "front")
        steps.append(PlanStep("Reach_user", arguments, ("start", "front"), reach, 100, nothing))
        steps.append(PlanStep("Greet_person", ("robot", person, modality, gesture), None, greet, 1, nothing))
    return Plan("test", True, True, 101 * len(people), tuple(steps))


class Episode:
    """A hall, a plan and its execution; what the tests run."""

    def __init__(
        self,
        hall: Hall,
        plan: Plan,
        limits: Limits | None = None,
        interventions: Iterable[Intervention] = (),
    ) -> None:
        self.hall = hall
        self.plan = plan
        self.values = {step.person: infer() for step in plan.steps}
        self.execution = Execution(plan, hall, self.values, limits or Limits(), interventions)

    def run(self, *, for_s: float = 300.0, until: Callable[[], bool] = lambda: False) -> Episode:
        """Go on until the end, for some time, or until something happens."""
        end = self.hall.now_s() + for_s
        while self.execution.tick() == "running" and self.hall.now_s() < end and not until():
            self.hall.step()
        return self

    def is_running(self, node: str) -> bool:
        """Whether the last event of a node says so."""
        statuses = [event.status for event in self.execution.events if event.node == node]
        return bool(statuses) and statuses[-1] == "running"

    def count(self, node: str, status: str) -> int:
        return sum(event.node == node and event.status == status for event in self.execution.events)


@pytest.fixture(scope="session")
def episode() -> Callable[..., Episode]:
    """Build an episode: people by name and distance ahead, greeted in that order."""

    def build(*names: str, ahead_m: float = 3.0, limits: Limits | None = None, **choices: object) -> Episode:
        people = {
            name: Stander(ahead_m, 2.0 * index, math.pi) for index, name in enumerate(names or ("johanna",))
        }
        plan = plan_for(*people, **choices)  # type: ignore[arg-type]
        return Episode(Hall(people), plan, limits)

    return build


@pytest.fixture(scope="session")
def reading() -> Callable[..., Reading]:
    """A reading at a perfect docking in front of a person at 1.01 m, but for what is given."""

    def build(**quantities: float) -> Reading:
        return replace(ScriptedReading(1.01, 1.46, 0.0, 0.0, 0.0, 0.0, 0.0), **quantities)

    return build
