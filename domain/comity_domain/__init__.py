"""Planning visits: who is visited in which order, from which side and with which greeting, and why.

A `VisitRequest` names the people with their inferred parameters and the routes between them; `make_plan`
returns the cheapest `Plan`, where distance and desirability are weighed in one currency: centimetres.
"""

from comity_domain.agenda import Agenda, Offer, Say, TakeLeave, Task, Wait, offers
from comity_domain.circumstances import QUIET_AND_FREE, Circumstances
from comity_domain.earshot import unheard
from comity_domain.errors import NoPlan, PlanningFailed
from comity_domain.export import as_json
from comity_domain.greeting import Greeting, greetings, refuse_gesture_in_words, ruled_out
from comity_domain.order import Order, Orders
from comity_domain.parts import parts
from comity_domain.pddl import plan_pddl
from comity_domain.permission import not_permitted, without
from comity_domain.plan import Alternative, Plan, PlanStep, RuledOut, Why
from comity_domain.planner import make_plan
from comity_domain.punctual import Deadlines
from comity_domain.rebinding import kept_cost, rebind, same_choices
from comity_domain.relaxing import InTheWay, in_the_way
from comity_domain.request import (
    START,
    Company,
    Leg,
    Spot,
    Travel,
    Visitee,
    VisitRequest,
    Way,
    Weights,
    location,
)
from comity_domain.rest import Progress, renumbered, rest_of
from comity_domain.side import Side, sides
from comity_domain.skipping import SKIP, cost_of_serving
from comity_domain.stability import Flip, differences, flips
from comity_domain.survey import Survey
from comity_domain.what_if import NextInstead, next_instead, visits_of

__all__ = [
    "QUIET_AND_FREE",
    "SKIP",
    "START",
    "Agenda",
    "Alternative",
    "Circumstances",
    "Company",
    "Deadlines",
    "Flip",
    "Greeting",
    "InTheWay",
    "Leg",
    "NextInstead",
    "NoPlan",
    "Offer",
    "Order",
    "Orders",
    "Plan",
    "PlanStep",
    "PlanningFailed",
    "Progress",
    "RuledOut",
    "Say",
    "Side",
    "Spot",
    "Survey",
    "TakeLeave",
    "Task",
    "Travel",
    "VisitRequest",
    "Visitee",
    "Wait",
    "Way",
    "Weights",
    "Why",
    "as_json",
    "cost_of_serving",
    "differences",
    "flips",
    "greetings",
    "in_the_way",
    "kept_cost",
    "location",
    "make_plan",
    "next_instead",
    "not_permitted",
    "offers",
    "parts",
    "plan_pddl",
    "rebind",
    "refuse_gesture_in_words",
    "renumbered",
    "rest_of",
    "ruled_out",
    "same_choices",
    "sides",
    "unheard",
    "visits_of",
    "without",
]
