"""The model card's tables are what the audit and the evaluation compute; `make tables` writes them again."""

from __future__ import annotations

from functools import cache
from typing import get_args

import pytest

from comity.report.difference import difference, share
from comity.report.text import words
from comity.tables.evaluation import Evaluation, evaluate
from comity.tables.measurements import SHIPPED, read_measurements
from comity_fis import load_rulebook, shipped_rulebooks
from comity_fis.audit import Audit, audit
from comity_fis.rules.rule import Evidence
from tests.docs.tables import Tables, markdown, write, written

CARD = "model-card.md"
GRADES = get_args(Evidence)


@cache
def audits() -> tuple[Audit, ...]:
    return tuple(audit(load_rulebook(name)) for name in shipped_rulebooks())


@cache
def evaluations() -> tuple[Evaluation, ...]:
    books = map(load_rulebook, shipped_rulebooks())
    return tuple(evaluate(book, read_measurements(SHIPPED, book)) for book in books)


def evidence() -> str:
    rows = []
    for one in audits():
        counts = [len(one.evidence.grades.get(grade, ())) for grade in GRADES]
        off = sum(map(len, one.evidence.off.values()))
        rows.append([f"`{one.rulebook}`", sum(counts), *counts, off, one.evidence.with_counter_evidence])
    return markdown(["rulebook", "rules in use", *GRADES, "not in use", "with counter-evidence"], rows)


def coverage() -> str:
    rows = []
    for one in audits():
        counts = one.findings.counts
        rows.append(
            [
                f"`{one.rulebook}`",
                f"{one.coverage.cultures} of {one.coverage.scored}",
                ", ".join(one.coverage.named) or "none",
                len(one.conflicts),
                counts.agreeing,
                counts.contradicting,
                counts.equal,
                one.findings.untested,
            ]
        )
    head = ["rulebook", "rows covered", "cultures named in rules", "rules at odds"]
    return markdown([*head, "findings: agreeing", "contradicting", "equal", "not comparable"], rows)


def treatment() -> str:
    rows = []
    for one in audits():
        book = load_rulebook(one.rulebook)
        for found in one.pairs:
            unit = getattr(book.parameters[found.parameter], "unit", None)
            rows.append(
                [
                    f"`{one.rulebook}`",
                    words(found.parameter),
                    "nationality" if found.attribute == "culture" else found.attribute,
                    found.pairs,
                    share(found.differing),
                    difference(found.largest, unit, sign=False),
                    difference(found.median, unit, sign=False),
                ]
            )
    head = ["rulebook", "parameter", "differing in", "pairs", "treated differently", "largest", "median"]
    return markdown(head, rows)


def accuracy() -> str:
    rows = []
    for one in evaluations():
        for numbers in one.numbers.values():
            surface, centre = numbers.readings["surface"], numbers.readings["centre"]
            rows += [
                [
                    f"`{one.rulebook}`",
                    study,
                    surface[study].rows,
                    difference(surface[study].mean_absolute_error, "m", sign=False),
                    difference(centre[study].mean_absolute_error, "m", sign=False),
                    difference(surface[study].neutral, "m", sign=False),
                    difference(surface[study].constant, "m", sign=False),
                ]
                for study in surface
            ]
    head = ["rulebook", "study", "rows", "error if surfaces", "if centres", "neutral value", "constant"]
    return markdown(head, rows)


TABLES: Tables = {
    "evidence": evidence,
    "coverage": coverage,
    "treatment": treatment,
    "accuracy": accuracy,
}


@pytest.mark.parametrize("name", TABLES)
def test_a_table_of_the_model_card_is_what_is_computed(name):
    """If this fails because a rulebook changed: `make tables`, and read what it changed."""
    tables = written(CARD)
    assert tables.keys() == TABLES.keys()
    assert tables[name] == TABLES[name]()


if __name__ == "__main__":
    write(CARD, TABLES)
