"""The kinds of expectations, one in each file; a new one needs a file and a line here."""

from collections.abc import Mapping

from comity.testing.expectation import Comparison, Expectation
from comity.testing.kinds.approach import Approach
from comity.testing.kinds.bound import Between, Close, Lower, Upper
from comity.testing.kinds.difference import Difference
from comity.testing.kinds.distance import Distance
from comity.testing.kinds.duration import Duration
from comity.testing.kinds.greeting import Greeting
from comity.testing.kinds.hearing import Hearing, NeverHears
from comity.testing.kinds.instead import InsteadCostly, InsteadPriced, InsteadRuledOut
from comity.testing.kinds.intrusion import Intrusion
from comity.testing.kinds.lasting import Lasting
from comity.testing.kinds.made_of import MadeOf
from comity.testing.kinds.node_halt import Halt, NeverHalt
from comity.testing.kinds.node_result import Fails, NeverFails, NeverSucceeds, Succeeds
from comity.testing.kinds.order import Before, Order
from comity.testing.kinds.origin import DecidedBy
from comity.testing.kinds.reasons import (
    BindsAnewBecause,
    FailsBecause,
    HaltedBecause,
    NoOtherPlanBecause,
    PlansAnewBecause,
    SucceedsBecause,
)
from comity.testing.kinds.repetition import Repetition
from comity.testing.kinds.revising import BindsAnew, NeverBindsAnew, NeverPlansAnew, PlansAnew
from comity.testing.kinds.sameness import Sameness
from comity.testing.kinds.state import State

KINDS: Mapping[str, type[Expectation] | type[Comparison]] = {
    "distance": Distance,
    "approach": Approach,
    "greeting": Greeting,
    "intrusion": Intrusion,
    "duration": Duration,
    "lasting": Lasting,
    "hearing": Hearing,
    "never_hears": NeverHears,
    "order": Order,
    "before": Before,
    "difference": Difference,
    "sameness": Sameness,
    "halt": Halt,
    "never_halt": NeverHalt,
    "succeeds": Succeeds,
    "fails": Fails,
    "never_succeeds": NeverSucceeds,
    "never_fails": NeverFails,
    "plans_anew": PlansAnew,
    "never_plans_anew": NeverPlansAnew,
    "binds_anew": BindsAnew,
    "never_binds_anew": NeverBindsAnew,
    "succeeds_because": SucceedsBecause,
    "fails_because": FailsBecause,
    "halted_because": HaltedBecause,
    "plans_anew_because": PlansAnewBecause,
    "binds_anew_because": BindsAnewBecause,
    "no_other_plan_because": NoOtherPlanBecause,
    "decided_by": DecidedBy,
    "made_of": MadeOf,
    "repetition": Repetition,
    "instead_costly": InsteadCostly,
    "instead_priced": InsteadPriced,
    "instead_ruled_out": InsteadRuledOut,
    "lower": Lower,
    "upper": Upper,
    "between": Between,
    "close": Close,
    "state": State,
}
"""By the name of their rule in the grammar."""
