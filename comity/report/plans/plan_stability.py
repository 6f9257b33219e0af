"""How far the weights of a plan can change before another plan is cheaper."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.plan import PlanFlipAnswer, StabilityAnswer
from comity_domain import differences, flips, visits_of
from comity_domain.explanation.stability import HIGHEST, LOWEST

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity_domain import Plan, VisitRequest


def stability(request: VisitRequest, plan: Plan) -> StabilityAnswer | None:
    """The answer of `comity plan --stability`; None for too many people."""
    found = flips(request, plan)
    if found is None:
        return None
    visits = visits_of(plan)
    return StabilityAnswer(
        lowest=LOWEST,
        highest=HIGHEST,
        stable=not found,
        flips=tuple(
            PlanFlipAnswer(
                weight=flip.weight,
                factor=round(flip.factor, 3),
                changes=tuple(differences(visits, flip.visits)),
            )
            for flip in found
        ),
    )


WEIGHTS = {"side": "the weight of sides", "greeting": "the weight of greetings", "both": "both weights"}


def stability_text(found: StabilityAnswer | None) -> Iterator[RenderableType]:
    """The answer as text."""
    from rich.padding import Padding

    if found is None:
        yield "\nStability: not known for so many people"
        return
    span = f"from {found.lowest:g} to {found.highest:g} times the weights"
    if found.stable:
        yield f"\nStability: no other plan is cheaper {span}"
        return
    yield f"\nStability: another plan is cheaper somewhere {span}"
    for flip in found.flips:
        changes = "; ".join(flip.changes) or "costs less by its order alone"
        yield Padding(f"at {flip.factor:.2f} times {WEIGHTS[flip.weight]}: {changes}", (0, 0, 0, 2))
