"""The page about metrics lists every figure as the program defines it."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity_sim2d import EPISODE, VISIT

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "metrics.md"


def rows_of(definitions):
    return [
        f"| `{name}` | {one.unit if one.unit != '1' else ''} | {one.means} | {one.source} |"
        for name, one in definitions.items()
    ]


@pytest.mark.parametrize("definitions", [EPISODE, VISIT], ids=["of the episode", "of a person"])
def test_the_page_has_the_program_s_definitions_in_their_order(definitions):
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line in rows_of(definitions)]
    assert lines == rows_of(definitions)
