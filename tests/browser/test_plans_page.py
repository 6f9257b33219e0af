"""The page where things change: the plan and the values in force at each time, doors, and what is carried."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from comity.output.run_folder import RUN, RunFolder, open_run
from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario
from tests.browser.moments import cursor_of, go, weak_texts

LOUNGE = {
    "schema_version": 1,
    "name": "lounge",
    "place": {"width_m": 10, "height_m": 6},
    "robot": {"at_m": [1, 3], "carrying": "a tray"},
    "people": {
        "anna": {"profile": "german_woman", "at_m": [5, 5], "facing_deg": -90},
        "bob": {"profile": "arab_man", "at_m": [8, 1.5], "facing_deg": 165},
    },
    "goals": [{"greet": "anna"}, {"greet": "bob"}],
    "changes": [
        {"at_s": 2, "person": "anna", "moves_to_m": [9, 5], "facing_deg": -90},
        {"at_s": 9, "person": "bob", "says": {"conversational_distance": 1.4}},
    ],
}


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Folders of runs by name: one whose plan changes twice, one with a door, one with tea."""
    base = tmp_path_factory.mktemp("runs")
    (base / "lounge.scenario.yaml").write_text(yaml.safe_dump(LOUNGE, sort_keys=False))
    scenarios = {
        "lounge": str(base / "lounge.scenario.yaml"),
        "tea": "tea-visit",
        "door": "comity-bench-1/meeting-room-opened",
    }
    for name, scenario in scenarios.items():
        record(prepare(load_scenario(scenario)), out=base / name, views=())
    account = json.loads((base / "door" / RUN).read_text())
    account["doors"] = [{"t": 5.0, "door": "meeting room", "open": False}]
    (base / "door" / RUN).write_text(json.dumps(account))
    return {name: open_run(base / name) for name in scenarios}


def page_of(folder: RunFolder, other: RunFolder | None = None) -> Path:
    path = folder / ("both.html" if other else "replay.html")
    path.write_text(replay_page(folder, other), encoding="utf-8")
    return path


def revisions_of(folder: RunFolder):
    return json.loads((folder / RUN).read_text())["revisions"]


def strip(page):
    """The steps of the plan: what, for whom, how."""
    return page.eval_on_selector_all(
        ".plan .step",
        "all => all.map(s => [...s.querySelectorAll('.action, .who, .how')].map(e => e.textContent))",
    )


def charted(page, person: str) -> str:
    return page.locator(".chart", has=page.locator(".name", has_text=person)).locator(".note").inner_text()


def test_the_strip_shows_the_plan_in_force(reader, runs):
    """Before a revision the plan before it, from then on what took over, as the run wrote it down."""
    anew, rebound = revisions_of(runs["lounge"])
    assert (anew["kind"], rebound["kind"]) == ("replanned", "rebound")
    page = reader.open(page_of(runs["lounge"]))
    assert [who for _, who, _ in strip(page)] == ["anna", "anna", "bob", "bob"]
    go(page, anew["t"])
    told = [[step["action"].replace("_", " "), *step["people"]] for step in anew["steps"]]
    assert [step[:2] for step in strip(page)] == told
    assert strip(page)[0][2].startswith(f"{anew['steps'][0]['arguments'][2]} · 0.88 m")
    go(page, rebound["t"])
    assert strip(page)[0][2].endswith("1.40 m")
    assert page.locator(".plan .was").first.inner_text() == "was 0.88 m"


def test_the_values_in_force_are_drawn(reader, runs):
    """The ring, the chart and the chain go by what somebody wants at that time."""
    _, rebound = revisions_of(runs["lounge"])
    page = reader.open(page_of(runs["lounge"]))
    ring = page.locator(".ring").nth(1)
    before = float(ring.get_attribute("r"))
    assert charted(page, "bob").startswith("wants 0.88 m, approached at ")
    go(page, rebound["t"])
    assert charted(page, "bob").startswith("wants 1.40 m, approached at ")
    assert float(ring.get_attribute("r")) - before == pytest.approx(100 * (1.4 - 0.8753), abs=0.1)
    page.keyboard.press("Shift+ArrowLeft")
    page.keyboard.press("Shift+ArrowRight")
    value = page.locator(".event[aria-current=true] .link.parameter")
    assert "conversational distance 1.400 m" in value.inner_text()
    assert "before it was 0.875 m" in value.inner_text()


def test_the_keys_go_from_change_to_change_of_the_plan(reader, runs):
    moments = [revision["t"] for revision in revisions_of(runs["lounge"])]
    page = reader.open(page_of(runs["lounge"]))
    for t in moments:
        page.keyboard.press("Shift+ArrowRight")
        assert cursor_of(page) == pytest.approx(t)
        assert page.locator(".revision[aria-current=true]").inner_text().startswith(("↺", "↻"))
    page.keyboard.press("Home")
    page.get_by_label("Events", exact=True).select_option("plans")
    page.keyboard.press("ArrowRight")
    assert cursor_of(page) == pytest.approx(moments[0])


def test_what_changed_and_why_stands_below_the_plan(reader, runs):
    anew, _ = revisions_of(runs["lounge"])
    page = reader.open(page_of(runs["lounge"]), f"#t={anew['t']}")
    assert page.locator(".revision-text").inner_text() == f"Replanned: {'; '.join(anew['because'])}"
    page.locator(".revision-box summary").click()
    assert page.locator(".revision-box li").all_inner_texts() == anew["because"]
    assert weak_texts(page) == []


def test_a_run_whose_plan_stays_has_no_row_of_changes(reader, runs):
    page = reader.open(page_of(runs["tea"]))
    assert page.locator(".revisions").is_hidden()


def test_two_runs_are_compared_by_the_values_in_force(reader, runs):
    page = reader.open(page_of(runs["lounge"], runs["lounge"]), "#t=1.00")
    rows = page.locator(".comparison tbody tr", has_text="conversational distance")
    assert rows.nth(1).inner_text().split("\t")[1:] == ["0.875 m", "0.875 m"]
    go(page, 10.0)
    assert rows.nth(1).inner_text().split("\t")[1:] == ["1.400 m", "1.400 m"]
    assert page.locator(".revisions:visible").count() == 2


def test_every_step_of_a_visit_is_under_way_while_its_nodes_are(reader, runs):
    """Fetch, reach, greet, say, offer, wait, take leave: each is current once, in the order of the plan."""
    page = reader.open(page_of(runs["tea"]))
    names = [step[0] for step in strip(page)]
    seen = []
    for tenth in range(0, 446, 5):
        go(page, tenth / 10)
        places = page.eval_on_selector_all(
            ".plan .step", "all => all.flatMap((s, i) => s.dataset.state === 'current' ? [i] : [])"
        )
        seen += [place for place in places if place not in seen]
    assert [names[place] for place in seen] == names
    assert page.locator(".plan .step[data-state=done]").count() == len(names)


def test_what_is_said_stands_with_the_event_that_says_it(reader, runs):
    page = reader.open(page_of(runs["tea"]), "#t=19.40")
    said = page.locator(".event .sentence", has_text="“I brought you tea from the kitchen.”")
    assert said.count() == 1


def test_a_thing_goes_from_where_it_is_fetched_over_the_robot_to_the_person(reader, runs):
    page = reader.open(page_of(runs["tea"]))
    thing = page.locator(".thing[data-thing=tea]")
    holders = []
    for t in (0.0, 12.0, 22.0, 30.0):
        go(page, t)
        holders.append(thing.get_attribute("data-holder"))
    assert holders == ["", "robot", "robot", "anna"]
    page = reader.open(page_of(runs["lounge"]))
    assert page.locator(".thing[data-thing='a tray']").get_attribute("data-holder") == "robot"


def test_a_door_is_drawn_as_it_is_at_the_time(reader, runs):
    page = reader.open(page_of(runs["door"]))
    door = page.locator(".door[data-door='meeting room']")
    states, leaves = [], []
    for t in (0.0, 4.9, 5.2, 6.0):
        go(page, t)
        states.append(door.get_attribute("data-state"))
        leaves.append(door.locator(".leaf").get_attribute("points"))
    assert states == ["open", "open", "closed", "closed"]
    assert leaves[0] == leaves[1]
    assert len(set(leaves[1:])) == 3  # it is on its way at 5.2


def test_the_planned_route_is_that_of_the_plan_in_force_and_the_driven_path_ends_at_the_robot(reader, runs):
    page, revisions = reader.open(page_of(runs["lounge"]), "#t=0.00"), revisions_of(runs["lounge"])

    def route(t):
        go(page, t)
        return page.locator(".planned").get_attribute("points")

    def driven():
        return float(page.locator(".travelled").evaluate("path => parseFloat(path.style.strokeDasharray)"))

    first, second = route(0.0), route(revisions[0]["t"] + 0.1)
    assert "" not in (first, second)
    assert first != second
    assert route(2.5) == first  # anna has moved, and no plan knows of it yet
    go(page, 0.0)
    assert driven() == 0.0
    go(page, revisions[0]["t"])
    assert driven() > 0.0
