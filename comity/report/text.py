"""How text reaches the terminal: tables that fit, and words of users that are never read as markup."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from comity_fis.listing import listed

if TYPE_CHECKING:
    from rich.console import Console, ConsoleOptions, RenderableType, RenderResult

WIDTH_IN_FILES = 110
"""Columns where there is no terminal to ask."""
READABLE, TEXT = 16, 24
"""Characters that a column of a table has at least, as far as it is that long, and one of whole sentences."""
INDENT, GAP = 2, 2


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
            out.print(part, crop=False)
    sys.stdout.writelines(f"{line.rstrip()}\n" for line in capture.get().splitlines())


def unbroken(text: str) -> RenderableType:
    """Lines with a path or a command, which people copy: never broken, however narrow the terminal is."""
    return _Unbroken(text)


@dataclass(frozen=True, slots=True)
class _Unbroken:
    """A text that keeps its lines: of one that is rich's own, printing forgets how it is to be wrapped."""

    text: str

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        from rich.text import Text

        yield Text(self.text, no_wrap=True, overflow="ignore")


def table(rows: Iterable[Sequence[str]], *, head: Sequence[str] = ()) -> RenderableType:
    """Aligned columns, indented; where they would be too narrow to read, a block of lines for each row."""
    return _Table(tuple(map(tuple, rows)), tuple(head))


@dataclass(frozen=True, slots=True)
class _Table:
    """Rows that know how they look only when they see how wide the terminal is."""

    rows: tuple[tuple[str, ...], ...]
    head: tuple[str, ...]

    def __rich_console__(self, console: Console, options: ConsoleOptions) -> RenderResult:
        from rich.padding import Padding

        if self._needs() <= options.max_width:
            yield Padding(self._columns(), (0, 0, 0, INDENT))
        else:
            yield from self._blocks()

    def _needs(self) -> int:
        """The width of a terminal in which no column is squeezed."""
        edges = 1 + len(self.head)  # of the box around columns with names
        return INDENT + edges + sum(width + GAP for width in self._least())

    def _least(self) -> list[int]:
        """The narrowest that each column can be read in."""
        from rich.cells import cell_len

        rows = [*self.rows, self.head] if self.head else self.rows
        widest = [max(map(cell_len, column)) for column in zip(*rows, strict=True)]
        return widest[:1] + [min(width, TEXT if width > 2 * TEXT else READABLE) for width in widest[1:]]

    def _columns(self) -> RenderableType:
        """The first is never broken, the others wrap."""
        from rich import box
        from rich.table import Table

        head = self.head
        made = Table(
            box=box.SIMPLE_HEAD if head else None,
            show_header=bool(head),
            padding=(0, GAP, 0, 0),
            pad_edge=False,
        )
        for i, least in enumerate(self._least()):
            made.add_column(head[i] if head else "", no_wrap=i == 0, overflow="fold", min_width=least)
        for row in self.rows:
            made.add_row(*row)
        return made

    def _blocks(self) -> Iterator[RenderableType]:
        """What a row is about, and below it the rest of it, `name: value` where the columns have names."""
        from rich.padding import Padding

        names = [f"{title}: " for title in self.head[1:]]
        if names:
            yield ""
        for first, *others in self.rows:
            about = f"{self.head[0]} {first}" if first.isdigit() and names else first
            yield unbroken(" " * INDENT + about)
            for i, text in enumerate(others):
                if text:
                    yield Padding(
                        f"{names[i] if names else ''}{text}", (0, 0, 0, 2 * INDENT + _indent(first))
                    )
        if names:
            yield ""


def _indent(text: str) -> int:
    """Spaces at its start."""
    return len(text) - len(text.lstrip())


def number(value: float | str | None, unit: str | None = None, digits: int = 3) -> str:
    """A value as people read it: `0.640 m`, `nod`, or a dash for nothing."""
    if value is None:
        return "-"
    if isinstance(value, str):
        return value.replace("_", " ")
    rounded = round(value, 1 if unit == "deg" else digits) + 0.0  # no negative zero
    text = f"{rounded:.{1 if unit == 'deg' else digits}f}"
    return f"{text} {unit}" if unit and unit != "1" else text


def step(value: float | str, unit: str | None, *, first: bool) -> str:
    """One contribution: the first is where a value sets out from, further numbers are differences."""
    text = number(value, unit)
    return f"+{text}" if not first and not isinstance(value, str) and value > 0 else text


def words(name: str) -> str:
    """A parameter's or variable's name as people say it."""
    return name.replace("_", " ")


def spans(numbers: Iterable[int]) -> str:
    """Ascending numbers in a row, neighbours as one span: `1-4, 9, 11-13`."""
    rows: list[list[int]] = []
    for one in numbers:
        if rows and one == rows[-1][-1] + 1:
            rows[-1].append(one)
        else:
            rows.append([one])
    return ", ".join(f"{row[0]}-{row[-1]}" if len(row) > 1 else f"{row[0]}" for row in rows)


def words_of(names: Iterable[str]) -> str:
    """Names as people say them, in a row."""
    return ", ".join(map(words, names))


def terms_in_words(terms: Iterable[str]) -> str:
    """Terms in a sentence: `medium and far`."""
    return listed(map(words, terms))


def stated(fact: object, unit: str | None = None) -> str:
    """What was disclosed of a variable: `female`, `38`, `82 years`, roughly `60..70 years`."""
    text = f"{fact:g}" if isinstance(fact, float | int) else str(fact)
    return f"{text} {unit}" if unit and unit != "1" else text


def duration_text(seconds: float) -> str:
    """`40 s`, `12 min`, `3.5 h`."""
    if seconds < 100:
        return f"{max(seconds, 1):.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
