"""Stability of a plan: how far the options' weights can change before another plan is cheaper.

A plan's cost is linear in the factor of a weight, so the minimum over all plans is concave and piecewise
linear. The factor at which the current plan stops being the cheapest is found as in Eisner and Severance
(1976): the plan that is cheapest at the end of the range crosses the current one somewhere; a plan that is
cheaper still at that crossing crosses it earlier.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from comity_domain.custom.solving.bound import Bound, bind
from comity_domain.custom.solving.planning import CustomPlan, plan_custom
from comity_domain.custom.solving.solution import GroundAction
from comity_domain.custom.solving.swap import row_of
from comity_domain.errors import PlanningFailed
from comity_domain.explanation.stability import HIGHEST, LOWEST
from comity_fis.errors import InputError

ALL = "all"
MOST_CROSSINGS = 12
"""Maximum number of engine calls per weight and direction; each finds another plan or is the last."""
NEAR = 1e-6
"""Tolerance for equal costs, in units of the domain's own cost."""


@dataclass(frozen=True, slots=True)
class CustomFlip:
    """The factor of weights beyond which another plan is cheaper."""

    weight: str
    """An action and the argument of its option, such as `greet ?how`, or `all`."""
    factor: float
    no_longer: tuple[str, ...]
    """Steps of the current plan that the cheaper one lacks."""
    instead: tuple[str, ...]
    """Steps of the cheaper plan that the current one lacks."""


@dataclass(frozen=True, slots=True)
class Stability:
    """Result of the stability analysis."""

    flips: tuple[CustomFlip, ...]
    """The nearest flip in each direction, by weight."""
    exact: bool
    """Whether every search completed; if not, there may be nearer flips."""


def weigh(
    bound: Bound,
    found: CustomPlan,
    *,
    time_limit_s: float = 30.0,
) -> Stability:
    """Vary each weight, and all at once, from a quarter to four times its value.

    Args:
        bound: A classical domain and a binding with options.
        found: The plan of this problem.
        time_limit_s: Wall-clock time for each engine call [s].
    """
    return _Weighing(bound, found, time_limit_s).all()


@dataclass(frozen=True, slots=True)
class _Weighing:
    bound: Bound
    found: CustomPlan
    time_limit_s: float

    def all(self) -> Stability:
        flips, exact = [], True
        for name, options in self.weights():
            for end in (LOWEST, HIGHEST):
                flip, proven = self.first_flip(name, options, end)
                exact &= proven
                flips += [flip] if flip else []
        return Stability(tuple(flips), exact)

    def weights(self) -> Iterator[tuple[str, list[tuple[str, str]]]]:
        """Each weight by its name, with the options it belongs to."""
        options = [
            (action, argument)
            for action, one in self.bound.binding.actions.items()
            for argument, option in one.options.items()
            if option.weight > 0.0
        ]
        if len(options) > 1:
            yield from ((f"{action} ?{argument}", [(action, argument)]) for action, argument in options)
        if options:
            yield ALL, options

    def first_flip(
        self, name: str, options: list[tuple[str, str]], end: float
    ) -> tuple[CustomFlip | None, bool]:
        """The factor at which another plan gets cheaper before `end`, and whether that is exact."""
        flip, factor = None, end
        for _ in range(MOST_CROSSINGS):
            other = self.cheapest(dict.fromkeys(options, factor))
            if other is None:
                return flip, False
            crossing = self.crossing(other, options, factor)
            if crossing is None:
                return flip, other.plan.optimal
            flip, factor = CustomFlip(name, crossing, *self.found.changes(other)), crossing
        return flip, False

    def crossing(self, other: CustomPlan, options: list[tuple[str, str]], factor: float) -> float | None:
        """The factor at which another plan costs the same as the current one; None if it is not cheaper."""
        fixed, moving = self.line(self.found.actions, options)
        other_fixed, other_moving = self.line(other.actions, options)
        more = other_fixed + factor * other_moving > fixed + factor * moving - NEAR
        if more or abs(moving - other_moving) < NEAR:
            return None
        return min(HIGHEST, max(LOWEST, (other_fixed - fixed) / (moving - other_moving)))

    def line(self, actions: Sequence[GroundAction], options: list[tuple[str, str]]) -> tuple[float, float]:
        """A plan's cost that these weights do not affect, and the part they scale, at a factor of 1."""
        fixed = moving = 0.0
        for action in actions:
            row = row_of(action, self.bound)
            assert row is not None  # no weight excludes a combination
            own = {one.lower() for bound, one in options if bound.lower() == action.name}
            part = sum(
                preference.preference_cost for key, preference in row.preferences.items() if key in own
            )
            fixed, moving = fixed + row.base + row.preference_cost - part, moving + part
        return fixed, moving

    def cheapest(self, factors: Mapping[tuple[str, str], float]) -> CustomPlan | None:
        """The cheapest plan under other weights, by action and option; None if none was found."""
        actions = {
            action: replace(
                one,
                options={
                    argument: replace(option, weight=option.weight * factors.get((action, argument), 1.0))
                    for argument, option in one.options.items()
                },
            )
            for action, one in self.bound.binding.actions.items()
        }
        try:
            bound = bind(self.bound.own, replace(self.bound.binding, actions=actions), self.bound.people)
            return plan_custom(bound, time_limit_s=self.time_limit_s, diagnose=False)
        except (PlanningFailed, InputError):  # a heavier weight may make a cost too large
            return None
