"""From a request to a plan: the order by Fast Downward, each step with full precision and its reasons."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from comity_domain.engine import ENGINE, solve
from comity_domain.options import Options, options
from comity_domain.plan import Plan, PlanStep
from comity_domain.reason import why_this_greeting, why_this_side
from comity_domain.request import START, Spot, VisitRequest
from comity_domain.tour import Visit, best_tour
from comity_domain.visit_problem import visit_names, visit_problem


def make_plan(request: VisitRequest, *, time_limit_s: float = 30.0) -> Plan:
    """The cheapest way to visit and greet everybody.

    Args:
        request: People that cannot be reached on any side they accept have been left out of it.
        time_limit_s: Wall-clock seconds for the engine, > 0. Where they do not suffice for the proof, the
            plan is the best found so far, neither `optimal` nor `reproducible`.

    Raises:
        PlanningFailed: There is no plan, or none was found in time.
        ValueError: The request holds a person whom no plan can serve.
    """
    if not time_limit_s > 0.0:
        raise ValueError(f"the time limit must be positive, got {time_limit_s!r} s")
    choices = options(request)
    order, proven = _order(choices, time_limit_s)
    visits = best_tour(order, choices)
    steps = tuple(steps_of(visits, choices))
    return Plan(
        ENGINE, optimal=proven, reproducible=proven, cost=sum(step.cost for step in steps), steps=steps
    )


def _order(choices: Options, time_limit_s: float) -> tuple[list[str], bool]:
    """The people in the order of the best plan, and whether that is proven optimal."""
    if not choices.people:
        return [], True  # nothing to do is a plan, not a failure
    names = visit_names(choices)
    solution = solve(visit_problem(choices, names), time_limit_s=time_limit_s)
    order = [names.name(action.arguments[1]) for action in solution.actions if action.name == "Reach_user"]
    return order, solution.finished


def steps_of(visits: Sequence[Visit], choices: Options) -> Iterator[PlanStep]:
    """The steps of a tour, each with its parameters, cost and reasons."""
    spots = [visit.spot for visit in visits]
    for index, visit in enumerate(visits):
        yield _reach(index, spots, choices)
        yield _greet(visit, choices)


def _reach(index: int, spots: Sequence[Spot], choices: Options) -> PlanStep:
    spot, start = spots[index], spots[index - 1] if index else START
    values = choices.people[spot.place].values
    return PlanStep(
        "Reach_user",
        (choices.robot, spot.place, spot.side),
        origin=(start.place, start.side),
        parameters={
            "conversational_distance": values["conversational_distance"].number,
            "approach_direction": values["approach_direction"].number,
            "approach_bearing": choices.side(spot).bearing_deg,
            "approach_speed": values["approach_speed"].number,
        },
        cost=choices.legs[start, spot],
        why=why_this_side(index, spots, choices),
    )


def _greet(visit: Visit, choices: Options) -> PlanStep:
    person, greeting = choices.people[visit.spot.place], visit.greeting
    return PlanStep(
        "Greet_person",
        (choices.robot, person.name, greeting.modality, greeting.gesture),
        origin=None,
        parameters={"greeting_modality": greeting.modality, "greeting_gesture": greeting.gesture},
        cost=person.greetings[greeting],
        why=why_this_greeting(greeting, person, choices.robot),
    )
