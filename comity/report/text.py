"""How text reaches the terminal: tables that fit, and words of users that are never read as markup."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console, RenderableType
    from rich.padding import Padding

WIDTH_IN_FILES = 110
"""Columns where there is no terminal to ask."""


def console(*, to_errors: bool = False) -> Console:
    """A console that prints users' words literally."""
    from rich.console import Console

    stream = sys.stderr if to_errors else sys.stdout
    return Console(
        file=stream,
        markup=False,
        highlight=False,
        emoji=False,
        width=None if stream.isatty() else WIDTH_IN_FILES,
    )


def show(*parts: RenderableType) -> None:
    """Print parts to standard output, without the blanks that tables leave at the ends of lines."""
    out = console()
    with out.capture() as capture:
        for part in parts:
            out.print(part)
    sys.stdout.writelines(f"{line.rstrip()}\n" for line in capture.get().splitlines())


def table(rows: Iterable[Sequence[str]], *, head: Sequence[str] = ()) -> Padding:
    """Aligned columns, indented; the first is never broken, the others wrap."""
    from rich import box
    from rich.padding import Padding
    from rich.table import Table

    rows = list(rows)
    made = Table(
        box=box.SIMPLE_HEAD if head else None, show_header=bool(head), padding=(0, 2, 0, 0), pad_edge=False
    )
    for i in range(len(head) or max((len(row) for row in rows), default=0)):
        made.add_column(head[i] if head else "", no_wrap=i == 0, overflow="fold")
    for row in rows:
        made.add_row(*row)
    return Padding(made, (0, 0, 0, 2))


def number(value: float | str | None, unit: str | None = None, digits: int = 3) -> str:
    """A value as people read it: `0.640 m`, `nod`, or a dash for nothing."""
    if value is None:
        return "-"
    if isinstance(value, str):
        return value.replace("_", " ")
    rounded = round(value, 1 if unit == "deg" else digits) + 0.0  # no negative zero
    text = f"{rounded:.{1 if unit == 'deg' else digits}f}"
    return f"{text} {unit}" if unit else text


def words(name: str) -> str:
    """A parameter's or variable's name as people say it."""
    return name.replace("_", " ")


def stated(fact: object) -> str:
    """What was disclosed of a variable: `female`, `38.0`, `60.0 to 70.0` where only that much is known."""
    return " to ".join(map(str, fact)) if isinstance(fact, tuple) else str(fact)
