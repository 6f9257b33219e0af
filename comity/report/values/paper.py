"""The numbers that the paper prints, and the same from this package in every mode."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, get_args

from comity.answers.paper import ComputedDistanceAnswer, PaperAnswer, PrintedDistanceAnswer
from comity.report.text import table
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import Mode, NumericParameter, Rulebook, load_rulebook

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from rich.console import RenderableType

MODES: tuple[Mode, ...] = ("matlab", "exact", "skfuzzy")
"""The paper's own way of computing comes first."""
assert set(MODES) == set(get_args(Mode))


@dataclass(frozen=True, slots=True)
class Printed:
    """A conversational distance that the paper prints."""

    case: Literal[1, 2]
    individualism: float
    gender: str | None
    distance_cm: float


PRINTED = (
    Printed(1, 38.0, None, 69.9),
    Printed(1, 67.0, None, 100.7),
    Printed(2, 38.0, "female", 63.63),
    Printed(2, 67.0, "female", 84.7),
    Printed(2, 38.0, "male", 87.51),
    Printed(2, 67.0, "male", 109.34),
)
"""Bruno et al., FUZZ-IEEE 2017."""


def distance_cm(rulebook: Rulebook, individualism: float, gender: str | None, mode: Mode = "exact") -> float:
    """The conversational distance [cm] that one of the paper's rulebooks gives."""
    inputs: dict[str, float | str | None] = {"individualism": individualism}
    if "gender" in rulebook.variables:
        inputs["gender"] = gender
    return 100 * rulebook.infer(inputs, mode)[DISTANCE].number


def paper_answer() -> PaperAnswer:
    """The six numbers in every mode, and case 1 with the output shapes of case 2."""
    case1, case2 = load_rulebook("bruno2017-case1"), load_rulebook("bruno2017-case2")
    numbers = tuple(_beside(printed, case1 if printed.case == 1 else case2) for printed in PRINTED)
    other = _with_shapes_of(case1, case2)
    return PaperAnswer(
        numbers=numbers,
        largest_difference_cm={
            mode: max(abs(number.modes[mode].difference_cm) for number in numbers) for mode in MODES
        },
        case_1_with_the_shapes_of_case_2=tuple(
            _beside(printed, other) for printed in PRINTED if printed.case == 1
        ),
    )


def paper_text(answer: PaperAnswer) -> Iterator[RenderableType]:
    """The answer as tables: each mode's distance with its difference from the paper's."""
    yield "Conversational distance [cm]: the paper's numbers, ours, and in brackets the difference"
    largest = (f"{answer.largest_difference_cm[mode]:.2f}" for mode in MODES)
    yield table(
        [*_rows(answer.numbers), ("largest difference", "", "", *largest)],
        head=("individualism", "gender", "paper", *MODES),
    )
    yield "The output shapes were reconstructed from these numbers: the agreement is a fit, not a validation."
    yield "The two cases use two sets of shapes. Case 1 with the close and far of case 2:"
    yield table(
        _rows(answer.case_1_with_the_shapes_of_case_2), head=("individualism", "gender", "paper", *MODES)
    )


def _rows(numbers: Sequence[PrintedDistanceAnswer]) -> list[tuple[str, ...]]:
    return [
        (
            f"{number.individualism:g}",
            number.gender or "-",
            f"{number.paper_cm:.2f}",
            *(
                f"{number.modes[mode].distance_cm:.2f} ({number.modes[mode].difference_cm:+.2f})"
                for mode in MODES
            ),
        )
        for number in numbers
    ]


def _beside(printed: Printed, rulebook: Rulebook) -> PrintedDistanceAnswer:
    """A number of the paper with what a rulebook gives for the same person."""
    ours: dict[Mode, float] = {
        mode: distance_cm(rulebook, printed.individualism, printed.gender, mode) for mode in MODES
    }
    return PrintedDistanceAnswer(
        case=printed.case,
        individualism=printed.individualism,
        gender=printed.gender,
        paper_cm=printed.distance_cm,
        modes={
            mode: ComputedDistanceAnswer(distance_cm=cm, difference_cm=cm - printed.distance_cm)
            for mode, cm in ours.items()
        },
    )


def _with_shapes_of(rulebook: Rulebook, other: Rulebook) -> Rulebook:
    """A rulebook whose distance has the shapes that terms of the same names have in another one."""
    own, others = rulebook.parameters[DISTANCE], other.parameters[DISTANCE]
    assert isinstance(own, NumericParameter)
    assert isinstance(others, NumericParameter)
    terms = {name: others.terms[name] for name in own.terms}
    return replace(rulebook, parameters={**rulebook.parameters, DISTANCE: replace(own, terms=terms)})
