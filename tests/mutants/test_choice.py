"""Which changes are made: none that cannot come out otherwise in what ships."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.mutants.attempt import rounds
from tests.mutants.progress import counted
from tests.mutants.python_mutations import left_out, mutations
from tests.mutants.reach import Reach
from tests.mutants.selection import SHARES, names_read, selected, shared_out

CODE = """\
MARGIN_M = 0.2


def nearer(gap_m: float, limit_m: float) -> float:
    if gap_m < 0:
        raise ValueError("no gap")
    if gap_m == limit_m:
        return limit_m
    note = f"{gap_m - limit_m:.2f} m" if gap_m > limit_m else ""
    return Answer(min(gap_m, limit_m - MARGIN_M), note)


def explain(gap_m: float) -> Account | None:
    return Account("near") if gap_m < 1.0 else None
"""
ALL = set(range(1, 15))


def shown(root: Path, executed: set[int]) -> list[str]:
    (root / "domain").mkdir(exist_ok=True)
    (root / "domain" / "near.py").write_text(CODE, encoding="utf-8")
    return [one.shown for one in mutations(root, "domain/near.py", "domain", executed)]


def test_units_signs_comparisons_and_guards_are_changed(tmp_path):
    """And in a function that only words a reason nothing is."""
    assert sorted(shown(tmp_path, ALL - {6})) == sorted(
        [
            "0.2 -> 2.0",
            "gap_m == limit_m -> False",
            "gap_m == limit_m -> gap_m != limit_m",
            "min -> max",
            "limit_m - MARGIN_M -> (limit_m) + (MARGIN_M)",
        ]
    )


def test_what_refuses_bad_input_is_changed_only_where_what_ships_comes_to_it(tmp_path):
    assert "gap_m < 0 -> gap_m > 0" not in shown(tmp_path, ALL - {6})
    assert "gap_m < 0 -> gap_m > 0" in shown(tmp_path, ALL)


def test_a_guard_is_removed_only_where_it_was_taken(tmp_path):
    assert "gap_m == limit_m -> False" not in shown(tmp_path, ALL - {6, 8})


@given(st.integers(0, 10_000))
def test_so_many_changes_are_tried_as_are_asked_for(count):
    """Of each package its share, to the whole number above or below."""
    shares = shared_out(count)
    assert sum(shares.values()) == count
    for package, share in SHARES.items():
        assert abs(shares[package] - share * count / sum(SHARES.values())) < 1.0


def test_who_waits_sees_how_far_it_is(capsys):
    assert list(counted("a scenario,", ["x", "y", "z"], every=2)) == ["x", "y", "z"]
    told = capsys.readouterr()
    assert told.err.splitlines() == ["a scenario, 1 of 3: x", "a scenario, 3 of 3: z"]
    assert told.out == ""


@pytest.mark.parametrize("seed", [0, 1])
def test_lines_that_are_added_elsewhere_do_not_alter_the_choice(tmp_path, seed):
    (tmp_path / "fis/comity_fis/rulebooks").mkdir(parents=True)
    (tmp_path / "fis/comity_fis/rulebooks/bruno2017.yaml").write_text("", encoding="utf-8")
    shown(tmp_path, ALL)
    file = tmp_path / "domain" / "near.py"
    reach = {"one": Reach(0.1, (), {"domain/near.py": sorted(ALL)}, {})}
    before = [one.shown for one in selected(tmp_path, reach, 10, seed)]
    file.write_text(f"# A comment.\n{CODE}", encoding="utf-8")
    reach = {"one": Reach(0.1, (), {"domain/near.py": sorted(line + 1 for line in ALL)}, {})}
    assert [one.shown for one in selected(tmp_path, reach, 10, seed)] == before
    assert len(before) == 2


@pytest.mark.parametrize(
    ("code", "rule"),
    [
        ("def nearer(gap_m):\n    return gap_m - 1e-9\n", "allows for rounding"),
        ("def _require_room(gap_m):\n    return gap_m - 0.2\n", "refuses bad input"),
        ("def nearer(gap_m):\n    if gap_m < 0:\n        require_room(gap_m)\n", "refuses bad input"),
        ("FARTHEST_M = 9.0\n", "is a constant that nothing executed reads"),
        ("def why(gap_m):\n    return gap_m - 0.2\n", "words reasons"),
    ],
)
def test_what_is_left_out_is_counted_by_its_rule(tmp_path, code, rule):
    (tmp_path / "near.py").write_text(code, encoding="utf-8")
    arguments = (tmp_path, "near.py", "domain", range(9), {"gap_m"})
    assert list(mutations(*arguments)) == []
    assert set(left_out(*arguments)) == {rule}


def test_a_constant_counts_as_read_only_where_executed_code_reads_it(tmp_path):
    shown(tmp_path, ALL)
    within, beside = [set(range(13, 15)), set(range(4, 12))]
    reading = {"one": Reach(0.1, (), {"domain/near.py": sorted(beside)}, {})}
    other = {"one": Reach(0.1, (), {"domain/near.py": sorted(within)}, {})}
    assert "MARGIN_M" in names_read(tmp_path, reading)
    assert "MARGIN_M" not in names_read(tmp_path, other)


def test_the_profiles_for_which_a_changed_line_is_executed_begin():
    reach = Reach(0.1, ("a", "b", "c"), {"near.py": [1, 2]}, {}, some={"near.py": {"2": ["c"]}})
    assert reach.through("near.py", 1).profiles == ("a", "b", "c")
    through = reach.through("near.py", 2)
    assert through.profiles == ("c", "a", "b")
    first, second = [*rounds({"x": through, "y": through}, 2)][1:]
    assert {turn.profile for turn in first} == {"c"}
    assert {turn.profile for turn in second} == {"a"}
