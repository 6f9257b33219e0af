"""The first plan and every replacement, with the parameter values that each was made with."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from comity.simulation.changes import changes_of_values
from comity_executor.tracing.intervention import INSTANT_S
from comity_fis.record import plain

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from comity.answers.plan import PlanAnswer
    from comity.answers.run import RevisionAnswer, RunAnswer
    from comity.parameters.cast import Cast
    from comity_fis import Inference

Json = dict[str, Any]


def plans_data(plan: PlanAnswer, account: RunAnswer) -> list[Json]:
    """The first plan, and then the plan updates, by time."""
    unserved = {one.person: one.reason for one in plan.unreachable}
    first = {"t": 0.0, "kind": "planned", "because": [], "cost": plan.cost, "steps": plan.steps}
    revisions = map(plain, account.revisions)
    return [_without_contributions(one) for one in (plain({**first, "unserved": unserved}), *revisions)]


def _without_contributions(plan: Json) -> Json:
    """A plan without contributions, which are part of the values."""
    steps = [{key: step[key] for key in step if key != "contributions"} for step in plan["steps"]]
    return {**plan, "steps": steps}


def stages_of(
    cast: Cast, first: Mapping[str, Inference], revisions: Iterable[RevisionAnswer]
) -> list[Mapping[str, Inference]]:
    """For each plan, the values that it was the first to use, by person.

    Args:
        cast: People of the run's scenario, resolved.
        first: Initial values by person.
        revisions: Plan updates; a person's statement counts from the next one on.
    """
    stages, waiting = [first], list(changes_of_values(cast).values())
    for revision in revisions:
        is_due = revision.t + INSTANT_S if revision.kind != "not_replanned" else -1.0
        stages.append({change.person: change.values for change in waiting if change.at_s <= is_due})
        waiting = [change for change in waiting if change.at_s > is_due]
    return stages
