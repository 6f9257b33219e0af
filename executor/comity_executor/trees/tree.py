"""From a plan to a behaviour tree: one postcondition-precondition-action block per action.

The form is that of Colledanchise and Ogren (Behavior Trees in Robotics and AI, 2018, section 3.5): a fallback
asks whether the effect of an action holds already and otherwise acts, after the same question for the
precondition. The plan decides who is visited, in which order and how; the tree only decides, in every tick,
what is still to be done.

    Safe ?
    |- Stop ->                               the emergency stop, see `emergency`
    '- Goal ->
       |- <> plan_holds?                     false when another plan is to take over, see `revision`
       |- visited(u) ?                       one per person, in the plan's order
       |  |- <> greeted?(u)
       |  |- <> given_up?(u)
       |  |- Achieve(u) ->
       |  |  |- docked(u) ?
       |  |  |  |- <> docked?(u)
       |  |  |  '- Retry > Timeout > Approach =>
       |  |  |     |- Mind_way > Pass(u) ?   who is in the way is asked to let the robot pass, see `passing`
       |  |  |     '- Reach_user ->(memory)  Navigate_to_user, Dock_to_user, Face_user
       |  |  '- Greet_person =>
       |  |     |- Keep_distance(u)          always RUNNING
       |  |     '- Perform =>                per act: ?(done?(act, u), Timeout > act), at the same time;
       |  |                                  and Attend_to(u) where the limits give time for it
       |  '- Give_up(u)
       '- <> all_greeted?

Where more is to be done at a visit than to greet (`task_tree`), `served?(u)` takes the place of `greeted?`
and Achieve(u) is a sequence of such blocks, the greeting's first. A person who does not see is told that the
robot comes, has stopped and leaves, see `announcing`.

One person's failure must not cost the others their visit, so `visited(u)` never fails: if every attempt at
Achieve failed, Give_up records why and succeeds, `given_up?` keeps the branch shut in later ticks, and the
Goal continues with the next person. The last node, `all_greeted?`, then makes the root fail. The visits
record who was served; from them the caller reads whether the run was a success, partial or failed.
"""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Sequence as Seq
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType

from py_trees.behaviour import Behaviour

from comity_domain.plans.actions import ANNOUNCED, FETCH, GREET, GREETINGS, REACH, RETURN, SKIP
from comity_domain.plans.plan import Plan, PlanStep
from comity_executor.leaves.act import Act
from comity_executor.leaves.announce import is_announced
from comity_executor.leaves.attend import AttendTo
from comity_executor.leaves.conditions import AreAllGreeted, IsActDone, IsDocked, IsGivenUp, IsGreeted
from comity_executor.leaves.custom_act import CustomAct
from comity_executor.leaves.dock_to_user import DockToUser
from comity_executor.leaves.emergency import EmergencyGuard
from comity_executor.leaves.face_user import FaceUser
from comity_executor.leaves.give_up import GiveUp
from comity_executor.leaves.keep_distance import KeepDistance
from comity_executor.leaves.navigate import NavigateToUser
from comity_executor.leaves.plan_holds import DoesPlanHold
from comity_executor.leaves.task_conditions import IsServed
from comity_executor.memory.memory import Memory
from comity_executor.memory.task import EFFECTS, Task, agenda_of
from comity_executor.memory.visit import VisitMemory
from comity_executor.memory.visit_context import NO_ACTS, MakeAct, VisitContext
from comity_executor.nodes.act_timeout import ActTimeout
from comity_executor.nodes.cause import Provenance, explains
from comity_executor.nodes.composites import fallback, parallel_until_all, parallel_until_one, sequence
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.limits import DEFAULT_LIMITS, Limits
from comity_executor.nodes.node import preorder
from comity_executor.nodes.retry import Retry
from comity_executor.nodes.simulated_timeout import SimulatedTimeout
from comity_executor.robots.carrier import HAND_OVER
from comity_executor.robots.robot import Robot
from comity_executor.robots.senses import Senses
from comity_executor.speech.speaker import SPEAKER, Speaker
from comity_executor.trees.announcing import coming_told, leave_told, stop_told
from comity_executor.trees.fetching import brought, taken
from comity_executor.trees.passing import passing, way_to
from comity_executor.trees.task_tree import block
from comity_fis.inference.value import Inference

VISITED, DOCKED = "visited", "docked"
"""Names of the nodes of a whole visit, and of getting to the docking pose."""
KNOWN = (REACH, *GREETINGS, FETCH, RETURN, *EFFECTS)


@dataclass(frozen=True, slots=True)
class Tree:
    """A tree ready to tick, with what its branches share; every tick starts with `senses.begin_tick`."""

    root: Behaviour
    plans: list[Plan]
    """The plan, and what was left of it each time that its parameters were updated."""
    meetings: tuple[VisitContext, ...]
    """Visit contexts, in the order of the visits."""
    returns: tuple[VisitContext, ...]
    """Where the robot comes back to a person with what it has fetched in the middle of their visit."""
    senses: Senses
    memory: Memory
    holds: DoesPlanHold

    @property
    def plan(self) -> Plan:
        """What is left of the plan."""
        return self.plans[-1]

    def rebind(self, plan: Plan, values: Mapping[str, Inference]) -> None:
        """Update the parameters of all nodes from the same steps of another plan.

        Args:
            plan: The same choices; steps that it does not have stay as they are.
            values: Everyone's parameters, by name.
        """
        self.plans.append(plan)
        steps = {_key(step): step for step in plan.steps}
        people = {step.person for step in plan.steps}
        for node in preorder(self.root):
            if explains(node) and (provenance := node.provenance) and provenance.step.person in people:
                node.provenance = Provenance(_renewed(provenance.step, steps), values[provenance.step.person])
        for meeting in (*self.meetings, *self.returns):
            if meeting.person in people:
                reach, greet = (_renewed(step, steps) for step in (meeting.reach, meeting.greet))
                meeting.rebind(reach, greet, values[meeting.person])


def _key(step: PlanStep) -> tuple[str, tuple[str, ...]]:
    """What a step is known by: to come back to a person is to reach them."""
    return REACH if step.action == RETURN else step.action, step.arguments


def _renewed(step: PlanStep, steps: Mapping[tuple[str, tuple[str, ...]], PlanStep]) -> PlanStep:
    """The same step with the numbers of now; as it was where it is over."""
    return replace(steps.get(_key(step), step), action=step.action)


def build_tree(
    plan: Plan,
    robot: Robot,
    values: Mapping[str, Inference],
    limits: Limits = DEFAULT_LIMITS,
    *,
    senses: Senses | None = None,
    memory: Memory | None = None,
    acts: Mapping[str, MakeAct] = NO_ACTS,
    unserved: Mapping[str, str] = MappingProxyType({}),
    speaker: Speaker = SPEAKER,
) -> Tree:
    """Build the tree of a plan.

    Args:
        plan: Per stop a Reach_user, and then a Greet_person or a Greet_company of the person and companions;
            before it a Fetch and after it an agenda, where there is more to do. Whoever was greeted by an
            earlier plan is not greeted again.
        robot: The robot that executes it.
        values: Everyone's parameters, by name.
        limits: Timeouts, attempts and tolerances.
        senses: Those of the tree before, so that the readings go on.
        memory: What is remembered of the plans before; a new one is the tree's own.
        acts: Behaviours of the user's own in place of the robot's acts, by the act's name.
        unserved: Who is to be served and is not in the plan, and why: the goal is not reached without them.
        speaker: What the robot says, and how it addresses people.

    Raises:
        ValueError: The plan has other actions than these, lacks one of them for a person, or names a
            person whose parameters are not given; or `acts` names an act that must be the robot's.
    """
    if HAND_OVER in acts:
        raise ValueError(
            f"{HAND_OVER} cannot be a behaviour of one's own: what the robot holds depends on it"
        )
    senses = senses or Senses(robot)
    memory = memory or Memory(senses.now_s)
    shared = memory.shared
    shared.outdated = None
    tells_leaving = shared.announced is not None or any(ANNOUNCED in step.parameters for step in plan.steps)
    meetings: list[VisitContext] = []
    returns: list[VisitContext] = []
    branches = []
    for person, steps in _visits(plan).items():
        visit, own = memory.visit(person), _values_of(person, values)
        visit.reach = next(step for step in steps if step.action == REACH)
        visit.greet = greet = _greeting(steps, visit)
        visit.values = own
        meeting = VisitContext(person, robot, senses, limits, visit, shared, acts, speaker, tells_leaving)
        _ = meeting.wanted  # a step without its numbers is refused here
        tasks = agenda_of(steps, meeting)
        meetings.append(meeting)
        returns += [task.meeting for task in tasks if task.meeting is not meeting]
        branches.append(_visited(meeting, tasks, values, greets=greet in steps))
    holds = DoesPlanHold(shared)
    goal = sequence(NodeId("Goal"), [holds, *branches, AreAllGreeted(meetings, unserved)])
    root = EmergencyGuard(goal, robot, senses, shared)
    return Tree(root, [plan], tuple(meetings), tuple(returns), senses, memory, holds)


def _visits(plan: Plan) -> dict[str, list[PlanStep]]:
    """Every person's steps, by the first."""
    visits: dict[str, list[PlanStep]] = {}
    for step in plan.steps:
        if step.action == SKIP:
            continue
        if step.action not in KNOWN:
            raise ValueError(f"no behaviour for action {step.action!r}, known are {', '.join(KNOWN)}")
        visits.setdefault(step.person, []).append(step)
    for person, steps in visits.items():
        actions = [step.action for step in steps]
        before = actions[1:] if actions[0] == FETCH else actions
        after = before[2:] if len(before) > 1 and before[1] in GREETINGS else before[1:]
        if before[:1] != [REACH] or not {FETCH, RETURN, *EFFECTS}.issuperset(after):
            raise ValueError(
                f"the visit of {person} needs {REACH} and then {GREET}, got {', '.join(actions)}"
            )
    return visits


def _greeting(steps: Seq[PlanStep], memory: VisitMemory) -> PlanStep:
    """How the person is greeted, or was by an earlier plan."""
    greet = next((step for step in steps if step.action in GREETINGS), memory.greet)
    if greet is None:
        actions = ", ".join(step.action for step in steps)
        raise ValueError(f"the visit of {steps[0].person} needs {REACH} and then {GREET}, got {actions}")
    return greet


def _values_of(person: str, values: Mapping[str, Inference]) -> Inference:
    if person not in values:
        raise ValueError(
            f"the plan visits {person}, whose parameters are not given (given: {', '.join(values)})"
        )
    return values[person]


def _visited(
    meeting: VisitContext, tasks: Seq[Task], values: Mapping[str, Inference], *, greets: bool
) -> Behaviour:
    person = meeting.person
    over = IsServed(meeting, tasks) if tasks else IsGreeted(meeting)
    achieve = sequence(NodeId.of("Achieve", person), _achieved(meeting, tasks, values, greets=greets))
    return fallback(NodeId.of(VISITED, person), [over, IsGivenUp(meeting), achieve, GiveUp(meeting, achieve)])


def _achieved(
    meeting: VisitContext, tasks: Seq[Task], values: Mapping[str, Inference], *, greets: bool
) -> list[Behaviour]:
    docked = partial(_docked, values=values)
    if not tasks:
        return [docked(meeting), _greet_person(meeting)]
    first = [task for task in tasks if task.fetched_before]
    blocks = [block(task, docked, partial(taken, values=values)) for task in tasks]
    if not greets:
        return [*(taken(task, values) for task in first), *blocks]
    greet = sequence(
        NodeId.of("Achieve", meeting.greet.action, meeting.person),
        [*(brought(task, values) for task in first), docked(meeting), _greet_person(meeting)],
    )
    greeted = fallback(NodeId.of("greeted", meeting.person), [IsGreeted(meeting), greet])
    return [greeted, *blocks]


def _docked(meeting: VisitContext, values: Mapping[str, Inference]) -> Behaviour:
    person, limits, provenance = meeting.person, meeting.limits, meeting.reach_grounds
    timeout = SimulatedTimeout(
        NodeId.of(f"Timeout {limits.reach_timeout_s:g} s", REACH, person),
        _approach(meeting, values),
        duration_s=limits.reach_timeout_s,
        clock=meeting.senses.now_s,
        provenance=provenance,
        limit="reach_s",
        under_way=lambda: meeting.robot.motion().text,
    )
    retry = Retry(
        NodeId.of(f"Retry {limits.reach_attempts}", person),
        timeout,
        attempts=limits.reach_attempts,
        pause_s=limits.reach_pause_s,
        clock=meeting.senses.now_s,
        provenance=provenance,
    )
    docked = fallback(NodeId.of(DOCKED, person), [IsDocked(meeting), retry])
    return stop_told(meeting, docked) if is_announced(meeting) else docked


def _approach(meeting: VisitContext, values: Mapping[str, Inference]) -> Behaviour:
    reach: Behaviour = _reach_user(meeting)
    if is_announced(meeting):
        reach = coming_told(meeting, reach)
    if meeting.tells_leaving:
        leave = leave_told(meeting, (meeting.person,), meeting.reach_grounds, values, goes_to=meeting.person)
        reach = sequence(NodeId.of("Leave_and_reach", meeting.person), [leave, reach])
    return parallel_until_one(  # Pass never succeeds by itself: Reach_user decides
        NodeId.of("Approach", meeting.person), [passing(way_to(meeting), values), reach]
    )


def _reach_user(meeting: VisitContext) -> Behaviour:
    return sequence(
        NodeId.of(REACH, meeting.person),
        [NavigateToUser(meeting), DockToUser(meeting), FaceUser(meeting)],
        memory=True,
    )


def _greet_person(meeting: VisitContext) -> Behaviour:
    perform = parallel_until_all(
        NodeId.of("Perform", meeting.person),
        [*(_done(meeting, act) for act in meeting.acts), *_attended(meeting)],
    )
    return parallel_until_one(  # Keep_distance never ends by itself: Perform decides
        NodeId.of(meeting.greet.action, meeting.person), [KeepDistance(meeting), perform]
    )


def _attended(meeting: VisitContext) -> list[Behaviour]:
    return [AttendTo(meeting)] if meeting.limits.attend_s > 0.0 else []


def _act(meeting: VisitContext, act: str) -> Behaviour:
    make = meeting.custom.get(act)
    return CustomAct(act, (meeting.person,), make, meeting) if make else Act(meeting, act)


def _done(meeting: VisitContext, act: str) -> Behaviour:
    patience_s = meeting.limits.act_timeout_s / min(1.0, meeting.manner.rate)  # slow speech takes its time
    timeout = ActTimeout(
        NodeId.of(f"Timeout {patience_s:g} s", act, meeting.person),
        _act(meeting, act),
        duration_s=patience_s,
        pause_s=meeting.limits.act_pause_s,
        clock=meeting.senses.now_s,
        provenance=meeting.greet_grounds,
    )
    return fallback(NodeId.of("done", act, meeting.person), [IsActDone(meeting, act), timeout])
