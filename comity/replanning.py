"""What to do when things change: new numbers where the choice is known to stay the best, else a new plan.

The world as the robot believes it to be now takes the place of the scenario's start: where it is, what it
holds, where everybody stands, who is left, what is left to be done with them, and everybody's parameters of
now. Whoever stands in the only way is taken to make way when asked.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity.news import News, Watch, differences
from comity.remaining import Remaining
from comity.request import Asked
from comity.verdict import choices, known, verdict
from comity_domain import Plan, PlanningFailed, kept_cost, make_plan, rebind, renumbered, rest_of
from comity_executor import Cause, Course, NoRevision, Revision
from comity_fis import InputError
from comity_sim2d import Scene

if TYPE_CHECKING:
    from comity.preparation import Prepared
    from comity_fis import Inference
    from comity_sim2d import World


class WorldPlanner:
    """Plans again with the world as it is; it is the executor's `Planner`.

    Args:
        prepared: The scenario with its first plan.
        world: Its robot knows where everybody is, and which doors are shut.
    """

    def __init__(self, prepared: Prepared, world: World) -> None:
        self._prepared = prepared
        self._world = world
        self._values = dict(prepared.values)
        self._watch = Watch(world)

    def tell(self, person: str, values: Inference, text: str) -> None:
        """Somebody's parameters are others from now on.

        Args:
            person: Who.
            values: All their parameters.
            text: What changed, in words.

        Raises:
            KeyError: if nobody is called so.
        """
        before = self._values[person]
        self._watch.tell(News(person, text))
        for news in differences(person, before, values):
            self._watch.tell(news)
        self._values[person] = values

    def has_news(self, t: float) -> bool:
        """Whether somebody's parameters or a door changed, or somebody moved and stands still again."""
        return self._watch.has_news(t)

    def review(self, course: Course) -> Revision | None:
        """New numbers where the choices are known to stay the cheapest, else another plan, within the cap.

        What somebody no longer permits, or asked for otherwise, is never done: no cap holds against that.
        People say only so much, so that every run ends still.
        """
        was_told, because = self._watch.was_told, self._take_news()
        try:
            asked = self._asked(course)
            rest = rest_of(course.plan, course.done, course.progress)
            rebound = None if asked.unreachable else rebind(rest, asked.request)
            if rebound is not None:
                return self._same(rebound, (*because, known(rebound)))
            kept = None if asked.unreachable else kept_cost(rest, asked.request)
            if not course.may_replan and not (was_told and kept is None):
                return self._as_planned(course, because, "the limit of new plans is reached")
            plan = self._plan(asked)
        except (InputError, PlanningFailed, ValueError) as error:
            return self._as_planned(course, because, str(error))
        why = verdict(rest, kept, plan, asked.unreachable)
        return self._new(plan, asked, (*because, why, *choices(rest, plan)))

    def replan(self, course: Course) -> Revision | NoRevision:
        """Another plan for whoever is left, or why there is none."""
        because = (
            *(Cause("reading", f"{person} was not served: {why}") for person, why in course.failures.items()),
            *self._take_news(),
        )
        try:
            asked = self._asked(course)
            plan = self._plan(asked)
        except (InputError, PlanningFailed, ValueError) as error:
            return NoRevision((*because, Cause("condition", f"no new plan: {error}")))
        if not plan.steps:
            reasons = (f"{person}: {why}" for person, why in asked.unreachable.items())
            return NoRevision((*because, Cause("condition", f"no new plan: {'; '.join(reasons)}")))
        left = ", ".join(dict.fromkeys(step.person for step in plan.steps))
        told = Cause("condition", f"a new plan for {left} from here costs {plan.cost} cm", float(plan.cost))
        return self._new(plan, asked, (*because, told))

    def _same(self, plan: Plan, because: tuple[Cause, ...]) -> Revision:
        return Revision(plan, dict(self._values), replanned=False, because=because)

    def _as_planned(self, course: Course, because: tuple[Cause, ...], reason: str) -> Revision:
        """The choices stay although they may not be the cheapest: only the numbers are new."""
        plan = renumbered(rest_of(course.plan, course.done, course.progress), self._values)
        stays = Cause("condition", f"the choices stay as planned, whether or not they are the best: {reason}")
        return self._same(plan, (*because, stays))

    def _new(self, plan: Plan, asked: Asked, because: tuple[Cause, ...]) -> Revision:
        values = dict(self._values)
        return Revision(plan, values, replanned=True, because=because, unserved=asked.unreachable)

    def _plan(self, asked: Asked) -> Plan:
        limits = self._prepared.file.scenario.limits
        return make_plan(asked.request, time_limit_s=limits.planning_s, memory_mb=limits.planning_mb)

    def _asked(self, course: Course) -> Asked:
        """The request for whoever is left, from here and now."""
        world = self._world
        return Remaining(self._prepared, self._scene(), self._values, world.robot.carried()).asked(course)

    def _scene(self) -> Scene:
        robot, before = self._world.robot.pose, self._prepared.scene
        return replace(
            before,
            doors=self._watch.doors,
            robot=replace(before.robot, x_m=robot.x_m, y_m=robot.y_m, heading_rad=robot.heading_rad),
            people=tuple(
                replace(person, personal_distance_m=self._values[name]["conversational_distance"].number)
                for name, person in self._watch.planned_with.items()
            ),
        )

    def _take_news(self) -> tuple[Cause, ...]:
        return tuple(cause for news in self._watch.take() for cause in news.causes)
