"""The page about metrics lists every metric as the registries define it."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.testing.measuring.registry import TESTED
from comity_sim2d import EPISODE, VISIT

PAGE = Path(__file__).parents[2] / "docs" / "reference" / "metrics.md"


def rows_of(metrics):
    return [
        " | ".join(
            [
                f"| `{name}`",
                one.unit if one.unit != "1" else "",
                one.means,
                *([one.per] if one.per != "run" else []),
                f"{one.source} |",
            ]
        )
        for name, one in metrics.items()
    ]


@pytest.mark.parametrize(
    "metrics", [EPISODE, VISIT, TESTED], ids=["per run", "per visit and per person", "compared by tests"]
)
def test_the_page_has_the_definitions_of_the_registry_in_their_order(metrics):
    lines = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line in rows_of(metrics)]
    assert lines == rows_of(metrics)


def test_the_page_has_no_other_metric():
    named = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("| `")]
    assert named == [*rows_of(EPISODE), *rows_of(VISIT), *rows_of(TESTED)]
