"""The kinds of expectations, one in each file; a new one needs a file and a line here."""

from collections.abc import Mapping

from comity.testing.expectation import Expectation, ProfileComparison
from comity.testing.kinds.alternative import OtherChoice
from comity.testing.kinds.approach import ApproachSide
from comity.testing.kinds.decision import DecidedBy
from comity.testing.kinds.difference import ProfileDifference
from comity.testing.kinds.duration import Duration
from comity.testing.kinds.event import Event
from comity.testing.kinds.greeting import GreetingContent
from comity.testing.kinds.hearing import Hearing
from comity.testing.kinds.metric import MetricBounds
from comity.testing.kinds.order import VisitOrder
from comity.testing.kinds.sameness import ProfileSameness
from comity.testing.kinds.state import State

KINDS: Mapping[str, type[Expectation] | type[ProfileComparison]] = {
    "metric": MetricBounds,
    "state": State,
    "event": Event,
    "duration": Duration,
    "order": VisitOrder,
    "approach": ApproachSide,
    "greeting": GreetingContent,
    "hearing": Hearing,
    "decided_by": DecidedBy,
    "alternative": OtherChoice,
    "difference": ProfileDifference,
    "sameness": ProfileSameness,
}
"""Kinds by the name of their grammar rule."""
