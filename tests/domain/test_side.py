from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity_domain import Side, sides

LAW = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=100, deadline=None)


@LAW
@given(heights=st.lists(st.floats(0.0, 1.0), min_size=2, max_size=7))
def test_left_and_right_are_mirror_images(infer, line, heights):
    """Whatever the curve: same desirability, opposite bearings inside their sectors, and the front is 0."""
    step = 90.0 / (len(heights) - 1)
    curve = line(tuple((step * i, height) for i, height in enumerate(heights)))
    found = sides(infer(curve=curve))
    front, left, right = found["front"], found["left"], found["right"]
    assert front.bearing_deg == 0.0
    assert left.bearing_deg == -right.bearing_deg
    assert 22.5 <= left.bearing_deg <= 90.0 + 1e-9
    assert left.desirability == right.desirability
    assert max(front.desirability, left.desirability) == pytest.approx(max(heights))


def test_a_side_stands_at_the_centre_of_area_of_its_sector(infer, line):
    left = sides(infer(curve=line(((0.0, 1.0), (22.5, 0.0), (90.0, 1.0)))))["left"]
    assert left == Side("left", pytest.approx(22.5 + 67.5 * 2 / 3), 1.0, inferred=False)


def test_a_side_without_any_desirability_stands_in_the_middle_of_its_sector(infer, line):
    curve = line(((0.0, 1.0), (10.0, 0.0), (90.0, 0.0)))
    assert sides(infer(curve=curve))["right"] == Side("right", -56.25, 0.0, inferred=False)


@pytest.mark.parametrize(
    ("asked_deg", "bearings_deg"),
    [
        (0.0, {"front": 0.0}),
        (10.0, {"left": 10.0, "right": -10.0}),
        (45.0, {"left": 45.0, "right": -45.0}),
        (180.0, {"left": 180.0}),
    ],
)
def test_an_explicit_direction_leaves_only_itself_and_its_mirror_image(infer, asked_deg, bearings_deg):
    found = sides(infer(direction=asked_deg, settings=["approach_direction"]))
    assert {name: side.bearing_deg for name, side in found.items()} == bearings_deg
    assert all(side.desirability == 1.0 for side in found.values())
