"""Contributions to a step's values: culture, situation, learning, wishes, and safety."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.answers.plan import StepValueAnswer
from comity.report.values.inference import because

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from comity.answers.plan import StepAnswer
    from comity_fis import Inference
    from comity_fis.inference.value import Contribution

Contributions = dict[str, "tuple[Contribution, ...]"]

ORIGINS = {"setting": "asked for", "neutral": "neutral value"}
"""Readable names of origins."""


def contributions_of(parameters: Mapping[str, object], inference: Inference | None) -> Contributions:
    """Contributions to each parameter of a step, by name; none for values without a rule, such as a text.

    Args:
        parameters: Parameters of the step.
        inference: Inference of the person; None if they are nobody's.
    """
    known = inference.parameters if inference else {}
    return {name: known[name].contributions for name in parameters if name in known}


def step_values(step: StepAnswer, values: Mapping[str, Inference]) -> Iterator[StepValueAnswer]:
    """Each value of a step for each person whom it serves, with the reason for it.

    Args:
        step: The step.
        values: Values by person.
    """
    for person in step.people:
        inference = values[person]
        for name, planned in step.parameters.items():
            if name not in inference.parameters:
                continue
            own = inference[name]
            yield StepValueAnswer(
                person=person,
                parameter=name,
                planned=planned,
                value=own.value,
                unit=own.unit,
                contributions=own.contributions,
                because=because(own, inference.inputs),
            )


def origin_in_words(step: StepAnswer, parameter: str) -> str:
    """Suffix such as ` (culture + learnt)`; empty for culture alone, and for a planned choice."""
    made_of = step.contributions.get(parameter, ())
    if all(one.origin == "culture" for one in made_of):
        return ""
    start, planned = made_of[0].value, step.parameters[parameter]
    if isinstance(start, str) and start != planned:
        return ""
    origins = dict.fromkeys(ORIGINS.get(one.origin, one.origin) for one in made_of)
    return f" ({' + '.join(origins)})"
