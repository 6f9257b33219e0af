"""`comity audit`: what a rulebook rests on, which people it covers, and what it does to whom."""

from __future__ import annotations

from typing import Annotated

import typer

from comity.commands.options import AsJson, print_json


def audit(
    rulebook: Annotated[
        str, typer.Argument(metavar="RULEBOOK", help="A shipped rulebook or a file.")
    ] = "bruno2017",
    as_json: AsJson = False,
) -> None:
    """Audit a rulebook: evidence, coverage, contradictions, sensitivity, fairness, findings.

    Which grade of evidence the rules have; for whom they decide anything; which rules contradict each
    other; how far each attribute moves each parameter; how differently people are treated who differ in
    nationality or gender alone; and which ordinal findings of the literature the rulebook agrees with.

    For example `comity audit bruno2017-case2`, or `comity audit mine.yaml --json`.
    """
    from comity.report.rulebooks.audit import audit_text
    from comity.report.text import show
    from comity_fis import load_rulebook
    from comity_fis.audit import audit as audited

    book = load_rulebook(rulebook)
    found = audited(book)
    if as_json:
        print_json(found)
    else:
        show(*audit_text(found, book))
