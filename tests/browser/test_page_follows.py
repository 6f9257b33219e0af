"""The page follows the time, and compares runs of other people: what a new reader stumbled over."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from comity.output.run_folder import RunFolder
from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario
from tests.browser.moments import go

ONLY_IN_ONE = ["__proto__", "constructor"]
"""Names that every object of a browser knows."""


def recorded(base: Path, name: str, people: list[str], greeted: int) -> RunFolder:
    """A run with some people in a row, of whom the first ones are greeted."""
    scenario = {
        "schema_version": 1,
        "name": name,
        "place": {"width_m": 13, "height_m": 5},
        "robot": {"at_m": [0.8, 0.8]},
        "people": {one: {"at_m": [2.0 + 1.6 * i, 3.1], "facing_deg": -90} for i, one in enumerate(people)},
        "goals": [{"greet": one} for one in people[:greeted]],
    }
    path = base / f"{name}.scenario.yaml"
    path.write_text(yaml.safe_dump(scenario, sort_keys=False))
    return record(prepare(load_scenario(str(path))), out=base / name, views=()).folder


@pytest.fixture(scope="module")
def pages(tmp_path_factory) -> dict[str, Path]:
    """One run with many people, and two whose people are not the same."""
    base = tmp_path_factory.mktemp("runs")
    one = recorded(base, "long", [*ONLY_IN_ONE, "anna", "bob", "carl", "dora"], 6)
    other = recorded(base, "short", ["eve", "anna"], 1)
    for name, folders in {"single": (one,), "both": (one, other), "same": (one, one)}.items():
        (base / f"{name}.html").write_text(replay_page(*folders), encoding="utf-8")
    return {name: base / f"{name}.html" for name in ("single", "both", "same")}


def in_its_panel(page, element) -> bool:
    """Whether an element can be seen within the panel that scrolls it."""
    return element.evaluate(
        """one => {
          const [inner, outer] = [one, one.closest('.scroll')].map(each => each.getBoundingClientRect());
          return inner.top >= outer.top - 1 && inner.bottom <= outer.bottom + 1;
        }"""
    )


def test_people_whose_names_every_object_knows_are_people_like_any_other(reader, pages):
    page = reader.open(pages["both"], "#t=5.00")
    groups = page.locator(".comparison .group").all_inner_texts()
    assert groups == ["Run", *ONLY_IN_ONE, "anna", "bob", "carl", "dora", "eve"]
    profile = page.locator(".comparison tbody", has_text="constructor").locator("tr").nth(1)
    assert profile.locator("td").all_inner_texts()[1] == "\N{EN DASH}"


def test_the_person_filter_of_a_comparison_knows_the_people_of_both(reader, pages):
    page = reader.open(pages["both"])
    people = page.get_by_label("Person", exact=True).locator("option").all_inner_texts()
    assert people == ["Everybody", *ONLY_IN_ONE, "anna", "bob", "carl", "dora", "eve"]


@pytest.mark.parametrize("width", [1366, 390])
@pytest.mark.parametrize("name", ["single", "both"])
def test_the_cursor_stands_on_the_lanes_at_the_time_that_it_shows(reader, pages, name, width):
    reader.page.set_viewport_size({"width": width, "height": 800})
    page = reader.open(pages[name], "#t=0.00")
    places = """() => {
      const box = (what) => document.querySelector(what).getBoundingClientRect();
      const [cursor, lane] = [box('.tree .cursor'), box('.row .track')];
      return [cursor.left + cursor.width / 2, lane.left, lane.right];
    }"""
    cursor, left, _ = page.evaluate(places)
    assert cursor == pytest.approx(left, abs=1)
    page.keyboard.press("End")
    cursor, _, right = page.evaluate(places)
    assert cursor == pytest.approx(right, abs=1)


def test_the_shorter_of_two_runs_stays_at_its_end_and_says_so(reader, pages):
    page = reader.open(pages["both"])
    assert page.locator(".over:visible").count() == 0
    page.keyboard.press("End")
    assert page.locator(".over:visible").count() == 1
    side = page.locator(".side").nth(1)
    assert side.locator(".over").inner_text().startswith("ended at ")
    cursor, beyond = (side.locator(f".tree {one}").bounding_box() for one in (".cursor", ".beyond"))
    assert cursor["x"] + cursor["width"] / 2 == pytest.approx(beyond["x"], abs=1)


def test_one_box_folds_the_finished_branches_of_both_runs(reader, pages):
    page = reader.open(pages["both"])
    page.keyboard.press("End")
    page.get_by_label("Fold finished branches").uncheck()
    rows = [page.locator(f".side:nth-child({side}) [role=treeitem]:visible") for side in (1, 2)]
    before = [each.count() for each in rows]
    page.get_by_label("Fold finished branches").check()
    assert all(each.count() < count for each, count in zip(rows, before, strict=True))


def test_a_folded_row_lends_its_mark_to_the_nearest_one_in_sight(reader, pages):
    page = reader.open(pages["single"])
    page.get_by_label("Fold finished branches").check()
    for _ in range(25):
        page.keyboard.press("ArrowRight")
        assert page.locator("[role=treeitem][aria-selected=true]:visible").count() == 1


def test_the_tree_and_the_charts_follow_the_time_and_the_page_stays(reader, pages):
    reader.page.set_viewport_size({"width": 390, "height": 700})
    page = reader.open(pages["single"], "#t=3.00")
    end = float(page.locator(".moment").inner_text().split(" / ")[1].removesuffix(" s"))
    for share in (0.2, 0.5, 0.8):
        go(page, share * end)
        running = page.locator("[data-status=running]:has(.kind[title=action])")
        assert any(in_its_panel(page, one) for one in running.all())
        assert in_its_panel(page, page.locator(".chart.speed"))
        assert page.evaluate("scrollY") == 0
    reached = page.locator(".tree-panel .scroll").evaluate("one => one.scrollTop")
    assert reached > 0
    charts = page.locator(".chart .name").all_inner_texts()
    assert charts[0] == "speed"
    assert page.locator(".series .scroll").evaluate("one => one.scrollTop") > 0


def test_who_has_just_scrolled_the_tree_reads_on_there(reader, pages):
    page = reader.open(pages["single"], "#t=3.00")
    page.get_by_label("Fold finished branches").uncheck()
    panel = page.locator(".tree-panel .scroll")
    panel.hover()
    page.mouse.wheel(0, 4000)
    page.wait_for_function("() => document.querySelector('.tree-panel .scroll').scrollTop > 0")
    page.wait_for_timeout(100)
    there = panel.evaluate("one => one.scrollTop")
    for t in (4.0, 6.0, 8.0):
        go(page, t)
        assert panel.evaluate("one => one.scrollTop") == there


def test_a_composite_node_is_shown_without_showing_every_change(reader, pages):
    page = reader.open(pages["single"], "#t=9.00")
    before = page.locator(".count", has_text="event ").inner_text().split(" of ")[1]
    page.locator('[role=treeitem][aria-level="1"] .name').first.click()
    assert page.get_by_label("Events", exact=True).input_value() == "deeds"
    after = page.locator(".count", has_text="event ").inner_text().split(" of ")[1]
    assert int(after) <= int(before) + 1
    row = page.locator('[role=treeitem][aria-level="1"]').first.get_attribute("data-node")
    assert page.locator(".event[aria-current=true] .node").inner_text() == row


def test_a_search_without_a_hit_leaves_no_cursor_behind(reader, pages):
    page = reader.open(pages["single"], "#t=9.00")
    page.get_by_label("Search nodes").fill("zzz(")
    assert page.locator(".tree .cursor").is_hidden()
    page.keyboard.press("Escape")
    assert page.locator(".tree .cursor").is_visible()


def test_a_comparison_says_at_every_width_which_run_is_which(reader, pages):
    for width in (1366, 1024, 768, 390):
        reader.page.set_viewport_size({"width": width, "height": 768})
        assert " beside " in reader.open(pages["both"]).locator(".head .facts:visible").inner_text()
        assert "seed 0" in reader.open(pages["single"]).locator(".head .facts:visible").inner_text()


def test_a_run_beside_itself_is_told_apart(reader, pages):
    tabs = reader.open(pages["same"]).get_by_role("tab").all_inner_texts()
    assert [tab[2:] for tab in tabs] == ["long", "long (the same folder)"]


def test_the_comparison_has_room_and_can_have_more(reader, pages):
    reader.page.set_viewport_size({"width": 1366, "height": 768})
    page = reader.open(pages["both"])

    def rows() -> int:
        return sum(in_its_panel(page, row) for row in page.locator(".comparison tbody tr").all())

    few = rows()
    page.get_by_role("button", name="Larger").click()
    assert rows() > few
    assert page.locator(".whys").is_hidden()
    page.get_by_role("button", name="Smaller").click()
    assert page.locator(".whys").is_visible()


def test_no_name_in_the_world_is_crossed_by_the_ring_of_its_person(reader, pages):
    """The letters stand within the ring or beyond it, in drawings of any size, where the room allows it."""
    for width in (1366, 390):
        reader.page.set_viewport_size({"width": width, "height": 768})
        page = reader.open(pages["single"], "#t=3.00")
        crossed = page.evaluate(
            """() => [...document.querySelectorAll('.person-name')].filter((text, i) => {
              const box = text.getBBox();
              const ring = document.querySelectorAll('.ring')[i].r.baseVal.value;
              const nearest = Math.max(Math.min(Math.abs(box.y), Math.abs(box.y + box.height)), 0);
              const farthest = Math.hypot(
                Math.max(Math.abs(box.y), Math.abs(box.y + box.height)) - box.height * 0.2, box.width / 2);
              return nearest + box.height * 0.2 < ring && farthest > ring;
            }).map((text) => text.textContent)"""
        )
        assert crossed == []
