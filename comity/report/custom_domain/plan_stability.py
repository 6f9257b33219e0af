"""How far the weights of a binding can change before another plan is cheaper."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.plan import PlanFlipAnswer, StabilityAnswer
from comity_domain.custom import ALL, weigh
from comity_domain.explanation.stability import HIGHEST, LOWEST

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity_domain.custom import Bound, CustomPlan


def custom_stability(bound: Bound, found: CustomPlan, limit_s: float) -> StabilityAnswer:
    """The answer of `comity plan --domain ... --stability`.

    Args:
        bound: The planning problem.
        found: Its plan.
        limit_s: Time limit for each planner call [s].
    """
    weighed = weigh(bound, found, time_limit_s=limit_s)
    return StabilityAnswer(
        lowest=LOWEST,
        highest=HIGHEST,
        stable=not weighed.flips,
        exact=weighed.exact,
        flips=tuple(
            PlanFlipAnswer(
                weight=flip.weight,
                factor=round(flip.factor, 3),
                changes=(
                    *(f"no longer {step}" for step in flip.no_longer),
                    *(f"instead {step}" for step in flip.instead),
                ),
            )
            for flip in weighed.flips
        ),
    )


def custom_stability_text(found: StabilityAnswer) -> Iterator[RenderableType]:
    """The answer as text."""
    from rich.padding import Padding

    span = f"from {found.lowest:g} to {found.highest:g} times the weights"
    cut = "" if found.exact else " (not every search ended within the limit)"
    if found.stable:
        yield f"\nStability: no other plan is cheaper {span}{cut}"
        return
    yield f"\nStability: another plan is cheaper somewhere {span}{cut}"
    for flip in found.flips:
        weight = "all weights" if flip.weight == ALL else f"the weight of {flip.weight}"
        beyond = "below" if flip.factor < 1 else "from"
        changes = "; ".join(flip.changes) or "costs less by its order alone"
        yield Padding(f"{beyond} {flip.factor:.2f} times {weight}: {changes}", (0, 0, 0, 2))
