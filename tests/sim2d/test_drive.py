"""The laws of the drive: it comes to rest where it should, and asks no more of the base than there is."""

import math

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.base.drive import (
    KEEP_OFF_M,
    PAST_S,
    keep_off_people,
    limit_change,
    limit_speed,
    speed_near_people,
    stopping_speed,
    turn_rate,
)
from comity_sim2d.scene.person import Person

STEP = 0.05
VECTORS = st.tuples(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0))


@given(st.floats(0.0, 10.0), st.floats(0.05, 3.0))
def test_braking_ends_exactly_at_the_goal_with_no_more_than_the_allowed_deceleration(
    way: float, a: float
) -> None:
    speed = stopping_speed(way, a, STEP)
    for _ in range(10_000):
        if way < 1e-9:
            break
        way -= speed * STEP
        assert way >= -1e-9
        slower = stopping_speed(max(way, 0.0), a, STEP)
        assert speed - slower <= a * STEP + 1e-9
        speed = slower
    assert way == pytest.approx(0.0, abs=1e-6)


@given(st.floats(0.01, 10.0), st.floats(0.05, 3.0))
def test_the_stopping_speed_is_below_the_continuous_law(way: float, a: float) -> None:
    assert stopping_speed(way, a, STEP) <= math.sqrt(2.0 * a * way) + 1e-12


@given(VECTORS, VECTORS, st.floats(0.0, 1.0))
def test_a_change_of_velocity_is_limited_and_goes_towards_what_is_wanted(now, wanted, most: float) -> None:
    new = limit_change(now, wanted, most)
    assert math.dist(now, new) <= most + 1e-12
    assert math.dist(new, wanted) <= math.dist(now, wanted) + 1e-12


@given(VECTORS, st.floats(0.0, 1.0))
def test_a_speed_limit_keeps_the_direction(velocity, most: float) -> None:
    x, y = limit_speed(velocity, most)
    assert math.hypot(x, y) <= most + 1e-12
    assert x * velocity[1] == pytest.approx(y * velocity[0], abs=1e-12)


@given(st.floats(0.0, 1.53))
def test_within_reach_of_people_the_limit_is_half_a_metre_per_second(gap: float) -> None:
    person = Person("ada", gap + 0.45, 0.0, 0.0)
    assert speed_near_people((0.0, 0.0), 0.5, 0.25, [person], braking=0.3, step_s=STEP) == 0.5


@given(st.floats(-0.05, 1.0), st.floats(-math.pi, math.pi), VECTORS)
def test_a_robot_too_near_to_a_person_goes_past_slowly_and_away_freely(gap, towards, velocity) -> None:
    ux, uy = math.cos(towards), math.sin(towards)
    person = Person("p0", (0.45 + gap) * ux, (0.45 + gap) * uy, 0.0)
    left = keep_off_people((0.0, 0.0), velocity, 0.25, [person], braking=0.3, step_s=STEP)
    closing, was = (vx * ux + vy * uy for vx, vy in (left, velocity))
    past, before = (abs(vx * uy - vy * ux) for vx, vy in (left, velocity))
    assert closing <= was + 1e-9
    assert past <= before + 1e-9
    if was <= 0.0:
        assert closing == pytest.approx(was, abs=1e-9)
    if gap < KEEP_OFF_M - 1e-9:
        assert closing <= 1e-9
        assert past <= max(gap, 0.0) / PAST_S + 1e-9
    else:
        assert past == pytest.approx(before, abs=1e-9)


@given(st.lists(st.tuples(st.floats(-0.05, 1.0), st.floats(-math.pi, math.pi)), max_size=4), VECTORS)
@example([(0.242, -1.48), (0.08, 0.63)], (-0.46, -0.20))
def test_what_is_kept_from_one_person_never_leads_into_the_margin_of_another(places, velocity) -> None:
    """Pressed by a walker 8 cm from it, it gave way down to 12 cm from somebody who stood."""
    at = [((0.45 + gap) * math.cos(way), (0.45 + gap) * math.sin(way)) for gap, way in places]
    people = [Person(f"p{i}", *xy, 0.0) for i, xy in enumerate(at)]
    vx, vy = keep_off_people(
        (0.0, 0.0), velocity, 0.25, people, braking=0.3, step_s=STEP, keep_m=lambda _: PERSON_MARGIN_M
    )
    for gap, way in places:
        most = stopping_speed(max(gap - PERSON_MARGIN_M, 0.0), 0.3, STEP)
        assert vx * math.cos(way) + vy * math.sin(way) <= most + 1e-6


@given(st.floats(-math.pi, math.pi))
def test_a_turn_ends_at_the_wanted_heading(angle: float) -> None:
    rate = 0.0
    for _ in range(200):
        rate = turn_rate(rate, angle, STEP)
        angle -= rate * STEP
    assert angle == pytest.approx(0.0, abs=1e-6)
