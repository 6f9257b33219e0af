"""Tables of the docs that are computed: each stands between two marks, and `make tables` writes it again."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

PAGES = Path(__file__).parents[2] / "docs" / "reference"
MARKED = re.compile(r"(<!-- (\w+): made by `make tables` -->\n)(.*?)(<!-- end -->)", re.DOTALL)

Tables = Mapping[str, Callable[[], str]]
"""What computes each table, by the name in its mark."""


def markdown(head: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """A table, with an empty line before and after."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n" + "".join(f"| {' | '.join(map(str, line))} |\n" for line in lines) + "\n"


def written(page: str) -> dict[str, str]:
    """The tables that a page has, by their names."""
    return {found[2]: found[3] for found in MARKED.finditer((PAGES / page).read_text(encoding="utf-8"))}


def write(page: str, tables: Tables) -> None:
    """Write the tables of a page again."""
    text = (PAGES / page).read_text(encoding="utf-8")
    text = MARKED.sub(lambda found: found[1] + tables[found[2]]() + found[4], text)
    (PAGES / page).write_text(text, encoding="utf-8")
