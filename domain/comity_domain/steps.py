"""The steps of a tour, each with its full-precision parameters, its cost and its reasons."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from comity_domain.choices.options import Options
from comity_domain.explanation.agenda_reason import why_this_fetching, why_this_offer, why_this_task
from comity_domain.explanation.company_reason import why_this_company
from comity_domain.explanation.reason import (
    why_this_farewell,
    why_this_greeting,
    why_this_return,
    why_this_side,
)
from comity_domain.plans.actions import (
    FETCH,
    GREET,
    GREET_TOGETHER,
    LEAVE,
    OFFER,
    REACH,
    RETURN,
    TOLD,
)
from comity_domain.plans.plan import PlanStep, StepExplanation
from comity_domain.problem.agenda import Offer, PlainTask, TakeLeave, Task
from comity_domain.problem.bound_parameters import BEARING, DISTANCE, SPEED
from comity_domain.problem.spot import START, Spot, location
from comity_domain.tours.tour import PlannedVisit, farewell_cost, greeting_parts, served


def steps_of(visits: Sequence[PlannedVisit], choices: Options, around: Options) -> Iterator[PlanStep]:
    """The steps of a tour.

    Args:
        visits: The tour.
        choices: Among what it was chosen, with all measured that it takes.
        around: The same with all measured that one visit made otherwise would take; for the reasons.
    """
    parts = greeting_parts(visits, choices)
    for index in range(len(visits)):
        yield from _Steps(index, visits, choices, around).all(parts[index])


@dataclass(frozen=True, slots=True)
class _Steps:
    """The steps of one visit."""

    index: int
    visits: Sequence[PlannedVisit]
    choices: Options
    around: Options

    @property
    def visit(self) -> PlannedVisit:
        return self.visits[self.index]

    @property
    def robot_and_person(self) -> tuple[str, str]:
        return self.choices.robot, self.visit.spot.place

    def all(self, greeting: Mapping[str, int]) -> Iterator[PlanStep]:
        here = self.visits[self.index - 1].last_spot if self.index else START
        person = self.choices.people[self.visit.spot.place]
        agenda = person.agenda
        if self.visit.bringing and not person.in_hand:
            first = next(task for task in agenda if isinstance(task, Offer))
            yield self._fetch(first, here)
            here = location(first.place)
        why = why_this_side(self.index, self.visits, self.around)
        yield self._reach(here, self.visit.spot, REACH, why)
        if self.visit.way is not None:
            yield self._greet(self.visit.way, greeting)
        yield from self._agenda(agenda)

    def _agenda(self, agenda: Sequence[Task]) -> Iterator[PlanStep]:
        here, returns, in_hand = self.visit.spot, enumerate(self.visit.returns), self.visit.bringing
        for task in agenda:
            if isinstance(task, Offer) and not in_hand:
                trip, spot = next(returns)
                yield self._fetch(task, here)
                why = why_this_return(task, trip, self.index, self.visits, self.around)
                yield self._reach(location(task.place), spot, RETURN, why)
                here = spot
            in_hand = in_hand and not isinstance(task, Offer)
            yield self._task(task, here)

    def _task(self, task: Task, here: Spot) -> PlanStep:
        values = self.choices.people[here.place].values
        match task:
            case PlainTask():
                shaped = {name: values[name].value for name in task.shaped_by if name in values.parameters}
                why = why_this_task(task, here.place, values)
                return self._act(task.action, task.arguments, {**task.parameters, **shaped}, why)
            case Offer():
                why = why_this_offer(task, here, self.around)
                modality = "gestural" if self.choices.people[here.place].silent else "both"
                given = {"thing": task.thing, "modality": modality}
                return self._act(OFFER, (task.thing,), {**self._place(here), **given}, why)
            case TakeLeave():
                return self._leave()

    def _act(
        self,
        action: str,
        choice: tuple[str, ...],
        parameters: Mapping[str, float | str],
        why: StepExplanation,
    ) -> PlanStep:
        """Something that is done before the person; it costs nothing, as there is no other way to do it."""
        return PlanStep(
            action, (*self.robot_and_person, *choice), origin=None, parameters=parameters, cost=0, why=why
        )

    def _place(self, spot: Spot) -> dict[str, float | str]:
        values = self.choices.people[spot.place].values
        return {
            DISTANCE: values[DISTANCE].number,
            BEARING: self.choices.side(spot).bearing_deg,
        }

    def _fetch(self, offer: Offer, start: Spot) -> PlanStep:
        cost = self.choices.legs[start, location(offer.place)]
        return PlanStep(
            FETCH,
            (*self.robot_and_person, offer.thing, offer.place),
            origin=(start.place, start.side),
            parameters={"thing": offer.thing, "place": offer.place},
            cost=cost,
            why=why_this_fetching(offer, self.index, self.visits, self.around),
            cost_parts={"travel": cost},
        )

    def _reach(self, start: Spot, spot: Spot, action: str, why: StepExplanation) -> PlanStep:
        person = self.choices.people[spot.place]
        values = person.values
        return PlanStep(
            action,
            (*self.robot_and_person, spot.side),
            origin=(start.place, start.side),
            parameters={
                DISTANCE: values[DISTANCE].number,
                "approach_direction": values["approach_direction"].number,
                BEARING: self.choices.side(spot).bearing_deg,
                SPEED: values[SPEED].number,
                **(TOLD if person.is_told else {}),
            },
            cost=self.choices.legs[start, spot],
            why=why,
            cost_parts=self.choices.leg_parts(start, spot),
        )

    def _greet(self, way: tuple[str, str], parts: Mapping[str, int]) -> PlanStep:
        visit, cost = self.visit, sum(parts.values())
        modality, gesture = way
        company = () if visit.company is None else (visit.company,)
        if company:
            why = why_this_company(self.index, self.visits, self.around, cost)
        else:
            why = why_this_greeting(visit, self.around, cost)
        return PlanStep(
            GREET_TOGETHER if company else GREET,
            (*self.robot_and_person, *company, modality, gesture),
            origin=None,
            parameters={"greeting_modality": modality, "greeting_gesture": gesture},
            cost=cost,
            why=why,
            cost_parts=parts,
            companions=served(visit, self.choices)[1:],
        )

    def _leave(self) -> PlanStep:
        assert self.visit.farewell is not None  # there is one where the agenda has it
        modality, gesture = self.visit.farewell
        cost = farewell_cost(self.visit, self.choices)
        return PlanStep(
            LEAVE,
            (*self.robot_and_person, modality, gesture),
            origin=None,
            parameters={"greeting_modality": modality, "greeting_gesture": gesture},
            cost=cost,
            why=why_this_farewell(self.visit, self.around),
            cost_parts={"farewell": cost},
        )
