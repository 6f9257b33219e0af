"""Differences are told once for each case, and not for each pair of people."""

from __future__ import annotations

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from comity.report.text import console
from comity.testing.reporting.answers import UnexplainedAnswer
from comity.testing.reporting.contrasts import contrasts

NAMES = ("ann", "bob", "cid", "dora", "eve")


def pair(one, other, *, case="visit[seed0]", settings=(), because="nobody's culture may decide that"):
    return UnexplainedAnswer(
        scenario="visit",
        case=case,
        what="detour",
        unit="m",
        profiles=(one[0], other[0]),
        values=(one[1], other[1]),
        settings=settings,
        because=because,
        text="",
    )


def told(*pairs):
    out = console()
    with out.capture() as capture:
        out.print(*contrasts(pairs), sep="\n")
    return [line.rstrip() for line in capture.get().splitlines() if line.strip()]


@given(st.lists(st.floats(0.0, 9.0), min_size=2, max_size=len(NAMES)))
def test_everybody_is_named_once_and_who_gets_most_first(values):
    people = list(zip(NAMES, values, strict=False))
    head, *rows = told(*(pair(*both) for both in combinations(people, 2)))
    assert head == "visit[seed0]: detour; nobody's culture may decide that"
    named = [name for row in rows for name in row.split(" m  ")[1].split(", ")]
    assert sorted(named) == sorted(name for name, _ in people)
    got = [float(row.split(" m")[0]) for row in rows]
    assert got == sorted(set(got), reverse=True)
    assert set(got) == {round(value, 2) for value in values}


def test_seeds_are_told_apart():
    first, second = pair(("ann", 1.0), ("bob", 2.0)), pair(("ann", 3.0), ("bob", 2.0), case="visit[seed1]")
    assert told(first, second) == [
        "visit[seed0]: detour; nobody's culture may decide that",
        "  2.00 m  bob",
        "  1.00 m  ann",
        "visit[seed1]: detour; nobody's culture may decide that",
        "  3.00 m  ann",
        "  2.00 m  bob",
    ]


def test_of_what_was_asked_for_only_what_all_pairs_share_is_named():
    asked = pair(("ann", 1.0), ("bob", 2.0), settings=("conversational_distance", "greeting_gesture"))
    head, *_ = told(asked, pair(("ann", 1.0), ("cid", 2.0), settings=("conversational_distance",)))
    assert head == "visit[seed0]: detour; one of them asked for another conversational_distance"
