"""A plan as plain JSON data; the keys are stable, more may be added."""

from __future__ import annotations

from comity_domain.plan import Alternative, Plan, PlanStep

Json = dict[str, object]


def as_json(plan: Plan) -> Json:
    """The plan as what `json.dumps` takes."""
    return {
        "engine": plan.engine,
        "optimal": plan.optimal,
        "reproducible": plan.reproducible,
        "cost": plan.cost,
        "steps": [_step(step) for step in plan.steps],
    }


def _step(step: PlanStep) -> Json:
    return {
        "action": step.action,
        "arguments": list(step.arguments),
        "from": None if step.origin is None else list(step.origin),
        "parameters": dict(step.parameters),
        "cost": step.cost,
        "why": {
            "text": step.why.text,
            "alternatives": [_alternative(alternative) for alternative in step.why.alternatives],
        },
    }


def _alternative(alternative: Alternative) -> Json:
    return {"arguments": list(alternative.arguments), "extra_cost": alternative.extra_cost}
