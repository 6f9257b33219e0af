"""Predictors of unseen rows: what examples propose, and simpler baselines to be beaten."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import fsum
from typing import Final

import numpy as np

from comity.tables.basis import ParameterRules
from comity.tables.examples import ExampleRow, Inputs
from comity.tables.proposal import cells_of, prior_of, with_cells, with_prior
from comity_fis import InputError, NominalVariable, OrdinalVariable, Rulebook, Source
from comity_fis.inference.column import Floats

Predictor = Callable[[ExampleRow, float | None], float | None]
"""Maps a row, and the same person's first answer, to a predicted value; None if it has none."""
Learner = Callable[[Sequence[ExampleRow]], Predictor]
"""Maps the training rows, at least one, to a predictor."""

CONSTANT: Final = "constant"
LINE: Final = "line"
ASK: Final = "ask once"
RULES: Final = "rules"
PRIOR: Final = "prior"
INDIVIDUAL: Final = "prior and one answer"
UNWRITTEN = Source("table", "The table", "not yet")


@dataclass(frozen=True, slots=True)
class Contenders:
    """All learners of one parameter, by name."""

    basis: ParameterRules
    inputs: tuple[str, ...]
    books: Mapping[str, Rulebook]
    """Fixed rulebooks, by name."""

    def learners(self, *, people: bool) -> dict[str, Learner]:
        """All learners, simpler ones first.

        Args:
            people: Whether rows name their participants: without them no person can be identified.
        """
        books = {name: _learning_nothing(self._of_book(book)) for name, book in self.books.items()}
        asked = _learning_nothing(lambda _, answer: answer)
        simple: dict[str, Learner] = {CONSTANT: constant, **books}
        return {
            **simple,
            **({LINE: self.line} if self.inputs else {}),
            **({ASK: asked} if people else {}),
            **({RULES: self.rules} if self.inputs else {}),
            **({PRIOR: self.prior, INDIVIDUAL: self.individual} if people else {}),
        }

    def rules(self, rows: Sequence[ExampleRow]) -> Predictor:
        """The rulebook with rules learnt from these rows."""
        cells = cells_of(self.basis, self.inputs, rows)
        return self._of_book(with_cells(self.basis.rulebook, self._name, cells, UNWRITTEN))

    def prior(self, rows: Sequence[ExampleRow]) -> Predictor:
        """The rulebook with a prior learnt from these rows."""
        prior = prior_of(self.basis, rows)
        return self._of_book(with_prior(self.basis.rulebook, self._name, prior, UNWRITTEN))

    def individual(self, rows: Sequence[ExampleRow]) -> Predictor:
        """The prior, adapted to the person by one of their answers; None if nobody gave two answers."""
        prior = prior_of(self.basis, rows)

        def predict(row: ExampleRow, answer: float | None) -> float | None:
            if answer is None or prior.within_person is None:
                return None
            return row.before + prior.known(row.group, [answer - row.before])

        return predict

    def line(self, rows: Sequence[ExampleRow]) -> Predictor:
        """Linear least squares over the inputs, with one-hot columns for categories."""
        columns = [_column(self.basis.rulebook, name, rows) for name in self.inputs]

        def design(some: Sequence[ExampleRow]) -> Floats:
            return np.column_stack([np.ones(len(some)), *(column(some) for column in columns)])

        values = np.array([row.value for row in rows])
        factors = np.linalg.lstsq(design(rows), values)[0]
        return lambda row, _: float((design([row]) @ factors)[0])

    @property
    def _name(self) -> str:
        return self.basis.parameter.name

    def _of_book(self, book: Rulebook) -> Predictor:
        """The prediction of a rulebook, cached by inputs."""
        said: dict[int, float] = {}

        def predict(row: ExampleRow, _: float | None) -> float:
            if id(row.inputs) not in said:
                said[id(row.inputs)] = float(book.value(self._name, _known(book, row.inputs)))
            return said[id(row.inputs)]

        return predict


def constant(rows: Sequence[ExampleRow]) -> Predictor:
    """The mean of the rows."""
    mean = fsum(row.value for row in rows) / len(rows)
    return lambda _row, _answer: mean


def _learning_nothing(predictor: Predictor) -> Learner:
    return lambda _: predictor


def _known(book: Rulebook, inputs: Inputs) -> Inputs:
    """The inputs that another rulebook accepts: its variables may have other values."""
    return {name: value for name, value in inputs.items() if name in book.facts and _takes(book, name, value)}


def _takes(book: Rulebook, name: str, value: object) -> bool:
    try:
        book.checked_inputs({name: value})
    except InputError:
        return False
    return True


def _column(
    rulebook: Rulebook, name: str, rows: Sequence[ExampleRow]
) -> Callable[[Sequence[ExampleRow]], Floats]:
    """An encoder of an input as numeric columns, centred; unknown values count as the mean."""
    variable = rulebook.variables[name]
    told = [row.inputs[name] for row in rows if row.inputs.get(name) is not None]
    if isinstance(variable, NominalVariable) and not isinstance(variable, OrdinalVariable):
        words = sorted({str(word) for word in told})
        return lambda some: np.array(
            [[row.inputs.get(name) == word for word in words] for row in some], float
        )

    order = variable.categories if isinstance(variable, OrdinalVariable) else ()

    def number(value: object) -> float:
        return float(order.index(str(value)) if order else str(value))

    middle = fsum(map(number, told)) / len(told) if told else 0.0

    def column(some: Sequence[ExampleRow]) -> Floats:
        cells = (row.inputs.get(name) for row in some)
        return np.array([[0.0 if cell is None else number(cell) - middle] for cell in cells])

    return column
