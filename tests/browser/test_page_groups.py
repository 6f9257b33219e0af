"""What groups keep open between them is on the page as it is in pictures: at any time, in light and dark."""

from __future__ import annotations

import pytest

from comity.preparation import prepare
from comity.recording import record
from comity.replay import replay_page
from comity.scenario import load_scenario
from comity_sim2d.pictures.drawing import o_spaces_at
from tests.browser.moments import go, weak_texts

TALK = """\
schema_version: 1
name: talk
place:
  width_m: 8
  height_m: 6
  furniture: [{name: table, box_m: [4.6, 2.7, 0.8, 0.6]}]
robot: {at_m: [1, 1]}
people:
  ann: {at_m: [4, 3], facing_deg: 0}
  bob: {at_m: [6, 3], facing_deg: 180}
  cleo: {at_m: [5, 4], facing_deg: -90}
  dan: {at_m: [2, 5], facing_deg: -90}
groups:
  talk: [ann, bob, cleo]
goals: [{greet: dan}]
changes:
  - {at_s: 2, person: cleo, moves_to_m: [7, 5.4]}
  - {at_s: 4, person: cleo, moves_to_m: [5, 4], facing_deg: -90}
  - {at_s: 7, person: ann, moves_to_m: [1, 3]}
  - {at_s: 7, person: bob, moves_to_m: [7, 1]}
"""


@pytest.fixture(scope="module")
def talk(tmp_path_factory):
    """A page, with its scene and frames: one leaves the group and comes back, and then two leave."""
    base = tmp_path_factory.mktemp("talk")
    (base / "talk.scenario.yaml").write_text(TALK)
    prepared = prepare(load_scenario(str(base / "talk.scenario.yaml")))
    done = record(prepared, out=base / "run", views=())
    (base / "page.html").write_text(replay_page(done.folder), encoding="utf-8")
    return base / "page.html", prepared.scene, done.episode.frames


def drawn(page, projection) -> list[tuple[float, float, float]]:
    circles = page.locator(".o-space:visible")
    found = [[float(circle.get_attribute(key)) for key in ("cx", "cy", "r")] for circle in circles.all()]
    return [(x / 100 - 0.3, projection - y / 100, r / 100) for x, y, r in found]


def test_the_spaces_at_any_time_are_those_of_the_picture(reader, talk):
    path, scene, frames = talk
    page, seen = reader.open(path), set()
    for t in (*frames.time_s[::13].tolist(), frames.time_s[-1].item()):
        spaces = o_spaces_at(scene, frames, t)
        go(page, t)
        wanted = [(space.x_m, space.y_m, space.radius_m) for space in spaces]
        assert drawn(page, 6.3) == [pytest.approx(one, abs=2e-3) for one in wanted]
        titles = page.locator(".o-space:visible title").all_text_contents()
        assert titles == [f"space that {' and '.join(_listed(space.members))} keep open" for space in spaces]
        seen |= {space.members for space in spaces} or {()}
    assert seen == {("ann", "bob", "cleo"), ("ann", "bob"), ()}


def _listed(names: tuple[str, ...]) -> tuple[str, str]:
    return ", ".join(names[:-1]), names[-1]


def test_furniture_and_walls_stand_on_the_spaces(reader, talk):
    page = reader.open(talk[0])
    order = page.evaluate(
        "[...document.querySelectorAll('.room, .o-space, .furniture, .person')].map(e => e.classList[0])"
    )
    assert order[0] == "room"
    assert max(i for i, kind in enumerate(order) if kind == "o-space") < order.index("furniture")
    assert order.index("furniture") < order.index("person")


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_the_space_differs_from_the_floor_and_all_text_stands_out(reader, talk, theme):
    reader.page.emulate_media(color_scheme=theme)
    page = reader.open(talk[0])
    go(page, 1.0)
    fills = "['.room', '.o-space'].map(one => getComputedStyle(document.querySelector(one)).fill)"
    floor, space = page.evaluate(fills)
    assert floor != space
    assert weak_texts(page) == []
