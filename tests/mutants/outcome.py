"""What the scenarios said about every change, as a table."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from tests.mutants.mutation import Mutation
from tests.mutants.telling_apart import Apart


@dataclass(frozen=True)
class Outcome:
    """What came of one change."""

    mutation: Mutation
    caught_by: str | None
    text: str
    """Of the failure."""
    tried: int
    """Tests until then."""
    otherwise: tuple[str, ...]
    """The tests that held, and whose golden episode of the unchanged software would not."""
    apart: Apart | None = None
    """Whether random episodes tell a survivor from the original; None where that was not asked."""

    @property
    def named(self) -> bool:
        """Whether the failure points to the change."""
        told = (
            line for line in self.text.splitlines() if not line.startswith("  file ")
        )  # says where, not what
        text = "\n".join(told).lower()
        return any(word.lower() in text for word in self.mutation.culprits)

    @property
    def noticed(self) -> bool:
        """Whether an expectation does not hold, or a golden episode would not."""
        return bool(self.caught_by or self.otherwise)

    @property
    def indistinct(self) -> bool:
        """Whether nothing notices it, random episodes execute it, and not one tells it from the original."""
        return not self.noticed and self.apart is not None and self.apart.by is None and self.apart.tried > 0

    def row(self) -> str:
        """A line of the table."""
        shown = self.mutation.shown.replace("|", "\\|")
        named = "-" if not self.caught_by else "yes" if self.named else "no"
        place = f"{self.mutation.file}:{self.mutation.line}"
        caught = self.caught_by or f"**survived**; {self.unseen}"
        return f"| {place} | {self.mutation.family} | `{shown}` | {caught} | {named} |"

    @property
    def unseen(self) -> str:
        """Why a change that survived did: nothing came out otherwise, or nobody expects it."""
        library = "not one episode differs"
        if self.otherwise:
            library = f"{len(self.otherwise)} of {self.tried} differ, such as {self.otherwise[0]}"
        return library if self.apart is None else f"{library}; {self.apart.words}"


def table(
    outcomes: Sequence[Outcome],
    seed: int,
    reached: Mapping[str, tuple[int, int]],
    places: int,
    left_out: Mapping[str, int],
) -> str:
    """The report as Markdown.

    Args:
        outcomes: One for each change.
        seed: By which they were chosen.
        reached: By package, how many lines of code the scenarios execute, and how many there are.
        places: From how many changes they were chosen.
        left_out: By the rule, how many others were not among these.
    """
    rules = [f"| {rule} | {count} |" for rule, count in sorted(left_out.items(), key=lambda one: -one[1])]
    head = ["", "| places | changes |", "|---|---|", f"| to choose from | {places} |"]
    return "\n".join([*_summary(outcomes, seed, reached), *head, *rules, "", *_rows(outcomes)]) + "\n"


def _summary(outcomes: Sequence[Outcome], seed: int, reached: Mapping[str, tuple[int, int]]) -> Iterator[str]:
    caught = [one for one in outcomes if one.caught_by]
    named = [one for one in caught if one.named]
    yield (
        f"{len(outcomes)} changes, chosen with seed {seed}: {len(caught)} caught "
        f"({_share(caught, outcomes)}); the text of the failure names the culprit in {len(named)} of these "
        f"({_share(named, caught)})."
    )
    indistinct = [one for one in outcomes if one.indistinct]
    rest = [one for one in outcomes if not one.indistinct]
    golden = [one for one in rest if one.noticed]
    yield (
        f"{len(indistinct)} of those that survived cannot be told from the original by random episodes; "
        f"of the {len(rest)} others {_share(caught, rest)} are caught."
    )
    noticed = [one for one in outcomes if one.noticed]
    yield (
        f"With golden episodes of the original besides, {len(noticed)} are noticed "
        f"({_share(noticed, outcomes)}; {_share(golden, rest)} of the others)."
    )
    yield (
        "\n| package | lines reached | changes | caught | culprit named "
        "| golden episodes notice | missed | cannot be told apart |"
    )
    yield "|---" * 8 + "|"
    for package in Counter(one.mutation.package for one in outcomes):
        lines = f"{reached[package][0] / reached[package][1]:.0%}" if package in reached else "-"
        yield _package(package, lines, [one for one in outcomes if one.mutation.package == package])


def _package(package: str, lines: str, outcomes: Sequence[Outcome]) -> str:
    caught = [one for one in outcomes if one.caught_by]
    indistinct = sum(one.indistinct for one in outcomes)
    missed = len(outcomes) - len(caught) - indistinct
    return (
        f"| {package} | {lines} | {len(outcomes)} | {len(caught)} | {sum(one.named for one in caught)} "
        f"| {sum(one.noticed for one in outcomes)} | {missed} | {indistinct} |"
    )


def _rows(outcomes: Sequence[Outcome]) -> Iterator[str]:
    yield from ("| place | kind | change | caught by | culprit named |", "|---|---|---|---|---|")
    yield from (one.row() for one in outcomes)


def _share(part: Sequence[object], whole: Sequence[object]) -> str:
    return f"{len(part) / max(1, len(whole)):.0%}"
