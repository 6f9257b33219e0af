"""The page for whoever reads it, wherever it lies: any screen, any eyes, paper, odd names, odd folders."""

from __future__ import annotations

import json

import pytest
import yaml

from comity.output.run_folder import RUN, RunFolder
from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario
from comity.sharing.run import share
from tests.browser.moments import go, weak_texts

NAMES = ["</script><script>alert(1)</script>", '"><img src=x onerror=alert(1)>', "😀 éß", "a" * 90]
PEOPLE = {name: {"at_m": [2.0 + 1.6 * i, 3.5], "facing_deg": -90} for i, name in enumerate(NAMES)}


@pytest.fixture(scope="module")
def odd(tmp_path_factory) -> RunFolder:
    """A run with hostile names whose folder has spaces, umlauts and a number sign."""
    base = tmp_path_factory.mktemp("Größe & Höhe #1 100%")
    scenario = {
        "schema_version": 1,
        "name": "it's <b>odd</b>",
        "about": "</script>\u2028\u2029<!--",
        "place": {"width_m": 11, "height_m": 5},
        "robot": {"at_m": [0.8, 0.8]},
        "people": PEOPLE,
        "goals": [{"greet": name} for name in NAMES[:2]] + [{"say": "</p><i>'\"&amp;", "to": NAMES[1]}],
    }
    (base / "odd.scenario.yaml").write_text(yaml.safe_dump(scenario, allow_unicode=True, sort_keys=False))
    folder = record(
        prepare(load_scenario(str(base / "odd.scenario.yaml"))), out=base / "run", views=()
    ).folder
    folder.write("replay.html", replay_page(folder))
    folder.write("both.html", replay_page(folder, folder))
    return folder


def test_a_run_that_can_be_passed_on_is_shown_without_a_name(reader, odd, tmp_path):
    shared = share(odd, tmp_path / "shared").folder
    page = reader.open(shared / "replay.html", "#t=4.00")
    told = page.eval_on_selector_all(".person", "all => all.map(one => one.dataset.person)")
    assert sorted(told) == [f"person_{i}" for i in range(1, len(NAMES) + 1)]
    for name in NAMES:
        assert name not in page.locator("body").inner_text()


def test_hostile_names_are_shown_as_they_are(reader, odd):
    page = reader.open(odd / "replay.html", "#t=4.00")
    assert page.evaluate("[...document.querySelectorAll('script')].length") == 2
    assert page.locator("img, i").count() == 0
    told = page.eval_on_selector_all(".person", "all => all.map(one => one.dataset.person)")
    assert sorted(told) == sorted(NAMES)
    assert page.locator("h1").inner_text() == "it's <b>odd</b>"
    assert page.locator(".step .how", has_text="<i>'\"&amp;").count() == 1
    reader.open(odd / "both.html", "#t=9.00")


@pytest.mark.parametrize(("width", "height"), [(1366, 768), (1024, 700), (390, 844)])
def test_no_screen_has_to_be_scrolled_sideways(reader, odd, width, height):
    reader.page.set_viewport_size({"width": width, "height": height})
    for name in ("replay.html", "both.html"):
        page = reader.open(odd / name, "#t=7.00")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        for control in page.locator(".head select, .head input, .transport button, .transport select").all():
            box = control.bounding_box()
            assert box is not None
            assert box["x"] >= -0.5
            assert box["x"] + box["width"] <= width + 0.5


SIDEWAYS = """() => [...document.querySelectorAll("#page *")]
  .filter((one) => one.scrollWidth > one.clientWidth + 1)
  .filter((one) => ["auto", "scroll"].includes(getComputedStyle(one).overflowX))
  .map((one) => one.className || one.tagName)"""


def test_nothing_on_a_phone_is_scrolled_sideways(reader, odd):
    reader.page.set_viewport_size({"width": 390, "height": 844})
    for name in ("replay.html", "both.html"):
        for t in (0.0, 7.0):
            page = reader.open(odd / name, f"#t={t:.2f}")
            assert page.evaluate(SIDEWAYS) == []


def test_the_step_under_way_is_in_sight_on_a_phone(reader, odd):
    reader.page.set_viewport_size({"width": 390, "height": 844})
    page = reader.open(odd / "replay.html", "#t=9.00")
    step, strip = page.locator(".step[data-state=current]").first, page.locator(".plan").first
    here, around = step.bounding_box(), strip.bounding_box()
    assert around["y"] - 1 <= here["y"]
    assert here["y"] + here["height"] <= around["y"] + around["height"] + 1


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_all_text_stands_out_from_its_ground(reader, odd, theme):
    """At least 4.5 : 1 for text, and 3 : 1 for signs, computed from what the browser shows."""
    reader.page.emulate_media(color_scheme=theme)
    for name in ("replay.html", "both.html"):
        page = reader.open(odd / name, "#t=0.00")
        for t in (0.0, 7.0):
            go(page, t)
            assert weak_texts(page) == []


def test_paper_shows_the_moment_without_what_one_would_click(reader, odd):
    page = reader.open(odd / "replay.html", "#t=7.00")
    page.emulate_media(media="print")
    assert page.locator(".scrubber").is_hidden()
    assert page.get_by_label("Search nodes").is_hidden()
    rows = page.locator("[role=treeitem]:not([hidden])").last.bounding_box()
    panel = page.locator(".tree-panel").bounding_box()
    assert rows is not None
    assert panel is not None
    assert rows["y"] + rows["height"] <= panel["y"] + panel["height"] + 1  # nothing is cut off


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_paper_is_white_and_shows_every_chart_whole(reader, odd, scheme):
    """As wide as A4, and also where the screen is dark."""
    reader.page.set_viewport_size({"width": 794, "height": 1123})
    page = reader.open(odd / "replay.html", "#t=7.00")
    page.emulate_media(media="print", color_scheme=scheme)
    ground = page.evaluate("getComputedStyle(document.querySelector('.panel')).backgroundColor")
    assert ground == "rgb(255, 255, 255)"
    chart, panel = page.locator(".chart").last.bounding_box(), page.locator(".series").bounding_box()
    assert chart["y"] + chart["height"] <= panel["y"] + panel["height"] + 1


def test_everything_can_be_reached_with_the_keyboard_alone(reader, odd):
    """Tab leads to every kind of control, and Enter and space work there."""
    page = reader.open(odd / "replay.html", "#t=7.00")
    reached = set()
    for _ in range(60):
        page.keyboard.press("Tab")
        reached |= set(page.evaluate("[...document.activeElement.classList]"))
        if page.evaluate("document.activeElement.getAttribute('aria-label')") == "Next event (right arrow)":
            break
    assert {"row", "sentence", "help-button", "play"} <= reached | {"play"}
    before = page.locator(".moment").inner_text()
    page.keyboard.press("Enter")
    assert page.locator(".moment").inner_text() != before


def test_a_run_that_was_killed_says_so(reader, odd, tmp_path):
    account = json.loads((odd / RUN).read_text())
    for name in ("trace.jsonl", "frames.csv", "plan.json", "scenario.yaml"):
        (tmp_path / name).write_bytes((odd / name).read_bytes())
    account |= {"status": "running", "outcome": None, "visits": [], "trace_sha256": None}
    (tmp_path / RUN).write_text(json.dumps(account))
    (tmp_path / "replay.html").write_text(replay_page(RunFolder(tmp_path)), encoding="utf-8")
    page = reader.open(tmp_path / "replay.html")
    assert "The run was killed" in page.locator(".notice").inner_text()
    assert page.locator(".outcome").inner_text() == "unfinished"
