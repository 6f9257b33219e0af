"""Learning from a table: proposals for one parameter, their evaluation, and the accepted one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Literal

from comity.parameters.which_rulebook import EVIDENCE
from comity.tables.basis import basis_of
from comity.tables.contenders import CONSTANT, PRIOR, RULES, Contenders
from comity.tables.evaluation import USUAL_RADII, Radii
from comity.tables.examples import Examples, LeftOut, chosen_inputs, examples
from comity.tables.leaving_out import Judgement, judged
from comity.tables.measurements import read_measurements, table_path
from comity.tables.proposal import cells_of, is_in_terms, prior_of, with_cells, with_prior
from comity_fis import Rulebook, Source, load_rulebook
from comity_fis.audit.order import equality_band
from comity_fis.learning.pooling import PooledPrior
from comity_fis.learning.rule_table import Cell

Kind = Literal["rules", "prior"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Lesson:
    """What can be learnt from a table about one parameter."""

    rulebook: Rulebook
    """The rulebook to be changed."""
    examples: Examples
    inputs: tuple[str, ...]
    cells: tuple[Cell, ...]
    prior: PooledPrior | None
    """The proposed prior; None if no row names its participant."""
    judgement: Judgement
    digest: str
    """SHA-256 of the table, in hexadecimal."""

    @property
    def lacking_inputs(self) -> int:
        """Number of rows unused for rules, since an input is unknown or has no term."""
        return sum(not is_in_terms(self.rulebook, self.inputs, row) for row in self.examples.rows)

    @property
    def proposals(self) -> tuple[Kind, ...]:
        """Available proposals: rules if any combination of terms has enough rows, and the prior."""
        rules: tuple[Kind, ...] = (RULES,) if any(not cell.is_thin for cell in self.cells) else ()
        return (*rules, PRIOR) if self.prior is not None else rules

    def in_the_way(self, kind: Kind) -> tuple[str, ...]:
        """Simpler alternatives that a proposal does not beat.

        An alternative is beaten if its error is larger by more than the smallest difference that counts, with
        enough units for an interval; a constant must also be worse beyond chance. The reason is that the mean
        of the other rows is always slightly farther off than any fixed number near it, which says nothing
        about people.
        """
        against, least = self.judgement.differences[kind], equality_band(self.examples.parameter)
        beaten = {name for name, one in against.items() if one.low is not None and one.difference < -least}
        if against[CONSTANT].verdict != "better":
            beaten -= {CONSTANT}
        return tuple(name for name in self.rivals(kind) if name not in beaten)

    def rivals(self, kind: Kind) -> tuple[str, ...]:
        """Alternatives that a proposal has to beat to be written: what a rulebook could contain instead.

        A linear model cannot be a rulebook, so it is not among them. A prior of one group is itself a
        constant, and is only compared with the rulebook.
        """
        constant = () if kind == PRIOR and self._is_one_group else (CONSTANT,)
        return (*constant, self.rulebook.name)

    @property
    def standing(self) -> Kind | None:
        """The proposal with the smallest error that beats all its rivals; None if nothing is learnt."""
        free: list[Kind] = [kind for kind in self.proposals if not self.in_the_way(kind)]
        free.sort(key=lambda kind: self.judgement.errors[kind].mean_absolute_error)
        return free[0] if free else None

    def learnt(self, kind: Kind, source: Source) -> Rulebook:
        """The rulebook with a proposal applied."""
        name = self.examples.parameter.name
        if kind == PRIOR:
            assert self.prior is not None
            return with_prior(self.rulebook, name, self.prior, source)
        return with_cells(self.rulebook, name, self.cells, source)

    @property
    def _is_one_group(self) -> bool:
        return len({row.group for row in self.examples.rows}) == 1


def learn(
    table: str,
    parameter: str,
    rulebook: Rulebook,
    *,
    inputs: Sequence[str] = (),
    left_out: LeftOut | None = None,
    radii: Radii = USUAL_RADII,
) -> Lesson:
    """Learn about one parameter from a table.

    Args:
        table: Path of a file, in the format of `comity evaluate`.
        parameter: Name of a numeric parameter; also used for rows that name none.
        rulebook: The rulebook whose terms are used.
        inputs: Input variables of rules; empty for those that describe the person.
        left_out: Unit of cross-validation; None for a participant if rows name them, else a study, else a
            row.
        radii: Radii of the bodies, for distances.

    Raises:
        InputError: if something cannot be used, with its line in the table.
    """
    basis = basis_of(rulebook, parameter)
    found = examples(rulebook, basis, read_measurements(table, rulebook, about=parameter), radii)
    read = chosen_inputs(rulebook, found, inputs)
    evidence = load_rulebook(EVIDENCE)
    books = {EVIDENCE: evidence} if parameter in evidence.parameters else {}
    contenders = Contenders(basis, read, {**books, rulebook.name: rulebook})
    learners = contenders.learners(people=found.named)
    return Lesson(
        rulebook=rulebook,
        examples=found,
        inputs=read,
        cells=cells_of(basis, read, found.rows),
        prior=prior_of(basis, found.rows) if found.named else None,
        judgement=judged(
            found.rows,
            learners,
            left_out or found.left_out,
            proposals=[name for name in (RULES, PRIOR) if name in learners],
            file=found.file,
        ),
        digest=sha256(table_path(table).read_bytes()).hexdigest(),
    )
