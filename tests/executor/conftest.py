"""A robot without physics, and plans for it.

`Hall` is a complete implementation of the Robot protocol: it moves in straight lines at the speed it was
told, turns at a constant rate, speaks and gestures in simulated time. People stand where the test puts them
and move when it says so.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial

import pytest

from comity_domain.plans.plan import Plan, PlanStep, StepExplanation
from comity_executor import (
    ActGoal,
    ActStatus,
    CapabilityValues,
    Execution,
    GoalId,
    History,
    Intervention,
    Limits,
    Manner,
    MotionGoal,
    MotionStatus,
    Reading,
)
from comity_executor.robots.goals import GoalState
from comity_executor.robots.scripted import ScriptedReading
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.inference.value import Contribution, FiredRule, Inference, ParameterValue
from comity_fis.rules.rule import Is, Rule

ROBOT_RADIUS_M, PERSON_RADIUS_M = 0.25, 0.20
CONTROL_S = 0.05
LEASE_S = 0.3
ACT_S = {"say": 2.0}
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

    def __init__(self, people: Mapping[str, Stander], can: CapabilityValues | None = None) -> None:
        self.people = dict(people)
        self.x = self.y = 0.0
        self.heading = 0.6
        self.speed = 0.0
        self._turns = False
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
        self._acts: dict[str, tuple[str, str, float]] = {}
        self._states: dict[str, GoalState] = {}
        self.goals = 0
        """So many motion goals were given: the newest one is called by that number."""
        self.can = can or CapabilityValues(lease_s=LEASE_S)
        self._renewed_s = 0.0
        self.stops_told = 0
        """How often the base was told to stop."""
        self.goes_on_until_s = 0.0
        """Until then it does not come to rest, whatever it is told."""
        self.finished: list[tuple[str, str]] = []
        self.manners: dict[tuple[str, str], Manner] = {}
        self.others: list[tuple[str, Mapping[str, float | str]]] = []
        """What each goal and act was told of parameters that have no argument, in order."""
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

    @property
    def capabilities(self) -> CapabilityValues:
        return self.can

    def go(self, goal: MotionGoal) -> int:
        self._fail(goal.kind)
        if goal.kind == "navigate":
            self.detours_m.append(goal.detour_m)
        self.calls.append(f"{goal.kind} {goal.to}")
        self.others.append((goal.kind, goal.parameters))
        spot = Spot(goal.pose.distance_m, goal.pose.bearing_deg) if goal.pose else None
        self._goal = (goal.kind, goal.to, spot, goal.speed_m_s)
        self.goals += 1
        self._renewed_s = self.now_s()
        return self.goals

    def renew(self, goal: GoalId) -> None:
        self._fail("renew")
        if goal == self.goals and self._goal is not None:
            self._renewed_s = self.now_s()

    def motion(self) -> MotionStatus:
        self._fail("motion")
        told = partial(
            MotionStatus,
            self.goals or None,
            stamp_s=self.now_s(),
            is_at_rest=self.speed == 0.0 and not self._turns and self.now_s() >= self.goes_on_until_s,
        )
        if self._goal is None:
            return told("stopped")
        verb, person, _, _ = self._goal
        if person in self.blocked_by:
            return told("running", self.blocked_by[person], is_blocked=True)
        if self._is_hindered:
            names = (self.in_the_way,) if isinstance(self.in_the_way, str) else self.in_the_way or ()
            return told("running", "no way", is_blocked=True, blocked_by=names)
        if verb == "face":
            return told("running")
        return told("succeeded" if self._way()[0] < (0.5 if verb == "navigate" else 1e-4) else "running")

    def perform(self, act: ActGoal) -> str:
        self._fail(act.act)
        self.manners[act.act, act.to] = act.manner
        self.others.append((act.act, act.parameters))
        if act.act == "ask_to_pass":
            self.asked_s.append(self.now_s())
        self.calls.append(f"{act.act} {act.to}" + (f": {act.text}" if act.text else ""))
        name = f"{act.act} {len(self._states)}"
        self._acts[name] = (act.act, act.to, self.now_s())
        self._states[name] = "running"
        return name

    def performance(self, act: GoalId) -> ActStatus:
        self._fail("performance")
        return ActStatus(act, self._states[str(act)])

    def stop(self, goal: GoalId | None = None) -> None:
        self._fail("stop" if not isinstance(goal, str) else "stop_act")
        if isinstance(goal, str):
            if self._acts.pop(goal, None):
                self._states[goal] = "stopped"
        elif goal in (None, self.goals):
            self.stops_told += 1
            self._goal = None
            self.speed = 0.0

    def emergency(self) -> object:
        self._fail("emergency")
        return self.emergency_stop

    # The world.

    def step(self) -> None:
        """One control period."""
        self.ticks += 1
        for name, (act, person, start) in sorted(self._acts.items()):
            if self.now_s() - start >= ACT_S.get(act, GESTURE_S) - 1e-9:
                self.finished.append((act, person))
                self._states[name] = "succeeded"
                del self._acts[name]
        self._make_way()
        if self.now_s() - self._renewed_s > self.can.lease_s:
            self._goal = None
        self.speed, self._turns = 0.0, False
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
        return {(act, person) for act, person, _ in self._acts.values()}

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
        self._turns = abs(error) > 1e-6
        self.heading += math.radians(max(-most, min(most, error)))

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
            contributions=(Contribution("culture", value, ""),),
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
    nothing = StepExplanation("", ())
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

    def run(
        self, *, for_s: float = 300.0, until: Callable[[], bool] = lambda: False, resumes: bool = True
    ) -> Episode:
        """Go on until the end, for some time, or until something happens; resume once a stop is released."""
        end = self.hall.now_s() + for_s
        while self._tick(resumes=resumes) == "running" and self.hall.now_s() < end and not until():
            self.hall.step()
        return self

    def _tick(self, *, resumes: bool) -> str:
        if resumes:
            self.execution.resume()
        return self.execution.tick()

    def is_running(self, node: str) -> bool:
        """Whether the last event of a node says so."""
        statuses = [event.status for event in self.execution.events if event.node == node]
        return bool(statuses) and statuses[-1] == "running"

    def count(self, node: str, status: str) -> int:
        return sum(event.node == node and event.status == status for event in self.execution.events)


def visits_with(hall: Hall) -> Execution:
    """The visits of everybody in the hall."""
    return Execution(plan_for(*hall.people), hall, {person: infer() for person in hall.people})


def within(spans: Iterable[tuple[float, float]], now_s: float) -> bool:
    """Whether a time is in one of some spans, each given by its start and its length [s]."""
    return any(start <= now_s < start + length for start, length in spans)


def history_of(visits: Episode) -> History:
    return History(visits.execution.nodes, visits.execution.events)


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
