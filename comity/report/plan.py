"""A plan: what the robot means to do, how, and why so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers import PlanAnswer
from comity.report.side import SIDES
from comity.report.text import number, words
from comity_domain import as_json

if TYPE_CHECKING:
    from collections.abc import Iterator

    from rich.console import RenderableType

    from comity.answers import StepAnswer
    from comity.preparation import Prepared


def plan_answer(prepared: Prepared) -> PlanAnswer:
    """The answer of `comity plan --json`, and `plan.json` in the run folder."""
    return PlanAnswer.model_validate(
        {
            "scenario": prepared.file.scenario.name,
            **as_json(prepared.plan),
            "unreachable": [
                {"person": person, "reason": reason} for person, reason in prepared.asked.unreachable.items()
            ],
        }
    )


ALTERNATIVES_SHOWN = 3
"""The cheapest ones; `--json` has all."""
UNITS = {
    "conversational_distance": "m",
    "approach_direction": "deg",
    "approach_bearing": "deg",
    "approach_speed": "m/s",
}


def plan_text(answer: PlanAnswer) -> Iterator[RenderableType]:
    """The same, for a person to read."""
    from rich.padding import Padding

    quality = "no plan costs less" if answer.optimal else "not proven optimal"
    yield f"Plan for {answer.scenario}: {len(answer.steps)} steps, cost {answer.cost} ({quality})"
    yield "A cost of 1 is 1 cm of way: travel, and what a less desirable choice would be worth in travel."
    yield SIDES
    for i, step in enumerate(answer.steps, start=1):
        yield f"\n{i:3}. {step.action}({', '.join(step.arguments)})   cost {step.cost}"
        yield Padding(", ".join(_values(step)), (0, 0, 0, 5))
        yield Padding(step.why.text, (0, 0, 0, 5))
        for other in step.why.alternatives[:ALTERNATIVES_SHOWN]:
            yield Padding(
                f"or {', '.join(map(words, other.arguments[2:]))} for {other.extra_cost} more", (0, 0, 0, 7)
            )
        if hidden := step.why.alternatives[ALTERNATIVES_SHOWN:]:
            yield Padding(f"or {len(hidden)} others, from {hidden[0].extra_cost} more", (0, 0, 0, 7))
    for nobody in answer.unreachable:
        yield f"\nCannot be visited: {nobody.reason}"


def _values(step: StepAnswer) -> Iterator[str]:
    """The parameters, each with its unit; the direction together with the side that was made of it."""
    for name, value in step.parameters.items():
        text = number(value, UNITS.get(name))
        if name == "approach_direction":
            yield f"{words(name)} {text} off the front"
        elif name == "approach_bearing":
            yield f"side {step.arguments[-1]}: bearing {text}"
        else:
            yield f"{words(name)} {text}"
