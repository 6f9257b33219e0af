"""Planning in a domain of one's own: PDDL read with care, and costs that come from what people like.

`read_own` reads a domain and a problem, `bind` builds a `Binding` and people's inferred parameters into them,
and `plan_own` finds the plan.
"""

from comity_domain.own.binding.binding import ActionBinding, Binding, FluentBinding, Option, OptionValue
from comity_domain.own.binding.people import People
from comity_domain.own.binding.refusal import BindingRefusedError, Location
from comity_domain.own.export import OwnPddl, own_pddl
from comity_domain.own.forbidding import Without, without
from comity_domain.own.pddl.reading import Kind, OwnProblem, read_own
from comity_domain.own.solving.bound import Bound, bind
from comity_domain.own.solving.planning import OwnPlan, diagnosed, plan_own
from comity_domain.own.weighing import ALL, OwnFlip, Stability, weigh

__all__ = [
    "ALL",
    "ActionBinding",
    "Binding",
    "BindingRefusedError",
    "Bound",
    "FluentBinding",
    "Kind",
    "Location",
    "Option",
    "OptionValue",
    "OwnFlip",
    "OwnPddl",
    "OwnPlan",
    "OwnProblem",
    "People",
    "Stability",
    "Without",
    "bind",
    "diagnosed",
    "own_pddl",
    "plan_own",
    "read_own",
    "weigh",
    "without",
]
