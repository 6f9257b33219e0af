"""What an effect says of costs: planners disagree, or fail, where it is odd."""

from __future__ import annotations

from collections.abc import Iterator

from comity_domain.custom.pddl.declared import Action
from comity_domain.custom.pddl.form import Form, complaint

TOTAL_COST = "total-cost"


def require_one_cost(action: Action) -> None:
    """Refuse costs that are stated twice or for each of many things: they would not all be counted.

    Raises:
        InputError: at the one too many.
    """
    effect = action.parts.get(":effect")
    found = list(cost_increases(effect)) if effect is not None else []
    for form, repeated in found:
        if repeated:
            remedy = "Take it out of the forall, and multiply it by hand."
            raise complaint(form.where, "a cost outside of forall", f"'{form}' in one", remedy)
    if len(found) > 1:
        (first, _), (second, _) = found[:2]
        raise complaint(
            second.where,
            f"one cost of the action {action.word}",
            f"a second one (the first is at {first.where})",
            f"Add them up: (increase ({TOTAL_COST}) (+ {first.items[-1]} {second.items[-1]})).",
        )


def cost_increases(form: Form, *, repeated: bool = False) -> Iterator[tuple[Form, bool]]:
    """Each `(increase (total-cost) ...)` of an effect, and whether it stands inside a forall."""
    if form.head == "increase" and str(form.items[1]).lower() in (TOTAL_COST, f"({TOTAL_COST})"):
        yield form, repeated
    for part in form.items:
        if isinstance(part, Form):
            yield from cost_increases(part, repeated=repeated or form.head == "forall")
