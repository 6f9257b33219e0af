"""Planning in a custom domain: checked PDDL, with costs from people's preferences.

`read_custom` reads a domain and a problem, `bind` adds a `Binding` and people's inferred parameters, and
`plan_custom` finds the plan.
"""

from comity_domain.custom.binding.binding import ActionBinding, Binding, FluentBinding, Option, OptionValue
from comity_domain.custom.binding.people import BoundPeople
from comity_domain.custom.binding.refusal import BindingRefusedError, Location
from comity_domain.custom.clock import PlanningClock, planned
from comity_domain.custom.export import CustomPddl, custom_pddl
from comity_domain.custom.forbidding import PlanWithout, without
from comity_domain.custom.process import in_one_process
from comity_domain.custom.reading.reading import CustomProblem, read_custom
from comity_domain.custom.solving.bound import Bound, bind
from comity_domain.custom.solving.planning import CustomPlan, diagnosed, plan_custom
from comity_domain.custom.weighing import ALL, CustomFlip, Stability, weigh

__all__ = [
    "ALL",
    "ActionBinding",
    "Binding",
    "BindingRefusedError",
    "Bound",
    "BoundPeople",
    "CustomFlip",
    "CustomPddl",
    "CustomPlan",
    "CustomProblem",
    "FluentBinding",
    "Location",
    "Option",
    "OptionValue",
    "PlanWithout",
    "PlanningClock",
    "Stability",
    "bind",
    "custom_pddl",
    "diagnosed",
    "in_one_process",
    "plan_custom",
    "planned",
    "read_custom",
    "weigh",
    "without",
]
