"""Plans visits: whom the robot visits in which order, from which side and with which greeting, and why.

A `VisitRequest` names the people with their inferred parameters and the routes between them. `make_plan`
returns the cheapest `Plan`, in which distance and desirability are weighed in one unit: centimetres of
walking.
"""

from comity_domain.choices.distances import distance_desirability
from comity_domain.choices.earshot import unheard
from comity_domain.choices.greeting import Greeting, greetings, refuse_gesture_in_words, ruled_out
from comity_domain.choices.side import Side, sides, widest_deg
from comity_domain.classical.pddl import plan_pddl
from comity_domain.classical.problem import problem_of
from comity_domain.classical.solving import solve
from comity_domain.classical.timing import Timing, timing_of
from comity_domain.classical.validation import Validation, validate
from comity_domain.contrast import Contrast, from_other_sides
from comity_domain.errors import NoPlan, PlanningFailed
from comity_domain.explanation.other_order import OtherOrder, in_order
from comity_domain.explanation.relaxing import InTheWay, in_the_way
from comity_domain.explanation.stability import BreakEven, differences, flips
from comity_domain.explanation.what_if import NextInstead, next_instead, visits_of
from comity_domain.labelling.punctual import Deadlines
from comity_domain.labelling.skipping import cost_of_serving
from comity_domain.other_engines import plan_with
from comity_domain.planner import ENGINE, make_plan
from comity_domain.plans.actions import SKIP
from comity_domain.plans.permission import not_permitted, without
from comity_domain.plans.plan import Alternative, Plan, PlanStep, RuledOut, StepExplanation
from comity_domain.plans.rest import VisitProgress, renumbered, rest_of
from comity_domain.problem.agenda import Agenda, Offer, Say, TakeLeave, Task, Wait, offers
from comity_domain.problem.circumstances import QUIET_AND_FREE, Circumstances
from comity_domain.problem.parts import parts
from comity_domain.problem.reach import FORWARDS, REACH_M, reach_of
from comity_domain.problem.request import Company, Visitee, VisitRequest, Weights
from comity_domain.problem.spot import START, Leg, Spot, Travel, Way, location
from comity_domain.problem.survey import Survey
from comity_domain.rebinding import kept_cost, kept_late, rebind, same_choices
from comity_domain.tours.lateness import Late
from comity_domain.visit_plan import VisitPlan

__all__ = [
    "ENGINE",
    "FORWARDS",
    "QUIET_AND_FREE",
    "REACH_M",
    "SKIP",
    "START",
    "Agenda",
    "Alternative",
    "BreakEven",
    "Circumstances",
    "Company",
    "Contrast",
    "Deadlines",
    "Greeting",
    "InTheWay",
    "Late",
    "Leg",
    "NextInstead",
    "NoPlan",
    "Offer",
    "OtherOrder",
    "Plan",
    "PlanStep",
    "PlanningFailed",
    "RuledOut",
    "Say",
    "Side",
    "Spot",
    "StepExplanation",
    "Survey",
    "TakeLeave",
    "Task",
    "Timing",
    "Travel",
    "Validation",
    "VisitPlan",
    "VisitProgress",
    "VisitRequest",
    "Visitee",
    "Wait",
    "Way",
    "Weights",
    "cost_of_serving",
    "differences",
    "distance_desirability",
    "flips",
    "from_other_sides",
    "greetings",
    "in_order",
    "in_the_way",
    "kept_cost",
    "kept_late",
    "location",
    "make_plan",
    "next_instead",
    "not_permitted",
    "offers",
    "parts",
    "plan_pddl",
    "plan_with",
    "problem_of",
    "reach_of",
    "rebind",
    "refuse_gesture_in_words",
    "renumbered",
    "rest_of",
    "ruled_out",
    "same_choices",
    "sides",
    "solve",
    "timing_of",
    "unheard",
    "validate",
    "visits_of",
    "widest_deg",
    "without",
]
