"""`comity trace --why` and `--diff`, and the same from Python."""

from __future__ import annotations

import pytest

import comity as front_door
from comity.preparation import prepare
from comity.recording import record
from comity.scenario import load_scenario


@pytest.fixture
def runs(here):
    """The same visit for two profiles."""
    for name, profile in (("one", "arab_woman"), ("other", "german_man")):
        prepared = prepare(load_scenario("johanna"), profiles={"johanna": profile})
        record(prepared, out=here / name, views=())


def test_why_at_a_time_goes_from_the_action_to_the_culture_score(comity, runs):
    said = comity("trace", "one", "--why", "7.3")
    assert said.code == 0
    assert "Dock_to_user(johanna) is running since" in said.out
    assert "docked?(johanna) came out false at t=0.00 s" in said.out
    assert "if individualism is LC1 and gender is female then conversational_distance is close" in said.out
    assert "individualism 38" in said.out
    assert said.out.count("docked?(johanna) came out") == 1


def test_the_blackboard_is_shown_as_it_was_at_a_time(comity, runs):
    at_end = {
        one["entry"]: one for one in comity("trace", "one", "--blackboard", "--json").json["blackboard"]
    }
    assert at_end["johanna/docked"]["value"] == "yes"
    assert at_end["johanna/performed"] | {"t": 0} == {
        "entry": "johanna/performed",
        "value": "say, nod",
        "t": 0,
        "leaf": "nod(johanna)",
    }
    said = comity("trace", "one", "--blackboard", "--at", "2").out
    assert "Navigate_to_user(johanna)" in said
    assert "johanna/docked" not in said
    assert "that: the run ended" in comity("trace", "one", "--blackboard", "--at", "999").out


def test_a_run_without_its_blackboard_or_with_a_damaged_one(comity, here, runs):
    """Its page has none; the question is refused with file and line."""
    file = here / "one" / "blackboard.csv"
    file.write_text(file.read_text() + "soon,johanna/docked,yes,nobody\n")
    refused = comity("trace", "one", "--blackboard")
    assert (refused.code, "blackboard.csv:" in refused.err, "'soon'" in refused.err) == (2, True, True)
    file.unlink()
    assert "no such file" in comity("trace", "one", "--blackboard").err
    assert comity("replay", "one").code == 0


def test_two_questions_in_one_are_refused(comity, runs):
    assert comity("trace", "one", "--blackboard", "--why", "2").code == 2


def test_the_chain_ends_at_the_source_of_the_score(comity, runs):
    """Whose score it is and where it stands, in text and JSON, right behind the variable."""
    said = " ".join(comity("trace", "one", "--why", "2").out.split())
    assert (
        "variable individualism 38 source the score of Arab countries is 38: Hofstede, Hofstede & Minkov, "
        "Cultures and Organizations, 3rd edition, 2010" in said
    )
    (reason,) = comity("trace", "one", "--why", "2", "--json").json["why"]
    kinds = [cause["kind"] for cause in reason["because"]]
    assert kinds[kinds.index("variable") + 1] == "source"
    assert kinds.count("source") == 1, "gender was declared: it has none"


def test_a_number_that_somebody_states_themselves_has_no_source_but_them():
    stated = prepare(load_scenario("johanna"), profiles={"johanna": "german_woman"}).values["johanna"]
    assert stated.sources["individualism"].startswith("the score of Germany is 67")
    assert front_door.infer("german_woman").sources == stated.sources
    assert front_door.infer("unknown").sources == {}


def test_why_of_a_node_is_why_it_did_what_it_did_last(comity, runs):
    said = comity("trace", "one", "--why", "Dock_to_user", "--json")
    (reason,) = said.json["why"]
    assert reason["event"]["halt"] == "achieved_early"
    assert [cause["kind"] for cause in reason["because"]][:3] == ["reading", "condition", "step"]
    early = comity("trace", "one", "--why", "Dock_to_user", "--at", "7.3", "--json")
    assert early.json["why"][0]["event"]["status"] == "running"


def test_two_profiles_part_in_reasons_first_and_then_in_what_the_robot_does(comity, runs):
    said = comity("trace", "one", "--diff", "other")
    assert said.code == 0
    assert said.out.index("The reasons differ from t=0.00 s") < said.out.index(
        "They do different things from"
    )
    assert "individualism 38" in said.out
    assert "individualism 67" in said.out
    differences = comity("trace", "one", "--diff", "other", "--json").json["differences"]
    assert [difference["in_behaviour"] for difference in differences] == [False, True]


def test_a_run_does_not_part_from_itself(comity, runs):
    said = comity("trace", "one", "--diff", "one")
    assert said.out == "The two runs did the same at the same times, for the same reasons.\n"


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("--why", "no_such"), "expected a time in seconds, or a part of the name of a node of this run"),
        (("--why=-1",), "expected a time from 0 s on, or a node, got -1"),
        (("--why", "nan"), "expected a time from 0 s on"),
        (("--why", "nod(", "--at", "1"), "expected a node that did something by then"),
        (("--why", "3", "--at", "1"), "expected one question at a time, got --why 3 and --at"),
        (("--node", ""), "expected a part of the name of a node of this run, got ''. Known are: Achieve("),
        (("--why", ""), "expected a time in seconds, or"),
        (("--diff", "one", "--at", "1"), "expected one question at a time"),
        (("--diff", "nowhere"), "nowhere"),
        (("--between", "nan", "5"), "Write for example --between 5 10"),
        (("--between", "-3", "5"), "Write --between 0 5"),
        (("--between", "0", "inf"), "Write --between 0 12: the run ended at 11."),
        (("--between", "inf", "inf"), "Write for example --between 5 10"),
        (("--between", "-inf", "5"), "Write for example --between 5 10"),
        (("--between", "5", "nan"), "Write for example --between 5 10"),
        (("--at", "inf"), "expected a time from 0 s on, got inf. Write for example --at 7.3"),
        (("--at", "nan"), "expected a time from 0 s on, got nan"),
        (("--at=-1",), "expected a time from 0 s on, got -1"),
        (("--events", "--at", "inf"), "expected a time from 0 s on, got inf"),
        (("--between", "10", "5"), "Write --between 5 10"),
        (
            ("--why", "3", "--node", "say"),
            "expected one question at a time, got --why and --events, --node or --between",
        ),
        (("--why", "3", "--diff", "other"), "expected one question at a time, got --why and --diff"),
    ],
)
def test_what_cannot_be_answered_is_refused(comity, runs, words, expected):
    said = comity("trace", "one", *words)
    assert (said.code, said.out) == (2, "")
    assert expected in said.err
    assert "Traceback" not in said.err


def test_asked_about_a_time_beyond_the_end_it_says_so(comity, runs):
    said = comity("trace", "one", "--why", "500")
    assert said.out.startswith("At t=500.00 s nothing runs; the last that happened:\nKeep_distance(johanna)")


@pytest.mark.parametrize("scenario", ["two-visits", "tea-visit"])
def test_nothing_is_told_to_come_from_what_came_later(scenario):
    """What runs is asked about again and again, while more and more happens that goes on bearing it."""
    episode = front_door.run(scenario)
    for moment in range(int(episode.events[-1].t * 2)):
        for why in episode.why(moment / 2):
            led_to = (why.switched_by, *why.standing_on) if why.switched_by else ()
            assert all(result.t <= why.event.t for result in led_to), f"asked at {moment / 2} s: {why}"


def test_an_episode_can_be_asked_in_python():
    episode = front_door.run("johanna")
    (why,) = episode.why(7.3)
    assert why.event.node == "Dock_to_user(johanna)"
    episode.assert_halted("Dock_to_user", by="docked?")
    with pytest.raises(
        AssertionError, match=r"no halt of 'Dock_to_user' by 'Give_up'; halts of such nodes: t="
    ):
        episode.assert_halted("Dock_to_user", by="Give_up")
    with pytest.raises(AssertionError, match="none"):
        episode.assert_halted("say")
    for no_time in (-1, float("nan"), "say"):
        with pytest.raises(ValueError, match="expected a time from 0 s on"):
            episode.why(no_time)
    with pytest.raises(ValueError, match="a part of the name of a node"):
        episode.assert_halted("")
