"""What people read: honest about what was not disclosed, and readable in any terminal."""

from __future__ import annotations

from contextlib import redirect_stdout
from io import StringIO

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rich.console import Console
from saved import saved

from comity.replay.pictures import rings_of
from comity.report.text import show, table, unbroken


def flat(text: str) -> str:
    return " ".join(text.split())


def test_a_run_names_disclosed_reasons_first_and_sums_up_what_is_only_possible(comity):
    """Johanna told neither her age nor her experience: she is not made out to be old or inexperienced."""
    said = flat(comity("run", "johanna").out)
    speed = said[said.index("approach speed") : said.index("greeting modality")]
    assert "individualism is LC1 → slow (rule 10, 0.84)" in speed
    assert "age, robot experience not disclosed: rules 7, 8 hold as possible" in speed
    assert "elderly" not in speed
    assert "robot_experience" not in said


def test_a_rule_that_is_known_in_part_says_what_is_not(comity):
    said = flat(comity("infer", "--set", "individualism=38").out)
    assert "gender not disclosed" in said[said.index("conversational") :]


def test_an_explanation_says_at_each_rule_that_it_holds_only_for_want_of_facts(comity):
    said = comity("explain", "approach_speed", "arab_woman").out
    for rule, fact in (
        ("if robot experience is low", "robot experience"),
        ("if age is elderly", "age"),
    ):
        part = flat(said[said.index(rule) :])
        assert part.index(f"holds only because {fact} was not disclosed") < part.index("evidence")
    assert said.index("10     slow") < said.index("7      slow")
    assert "individualism     38\n" in said


def test_a_number_has_its_unit(comity):
    assert "age 82 years" in comity("infer", "british_elder").out
    assert "age               82 years" in comity("explain", "approach_speed", "british_elder").out


def test_plan_and_run_say_why_the_front_is_bearing_0(comity):
    plan, run = flat(comity("plan", "two-visits").out), flat(comity("run", "two-visits").out)
    assert "approach direction 11.7 deg off the front (situation), side front: bearing 0.0 deg" in plan
    assert "11.7 deg → front" in run
    for said in (plan, run):
        assert "on the side front the two cancel out, and the bearing is 0" in said


HEAD = ("parameter", "value", "because")
ROWS = [("distance", "0.640 m", "individualism is LC1 and gender is female → close (rule 1, 0.84)")]


@pytest.mark.parametrize("width", [20, 40, 80, 120])
def test_no_table_is_squeezed(width):
    out = StringIO()
    Console(file=out, width=width).print(table(ROWS, head=HEAD))
    lines = out.getvalue().splitlines()
    assert max(map(len, lines)) <= width
    assert "individualism" in out.getvalue()
    assert ("  value: 0.640 m" in out.getvalue()) == (width <= 40)


def test_the_trace_refuses_what_is_not_there(comity):
    comity("run", "--out", "run", "--json")
    unknown = comity("trace", "run", "--node", "docked?(johana)")
    assert unknown.code == 2
    assert "Did you mean 'docked?(johanna)'?" in unknown.err
    reversed_ = comity("trace", "run", "--between", 5, 2)
    assert reversed_.code == 2
    assert "--between 2 5" in reversed_.err
    assert "the run ended at t=" in comity("trace", "run", "--at", 999).out
    assert "the run ended at t=" in comity("trace", "run", "--between", 900, 999).out


def test_the_card_of_a_person_out_of_reach_shows_their_profile(comity, here):
    vera = next(ring for ring in rings_of(saved("walled-in", here / "run")) if ring.person == "vera")
    profile, remark = vera.label.splitlines()
    assert profile == comity("run", "walled-in", "--json").json["profiles"]["vera"].replace("_", " ")
    assert remark == "could not be served"


@given(
    st.lists(st.text("ab /'.", min_size=1, max_size=90).map(str.rstrip).filter(bool), min_size=1, max_size=9)
)
def test_what_is_copied_stays_whole_whatever_its_length(lines):
    """As it is printed and as the head of a row that has no place beside its other columns."""
    with redirect_stdout(StringIO()) as out:
        show(*map(unbroken, lines))
    assert out.getvalue().splitlines() == lines
    path = "/".join("".join(lines).split()) + "/" + 120 * "x"
    with redirect_stdout(StringIO()) as out:
        show(table([(path, "what it shows")]))
    assert out.getvalue().splitlines()[0] == f"  {path}"


def test_a_run_names_what_it_wrote_in_lines_that_can_be_copied(comity, tmp_path):
    folder = tmp_path / "runs of a long day" / "with names of several words each" / "the first one of them"
    folder.parent.mkdir(parents=True)
    said = comity("run", "empty-room", "--out", str(folder)).out.splitlines()
    assert f"Folder   {folder}" in said
    assert f"Picture  {folder / 'picture.png'}" in said
    drawn = tmp_path / "runs of a long day" / f"{'the ward as it is in the morning ' * 4}.png"
    assert comity("draw", "ward", "--out", str(drawn)).out.splitlines() == [f"Picture  {drawn}"]
