"""Who is left to be visited while a plan is under way, and what is left to be done with them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from comity.planning.circumstances import circumstances
from comity.planning.request import PlanningRequest, ask
from comity_sim2d import PastPeople, Scene

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode
    from comity_domain import Visitee
    from comity_executor import ExecutionState
    from comity_fis import Inference


@dataclass(frozen=True, slots=True)
class RemainingGoals:
    """What holds now, in the place of what held at the scenario's start."""

    prepared: PlannedEpisode
    values: Mapping[str, Inference]
    carried: str | None
    """What the robot has fetched."""
    refused: Collection[str] = ()
    """Who was asked to make way in vain: no way is planned past them."""
    lost: Mapping[str, str] = field(default_factory=dict)
    """Of whom it does not know where they are, and why."""
    walking: Collection[str] = ()
    """Who is going somewhere: they turn round."""

    def asked(self, course: ExecutionState, scene: Scene) -> PlanningRequest:
        """The request for the people who are left, from where everybody is now.

        What the robot has fetched is for the first who is to get such a thing and can be served; where there
        is nobody, its hands are full with it.
        """
        waiting = [name for name, visit in course.progress.items() if visit.taken and name not in course.done]
        for bearer in waiting:
            asked = self._asked_with(course, scene, bearer)
            if bearer not in asked.unreachable:
                return asked
        return self._asked_with(course, scene, None)

    def visitees(self, course: ExecutionState, bearer: str | None = None) -> tuple[Visitee, ...]:
        """Who is left, with what holds of them now.

        Args:
            course: How far the execution is.
            bearer: For whom the robot holds something.
        """
        return tuple(
            self._visitee(each, course, bearer)
            for each in self.prepared.visitees
            if each.name not in course.done
        )

    def _asked_with(self, course: ExecutionState, scene: Scene, bearer: str | None) -> PlanningRequest:
        return ask(
            scene,
            PastPeople(scene, self.refused, walkers=self.walking),
            self.visitees(course, bearer),
            groups={group.name: group.members for group in scene.groups},
            lost=self.lost,
            attend_s=self.prepared.attend_s,
        )

    def _visitee(self, visitee: Visitee, course: ExecutionState, bearer: str | None) -> Visitee:
        """The same with what holds now; a deadline that is over is none any more."""
        name, values = visitee.name, self.values[visitee.name]
        prepared = self.prepared
        profile, scenario = prepared.profiles[name], prepared.file.scenario
        now = circumstances(scenario, name, values, prepared.rulebook, profile=profile, day=prepared.day)
        if self.carried is not None and bearer is None:
            now = replace(now, robot_carries=self.carried)
        by_s = visitee.by_s - course.t if visitee.by_s is not None and visitee.by_s > course.t else None
        return _under_way(replace(visitee, values=values, now=now, by_s=by_s), course, bearer)


def _under_way(visitee: Visitee, course: ExecutionState, bearer: str | None) -> Visitee:
    """What is left of a visit; nobody whose visit was begun is left out at a price, or greeted again."""
    in_hand, progress = visitee.name == bearer, course.progress.get(visitee.name)
    if progress is None or not (progress.greeted or in_hand):
        return visitee
    begun = replace(
        visitee,
        agenda=visitee.agenda[len(visitee.agenda) - progress.tasks_left :],
        greeted=progress.greeted,
        in_hand=in_hand,
        skip_m=None,
    )
    return replace(begun, by_s=None, priority_m=0.0) if begun.greeted else begun
