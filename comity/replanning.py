"""What to do when things change: new numbers where the choice is known to stay the best, else a new plan.

The world as the robot believes it to be now takes the place of the scenario's start: where it is, where
everybody stands, who is left, and everybody's parameters of now. Whoever stands in the only way is taken to
make way when asked.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import degrees, dist
from typing import TYPE_CHECKING

from comity.circumstances import circumstances
from comity.request import Asked, ask
from comity_domain import (
    Plan,
    PlanningFailed,
    Visitee,
    kept_cost,
    make_plan,
    rebind,
    renumbered,
    rest_of,
)
from comity_executor import Cause, Course, NoRevision, Revision
from comity_fis import InputError
from comity_sim2d import PastPeople, Scene, wrap_angle

if TYPE_CHECKING:
    from comity.preparation import Prepared
    from comity_fis import Inference
    from comity_sim2d import Person, World

MOVED_M, TURNED_DEG = 0.5, 45.0
"""Somebody who stands so far from where they were planned with, or faces elsewhere, is news; our choice. The
robot follows smaller moves without another look at the plan."""
NOT_ANEW = "visits with more than a greeting are not planned anew: what of them is done stands in no plan"

SETTLED_M, SETTLED_S = 0.1, 0.5
"""A plan is reviewed once whoever moved has stayed within so much for so long."""


@dataclass(frozen=True, slots=True)
class News:
    """Something changed about somebody or something."""

    about: str
    text: str
    value: float | None = None
    fault: str | None = None


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
        self._told: list[News] = []
        self._planned_with = self._people()
        self._doors = world.doors
        self._seen = self._people()
        self._seen_s = 0.0
        self._has_agendas = any(visitee.agenda for visitee in prepared.visitees)

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
        self._told.append(News(person, text))
        self._told += _differences(person, before, values)
        self._values[person] = values

    def has_news(self, t: float) -> bool:
        """Whether somebody's parameters or a door changed, or somebody moved and stands still again."""
        return not self._has_agendas and (
            bool(self._told) or self._world.doors != self._doors or (self._look(t) and any(self._changed()))
        )

    def review(self, course: Course) -> Revision | None:
        """New numbers where the choices are known to stay the cheapest, else another plan, within the cap."""
        because = self._take_news()
        try:
            asked = self._asked(course)
            rest = rest_of(course.plan, course.done)
            rebound = None if asked.unreachable else rebind(rest, asked.request)
            if rebound is not None:
                return self._same(rebound, (*because, _known(rebound)))
            if not course.may_replan:
                return self._as_planned(course, because, "the limit of new plans is reached")
            plan = self._plan(asked)
        except (InputError, PlanningFailed, ValueError) as error:
            return self._as_planned(course, because, str(error))
        verdict = _verdict(rest, kept_cost(rest, asked.request), plan, asked.unreachable)
        return self._new(plan, asked, (*because, verdict, *_choices(rest, plan)))

    def replan(self, course: Course) -> Revision | NoRevision:
        """Another plan for whoever is left, or why there is none."""
        if self._has_agendas:
            return NoRevision((Cause("condition", NOT_ANEW),))
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
        plan = renumbered(rest_of(course.plan, course.done), self._values)
        stays = Cause("condition", f"the choices stay as planned, whether or not they are the best: {reason}")
        return self._same(plan, (*because, stays))

    def _new(self, plan: Plan, asked: Asked, because: tuple[Cause, ...]) -> Revision:
        values = dict(self._values)
        return Revision(plan, values, replanned=True, because=because, unserved=asked.unreachable)

    def _plan(self, asked: Asked) -> Plan:
        limits = self._prepared.file.scenario.limits
        return make_plan(asked.request, time_limit_s=limits.planning_s, memory_mb=limits.planning_mb)

    def _asked(self, course: Course) -> Asked:
        """The request for whoever is left, from here and now.

        Raises:
            SceneError: if somebody stands where no plan can be reckoned from, such as in the robot.
        """
        self._planned_with, self._doors = self._people(), self._world.doors
        prepared, scene = self._prepared, self._scene()
        visitees = tuple(
            self._visitee(each, course.t) for each in prepared.visitees if each.name not in course.done
        )
        return ask(
            scene,
            PastPeople(scene),
            visitees,
            groups=prepared.file.scenario.groups,
            attend_s=prepared.attend_s,
        )

    def _visitee(self, visitee: Visitee, t: float) -> Visitee:
        """The same with what holds now; a deadline that is over is none any more."""
        name, values = visitee.name, self._values[visitee.name]
        now = circumstances(self._prepared.file.scenario, name, values, self._prepared.rulebook)
        by_s = visitee.by_s - t if visitee.by_s is not None and visitee.by_s > t else None
        return replace(visitee, values=values, now=now, by_s=by_s)

    def _scene(self) -> Scene:
        robot, before = self._world.robot.pose, self._prepared.scene
        return replace(
            before,
            doors=self._doors,
            robot=replace(before.robot, x_m=robot.x_m, y_m=robot.y_m, heading_rad=robot.heading_rad),
            people=tuple(
                replace(person, personal_distance_m=self._values[name]["conversational_distance"].number)
                for name, person in self._planned_with.items()
            ),
        )

    def _people(self) -> dict[str, Person]:
        return {person.name: person for person in self._world.robot.people}

    def _look(self, t: float) -> bool:
        """Whether everybody has stood still since the last look, which is some time ago."""
        if t - self._seen_s < SETTLED_S:
            return False
        before, self._seen, self._seen_s = self._seen, self._people(), t
        return all(dist(person.xy, before[name].xy) <= SETTLED_M for name, person in self._seen.items())

    def _changed(self) -> Iterator[News]:
        for door, now in zip(self._doors, self._world.doors, strict=True):
            if door != now:
                text = f"the {now.name} was {'opened' if now.is_open else 'shut'}"
                yield News(now.name, text, fault=self._world.troubles.of(now.name))
        for name, person in self._people().items():
            before = self._planned_with[name]
            moved_m = dist(person.xy, before.xy)
            turned_deg = abs(degrees(wrap_angle(person.heading_rad - before.heading_rad)))
            if moved_m > MOVED_M:
                yield News(name, f"{name} moved by {moved_m:.2f} m", moved_m)
            elif turned_deg > TURNED_DEG:
                yield News(name, f"{name} turned by {turned_deg:.0f} deg", turned_deg)

    def _take_news(self) -> tuple[Cause, ...]:
        news, self._told = (*self._told, *self._changed()), []
        return tuple(cause for each in news for cause in _causes(each))


def _causes(news: News) -> Iterator[Cause]:
    if news.fault is not None:
        yield Cause("fault", news.fault)
    yield Cause("reading", news.text, news.value)


def _differences(person: str, before: Inference, after: Inference) -> Iterator[News]:
    """The parameters that are others now, with what they were."""
    for name, value in after.parameters.items():
        old = before.parameters.get(name)
        if old is None or old.value == value.value:
            continue
        if isinstance(value.value, str) or isinstance(old.value, str):
            yield News(person, f"{name} of {person} {old.value} -> {value.value} ({value.origin})")
        else:
            words = f"{old.value:.4f} -> {value.value:.4f} ({value.origin})"
            yield News(person, f"{name} of {person} {words}", float(value.value))


def _known(plan: Plan) -> Cause:
    """How it is known that the choices are the cheapest."""
    text = (
        f"the choices stay: they cost {plan.cost} cm now, and an exact search over all orders, sides and "
        "greetings finds nothing cheaper"
    )
    return Cause("condition", text, float(plan.cost))


def _verdict(rest: Plan, kept: int | None, plan: Plan, unreachable: Mapping[str, str]) -> Cause:
    """Why the choices fall, in numbers."""
    if unreachable:
        reasons = "; ".join(f"{person}: {why}" for person, why in unreachable.items())
        return Cause("condition", f"not everybody can be served as planned: {reasons}")
    if kept is None:
        return Cause("condition", f"a choice of the plan is not open any more; the best costs {plan.cost} cm")
    text = f"the choices would cost {kept} cm now, others {plan.cost} cm"
    return Cause("condition", text, float(kept - plan.cost))


def _choices(rest: Plan, plan: Plan) -> Iterator[Cause]:
    """The steps that differ, before and after."""
    before = [f"{step.action}({', '.join(step.arguments)})" for step in rest.steps]
    after = [f"{step.action}({', '.join(step.arguments)})" for step in plan.steps]
    for old in (step for step in before if step not in after):
        yield Cause("step", f"no longer {old}")
    for new in (step for step in after if step not in before):
        yield Cause("step", f"instead {new}")
    if sorted(before) == sorted(after):
        yield Cause("step", f"in the order {', '.join(dict.fromkeys(step.person for step in plan.steps))}")
