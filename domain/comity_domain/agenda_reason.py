"""Why what is on an agenda is done as it is: when a thing is fetched, and which values hold for an act."""

from __future__ import annotations

from collections.abc import Sequence

from comity_domain.agenda import Offer, Wait
from comity_domain.circumstances import FREE_OF_HANDS
from comity_domain.evidence import because
from comity_domain.options import Options
from comity_domain.plan import Alternative, RuledOut, Why
from comity_domain.request import Spot
from comity_domain.tour import Stop, Visit, stays, tour_cost, visit_as
from comity_fis.value import Inference

NO_SOURCE = "that this holds for handing over is a design choice without a source"
UNTIL = {"speaks": "says something", "moves": "moves"}
_HANDS_FULL = f"with full hands only {' or '.join(sorted(FREE_OF_HANDS - {'none'}))} is left of the gestures"
_BEFORE, _AFTER = "before the greeting", "after the greeting"


def why_this_fetching(offer: Offer, index: int, visits: Sequence[Visit], options: Options) -> Why:
    """Why a thing is fetched before its person is greeted, or after; of a second one there is no choice."""
    visit = visits[index]
    person = options.people[visit.spot.place]
    if len(person.fetched_at) > 1 and not visit.bringing:
        return Why("the robot carries one thing at a time", ())
    now, other = (_BEFORE, _AFTER) if visit.bringing else (_AFTER, _BEFORE)
    start = (options.robot, person.name, offer.thing, offer.place)
    extra = _extra_cost(index, visits, options)
    if extra is None:
        reason = "no route allows it" if person.bringing else _no_greeting(offer, options, person.name)
        return Why(f"fetched {now}: {other} is not possible", (), (RuledOut((*start, other), reason),))
    because_of = (
        "one way more, hands free for any greeting" if visit.bringing else f"one way less, {_HANDS_FULL}"
    )
    return Why(
        f"fetched {now}; {other} would cost {extra} cm more",
        (Alternative((*start, other), extra, because_of),),
    )


def _extra_cost(index: int, visits: Sequence[Visit], options: Options) -> int | None:
    """What the best visit with the other time of fetching would cost on top."""
    visit = visits[index]
    stop = Stop(visit.spot.place)
    others = (
        visit_as(stay, stop, options) for stay in stays(stop, options) if stay.bringing != visit.bringing
    )
    costs = [tour_cost([*visits[:index], other, *visits[index + 1 :]], options) for other in others]
    known, now = [cost for cost in costs if cost is not None], tour_cost(visits, options)
    return min(known) - now if known and now is not None else None


def _no_greeting(offer: Offer, options: Options, name: str) -> str:
    against = options.people[name].ruled_out_bringing or {}
    reasons = "; ".join(f"{greeting.words}: {reason}" for greeting, reason in against.items())
    return f"with {offer.thing} in the hands no greeting is left ({reasons})"


def why_this_return(offer: Offer, spot: Spot, options: Options) -> Why:
    """Why the robot comes back on this side."""
    person = options.people[spot.place]
    liked = person.sides[spot.side].desirability
    rule = because(person.values, "approach_direction")
    return Why(
        f"back with {offer.thing}; {spot.side}: desirability {liked:.2f} for the approach direction ({rule})",
        (),
    )


def why_this_message(values: Inference) -> Why:
    """Where the manner of speech comes from; the words are the scenario's."""
    told = [
        f"{name.replace('_', ' ')}: {because(values, name)}"
        for name in ("voice_volume", "speech_rate")
        if name in values.parameters
    ]
    manner = "; ".join(told) or "the rulebook says nothing of the voice, so it is the normal one"
    return Why(f"the scenario's words; {manner}", ())


def why_this_offer(offer: Offer, spot: Spot, options: Options) -> Why:
    """Where a thing is handed over."""
    values = options.people[spot.place].values
    distance = because(values, "conversational_distance")
    at = f"at {values['conversational_distance'].number:.2f} m ({distance}), {spot.side}"
    return Why(f"handed over where the robot stands: {at}; {NO_SOURCE}", ())


def why_this_pause(wait: Wait, person: str) -> Why:
    """What ends a pause."""
    if wait.until is None:
        return Why(f"the scenario's {wait.cap_s:g} s, at the distance of the greeting", ())
    return Why(f"until {person} {UNTIL[wait.until]}, for {wait.cap_s:g} s at most", ())
