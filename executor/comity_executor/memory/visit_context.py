"""All that the nodes of one person's branch share: the robot, the limits, and entries of the blackboard."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, replace
from math import inf
from types import MappingProxyType

from py_trees.behaviour import Behaviour

from comity_domain.choices.distances import distance_desirability
from comity_domain.choices.greeting import NO_GESTURE
from comity_domain.plans.plan import PlanStep
from comity_domain.problem.bound_parameters import BEARING, DISTANCE
from comity_executor.memory.asking import Asking
from comity_executor.memory.drive import Drive
from comity_executor.memory.shared import SharedMemory
from comity_executor.memory.visit import Outcome, ShownWish, Visit, VisitMemory
from comity_executor.nodes.cause import Provenance
from comity_executor.nodes.limits import Limits
from comity_executor.robots.goals import PlannedPose, RelativePose, unverified
from comity_executor.robots.robot import Robot
from comity_executor.robots.senses import Senses
from comity_executor.speech.manner import Manner, manner_of
from comity_executor.speech.other_parameters import other_parameters
from comity_executor.speech.speaker import SPEAKER, Speaker
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.defuzzification.moved_curve import MovedCurve
from comity_fis.inference.value import Inference
from comity_fis.membership.interval import Interval

SAY_ACT = "say"
POSE = ("pose", "reach", "values", "shown")
"""Entries that say where the robot is to stand."""
DONE = ("greet", "performed", "done_before")
"""Entries that say what was done of the greeting."""


MakeAct = Callable[[str, str], Behaviour]
"""Makes the behaviour of an act from the name of its node, `juggle(johanna)`, and the person."""
NO_ACTS: Mapping[str, MakeAct] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class VisitContext:
    """One person to reach and to greet; its choices stay, its parameters may be updated (`rebind`)."""

    person: str
    robot: Robot
    senses: Senses
    limits: Limits
    memory: VisitMemory
    shared: SharedMemory
    custom: Mapping[str, MakeAct]
    """Acts that are behaviours of the user's own, by name."""
    speaker: Speaker = SPEAKER
    """What is said, and how people are addressed."""
    tells_leaving: bool = False
    """Whether a person may have to be told that the robot leaves them."""

    def seen_by(
        self, leaf: Behaviour, *, reads: Collection[str] = (), writes: Collection[str] = ()
    ) -> VisitContext:
        """The same as a leaf uses it, which declares the entries that it reads and writes."""
        memory = self.memory.seen_by(leaf, reads=reads, writes=writes)
        return replace(self, memory=memory, shared=self.shared.seen_by(leaf, reads=reads, writes=writes))

    def rebind(self, reach: PlanStep, greet: PlanStep, values: Inference) -> None:
        """Go by other numbers from now on.

        The place to stand is chosen again, unless the robot stands there already and is to stand there still.
        """
        memory, wanted, before = self.memory, self.wanted, self._moves_by
        memory.reach, memory.greet, memory.values = reach, greet, values
        if memory.pose is not None and (self.wanted != wanted or not memory.docked):
            try:
                self.choose_pose()
            except Exception:  # the leaf that goes there fails, and its next attempt chooses again
                memory.pose = None
        memory.bindings += self._moves_by != before

    @property
    def reach(self) -> PlanStep:
        """The step that leads to the person."""
        return self.memory.reach

    @property
    def greet(self) -> PlanStep:
        """The step that greets."""
        greet = self.memory.greet
        assert greet is not None  # written when the tree is built
        return greet

    @property
    def values(self) -> Inference:
        """The person's parameters."""
        return self.memory.values

    @property
    def drive(self) -> Drive:
        """The base."""
        return Drive(self.robot, self.shared)

    @property
    def asking(self) -> Asking:
        """Requests for passage."""
        return Asking(self.limits, self.shared)

    @property
    def _moves_by(self) -> tuple[PlannedPose, float, RelativePose | None, Mapping[str, float | str]]:
        return self.wanted, self.approach_speed_m_s, self.memory.pose, other_parameters(self.values)

    def choose_pose(self) -> None:
        """Let the robot choose where to stand; the pose is None where it finds no place."""
        self.memory.pose = self.robot.choose_pose(
            self.person,
            distance_m=self.goes_for.distance_m,
            bearing_deg=self.goes_for.bearing_deg,
            distance_desirability=self._apart(),
            direction_desirability=self._desirability("approach_direction"),
        )

    def _apart(self) -> Curve:
        """How desirable each distance is; it moves along with what the person showed."""
        by_m, floor_m = self.goes_for.distance_m - self.wanted.distance_m, self.limits.safety_floor_m
        if by_m:
            return MovedCurve(self._desirability(DISTANCE), by_m, Interval(floor_m, inf))
        return distance_desirability(self.values[DISTANCE], floor_m + self.limits.tolerance_m)

    def _desirability(self, parameter: str) -> Curve:
        curve = self.values[parameter].desirability
        if isinstance(curve, Choice):
            raise TypeError(f"{parameter} is nominal: it has no desirability over a range")
        return curve

    @property
    def reach_grounds(self) -> Provenance:
        """What the nodes that move stand on."""
        return Provenance(self.reach, self.values)

    @property
    def greet_grounds(self) -> Provenance:
        """What the nodes that greet stand on."""
        return Provenance(self.greet, self.values)

    @property
    def wanted(self) -> PlannedPose:
        """Where the plan wants the robot to stand."""
        return PlannedPose(
            distance_m=_number(self.reach, DISTANCE),
            bearing_deg=_number(self.reach, BEARING),
        )

    @property
    def shown(self) -> ShownWish | None:
        """What the person showed of their distance, unless they asked for another one outright since."""
        shown = self.memory.shown
        return shown if shown is not None and shown.setting_m == self._setting_m else None

    def note_shown(self, distance_m: float) -> None:
        """Remember how far away the person had the robot stand: it comes back to that."""
        self.memory.shown = ShownWish(distance_m, self._setting_m)

    @property
    def _own_m(self) -> float | None:
        """What the person showed or asked for of their distance; None where they did not."""
        return self.shown.distance_m if self.shown else self._setting_m

    @property
    def _setting_m(self) -> float | None:
        value = self.values[DISTANCE]
        return value.number if value.asked_for else None

    @property
    def goes_for(self) -> PlannedPose:
        """Where the robot tries to stand: as planned, but as far away as the person showed since.

        It is told to stand so far away that it is not nearer than the safety floor, or than the person asked
        for or showed, where it comes to rest too near by its tolerance.
        """
        wanted, shown, tolerance_m = self.wanted, self.shown, self.limits.tolerance_m
        distance_m = wanted.distance_m if shown is None else shown.distance_m
        least_m = self.limits.safety_floor_m if self._own_m is None else self._own_m
        return PlannedPose(max(distance_m, least_m + tolerance_m), wanted.bearing_deg)

    @property
    def pose(self) -> RelativePose:
        """Where the robot is to stand: the pose that was chosen, or before that the one it goes for."""
        return self.memory.pose or self.goes_for

    @property
    def approach_speed_m_s(self) -> float:
        """How fast the robot may come near this person, and where it would not see them."""
        speed_m_s = _number(self.reach, "approach_speed")
        return min(speed_m_s, self.limits.unverified_speed_m_s) if unverified(self.pose) else speed_m_s

    @property
    def detour_m(self) -> float:
        """How much farther the robot goes rather than ask: any way round, once it has asked in vain."""
        return inf if self.asking.may_go_round((self.person,)) else self.limits.detour_m

    @property
    def manner(self) -> Manner:
        """How loud, how fast and how large the robot acts towards this person."""
        return manner_of(self.values)

    @property
    def acts(self) -> tuple[str, ...]:
        """What the greeting consists of, `say` first."""
        return acts_of(self.greet)

    def is_done(self, act: str) -> bool:
        """Whether an act was performed: in this execution, or in one before it that was halted."""
        return act in self.memory.performed or act in self.memory.done_before

    def note_done(self, act: str) -> None:
        """Remember an act that came to its end."""
        self.memory.performed = (*self.memory.performed, act)
        self.memory.performed_s = self.senses.now_s()

    @property
    def is_greeted(self) -> bool:
        """Whether all that the greeting consists of was done, as far as the tree has noticed."""
        return all(map(self.is_done, self.acts))

    @property
    def why(self) -> str | None:
        """Why the visit is over before its end; None if it is not. Whoever was greeted has not declined."""
        if (how := self.memory.declined) is None:
            return self.memory.failure
        return f"after the greeting, {how}" if self.is_greeted else f"declined: {how}"

    @property
    def is_attended(self) -> bool:
        """Whether the person had time to show how they take the robot, where it is to wait for that."""
        return self.memory.attended or self.limits.attend_s == 0.0

    def visits(self) -> tuple[Visit, ...]:
        """What came of it so far: of the person, and of companions who are greeted with them."""
        own = self._visit()
        return (own, *(own.shared_with(companion) for companion in self.greet.companions))

    def _visit(self) -> Visit:
        memory, outcome = self.memory, self._outcome()
        return Visit(
            person=self.person,
            outcome=outcome,
            pose=memory.pose,
            docked_at=memory.docked_at,
            docked_s=memory.docked_s,
            greeting=tuple(act for act in self.acts if act in memory.performed),
            failure=None if outcome == "greeted" and memory.declined else self.why,
            noticed=memory.noticed,
            wanted=self.wanted,
            agenda=tuple(task.deed() for task in memory.agenda),
            greeted_s=memory.performed_s if self.is_greeted else None,
        )

    def _outcome(self) -> Outcome:
        memory, greeted = self.memory, self.is_greeted
        if greeted and all(task.done_s is not None for task in memory.agenda):
            return "greeted"
        if memory.declined is not None:
            return "declined"
        if not memory.given_up:
            return "pending"
        if greeted:
            return "unfinished"
        return "not_greeted" if memory.docked_at else "unreached"


def acts_of(step: PlanStep) -> tuple[str, ...]:
    """What a greeting or a farewell consists of, `say` first.

    Raises:
        ValueError: The step names no way to do it.
    """
    modality, gesture = step.arguments[-2:]
    known = {"verbal": (SAY_ACT,), "gestural": (gesture,), "both": (SAY_ACT, gesture)}
    if modality not in known:
        raise ValueError(f"unknown modality {modality!r} in {step.action}, known are {', '.join(known)}")
    if NO_GESTURE in known[modality]:
        raise ValueError(f"{step.action} of {step.person} is {modality}, but names no gesture")
    return known[modality]


def _number(step: PlanStep, parameter: str) -> float:
    value = step.parameters.get(parameter)
    if isinstance(value, str) or value is None:
        raise ValueError(
            f"{step.action}({', '.join(step.arguments)}) needs a number {parameter}, got {value!r}"
        )
    return float(value)
