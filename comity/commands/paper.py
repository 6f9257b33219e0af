"""`comity paper`: the paper's six numbers beside ours."""

from __future__ import annotations

from comity.commands.options import AsJson, print_json


def paper(as_json: AsJson = False) -> None:
    """Print the paper's six distances beside ours, in every mode, with the differences."""
    from comity.report.text import show
    from comity.report.values.paper import paper_answer, paper_text

    answer = paper_answer()
    if as_json:
        print_json(answer)
    else:
        show(*paper_text(answer))
