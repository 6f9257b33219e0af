"""The page of an episode in a real browser: what it shows is what the trace says, at any time."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations
from pathlib import Path

import pytest
import yaml

from comity.output.run_folder import RunFolder
from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario
from comity.system.library import find
from comity_executor import History, first_divergence, read_blackboard, read_nodes, read_trace
from comity_sim2d.pictures.person_colours import person_colour
from tests.browser.moments import cursor_of, go, weak_texts

SCRIPT = "<script>alert(1)</script>"
"""A person's name, which is shown as that name."""


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Folders of runs by name, each with its page."""
    base = tmp_path_factory.mktemp("runs")
    path, _ = find("scenario", "two-visits")
    odd = yaml.safe_load(path.read_text())
    odd["people"] = {SCRIPT: odd["people"]["host"], "guest": odd["people"]["guest"]}
    odd["goals"] = [{"greet": name} for name in odd["people"]]
    (base / "odd.scenario.yaml").write_text(yaml.safe_dump(odd, sort_keys=False))
    folders = {}
    for name, scenario in {
        "visits": "two-visits",
        "odd": str(base / "odd.scenario.yaml"),
        "many": "reception",
        "crowd": str(crowd(base)),
        "tall": str(tall(base)),
        "passed": "passers-by",
    }.items():
        done = record(prepare(load_scenario(scenario)), out=base / name, views=())
        (base / name / "replay.html").write_text(replay_page(done.folder), encoding="utf-8")
        folders[name] = base / name
    return folders


def crowd(folder: Path) -> Path:
    """Eight people, two of them with the longest names that there may be."""
    names = ["A" * 100, "Maximiliane von und zu " * 4, *"abcdef"]
    people = {name: {"at_m": [2.0 + 3 * (i % 3), 2.0 + 3 * (i // 3)]} for i, name in enumerate(names)}
    scenario = {
        "schema_version": 1,
        "name": "a scenario with quite a long name " * 2,
        "place": {"width_m": 11, "height_m": 10},
        "robot": {"at_m": [0.6, 0.6]},
        "people": people,
        "goals": [{"greet": name} for name in names[:2]],
    }
    path = folder / "crowd.scenario.yaml"
    path.write_text(yaml.safe_dump(scenario))
    return path


def tall(folder: Path) -> Path:
    """A corridor that is ten times as high as it is wide, with a person of a long name."""
    name = "Ada Konstantinopoulos-Wojcik"
    scenario = {
        "schema_version": 1,
        "name": "tall",
        "place": {"width_m": 2, "height_m": 20},
        "robot": {"at_m": [1.0, 1.0]},
        "people": {name: {"at_m": [0.5, 4.0], "facing_deg": -90}},
        "goals": [{"greet": name}],
    }
    path = folder / "tall.scenario.yaml"
    path.write_text(yaml.safe_dump(scenario))
    return path


@dataclass(frozen=True)
class Beside:
    """Two runs on one page."""

    page: Path
    histories: tuple[History, History]


@pytest.fixture(scope="module")
def beside(tmp_path_factory) -> Beside:
    """The same visit for two profiles."""
    base = tmp_path_factory.mktemp("beside")
    folders = []
    for name, profile in (("one", "arab_woman"), ("other", "german_man")):
        prepared = prepare(load_scenario("johanna"), profiles={"johanna": profile})
        folders.append(record(prepared, out=base / name, views=()).folder)
    (base / "page.html").write_text(replay_page(*folders), encoding="utf-8")
    return Beside(base / "page.html", (history_of(base / "one"), history_of(base / "other")))


def page_of(folder: Path) -> Path:
    return folder / "replay.html"


def history_of(folder: Path) -> History:
    return History(read_nodes(folder / "trace.jsonl"), read_trace(folder / "trace.jsonl"))


def told(history: History):
    """The events that the page shows at first: those of leaves, failures, and times that were over."""
    parents = {node.parent for node in history.nodes}
    return [
        event
        for event in history.events
        if event.path not in parents or event.status == "failure" or event.halt == "timed_out"
    ]


def states_on(page, side: int = 0) -> dict[int, str]:
    """The states in the tree; of two runs in that of a side, from 1."""
    tree = f".side:nth-child({side}) " if side else ""
    rows = page.eval_on_selector_all(
        f"{tree}[role=treeitem]", "rows => rows.map(r => [+r.dataset.path, r.dataset.status])"
    )
    return {path: status for path, status in rows if status != "idle"}


def chosen(page) -> int:
    return int(page.locator(".event[aria-current=true]").get_attribute("data-event"))


@pytest.mark.parametrize("name", ["visits", "many"])
def test_the_states_at_a_time_are_those_of_the_trace(reader, runs, name):
    """At the start, at every ninth event, between events, and at the end."""
    history = history_of(runs[name])
    page = reader.open(page_of(runs[name]))
    for t in (0.0, 3.33, *(event.t for event in history.events[::9]), history.end_s):
        go(page, t)
        assert states_on(page) == {path: event.status for path, event in history.states(t).items()}


def test_the_blackboard_at_a_time_is_that_of_the_run(reader, runs):
    page = reader.open(page_of(runs["visits"]))
    page.click(".blackboard summary")
    writes = read_blackboard(runs["visits"] / "blackboard.csv")
    for t in (0.0, *(one.t for one in writes[::5]), writes[-1].t):
        go(page, t)
        last = {one.entry: one for one in writes if one.t <= t + 0.005}
        rows = page.locator(".blackboard tbody tr:visible").evaluate_all(
            "rows => rows.map((row) => [...row.cells].map((cell) => cell.textContent))"
        )
        assert rows == [[entry, one.value, f"{one.t:.2f} s", one.leaf] for entry, one in sorted(last.items())]


def test_the_tree_is_the_trace_s_tree_and_has_its_roles(reader, runs):
    history = history_of(runs["visits"])
    page = reader.open(page_of(runs["visits"]))
    rows = page.eval_on_selector_all(
        "[role=tree] [role=treeitem]",
        "rows => rows.map(r => [r.dataset.node, +r.getAttribute('aria-level')])",
    )
    depth: dict[int | None, int] = {None: 0}
    for node in history.nodes:
        depth[node.path] = depth[node.parent] + 1
    assert rows == [[node.name, depth[node.path]] for node in history.nodes]


def test_the_arrow_keys_go_from_event_to_event(reader, runs):
    events = told(history_of(runs["visits"]))
    page = reader.open(page_of(runs["visits"]))
    start = [event for event in events if event.t == 0.0]
    for event in events[len(start) : len(start) + 8]:
        page.keyboard.press("ArrowRight")
        assert cursor_of(page) == pytest.approx(event.t, abs=0.006)
        assert page.locator(".event[aria-current=true] .node").inner_text() == event.node
    page.keyboard.press("ArrowLeft")
    assert page.locator(".event[aria-current=true] .node").inner_text() == events[len(start) + 6].node


def test_an_address_names_a_moment_and_the_page_keeps_it(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=12.30")
    assert cursor_of(page) == 12.30
    page.keyboard.press("End")
    page.wait_for_function("() => location.hash === '#t=21.55'")


def test_an_address_that_names_no_moment_is_mended(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=banana")
    page.wait_for_function("() => location.hash === '#t=0.00'")
    page.evaluate("() => { location.hash = 'nowhere'; }")
    page.wait_for_function("() => location.hash === '#t=0.00'")
    page.evaluate("() => { location.hash = 't=99999'; }")
    page.wait_for_function("() => location.hash === '#t=21.55'")


def test_the_page_plays_and_pauses(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=2.00")
    page.get_by_label("Speed", exact=True).select_option("4")
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("() => parseFloat(document.querySelector('.moment').textContent) > 2.5")
    page.get_by_role("button", name="Pause").click()
    stopped = cursor_of(page)
    page.wait_for_timeout(120)
    assert cursor_of(page) == stopped


def test_after_a_click_in_the_tree_the_arrows_go_on_from_event_to_event(reader, runs):
    """The arrows walk the tree only for those who came to it with the keyboard."""
    page = reader.open(page_of(runs["visits"]))
    page.locator('[data-node="docked?(host)"] .name').click()
    before = cursor_of(page)
    for _ in range(12):  # several events share a time
        page.keyboard.press("ArrowRight")
    assert cursor_of(page) > before


def test_a_click_on_a_node_an_event_or_a_lane_goes_there(reader, runs):
    history = history_of(runs["visits"])
    page = reader.open(page_of(runs["visits"]), "#t=20.00")
    page.locator('[data-node="docked?(host)"] .name').click()
    docked = [event for event in history.events if event.node == "docked?(host)"]
    assert cursor_of(page) == pytest.approx(docked[-1].t, abs=0.006)
    assert history.events[chosen(page)] == docked[-1]
    lane = page.locator('[data-node="docked?(host)"] .track').bounding_box()
    page.mouse.click(lane["x"] + lane["width"] / 2, lane["y"] + lane["height"] / 2)
    assert cursor_of(page) == pytest.approx(21.35 / 2, abs=0.1)
    other = page.locator(".event.later .sentence").first
    place = int(other.locator("xpath=..").get_attribute("data-event"))
    other.click()
    assert cursor_of(page) == pytest.approx(history.events[place].t, abs=0.006)


def test_an_event_opens_down_to_the_rules_and_the_cultural_variable_with_its_source(reader, runs):
    page = reader.open(page_of(runs["visits"]))
    page.locator('[data-node="docked?(guest)"] .name').click()
    card = page.locator(".card")
    assert card.locator("svg.sets .fired").count() >= 2
    rule = card.locator(".rule").first
    rule.locator("summary").click()
    assert "Bruno" in rule.locator("dd").nth(1).inner_text()
    assert "individualism 38" in rule.locator(".variable").first.inner_text()
    assert rule.locator(".variable svg .dot").count() == 2


def test_filters_show_halts_one_person_or_one_node(reader, runs):
    history = history_of(runs["visits"])
    page = reader.open(page_of(runs["visits"]), "#t=21.35")
    page.get_by_label("Events", exact=True).select_option("halts")
    shown = page.eval_on_selector_all(".event", "rows => rows.map(r => +r.dataset.event)")
    assert shown == [i for i, event in enumerate(history.events) if event.halt]
    page.get_by_label("Events", exact=True).select_option("all")
    page.get_by_label("Person", exact=True).select_option("guest")
    assert page.locator('[role=treeitem][data-node="docked(host)"]').is_hidden()
    assert page.locator('[role=treeitem][data-node="docked(guest)"]').is_visible()
    page.locator('[data-node="docked?(guest)"] .name').click()
    page.get_by_role("button", name="Only this node").click()
    names = set(page.locator(".event .node").all_inner_texts())
    assert names == {"docked?(guest)"}


def test_a_search_shows_what_was_found_with_the_way_to_it(reader, runs):
    page = reader.open(page_of(runs["many"]))
    before = page.locator("[role=treeitem]:visible").count()
    page.keyboard.press("/")
    page.keyboard.type("say, yuki")
    seen = page.locator("[role=treeitem]:visible")
    assert seen.first.get_attribute("data-node") == "Safe"
    assert page.locator("[role=treeitem][data-found=true]").count() == 3
    page.keyboard.press("Escape")
    assert page.locator("[role=treeitem]:visible").count() == before


def test_a_search_that_finds_nothing_says_so(reader, runs):
    page = reader.open(page_of(runs["visits"]))
    page.get_by_label("Search nodes").fill("zebra")
    assert page.locator(".nothing").inner_text() == "No node is called “zebra”. Esc empties the search."
    page.keyboard.press("Escape")
    assert page.locator(".nothing").inner_text() == ""


def test_a_filter_by_person_narrows_the_charts_to_that_person(reader, runs):
    page = reader.open(page_of(runs["visits"]))
    names = page.locator(".chart:visible .name")
    assert names.all_inner_texts() == ["speed", "host", "guest"]
    page.get_by_label("Person", exact=True).select_option("guest")
    assert names.all_inner_texts() == ["speed", "guest"]


def test_a_filter_by_person_narrows_the_comparison_to_that_person(reader, runs, tmp_path):
    folder = RunFolder(runs["visits"])
    (tmp_path / "page.html").write_text(replay_page(folder, folder), encoding="utf-8")
    page = reader.open(tmp_path / "page.html")
    groups = page.locator(".comparison .group:visible")
    assert groups.all_inner_texts() == ["Run", "host", "guest"]
    page.get_by_label("Person", exact=True).select_option("guest")
    assert groups.all_inner_texts() == ["Run", "guest"]


@pytest.mark.parametrize(("scheme", "ground"), [("light", "on_light"), ("dark", "on_dark")])
def test_a_person_has_the_colour_of_the_pictures_in_the_world_and_at_the_chart(reader, runs, scheme, ground):
    reader.page.emulate_media(color_scheme=scheme)
    page = reader.open(page_of(runs["crowd"]))
    wanted = [rgb(getattr(person_colour(place), ground)) for place in range(8)]
    for words, part in ((".person .person-name", "fill"), (".chart:not(.speed) .name", "color")):
        found = page.eval_on_selector_all(words, f"all => all.map(one => getComputedStyle(one).{part})")
        assert found == wanted


def rgb(colour: str) -> str:
    return "rgb({}, {}, {})".format(*bytes.fromhex(colour.removeprefix("#")))


@pytest.mark.parametrize("width", [420, 1366])
def test_names_in_the_world_lie_on_it_and_not_over_each_other(reader, runs, width):
    reader.page.set_viewport_size({"width": width, "height": 768})
    page = reader.open(page_of(runs["crowd"]))
    world = page.locator(".world svg").bounding_box()
    names = [name.bounding_box() for name in page.locator(".person-name:visible").all()]
    assert names
    assert all(name["y"] >= world["y"] - 4 for name in names)
    assert not any(overlap(*pair) for pair in combinations(names, 2))


def overlap(one, other) -> bool:
    """Whether letters do: boxes are 24 px high, with a halo and air around letters of at most 13 px."""
    across = min(one["x"] + one["width"], other["x"] + other["width"]) - max(one["x"], other["x"])
    along = min(one["y"] + one["height"], other["y"] + other["height"]) - max(one["y"], other["y"])
    return across > 0 and along > 7


def ink(locator):
    """The box of what is drawn, without the halo around it."""
    return locator.evaluate("one => one.getBoundingClientRect().toJSON()")


@pytest.mark.parametrize("width", [420, 1366, 1920])
def test_the_distance_to_a_person_does_not_lie_on_another_person_s_name(reader, runs, width):
    reader.page.set_viewport_size({"width": width, "height": 1080})
    page = reader.open(page_of(runs["passed"]))
    for t in (0.0, 1.0, 2.0, 3.0, 5.0, 9.0, 12.0, 19.0):
        go(page, t)
        names = [name.bounding_box() for name in page.locator(".person-name:visible").all()]
        distance = page.locator(".gap-label:visible").bounding_box()
        assert len(names) == 4
        assert not any(overlap(distance, name) for name in names), t


@pytest.mark.parametrize("width", [420, 1366])
def test_the_distance_to_a_person_is_on_the_drawing_and_lies_on_nobody(reader, runs, width):
    reader.page.set_viewport_size({"width": width, "height": 768})
    page = reader.open(page_of(runs["many"]))
    world = page.locator(".world").bounding_box()
    for t in (0.0, 9.0, 9.5, 10.0, 24.0):
        go(page, t)
        distance = ink(page.locator(".gap-label:visible"))
        bodies = [ink(body) for body in page.locator(".person .body, .robot .body").all()]
        assert overlap(distance, world)
        assert world["x"] <= distance["x"]
        assert distance["x"] + distance["width"] <= world["x"] + world["width"]
        assert not any(overlap(distance, body) for body in bodies), t


@pytest.mark.parametrize("width", [400, 420, 1366])
@pytest.mark.parametrize("name", ["visits", "many", "tall"])
def test_the_metre_stands_below_the_room_and_on_the_drawing(reader, runs, name, width):
    reader.page.set_viewport_size({"width": width, "height": 900})
    page = reader.open(page_of(runs[name]))
    drawing, room, metre = (ink(page.locator(one)) for one in (".world svg", ".room", ".scale-bar text"))
    assert room["y"] + room["height"] <= metre["y"]
    assert metre["y"] + metre["height"] <= drawing["y"] + drawing["height"]
    assert drawing["x"] <= metre["x"]
    assert metre["x"] + metre["width"] <= drawing["x"] + drawing["width"]


@pytest.mark.parametrize("theme", ["light", "dark"])
@pytest.mark.parametrize("name", ["passed", "many"])
def test_names_in_the_world_stand_out_on_furniture_in_rings_and_in_the_robot_s_gaze(
    reader, runs, name, theme
):
    reader.page.emulate_media(color_scheme=theme)
    page = reader.open(page_of(runs[name]))
    assert page.locator(".furniture-name:visible").count() > 0
    assert weak_texts(page) == []
    order = page.eval_on_selector_all(
        ".ring, .gaze, .world svg text", "all => all.map(one => one.getAttribute('class') ?? 'metre')"
    )
    tints = [i for i, kind in enumerate(order) if kind.split()[0] in ("ring", "gaze")]
    words = [i for i, kind in enumerate(order) if kind.endswith("-name")]
    assert max(tints) < min(words), "no tint lies on words"


@pytest.mark.parametrize("width", [400, 1100])
def test_a_name_that_is_wider_than_its_place_lies_on_the_panel(reader, runs, width):
    reader.page.set_viewport_size({"width": width, "height": 768})
    page = reader.open(page_of(runs["tall"]))
    world, name = page.locator(".world").bounding_box(), page.locator(".person-name").bounding_box()
    assert world["x"] <= name["x"]
    assert name["x"] + name["width"] <= world["x"] + world["width"]


@pytest.mark.parametrize(("name", "share"), [("tall", 1.0), ("visits", 0.46)])
def test_the_world_of_a_tall_place_is_as_high_as_the_page(reader, runs, name, share):
    """A wide one has the tree below it."""
    page = reader.open(page_of(runs[name]))
    world, whole = page.locator(".world-panel").bounding_box(), page.locator(".single").bounding_box()
    assert world["height"] == pytest.approx(share * whole["height"], abs=8)


def test_a_chart_says_how_far_the_curve_goes_on_above_it(reader, runs):
    page = reader.open(page_of(runs["visits"]))
    assert " ↑ up to " in page.locator(".chart:not(.speed) .ceiling").first.inner_text()


@pytest.mark.parametrize("width", [1024, 1280])
def test_the_longest_names_do_not_break_the_page(reader, runs, width):
    page = reader.page
    page.set_viewport_size({"width": width, "height": 720})
    reader.open(page_of(runs["crowd"]))
    assert page.evaluate("document.documentElement.scrollWidth") <= width
    for control in page.locator(".controls select, .controls input").all():
        box = control.bounding_box()
        assert box is not None
        assert box["x"] + box["width"] <= width


def test_finished_branches_can_be_folded_away(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=9.00")
    before = page.locator("[role=treeitem]:visible").count()
    page.get_by_label("Fold finished branches").check()
    assert page.locator("[role=treeitem]:visible").count() < before
    assert page.locator('[data-node="visited(host)"]').get_attribute("aria-expanded") == "false"
    assert page.locator('[data-node="visited(guest)"]').get_attribute("aria-expanded") == "true"


def test_the_tree_is_walked_with_the_keyboard(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=9.00")
    row = page.locator("[role=treeitem][data-node='visited(host)']")
    row.focus()
    page.keyboard.press("ArrowLeft")
    assert row.get_attribute("aria-expanded") == "false"
    page.keyboard.press("ArrowDown")
    focused = page.evaluate("document.activeElement.dataset.node")
    assert focused == "visited(guest)"
    assert cursor_of(page) == 9.00


def test_a_name_that_looks_like_markup_is_shown_as_that_name(reader, runs):
    page = reader.open(page_of(runs["odd"]), "#t=7.00")
    assert page.locator(".person-name").first.text_content() == SCRIPT
    assert (
        page.locator(f'[role=treeitem][data-node="docked?({SCRIPT})"] .name').text_content()
        == f"docked?({SCRIPT})"
    )
    assert page.locator(".bubble").inner_text().count("<Script>") == 1
    assert page.locator("script").count() == 2  # the data and the page's own


def test_what_is_said_is_shown_while_it_is_said(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=7.00")
    assert "Hello, Host." in page.locator(".bubble").inner_text()
    go(page, 9.0)
    assert page.locator(".bubble").is_hidden()


def test_a_laptop_shows_it_without_scrolling_sideways(reader, runs, beside):
    for path in (*map(page_of, runs.values()), beside.page):
        page = reader.open(path)
        for width, height in ((1440, 900), (1100, 700)):
            page.set_viewport_size({"width": width, "height": height})
            size = page.evaluate("(e => [e.scrollWidth, e.scrollHeight])(document.documentElement)")
            assert size == [width, height]


def test_the_keys_are_told_in_a_box_that_takes_them_while_it_is_open(reader, runs):
    page = reader.open(page_of(runs["visits"]), "#t=9.00")
    page.keyboard.press("?")
    assert page.get_by_role("dialog").is_visible()
    page.keyboard.press("ArrowRight")
    assert cursor_of(page) == 9.00
    page.keyboard.press("Escape")
    assert page.get_by_role("dialog").is_hidden()


def test_light_and_dark_follow_the_system_until_the_reader_chooses(reader, runs):
    page = reader.open(page_of(runs["visits"]))
    ground = "getComputedStyle(document.body).backgroundColor"
    light = page.evaluate(ground)
    page.emulate_media(color_scheme="dark")
    dark = page.evaluate(ground)
    assert light != dark
    page.get_by_label("Theme", exact=True).select_option("light")
    assert page.evaluate(ground) == light
    page.emulate_media(color_scheme="light")
    page.get_by_label("Theme", exact=True).select_option("dark")
    assert page.evaluate(ground) == dark


def test_two_runs_stand_side_by_side_at_the_same_time_or_the_same_plan_step(reader, beside):
    page, (one, other) = reader.open(beside.page, "#t=10.20"), beside.histories
    by_time = [states_on(page, side) for side in (1, 2)]
    assert by_time == [{p: e.status for p, e in h.states(10.2).items()} for h in (one, other)]
    page.get_by_label("Together", exact=True).select_option("step")
    docked = next(event.t for event in other.events if event.node == "Greet_person(johanna)")
    assert states_on(page, 1) == by_time[0]
    assert states_on(page, 2) == {p: e.status for p, e in other.states(docked).items()}


def test_where_two_runs_first_part_is_told_and_marked(reader, beside):
    page = reader.open(beside.page)
    parted = first_divergence(*beside.histories, in_behaviour=True)
    assert parted is not None
    told = page.locator("[data-parting=behaviour]")
    assert f"{parted.t:.2f} s" in told.inner_text()
    assert page.locator(".marks .parting").count() == 2
    told.get_by_role("button", name=f"{parted.t:.2f} s").click()
    assert cursor_of(page) == pytest.approx(parted.t, abs=0.006)


def test_what_two_runs_went_by_and_reached_is_compared(reader, beside):
    page = reader.open(beside.page)
    rows = dict(
        page.eval_on_selector_all(
            ".comparison tbody tr:not(.group)",
            "rows => rows.map(r => [...r.children].map(c => c.textContent)).map(([n, ...two]) => [n, two])",
        )
    )
    assert rows["conversational distance ≠"] == ["0.640 m", "1.091 m"]
    assert rows["profile ≠"] == ["arab woman", "german man"]
    assert rows["visit"] == ["greeted", "greeted"]
    assert [cell[:5] for cell in rows["stops at ≠"]] == ["0.640", "1.091"]


def test_the_arrow_keys_follow_the_run_that_is_looked_at(reader, beside):
    page = reader.open(beside.page)
    page.get_by_role("tab", name="B").click()
    page.keyboard.press("ArrowRight")
    later = next(event for event in told(beside.histories[1]) if event.t > 0)
    assert cursor_of(page) == pytest.approx(later.t, abs=0.006)
    assert page.locator(".event[aria-current=true]:visible .node").inner_text() == later.node
