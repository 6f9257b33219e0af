"""Why what is on an agenda is done as it is: when a thing is fetched, and which values hold for an act."""

from __future__ import annotations

from collections.abc import Sequence

from comity_domain.choices.options import Options
from comity_domain.explanation.evidence import because
from comity_domain.plans.plan import Alternative, RuledOut, StepExplanation
from comity_domain.problem.agenda import Offer, PlainTask, offers
from comity_domain.problem.circumstances import FREE_OF_HANDS
from comity_domain.problem.spot import Spot
from comity_domain.tours.lateness import late
from comity_domain.tours.tour import PlannedVisit, Stop, stays, tour_cost, visit_as
from comity_fis.inference.value import Inference
from comity_fis.listing import listed

NO_SOURCE = "that this holds for handing over is a design choice without a source"
_HANDS_FULL = f"with full hands only {listed(sorted(FREE_OF_HANDS - {'none'}), 'or')} is left of the gestures"
BEFORE, AFTER = "before the greeting", "after the greeting"


def why_this_fetching(
    offer: Offer, index: int, visits: Sequence[PlannedVisit], options: Options
) -> StepExplanation:
    """Why a thing is fetched before its person is greeted, or after; of a later one there is no choice."""
    visit = visits[index]
    person = options.people[visit.spot.place]
    if offer is not offers(person.agenda)[0]:
        return StepExplanation(
            "the robot carries one thing at a time: fetched after the one before, without a choice", ()
        )
    now, other = (BEFORE, AFTER) if visit.bringing else (AFTER, BEFORE)
    start = (options.robot, person.name, offer.thing, offer.place)
    extra = _otherwise(index, visits, options)
    if extra is None and not person.may_come_bringing:
        extra = _no_greeting(offer, options, person.name)
    if extra is None or isinstance(extra, str):
        out = RuledOut((*start, other), extra or "no route allows it")
        return StepExplanation(f"fetched {now}: {other} is not possible", (), (out,))
    because_of = (
        "one way more, hands free for any greeting" if visit.bringing else f"one way less, {_HANDS_FULL}"
    )
    return StepExplanation(
        f"fetched {now}; {other} would cost {extra} cm more",
        (Alternative((*start, other), extra, because_of),),
    )


def _otherwise(index: int, visits: Sequence[PlannedVisit], options: Options) -> int | str | None:
    """What the best visit with the other time of fetching would cost on top.

    Or who would be greeted too late; None where no route leads that way.
    """
    visit = visits[index]
    stop = Stop(visit.spot.place)
    tours = [
        [*visits[:index], visit_as(stay, stop, options), *visits[index + 1 :]]
        for stay in stays(stop, options)
        if stay.bringing != visit.bringing
    ]
    costs = {i: cost for i, tour in enumerate(tours) if (cost := tour_cost(tour, options)) is not None}
    too_late = {i: str(found) for i in costs if (found := late(tours[i], options))}
    kept, now = [cost for i, cost in costs.items() if i not in too_late], tour_cost(visits, options)
    if kept and now is not None:
        return min(kept) - now
    return next(iter(too_late.values()), None)


def _no_greeting(offer: Offer, options: Options, name: str) -> str:
    against = options.people[name].ruled_out_bringing or {}
    reasons = "; ".join(f"{greeting.words}: {reason}" for greeting, reason in against.items())
    return f"with {offer.thing} in the hands no greeting is left ({reasons})"


def why_this_task(task: PlainTask, person: str, values: Inference) -> StepExplanation:
    """Where the manner of a task without a choice comes from; the task itself is the scenario's."""
    told = [
        f"{name.replace('_', ' ')}: {because(values, name)}"
        for name in task.shaped_by
        if name in values.parameters
    ]
    if task.shaped_by and not told:
        unknown = " and no ".join(name.replace("_", " ") for name in task.shaped_by)
        told = [f"the rulebook has no {unknown}, so the normal one holds"]
    return StepExplanation("; ".join((task.reason(person), *told)), ())


def why_this_offer(offer: Offer, spot: Spot, options: Options) -> StepExplanation:
    """Where a thing is handed over."""
    values = options.people[spot.place].values
    distance = because(values, "conversational_distance")
    at = f"at {values['conversational_distance'].number:.2f} m ({distance}), {spot.side}"
    return StepExplanation(f"handed over where the robot stands, without a choice: {at}; {NO_SOURCE}", ())
