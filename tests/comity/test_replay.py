"""The page of an episode: it holds the run, asks for nothing else, and no word of a file is markup in it."""

from __future__ import annotations

import json
import math
import re
import signal
import webbrowser
from dataclasses import replace
from itertools import accumulate
from shutil import copytree

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.output.run_folder import open_run
from comity.preparation import prepare
from comity.recording import record
from comity.replay.groups_data import groups_data
from comity.replay.inlining import joined
from comity.replay.page import MARK, inline_json, page_of
from comity.replay.tracks import steps
from comity.replay.tree_data import tree_data
from comity.scenario import load_scenario
from comity_executor import History, read_nodes, read_trace
from comity_sim2d import Group, Person, RobotBody, Room, Scene, World, read_frames_csv

FRAMES_HEAD = "t,entity,x,y,heading_rad,radius_m"

PAGE_BYTES = 250_000
"""All of the page but the episode's data."""

PLAIN: dict[str, list[object]] = {"runs": [], "parting": []}


def data_of(page: str):
    return json.loads(re.search(r'<script type="application/json" id="data">(.*?)</script>', page)[1])


@pytest.fixture(scope="module")
def visits(tmp_path_factory):
    """A run with two people, as `comity run` leaves it."""
    import comity

    folder = tmp_path_factory.mktemp("runs") / "visits"
    comity.run("two-visits", out=folder)
    return open_run(folder)


@given(text=st.text(alphabet=st.sampled_from("<>/&!-\u2028\u2029\\\"'scripté𝄞 ")))
def test_no_text_can_end_the_element_that_holds_the_data(text):
    """Escaped data have no angle bracket, and read back to what they were."""
    inlined = inline_json({text: [text]})
    assert not re.search("[<>&\u2028\u2029]", inlined)
    assert json.loads(inlined) == {text: [text]}


@given(numbers=st.lists(st.floats(-500, 500), min_size=1))
def test_numbers_over_time_come_back_to_half_a_thousandth(numbers):
    packed = list(accumulate(steps(numbers)))
    back = packed if len(packed) == len(numbers) else packed * len(numbers)
    assert back == pytest.approx([1000 * number for number in numbers], abs=0.5)


def test_a_number_that_never_changes_is_written_once():
    assert steps([1.25] * 50) == [1250]


def test_modules_are_joined_in_the_order_in_which_they_need_each_other():
    modules = {
        "page": 'import { two, one as first } from "./parts.js";\ntwo();\n',
        "parts": "const hidden = 1;\nexport const one = hidden;\nexport function two() {}\n",
        "unused": "alert(1);\n",
    }
    script = joined(modules, "page")
    assert script.index("parts_js") < script.index("page_js")
    assert "const { two, one: first } = parts_js;" in script
    assert "return { one, two };" in script
    assert "alert" not in script


@pytest.mark.parametrize(
    ("modules", "words"),
    [
        ({"page": 'import { a } from "./page.js";\n'}, "page > page"),
        ({"page": 'import { a } from "./gone.js";\n'}, "page needs gone.js"),
        ({"page": 'import all from "./other.js";\n', "other": ""}, "import all"),
        ({"page": "export default 1;\n"}, "export default"),
    ],
)
def test_a_module_in_another_form_is_a_mistake_of_ours(modules, words):
    with pytest.raises(ValueError, match=words):
        joined(modules, "page")


def test_the_page_without_data_is_small_and_asks_for_nothing():
    page = page_of(PLAIN)
    assert len(page.encode()) < PAGE_BYTES
    assert MARK in page.encode()[:1024]
    assert "default-src 'none'" in page
    assert not re.search(
        r"""(?:src|href)\s*=\s*["'](?!data:,)|url\((?!#)|@import|\bfetch\(|innerHTML""", page
    )


def test_a_run_writes_its_page_and_names_it(comity, here):
    said = comity("run", "--out", "visit")
    assert "Page     visit/replay.html" in said.out
    written = (here / "visit" / "replay.html").read_bytes()
    assert "replay.html" in json.loads((here / "visit" / "run.json").read_text())["files"]
    assert comity("replay", "visit", "--out", "again.html").out == "Page  again.html\n"
    assert (here / "again.html").read_bytes() == written


def test_the_page_is_opened_where_the_user_asks_for_it(comity, here, monkeypatch):
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    comity("run", "--out", "visit", "--open")
    assert opened == [(here / "visit" / "replay.html").as_uri()]


def test_the_page_holds_every_event_with_its_causes_and_what_it_stands_on(visits):
    tree = data_of((visits / "replay.html").read_text())["runs"][0]["tree"]
    history = History(read_nodes(visits / "trace.jsonl"), read_trace(visits / "trace.jsonl"))
    assert [node[:4] for node in tree["nodes"]] == [
        [n.name, n.kind, n.parent, n.action] for n in history.nodes
    ]
    for told, event, why in zip(tree["events"], history.events, history.whys(), strict=True):
        t, path, status, halt, because, grounds = told
        assert (t, path, status, halt) == (event.t, event.path, event.status, event.halt)
        assert [tree["causes"][i] for i in because] == [[c.kind, c.text, c.value] for c in event.because]
        expected = [*filter(None, [why.switched_by]), *why.standing_on]
        assert [history.events[i] for i in grounds] == expected


def test_the_page_holds_where_everybody_was_to_the_millimetre(visits):
    tracks = data_of((visits / "replay.html").read_text())["runs"][0]["tracks"]
    frames = read_frames_csv(visits / "frames.csv")
    for body in tracks["bodies"]:
        for column, key in enumerate(("x", "y", "heading")):
            back = list(accumulate(body[key]))
            back = back if len(back) > 1 else back * tracks["count"]
            assert back == pytest.approx((1000 * frames.of(body["name"])[:, column]).tolist(), abs=0.51)


def test_the_page_holds_the_values_that_the_robot_went_by(visits):
    """Computed again from the resolved scenario, they are those that the run wrote down."""
    run = data_of((visits / "replay.html").read_text())["runs"][0]
    account = json.loads((visits / "run.json").read_text())
    for person, told in account["values"].items():
        for name, value in told["parameters"].items():
            assert run["values"]["people"][0][person]["parameters"][name]["value"] == value["value"]


def test_a_node_is_about_the_person_in_its_brackets(visits):
    history = History(read_nodes(visits / "trace.jsonl"), ())
    told = {name: person for name, _, _, _, person in tree_data(history, ["host", "guest"])["nodes"]}
    assert told["docked?(host)"] == told["Timeout 10 s(say, host)"] == "host"
    assert told["Goal"] is None


def test_two_runs_part_where_their_traces_first_differ(comity, here):
    for name, profile in (("one", "arab_woman"), ("two", "german_man")):
        prepared = prepare(load_scenario("johanna"), profiles={"johanna": profile})
        record(prepared, out=here / name, views=())
    assert comity("replay", "one", "two").out == "Page  one/comparison.html\n"
    parting = comity("trace", "one", "--diff", "two", "--json").json["differences"]
    data = data_of((here / "one" / "comparison.html").read_text())
    assert [run["name"] for run in data["runs"]] == ["one", "two"]
    for told, expected in zip(data["parting"], parting, strict=True):
        assert (told["t"], told["in_behaviour"]) == (expected["t"], expected["in_behaviour"])
        for run, place, event in zip(
            data["runs"], told["events"], (expected["one"], expected["other"]), strict=True
        ):
            assert run["tree"]["events"][place][:3] == [event["t"], event["path"], event["status"]]


@pytest.mark.parametrize(
    "damage",
    [
        ("plan.json", "{}", "the plan.json of a run"),
        ("frames.csv", "t,entity\n1,robot\n", "frames.csv:1: expected the columns t,entity,x,y"),
        ("frames.csv", f"{FRAMES_HEAD}\n", "frames.csv:2: expected where everybody was"),
        (
            "frames.csv",
            f"{FRAMES_HEAD}\n0,robot,1,here,0,0.2\n",
            "frames.csv:2: expected a number in column y",
        ),
        ("frames.csv", None, "no such file"),
        ("plan.json", None, "no such file"),
        ("scenario.yaml", "people: [", "scenario.yaml"),
    ],
    ids=str,
)
def test_a_damaged_run_is_named_with_its_file(comity, here, visits, damage):
    name, content, words = damage
    copytree(visits.path, here / "visit")
    if content is None:
        (here / "visit" / name).unlink()
    else:
        (here / "visit" / name).write_text(content)
    said = comity("replay", "visit", "--out", "page.html")
    assert said.code == 2
    assert words in said.err
    assert not (here / "page.html").exists()


def test_a_run_without_its_readings_is_shown_and_that_is_said(comity, here, visits):
    copytree(visits.path, here / "visit")
    (here / "visit" / "readings.csv").unlink()
    said = comity("replay", "visit", "--out", "page.html")
    assert said.code == 0
    assert "visit has no readings.csv" in said.out


def test_a_file_that_is_no_page_of_ours_is_not_replaced(comity, here, visits):
    (here / "mine.html").write_text("<p>mine</p>")
    said = comity("replay", visits.path, "--out", "mine.html")
    assert said.code == 2
    assert (here / "mine.html").read_text() == "<p>mine</p>"


def test_a_run_that_was_interrupted_can_be_watched_up_to_there(comity, here, monkeypatch):
    step, steps_done = World.step, []

    def interrupted(world):
        steps_done.append(world)
        if len(steps_done) == 100:
            signal.raise_signal(signal.SIGINT)
        step(world)

    monkeypatch.setattr(World, "step", interrupted)
    comity("run", "--out", "run")
    assert comity("replay", "run").code == 0
    run = data_of((here / "run" / "replay.html").read_text())["runs"][0]
    assert (run["account"]["status"], run["end"]) == ("crashed", pytest.approx(4.95))
    assert run["account"]["visits"] == []
    assert run["ending"] == "The run was interrupted. What happened before is here."


def test_a_trace_that_was_cut_is_refused_and_not_shown_as_the_whole(comity, visits, here):
    """A finished run names the digest of its trace."""
    copytree(visits.path, here / "cut")
    trace = here / "cut" / "trace.jsonl"
    lines = trace.read_text().splitlines(keepends=True)
    trace.write_text("".join(lines[:20]))
    for words in (("replay", "cut"), ("trace", "cut", "--at", "20")):
        said = comity(*words)
        assert (said.code, said.out) == (2, "")
        assert "cut off or changed" in said.err


def test_frames_of_a_finished_run_that_were_cut_are_refused(comity, visits, here):
    copytree(visits.path, here / "cut")
    frames = here / "cut" / "frames.csv"
    frames.write_bytes(frames.read_bytes()[:-5000])
    said = comity("replay", "cut", "--out", "page.html")
    assert (said.code, said.out) == (2, "")
    assert "frames.csv" in said.err
    assert "frames up to" in said.err


def test_a_place_that_is_no_number_is_refused(comity, visits, here):
    copytree(visits.path, here / "nan")
    frames = here / "nan" / "frames.csv"
    header, first, rest = frames.read_text().split("\n", 2)
    cells = first.split(",")
    frames.write_text("\n".join([header, ",".join([*cells[:2], "nan", *cells[3:]]), rest]))
    said = comity("replay", "nan")
    assert said.code == 2
    assert "frames.csv" in said.err
    assert "Traceback" not in said.err


def test_what_groups_keep_open_is_told_whenever_it_changes_and_no_more_often():
    """Someone steps from foot to foot, leaves the group, and comes back."""
    ann, bob, cleo = (
        Person("ann", 1.0, 2.0, 0.0),
        Person("bob", 3.0, 2.0, math.pi),
        Person("cleo", 2, 3, -1.6),
    )
    robot, group = RobotBody(5.0, 5.0), Group("talk", ("ann", "bob", "cleo"))
    scene = Scene(Room.rectangle(6.0, 6.0), robot, (ann, bob, cleo), groups=(group,))
    world = World(scene)
    for y in (3.2, 3.1, 4.0, 4.5, 3.1):
        world.move_person("cleo", 2.0, y, -1.6)
        world.run(0.1)
    together, apart, again = groups_data(scene, world.frames)
    assert [turn["t"] for turn in (together, apart, again)] == pytest.approx([0.0, 0.25, 0.45])
    assert together["spaces"] == again["spaces"]
    assert [space["members"] for space in apart["spaces"]] == [("ann", "bob")]
    assert groups_data(replace(scene, groups=()), world.frames) == []
