"""A plan as plain JSON data; the keys are stable, more may be added."""

from __future__ import annotations

from comity_domain.plans.plan import Alternative, Plan, PlanStep, RuledOut

Json = dict[str, object]


def as_json(plan: Plan) -> Json:
    """The plan as what `json.dumps` takes."""
    return {
        "engine": plan.engine,
        "optimal": plan.optimal,
        "reproducible": plan.reproducible,
        "cost": plan.cost,
        "bound": plan.bound,
        "gap": plan.gap,
        "killed": plan.killed,
        "steps": [_step(step) for step in plan.steps],
    }


def _step(step: PlanStep) -> Json:
    return {
        "action": step.action,
        "arguments": list(step.arguments),
        "people": list(step.people),
        "from": None if step.origin is None else list(step.origin),
        "parameters": dict(step.parameters),
        "cost": step.cost,
        "cost_parts": dict(step.cost_parts),
        "why": {
            "text": step.why.text,
            "alternatives": [_alternative(alternative) for alternative in step.why.alternatives],
            "ruled_out": [_ruled_out(option) for option in step.why.ruled_out],
        },
    }


def _alternative(alternative: Alternative) -> Json:
    return {
        "arguments": list(alternative.arguments),
        "extra_cost": alternative.extra_cost,
        "because": alternative.because,
    }


def _ruled_out(option: RuledOut) -> Json:
    return {"arguments": list(option.arguments), "reason": option.reason}
