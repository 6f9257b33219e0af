"""The paper's figures, drawn from what this package computes; each says where its shapes come from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from comity.report.drawing import COLOURS, GREY, INK, Label, picture
from comity.report.rulebooks import fit_picture
from comity.report.values import variable_picture
from comity.report.values.mapping_picture import Line, mapping_picture, parameter_picture
from comity.report.values.paper import PRINTED, Printed
from comity.tables.column import TableColumn
from comity.tables.fit import Fit, fit_column
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import (
    Level,
    NominalVariable,
    NumericParameter,
    NumericVariable,
    individualism_scores,
    load_rulebook,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BLUE, VERMILLION = COLOURS[:2]
RECONSTRUCTED = (
    "Output shapes reconstructed on a grid of 5 cm from the numbers that the paper prints, its figures being "
    "unavailable: agreement with those numbers is a fit and no validation."
)
SCORES = (
    "69 countries, 3 regions, 6 part-populations (Hofstede, Hofstede & Minkov 2010). "
    "They describe countries and not persons."
)


@dataclass(frozen=True, slots=True)
class PaperFigure:
    """One picture of the set."""

    shows: str
    sheet: Callable[[], Figure]

    def draw(self, form: str = "png") -> bytes:
        """The picture as the bytes of a `png`, `svg` or `pdf`."""
        return picture(self.sheet, form)


def _gender() -> Figure:
    variable = load_rulebook("bruno2017").variables["gender"]
    assert isinstance(variable, NominalVariable)
    return variable_picture.worded_variable(
        variable,
        about="All is known: values are equal or not, and each is a term.",
        note="The paper's two values. Nobody has to state one: not disclosed, both terms hold.",
    )


def _education() -> Figure:
    variable = load_rulebook("illustrative-levels").variables["education"]
    assert isinstance(variable, NominalVariable)
    return variable_picture.worded_variable(
        variable,
        about="All is known: nine levels in an order. A group stands for neighbours; no distances, no means.",
        note="ISCED 2011 (UNESCO), numbered as there. The groups are those of education statistics.",
    )


def _age() -> Figure:
    return variable_picture.numeric_variable(
        _numeric("age"),
        about="The terms are known, their shapes are not: each stage of life becomes a trapezoid.",
        note="The terms are the paper's. Where they meet (3, 12, 19, 65 years) and how wide they overlap "
        "is a design choice.",
    )


def _scores() -> Figure:
    return fit_picture.scores_picture(
        _fit(),
        title="Individualism: 78 scores in two clusters",
        about="Nothing is known but data. Each dot is a score, coloured by its nearest cluster.",
        note=SCORES + " Dashed: centres of fuzzy c-means.",
        marks=(Label(38, "Arab countries 38", INK), Label(67, "Germany 67", INK)),
    )


def _clusters() -> Figure:
    return fit_picture.counts_picture(
        _fit(),
        title="Individualism: how many clusters?",
        about="Subtractive clustering finds exactly two from radius 0.35 to 0.75: two terms.",
        note="Chiu 1994 with MATLAB's defaults: squash 1.25, accept 0.5, reject 0.15.",
    )


def _individualism() -> Figure:
    errors = _fit().variable
    assert errors is not None
    assert errors.partition is not None
    first, second = errors.partition.squared_errors
    return fit_picture.terms_picture(
        _fit(),
        title=f"Individualism: {errors.measured}",
        about="The degrees of fuzzy c-means (dots) become membership functions (lines).",
        note="Two-term Gaussians with amplitudes of at least 0, least squares over the 78 scores: squared "
        f"error {first:.5f} for LC1, {second:.5f} for LC2. The curves fall off at the ends of the scale.",
    )


def _output(case: int) -> Figure:
    parameter = load_rulebook(f"bruno2017-case{case}").parameters[DISTANCE]
    assert isinstance(parameter, NumericParameter)
    decided = "individualism alone" if case == 1 else "individualism and gender"
    return parameter_picture(
        parameter,
        title=f"Conversational distance, case {case}",
        about=f"The output variable that {decided} decide{'s' if case == 1 else ''}.",
        note=RECONSTRUCTED,
    )


def _case1() -> Figure:
    return mapping_picture(
        load_rulebook("bruno2017-case1"),
        [Line("", None, BLUE, _printed(None))],
        title="Distance from individualism, case 1",
        about="Rings: the two numbers that the paper prints. Line: the exact centre of area.",
        note=_mapping_note(),
    )


def _case2() -> Figure:
    return mapping_picture(
        load_rulebook("bruno2017-case2"),
        [
            Line("man", "male", BLUE, _printed("male"), above=True),
            Line("not disclosed", None, GREY),
            Line("woman", "female", VERMILLION, _printed("female")),
        ],
        title="Distance from individualism and gender, case 2",
        about="Rings: the four numbers that the paper prints. Lines: the exact centre of area.",
        note=_mapping_note(),
    )


def _printed(gender: str | None) -> tuple[Printed, ...]:
    """The paper's numbers for a line; case 1, where no gender is stated."""
    return tuple(printed for printed in PRINTED if printed.gender == gender)


def _mapping_note() -> str:
    return (
        "Shaded: beyond 15..80 the fitted terms fall off, and a larger score may mean a smaller distance. "
        + RECONSTRUCTED
    )


def _numeric(name: str) -> NumericVariable:
    variable = load_rulebook("bruno2017").variables[name]
    assert isinstance(variable, NumericVariable)
    return variable


@cache
def _fit() -> Fit:
    """The paper's partition, made again."""
    coercion = _numeric("individualism").coercion
    scores = tuple(float(row.value) for row in individualism_scores())
    return fit_column(
        TableColumn("individualism.csv", "individualism", scores, 0),
        domain=(0, 100),
        level=Level.ORDINAL,
        coercion=coercion.reason if coercion else None,
    )


FIGURES: Mapping[str, PaperFigure] = {
    "variable-gender": PaperFigure("gender, nominal: all known", _gender),
    "variable-education": PaperFigure("education (ISCED), ordinal: all known", _education),
    "variable-age": PaperFigure("age, ratio: terms known, shapes not", _age),
    "individualism-scores": PaperFigure("individualism: the 78 scores and their clusters", _scores),
    "individualism-clusters": PaperFigure("individualism: clusters by radius", _clusters),
    "individualism-terms": PaperFigure("individualism: memberships and the fit", _individualism),
    "output-case1": PaperFigure("case 1: terms of the conversational distance", lambda: _output(1)),
    "output-case2": PaperFigure("case 2: terms of the conversational distance", lambda: _output(2)),
    "mapping-case1": PaperFigure("case 1: distance from individualism", _case1),
    "mapping-case2": PaperFigure("case 2: distance from individualism and gender", _case2),
}
"""By file name, in the order of the paper."""
