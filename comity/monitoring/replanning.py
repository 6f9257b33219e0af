"""Replanning: updates parameters if the choices are known to stay optimal, else makes a new plan.

The world as currently believed replaces the scenario's start: the robot's pose and load, everyone's pose and
current parameters, who is left, and the tasks left. People who block the only path are assumed to make way
when asked.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import chain
from math import dist
from time import monotonic
from typing import TYPE_CHECKING

from comity.monitoring.belief_state import BeliefState, moment_of
from comity.monitoring.lateness import told_late, without_missed
from comity.monitoring.may_unblock import what_may_help
from comity.monitoring.parameter_updates import ParameterUpdate
from comity.monitoring.plan_validity import choices, found_again, known, other_ways, verdict
from comity.monitoring.remaining_goals import RemainingGoals
from comity.monitoring.world_changes import MOVED_M, Watch, WorldChange, differences
from comity.parameters.passing import asked_speed_m_s, own_distance_m
from comity.planning.request import PlanningRequest
from comity.planning.serving import plan_for_most
from comity_domain import (
    Plan,
    PlanningFailed,
    kept_cost,
    kept_late,
    not_permitted,
    plan_with,
    rebind,
    renumbered,
    rest_of,
    same_choices,
    without,
)
from comity_executor import Cause, ExecutionState, NoPlanUpdate, PlanUpdate
from comity_fis import InputError
from comity_sim2d import PastPeople, Scene, SceneError

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable

    from comity.environment import Environment
    from comity.preparation import PlannedEpisode
    from comity_fis import Inference


class WorldPlanner:
    """Replans from the believed world; implements the executor's `Planner`.

    Args:
        prepared: The scenario with its first plan.
        world: The world; its robot knows people's positions and which doors are shut.
    """

    def __init__(self, prepared: PlannedEpisode, world: Environment) -> None:
        self._prepared = prepared
        self._world = world
        self._values = dict(prepared.values)
        self._told: list[ParameterUpdate] = []
        self._watch = Watch(world)
        self._before = self._now()
        self._met = {visitee.name for visitee in prepared.visitees} - prepared.asked.unreachable.keys()
        """People to whom there was a route at some time."""
        self._walkers = {person.name for person in prepared.scene.people if person.walk}
        self._moved: set[str] = set()
        """People who moved, not yet reported to the execution."""
        self._barred = dict(prepared.asked.unreachable)
        """People without a route at the start, with the reason; reported with the first plan that serves
        them."""
        self._skipped: dict[str, str] = {}
        """People left out during the episode, with the reason."""

    def tell(self, person: str, values: Inference, text: str) -> None:
        """A person's parameters are others from now on; the robot keeps to them on its way at once.

        Args:
            person: Who.
            values: All their parameters.
            text: What changed, in words.

        Raises:
            KeyError: if nobody is called so.
        """
        before = self._values[person]
        self._watch.tell(WorldChange(person, text))
        for news in differences(person, before, values):
            self._watch.tell(news)
        self._values[person] = values
        self._told.append(ParameterUpdate(self._world.time_s, person, values, text))
        self._world.robot.learn(person, distance_m=own_distance_m(values), speed_m_s=asked_speed_m_s(values))

    def skip(self, person: str, reason: str) -> None:
        """Leave a person out from now on.

        Raises:
            KeyError: if nobody is called so.
        """
        if person not in self._values:
            raise KeyError(person)
        self._skipped[person] = reason
        self._watch.tell(WorldChange(person, reason))

    @property
    def told(self) -> tuple[ParameterUpdate, ...]:
        """All that it was told so far, in order."""
        return tuple(self._told)

    def note(self, about: str, text: str, fault: str | None) -> None:
        """Something happens, or does not, that the trace is to tell.

        Args:
            about: The person or thing it is about.
            text: What it is, in words.
            fault: What is behind it, if one is.
        """
        self._watch.note(WorldChange(about, text, fault=fault))

    def has_news(self, t: float) -> bool:
        """Whether a person's parameters or a door changed, or a person moved and stands still again."""
        return self._watch.has_news(t)

    def review(self, course: ExecutionState) -> PlanUpdate | None:
        """New numbers where the choices are known to stay the cheapest, else another plan, within the cap.

        What a person no longer permits, or asked for otherwise, is never done: no cap holds against that.
        People say only so much, so that every run ends still.
        """
        was_told = self._watch.was_told
        because = tuple(cause for one in self._take_news() for cause in one.causes)
        revision = self._reviewed(course, was_told=was_told, because=because)
        return replace(revision, was_asked_for=was_told, moved=self._tell_moved())

    def _reviewed(self, course: ExecutionState, *, was_told: bool, because: tuple[Cause, ...]) -> PlanUpdate:
        try:
            asked = self._asked(course)
            rest = rest_of(course.plan, course.done, course.progress)
            rebound = None if asked.unreachable else rebind(rest, asked.request)
            if rebound is not None:
                return self._same(rebound, (*because, known(rebound)))
            kept = None if asked.unreachable else kept_cost(rest, asked.request)
            if not course.may_replan and not (was_told and kept is None):
                return self._as_planned(course, because, "the limit of new plans is reached")
            asked, plan = self._plan(asked, course)
        except (InputError, PlanningFailed, ValueError) as error:
            return self._without_forbidden(course, because) or self._as_planned(course, because, str(error))
        if same_choices(rest, plan) and asked.unreachable.keys() == course.unserved.keys():
            return self._same(plan, (*because, found_again(plan)))
        too_late = None if kept is None else kept_late(rest, asked.request)
        why = verdict(rest, kept, plan, asked.unreachable, too_late and too_late.after(course.t))
        return self._new(plan, asked, (*because, why, *choices(rest, plan)))

    def permitted(self, course: ExecutionState) -> PlanUpdate | None:
        """The plan without what a person permits no more, told without planning; None where all of it is."""
        return self._without_forbidden(course, ())

    def _without_forbidden(self, course: ExecutionState, because: tuple[Cause, ...]) -> PlanUpdate | None:
        rest = rest_of(course.plan, course.done, course.progress)
        # Full hands are no ban: what is planned with them was planned for them.
        visitees = RemainingGoals(self._prepared, self._values, carried=None).visitees(course)
        against = not_permitted(rest, {visitee.name: visitee for visitee in visitees})
        if not against:
            return None
        left_out = {
            name: against[step.person]
            for step in rest.steps
            if step.person in against
            for name in step.people
        }
        told = tuple(
            Cause("condition", f"no longer permitted: {reason}", None) for reason in against.values()
        )
        return PlanUpdate(
            without(rest, against),
            dict(self._values),
            replanned=True,
            because=(*because, *told),
            unserved={**course.unserved, **left_out},
            was_asked_for=True,
        )

    def replan(self, course: ExecutionState) -> PlanUpdate | NoPlanUpdate:
        """Another plan for the people who are left, or why there is none."""
        because = course.failed
        try:
            before, news = self._before, self._take_news()
            if course.in_pause and not self._bears_on_who_is_left(news, before, course):
                return NoPlanUpdate(())
            because = (*because, *(cause for one in news for cause in one.causes))
            asked = self._asked(course)
            asked, plan = self._planned_even_late(asked, course)
        except SceneError as error:
            overlap = f"no new plan while {error.entity} and others seem to be in one place: {error.got}"
            return NoPlanUpdate((*because, Cause("condition", overlap, None)), may_pass=True)
        except (InputError, PlanningFailed, ValueError) as error:
            return NoPlanUpdate((*because, Cause("condition", f"no new plan: {error}", None)))
        if not plan.steps:
            reasons = (f"{person}: {why}" for person, why in asked.unreachable.items())
            no_plan = Cause("condition", f"no new plan: {'; '.join(reasons)}", None)
            robot, refused = self._world.robot, self._refused(course)
            unseen = [
                name for name in asked.unreachable if name not in self._skipped and robot.would_see(name)
            ]
            hope = self._hope(course, asked, unseen, refused)
            watched = (name for name in refused if robot.has_to_watch(name))
            look_for = next(chain(watched, unseen), None)
            return NoPlanUpdate((*because, no_plan), awaits=hope, look_for=look_for)
        served = dict.fromkeys(step.person for step in plan.steps)
        barred = [
            Cause("condition", f"{name} at the start: {self._barred.pop(name)}", None)
            for name in served
            if name in self._barred
        ]
        left = ", ".join(served)
        told = Cause("condition", f"a new plan for {left} from here costs {plan.cost} cm", float(plan.cost))
        late = told_late(self._prepared.visitees, asked.request.visitees)
        return replace(self._new(plan, asked, (*because, *barred, told, *late)), moved=self._tell_moved())

    def _same(self, plan: Plan, because: tuple[Cause, ...]) -> PlanUpdate:
        return PlanUpdate(plan, dict(self._values), replanned=False, because=because)

    def _as_planned(self, course: ExecutionState, because: tuple[Cause, ...], reason: str) -> PlanUpdate:
        """The choices stay although they may not be the cheapest: only the numbers are new."""
        plan = renumbered(rest_of(course.plan, course.done, course.progress), self._values)
        stays = Cause(
            "condition", f"the choices stay as planned, whether or not they are the best: {reason}", None
        )
        return self._same(plan, (*because, stays))

    def _new(self, plan: Plan, asked: PlanningRequest, because: tuple[Cause, ...]) -> PlanUpdate:
        values = dict(self._values)
        self._world.robot.learn_places(asked.places)
        return PlanUpdate(plan, values, replanned=True, because=because, unserved=asked.unreachable)

    def _plan(self, asked: PlanningRequest, course: ExecutionState) -> tuple[PlanningRequest, Plan]:
        limit_s = self._prepared.file.scenario.limits.planning_s
        make = partial(plan_with, self._prepared.engine, time_limit_s=limit_s)
        scene = self._scene(self._now())
        return plan_for_most(asked, scene, PastPeople(scene, self._refused(course)), make)

    def _planned_even_late(
        self, asked: PlanningRequest, course: ExecutionState
    ) -> tuple[PlanningRequest, Plan]:
        """A plan, without the deadlines that no order keeps any more; and what was asked with the others."""
        ends_s = monotonic() + self._prepared.file.scenario.limits.planning_s
        try:
            return self._plan(asked, course)
        except PlanningFailed:
            late = replace(asked, request=without_missed(asked.request, ends_s=ends_s))
            if late.request.visitees == asked.request.visitees:
                raise
        return self._plan(late, course)

    def _asked(self, course: ExecutionState) -> PlanningRequest:
        """The request for the people who are left, from here and now."""
        asked = self._remaining(course).asked(course, self._scene(self._now()))
        self._met |= {visitee.name for visitee in asked.request.visitees}
        return asked

    def _remaining(self, course: ExecutionState) -> RemainingGoals:
        return self._remaining_in(self._now(), course)

    def _remaining_in(self, moment: BeliefState, course: ExecutionState) -> RemainingGoals:
        return RemainingGoals(
            self._prepared,
            moment.values,
            self._world.robot.carried(),
            self._refused(course),
            {**moment.lost, **self._skipped},
            moment.walking,
        )

    def _refused(self, course: ExecutionState) -> tuple[str, ...]:
        """Who was asked in vain and has not moved since, and the people they stand together with."""
        alone = [name for name in course.refused if name not in self._moved]
        groups = [group.members for group in self._scene(self._now()).groups] if alone else []
        fellows = [name for members in groups if not set(members).isdisjoint(alone) for name in members]
        return tuple(dict.fromkeys((*alone, *fellows)))

    def _bears_on_who_is_left(
        self, news: Iterable[WorldChange], before: BeliefState, course: ExecutionState
    ) -> bool:
        """Whether a person moved who is left or was asked to make way, or there are other ways now."""
        left = {visitee.name for visitee in self._prepared.visitees} - set(course.done)
        if any(one.about in {*left, *course.asked} for one in news if not one.was_told):
            return True
        then = self._remaining_in(before, course).asked(course, self._scene(before))
        return other_ways(then, self._remaining(course).asked(course, self._scene(self._now())))

    def _hope(
        self, course: ExecutionState, asked: PlanningRequest, unseen: Iterable[str], refused: Collection[str]
    ) -> str | None:
        """What may give a way to anybody who has none."""
        moment, visitees = self._now(), self._remaining(course).visitees(course)
        scene = self._scene(moment)
        found = (
            what_may_help(scene, visitee, met=self._met, walkers=self._walkers, refused=refused)
            for visitee in visitees
            if visitee.name in asked.unreachable.keys() - moment.absent - self._skipped.keys()
        )
        otherwise = (f"{name}, {self._unseen}, may stand otherwise by now" for name in unseen)
        return "; ".join(dict.fromkeys(filter(None, (*otherwise, *found)))) or None

    @property
    def _unseen(self) -> str:
        """Why the robot has no current position of a person, in words."""
        delay_s = self._prepared.scene.robot.sensor.delay_s
        if self._world.robot.now_s() < delay_s - 1e-9:
            return "not measured yet"
        return f"not in view {delay_s:g} s ago" if delay_s else "not in view"

    def _now(self) -> BeliefState:
        visited = [visitee.name for visitee in self._prepared.visitees]
        return moment_of(self._world, self._values, visited)

    def _scene(self, moment: BeliefState) -> Scene:
        """As everything is or was, with the robot here: where a person was, it may stand by now."""
        return moment.scene(self._prepared.scene, self._world.robot.pose)

    def _take_news(self) -> tuple[WorldChange, ...]:
        then = {person.name: person for person in self._before.people}
        self._before = self._now()
        people = self._before.people
        self._moved |= {one.name for one in people if dist(one.xy, then[one.name].xy) > MOVED_M}
        return self._watch.take()

    def _tell_moved(self) -> tuple[str, ...]:
        moved, self._moved = tuple(sorted(self._moved)), set()
        return moved
