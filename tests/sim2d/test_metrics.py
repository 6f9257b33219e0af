"""Every figure of an episode, on trajectories whose figures can be worked out by hand."""

from __future__ import annotations

import math
from dataclasses import fields, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import InputError
from comity_sim2d import (
    EPISODE,
    VISIT,
    Contacts,
    Frames,
    Known,
    Metrics,
    Span,
    Stopping,
    TargetStop,
    measure,
    of_episode,
    of_person,
)
from comity_sim2d.metrics.disturbed_walks import DisturbedWalk
from comity_sim2d.metrics.metric import definitions
from comity_sim2d.metrics.motion import within, without
from comity_sim2d.metrics.near_people import NearPeople

R = 0.25
"""Radius of the robot; people have 0.20 m."""


def frames(robot, *people, every_s=1.0, names=("anna", "ben")):
    """Frames of a robot and people from lists of (x, y) or (x, y, heading); a person may be one pose."""
    count = len(robot)
    bodies = [robot, *([person] * count if isinstance(person, tuple) else person for person in people)]
    poses = np.array([[(*pose, 0.0)[:3] for pose in body] for body in bodies], dtype=float).swapaxes(0, 1)
    radii = (R, *[0.20] * len(people))
    return Frames(("robot", *names[: len(people)]), radii, np.arange(count) * every_s, poses)


def line(*xs):
    """A robot on the x axis."""
    return [(x, 0.0) for x in xs]


def test_way_and_speeds_of_a_walk_along_a_line():
    """1 m, 2 m, 0 m in three seconds: a way of 3 m, at 0 to 2 m/s."""
    found = measure(frames(line(0, 1, 3, 3)))
    assert found.duration_s == 3.0
    assert found.path_length_m == pytest.approx(3.0)
    assert (found.mean_speed_m_s, found.max_speed_m_s) == pytest.approx((1.0, 2.0))


def test_acceleration_and_jerk_are_changes_of_vectors_over_time():
    """Velocities 1, 2, 0, 0 m/s: accelerations 1, 2, 0 in size, and jerks 3 and 2 (the signs count)."""
    found = measure(frames(line(0, 1, 3, 3, 3)))
    assert found.max_acceleration_m_s2 == pytest.approx(2.0)
    assert found.mean_acceleration_m_s2 == pytest.approx(1.0)
    assert found.max_jerk_m_s3 == pytest.approx(3.0)


def test_a_turn_at_constant_speed_is_acceleration():
    """From 1 m/s along x to 1 m/s along y: a change of sqrt(2)."""
    found = measure(frames([(0, 0), (1, 0), (1, 1)]))
    assert found.max_acceleration_m_s2 == pytest.approx(math.sqrt(2))


def test_turning_adds_up_both_ways_and_across_the_half_turn():
    """170 to -170 degrees is a turn of 20, and back again another one."""
    left, right = math.radians(170), math.radians(-170)
    found = measure(frames([(0, 0, left), (0, 0, right), (0, 0, left)]))
    assert found.heading_change_rad == pytest.approx(math.radians(40))


def test_standing_counts_as_stalled_only_on_the_way():
    """Two of four seconds still, the last of them after the visit's way had ended."""
    robot = line(0, 1, 1, 2, 2)
    visit = TargetStop("anna", Span(0, 4), Span(0, 3), distance_m=1.0, bearing_deg=0.0)
    assert measure(frames(robot, (9, 9)), Known(visits=(visit,))).stalled_s == pytest.approx(1.0)


@given(st.lists(st.integers(0, 40), max_size=8).map(sorted), st.integers(0, 40), st.integers(0, 40))
def test_a_visit_without_its_breaks_is_all_of_it_but_from_the_start_of_each_to_before_its_end(
    cuts, one, other
):
    span = Span(*sorted((one, other)))
    breaks = tuple(Span(start, end) for start, end in zip(cuts[::2], cuts[1::2], strict=False))
    times = np.arange(0.0, 40.5, 0.5)
    away = np.array([any(each.start_s <= t < each.end_s for each in breaks) for t in times])
    assert (within(times, without(span, breaks)) == (within(times, (span,)) & ~away)).all()


def test_what_the_robot_does_about_somebody_else_in_between_is_no_part_of_a_visit():
    """It stands 0.55 m from anna for three seconds, of which two are about ben."""
    robot = line(0, 1, 1, 1, 1, 1.3)
    span = Span(0, 5)
    whole = TargetStop("anna", span, span, distance_m=0.25, bearing_deg=180.0)
    halved = replace(whole, breaks=(Span(2, 4),))
    walk = frames(robot, (2, 0), (9, 9))
    one, other = (measure(walk, Known(own_m={"anna": 0.9}, visits=(visit,))) for visit in (whole, halved))
    assert (one.stalled_s, one.failures_to_progress) == (3.0, 1)
    assert (other.stalled_s, other.failures_to_progress) == (1.0, 0)


def test_no_progress_for_three_seconds_counts_once_until_the_robot_gets_away():
    """Ten seconds at one place are one failure, five more at another place a second one."""
    robot = line(*[0.0] * 10, *[1.0] * 6)
    visit = TargetStop("anna", Span(0, 15), Span(0, 15), distance_m=1.0, bearing_deg=0.0)
    assert measure(frames(robot, (9, 9)), Known(visits=(visit,))).failures_to_progress == 2


def test_the_nearest_person_by_surface_and_by_centre():
    """Centres 3, 2, 1 m apart: with radii of 0.25 and 0.20 m the smallest gap is 0.55 m."""
    found = measure(frames(line(0, 1, 2), (3, 0)))
    assert found.min_clearance_m == pytest.approx(0.55)
    assert found.min_centre_distance_m == pytest.approx(1.0)


def test_time_in_the_spaces_goes_by_the_nearest_person():
    """Gaps 4, 3, 1, 0.3 m, each for a second: one second in each space, and one beyond all."""
    gaps = (4.0, 3.0, 1.0, 0.3, 0.3)
    found = measure(frames(line(*(10 - 0.45 - gap for gap in gaps)), (10, 0)))
    assert found.social_space_surface_s == pytest.approx(1.0)
    assert found.personal_space_surface_s == pytest.approx(1.0)
    assert found.intimate_space_surface_s == pytest.approx(1.0)


def test_shares_of_the_zones_and_the_mean_distance_go_by_the_nearest_person():
    """Gaps 4, 3, 1, 0.3 m, each for a second: a quarter in each zone, 2.075 m in the mean."""
    gaps = (4.0, 3.0, 1.0, 0.3, 0.3)
    found = measure(frames(line(*(10 - 0.45 - gap for gap in gaps)), (10, 0)))
    shares = (found.near_people.intimate_space_share, found.near_people.personal_space_share)
    assert (
        *shares,
        found.near_people.social_space_share,
        found.near_people.public_space_share,
    ) == pytest.approx((0.25,) * 4)
    assert found.near_people.mean_nearest_distance_m == pytest.approx(8.3 / 4)


def test_without_people_there_is_no_distance_no_zone_and_no_speed_near_them():
    named = of_episode(measure(frames(line(0, 1))))
    assert not {"mean_nearest_distance_m", "public_space_share", "p95_speed_within_1_5_m_m_s"} & named.keys()


def test_the_speed_near_people_is_a_percentile_of_the_steps_near_them():
    """Twenty steps of 0.01 to 0.20 m towards Anna, some of them within 1.5 m of her."""
    places = np.concatenate(([0.0], np.cumsum(np.arange(1, 21) / 100)))
    walk = frames(line(*places), (3.5, 0), (40, 0))
    near = measure(walk, Known(own_m={"anna": 0.5, "ben": 0.5}))
    inside = [step for step in range(20) if 3.05 - (places[step] + places[step + 1]) / 2 < 1.5]
    expected = np.quantile([(step + 1) / 100 for step in inside], 0.95)
    assert near.near_people.p95_speed_within_1_5_m_m_s == pytest.approx(expected)
    assert near.p95_speed_near_by_person_m_s == pytest.approx({"anna": expected})


def test_a_path_with_two_right_angles_turns_half_around_in_its_length():
    """1 m east, 1 m north, 1 m east: pi over 3 m; standing still in between adds nothing."""
    path = [(0, 0), (1, 0), (1, 0), (1, 0.001), (1, 1), (2, 1)]
    assert measure(frames(path)).path_irregularity_rad_m == pytest.approx(math.pi / 3, abs=1e-3)


def test_a_path_twice_as_long_as_the_shortest_has_a_ratio_of_two():
    assert measure(frames(line(0, 1, 2)), Known(shortest_m=1.0)).path_length_ratio == pytest.approx(2.0)
    assert measure(frames(line(0, 1, 2)), Known(shortest_m=1.0, success=False)).path_length_ratio is None


def test_whose_motion_led_to_a_contact():
    """The robot drives into Anna, who stands; Ben runs into the robot later."""
    robot = line(0, 0.6, 0.4, 0.4, 0.4)
    found = measure(frames(robot, (1, 0), [(0, 5), (0, 5), (0.4, 3), (0.4, 0.3), (0.4, 3)]))
    assert (found.near_people.contacts_by_robot, found.near_people.contacts_by_people) == (1, 1)


def test_a_contact_to_which_both_came_as_fast_is_the_robots():
    found = measure(frames(line(0, 0.3), [(1, 0), (0.7, 0)]))
    assert (found.near_people.contacts_by_robot, found.near_people.contacts_by_people) == (1, 0)


def test_a_robot_between_two_who_talk_intrudes_on_them_once_unless_it_visits_one():
    """Anna and Ben face each other 2 m apart; the robot drives through the middle."""
    crossing = [(0, y) for y in (-3, -2, 0, 0.1, 2, 3)]
    walk = frames(crossing, (-1, 0, 0.0), (1, 0, math.pi))
    group = Known(groups=(("anna", "ben"),))
    assert measure(walk, group).group_intrusions == 1
    visit = {"anna": (Span(0.0, 9.0),)}
    assert measure(walk, replace(group, engaged=visit)).group_intrusions == 0
    assert measure(walk).group_intrusions == 0


def test_a_group_of_which_one_has_gone_keeps_no_space():
    walk = frames([(0, -3), (0, 0)], [(-1, 0, 0.0), (-3, 0, 0.0)], (1, 0, math.pi))
    assert measure(walk, Known(groups=(("anna", "ben"),))).group_intrusions == 0


def test_a_group_of_people_who_are_not_there_is_refused():
    with pytest.raises(InputError):
        measure(frames(line(0, 1), (3, 0)), Known(groups=(("anna", "bem"),)))


walks = st.lists(st.tuples(*[st.floats(-5, 5)] * 4), min_size=2, max_size=8)


@given(walks, st.floats(-math.pi, math.pi), st.tuples(st.floats(-9, 9), st.floats(-9, 9)))
def test_metrics_near_people_stay_as_the_room_is_turned_and_moved(walk, angle, by):
    """And the shares of the four zones add up to 1."""
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])

    def of(place):
        return [tuple(turn @ np.array(pose) + by) for pose in place]

    robot, anna = [pose[:2] for pose in walk], [pose[2:] for pose in walk]
    one, other = measure(frames(robot, anna)), measure(frames(of(robot), of(anna)))
    assert other.near_people.mean_nearest_distance_m == pytest.approx(
        one.near_people.mean_nearest_distance_m, abs=1e-6
    )
    zones = ("intimate", "personal", "social", "public")
    assert sum(getattr(one.near_people, f"{zone}_space_share") for zone in zones) == pytest.approx(1.0)


def test_time_to_collision_of_two_who_meet_head_on():
    """5 m between centres, closing at 1 + 1 m/s: 4.55 m of air are gone after 2.275 s."""
    found = measure(frames(line(0, 1), [(5, 0), (4, 0)]))
    assert found.min_time_to_collision_s == pytest.approx(4.55 / 2)


def test_there_is_no_time_to_collision_with_somebody_who_is_passed():
    """A metre to the side of the way nobody is hit."""
    found = measure(frames(line(0, 1, 2), (1, 1)))
    assert math.isinf(found.min_time_to_collision_s)
    assert "min_time_to_collision_s" not in of_episode(found)


def test_space_compliance_leaves_out_whom_the_robot_visits_at_that_time():
    """Anna likes 1 m. For one of four seconds the robot is at 0.5 m, which counts unless it visits her."""
    walk = frames(line(0, 2.05, 0, 0, 0), (3, 0))
    own = {"anna": 1.0}
    found = measure(walk, Known(own_m=own))
    assert found.space_compliance_share == pytest.approx(0.75)
    assert found.compliance_share == pytest.approx({"anna": 0.75})
    visit = TargetStop("anna", Span(0.5, 1.5), Span(0.5, 1.5), distance_m=0.5, bearing_deg=180.0)
    found = measure(walk, Known(own_m=own, visits=(visit,)))
    assert found.space_compliance_share == 1.0
    assert found.compliance_share == {"anna": 1.0}


def test_somebody_whose_own_distance_is_not_known_has_that_of_routes():
    """A passer-by at gaps of 0.50, 0.40, 0.40, 0.50 m: two seconds of four are within 0.45 m."""
    found = measure(frames(line(*(3 - 0.45 - gap for gap in (0.5, 0.4, 0.4, 0.5, 0.5))), (3, 0)))
    assert found.space_compliance_share == pytest.approx(0.5)
    assert found.longest_intrusion_s == pytest.approx(1.0)  # from the first to the last frame of the stretch
    assert found.compliance_share == {}


def test_a_passer_by_counts_beside_somebody_whose_own_distance_is_kept():
    walk = frames(line(*(3 - 0.45 - gap for gap in (0.5, 0.4, 0.4, 0.5, 0.5))), (-9, 0), (3, 0))
    found = measure(walk, Known(own_m={"anna": 1.0}))
    assert found.space_compliance_share == pytest.approx(0.5)
    assert found.compliance_share == {"anna": 1.0}


def test_whoever_asks_for_another_distance_is_judged_by_it_from_then_on():
    """At gaps of 0.8 m throughout: Anna likes 0.5 m, asks for 1 m after a second and for 0.5 m two later."""
    walk = frames(line(*[3 - 0.45 - 0.8] * 5), (3, 0))
    found = measure(walk, Known(own_m={"anna": 0.5}, later_m={"anna": ((1.0, 1.0), (3.0, 0.5))}))
    assert found.compliance_share == pytest.approx({"anna": 0.5})
    assert found.space_compliance_share == pytest.approx(0.5)
    assert found.longest_intrusion_s == pytest.approx(1.0)


def test_what_was_asked_for_at_the_start_is_as_good_as_known_before():
    walk = frames(line(0, 2.05, 0, 0, 0), (3, 0))
    asked = measure(walk, Known(later_m={"anna": ((0.0, 1.0),)}))
    assert asked == measure(walk, Known(own_m={"anna": 1.0}))


def test_the_longest_intrusion_is_one_stretch_of_time():
    """Near for one second, away, near for two more: two seconds at the longest."""
    near, far = 2.05, 0.0
    walk = frames(line(near, near, far, near, near, near), (3, 0))
    assert measure(walk, Known(own_m={"anna": 1.0})).longest_intrusion_s == pytest.approx(2.0)


def leaves(*gaps: float) -> Metrics:
    """At gaps [m] a second apart; Anna likes 1 m, and the visit to her is over after the first second."""
    visit = TargetStop("anna", Span(0.0, 1.0), Span(0.0, 1.0), distance_m=gaps[0], bearing_deg=180.0)
    walk = frames(line(*(9 - 0.45 - gap for gap in gaps)), (9, 0))
    return measure(walk, Known(own_m={"anna": 1.0}, visits=(visit,)))


def test_leaving_is_no_intrusion():
    assert leaves(0.5, 0.5, 0.8, 1.2, 1.5).longest_intrusion_s == 0.0


def test_staying_within_her_distance_after_the_visit_is_one():
    assert leaves(0.5, 0.5, 0.5, 0.5, 0.5, 0.5).longest_intrusion_s > 0.0


def test_coming_back_after_leaving_is_one():
    assert leaves(0.5, 0.5, 1.2, 0.7, 0.7).longest_intrusion_s == pytest.approx(1.0)


def test_success_is_weighted_by_how_much_longer_the_way_was():
    """3 m where 2 would have done: two thirds; nothing for a failure; never more than 1."""
    walk = frames(line(0, 1, 3))
    assert measure(walk, Known(shortest_m=2.0)).success_weighted_by_path_length == pytest.approx(2 / 3)
    assert measure(walk, Known(shortest_m=2.0, success=False)).success_weighted_by_path_length == 0.0
    assert measure(walk, Known(shortest_m=5.0)).success_weighted_by_path_length == 1.0
    assert measure(walk).success_weighted_by_path_length is None


def test_contacts_are_counted_by_what_was_touched():
    found = measure(frames(line(0, 1)), Known(contacts=Contacts(people=1, walls=2, furniture=3)))
    assert (found.person_contacts, found.wall_contacts, found.furniture_contacts) == (1, 2, 3)
    assert found.touches == 6


def test_contacts_with_people_are_counted_from_frames_and_those_with_things_left_out():
    """Through Anna and back: twice; where she is entered, stayed in and left is one contact, not three."""
    found = measure(frames(line(0, 2.8, 3, 3.2, 5, 3, 0), (3, 0)))
    assert found.min_clearance_m == pytest.approx(-0.45)
    assert found.person_contacts == 2
    left_out = {"wall_contacts", "furniture_contacts", "touches"}
    assert not left_out & of_episode(found).keys()


def test_bodies_that_only_touch_do_not_overlap():
    assert measure(frames(line(0, 1), (1.5, 0))).person_contacts == 0


@given(st.integers(0, 2**32 - 1))
def test_contacts_of_frames_are_those_of_their_two_parts_less_those_that_go_on(seed):
    """Cut anywhere, both parts count whoever overlaps at the cut."""
    rng = np.random.default_rng(seed)
    poses = rng.uniform(-1, 1, (30, 3, 3))
    time, radii, names = np.arange(30.0), (R, 0.2, 0.2), ("robot", "anna", "ben")
    cut = int(rng.integers(1, 30))
    parts = [Frames(names, radii, time[part], poses[part]) for part in (np.s_[:cut], np.s_[cut - 1 :])]
    at_the_cut = Frames(names, radii, time[cut - 1 : cut], poses[cut - 1 : cut])
    one, other, both = (measure(each).person_contacts for each in (*parts, at_the_cut))
    assert measure(Frames(names, radii, time, poses)).person_contacts == one + other - both


@pytest.mark.parametrize(
    ("own", "said"), [({"ana": 1.0}, "anna"), ({"anna": -1.0}, "-1"), ({"anna": math.nan}, "nan")]
)
def test_own_distances_of_nobody_or_of_no_size_are_refused(own, said):
    with pytest.raises(InputError, match=said):
        measure(frames(line(0, 1), (5, 0)), Known(own_m=own))
    later = {name: ((0.0, distance_m),) for name, distance_m in own.items()}
    with pytest.raises(InputError, match=said):
        measure(frames(line(0, 1), (5, 0)), Known(later_m=later))


def approach(xs, *, wanted_m=1.0, every_s=0.1, person=(5.0, 0.0, math.pi), bearing_deg=0.0, arrives=True):
    """The robot on the x axis comes to Anna, who looks at it."""
    walk = frames(line(*xs), person, every_s=every_s)
    span = Span(0.0, float(walk.time_s[-1]))
    visit = TargetStop("anna", span, span, wanted_m, bearing_deg, arrives=arrives)
    return measure(walk, Known(visits=(visit,))).stopping["anna"]


def test_the_stop_is_measured_at_the_first_rest():
    """At 0.4 m/s from a gap of 2.55 m to one of 0.95 m, where 1 m was wanted; then it stands for 5 s."""
    coming = [2.0 + 0.04 * k for k in range(41)]
    found = approach([*coming, *[coming[-1]] * 50])
    assert found.stop_distance_error_m == pytest.approx(-0.05)
    assert found.overshoot_m == pytest.approx(0.05)
    assert found.bearing_error_deg == pytest.approx(0.0)
    assert found.robot_facing_error_deg == pytest.approx(0.0)
    assert found.person_facing_error_deg == pytest.approx(0.0)
    assert found.speed_at_1_2_m_m_s == pytest.approx(0.4)
    assert found.speed_at_target_plus_0_3_m_m_s == pytest.approx(0.4)
    assert found.speed_at_3_6_m_m_s is None  # it set out from within
    assert found.peak_closing_speed_m_s == pytest.approx(0.4)
    assert found.peak_deceleration_m_s2 == pytest.approx(4.0)  # 0.4 m/s gone within 0.1 s
    assert found.visible_approach_share == 1.0
    assert found.hold_error_rms_m == pytest.approx(0.05)


def test_a_stop_is_measured_in_the_first_frame_of_the_rest():
    """It creeps on while it rests, at 0.01 m/s: 4 mm in the 0.4 s after that frame."""
    coming = [2.0 + 0.05 * k for k in range(32)]
    found = approach([*coming, *[coming[-1] + 0.001 * k for k in range(1, 5)]])
    assert found.stop_distance_error_m == pytest.approx(-0.001)


@pytest.mark.parametrize("pause_m", [2.0, 3.4], ids=["far off", "near"])
def test_a_pause_on_the_way_is_no_stop_however_near(pause_m):
    """Somebody crosses its way for a second; then it goes on to a gap of 1 m, and docks there."""
    before, rest = np.arange(1.0, pause_m, 0.05), np.arange(pause_m, 3.55, 0.05)
    xs = [*before, *[pause_m] * 10, *rest, *[3.55] * 20]
    walk = frames(line(*map(float, xs)), (5.0, 0.0, math.pi), every_s=0.1)
    docked_s, end_s = 0.1 * (len(xs) - 18), float(walk.time_s[-1])
    visit = TargetStop("anna", Span(0.0, end_s), Span(0.0, docked_s), 1.0, 0.0)
    found = measure(walk, Known(visits=(visit,))).stopping["anna"]
    assert found.stop_distance_error_m == pytest.approx(0.0, abs=1e-9)
    assert found.hold_error_rms_m == pytest.approx(0.0, abs=1e-9)


def test_where_it_docked_before_it_rested_the_next_rest_is_the_stop():
    """It is told that it has docked at a gap of 1.05 m, still at 0.5 m/s, and rests at 1 m."""
    xs = [2.0 + 0.05 * k for k in range(32)]
    walk = frames(line(*xs, *[xs[-1]] * 10), (5.0, 0.0, math.pi), every_s=0.1)
    visit = TargetStop("anna", Span(0.0, 4.1), Span(0.0, 3.0), 1.0, 0.0)
    found = measure(walk, Known(visits=(visit,))).stopping["anna"]
    assert found.stop_distance_error_m == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("turns_deg", [60.0, -60.0])
def test_a_robot_that_still_turns_on_the_spot_has_not_come_to_rest(turns_deg):
    """It stops where it was wanted, looking past her, and turns to her within a second."""
    coming = [(2.0 + 0.05 * k, 0.0, math.radians(turns_deg)) for k in range(32)]
    turning = [(3.55, 0.0, math.radians(turns_deg * (1 - k / 10))) for k in range(1, 11)]
    walk = frames([*coming, *turning, *[(3.55, 0.0, 0.0)] * 10], (5.0, 0.0, math.pi), every_s=0.1)
    span = Span(0.0, 5.1)
    found = measure(walk, Known(visits=(TargetStop("anna", span, span, 1.0, 0.0),))).stopping["anna"]
    assert found.robot_facing_error_deg == pytest.approx(0.0, abs=1e-6)


def test_the_way_past_somebody_after_their_visit_is_no_overshoot():
    """It stops at a gap of 1 m for 6 s; later it passes at half of that."""
    coming = [2.0 + 0.05 * k for k in range(32)]
    walk = frames(line(*coming, *[3.55] * 60, 3.8, 4.05), (5.0, 0.0, math.pi), every_s=0.1)
    visit = TargetStop("anna", Span(0.0, 9.0), Span(0.0, 3.1), 1.0, 0.0)
    found = measure(walk, Known(visits=(visit,))).stopping["anna"]
    assert found.overshoot_m == pytest.approx(0.0, abs=1e-9)
    assert found.hold_error_rms_m == pytest.approx(0.0, abs=1e-9)


def overshoot_m(gaps, wanted):
    """Of a robot that is so far from Anna at seconds 0, 1, 2 ..., with what she wants from when on."""
    walk = frames(line(*(4.55 - gap for gap in gaps)), (5.0, 0.0, math.pi))
    span = Span(0.0, len(gaps) - 1.0)
    visit = TargetStop("anna", span, span, wanted[-1][1], 0.0, distances_m=tuple(wanted))
    return measure(walk, Known(visits=(visit,))).stopping["anna"].overshoot_m


GAPS = st.lists(st.floats(0.0, 3.0), min_size=1, max_size=8)
WANTED_M = st.floats(0.45, 3.0)


@given(GAPS, WANTED_M, st.sets(st.integers(0, 8)))
def test_what_is_wanted_throughout_is_overshot_by_how_much_nearer_it_came(gaps, wanted_m, again_s):
    """Also where plans say so again on the way."""
    said = [(float(since_s), wanted_m) for since_s in sorted({0, *again_s})]
    assert overshoot_m(gaps, said) == pytest.approx(max(0.0, wanted_m - min(gaps)), abs=1e-9)


@given(GAPS, WANTED_M, st.lists(st.floats(0.0, 1.0), max_size=5), WANTED_M)
def test_a_wish_for_more_room_that_comes_later_is_no_overshoot_where_the_robot_gives_way(
    gaps, wanted_m, steps_back, more_m
):
    before = overshoot_m(gaps, [(0.0, wanted_m)])
    back = [gaps[-1] + sum(steps_back[:k]) for k in range(len(steps_back) + 1)]
    wishes = [(0.0, wanted_m), (float(len(gaps)), max(wanted_m, more_m))]
    assert overshoot_m([*gaps, *back], wishes) == pytest.approx(before, abs=1e-9)


@pytest.mark.parametrize(
    ("gaps", "wanted", "nearer_m"),
    [
        ((2.0, 1.2, 1.0), [(0.0, 1.0), (2.0, 1.3)], 0.0),  # there already when she asks
        ((2.0, 1.2, 1.0), [(0.0, 1.0), (1.0, 1.3)], 0.2),  # comes nearer all the same
        ((2.0, 1.0, 1.3, 1.2), [(0.0, 1.0), (1.0, 1.3)], 0.1),  # goes back, and comes again
        ((2.0, 1.0, 0.6), [(0.0, 1.0), (1.0, 0.6)], 0.0),  # is asked nearer
        ((2.0, 1.0, 0.7, 0.6), [(0.0, 1.0), (2.0, 1.3)], 0.4),  # was too near, and comes nearer still
    ],
)
def test_overshoot_is_held_against_what_was_wanted_as_the_robot_came(gaps, wanted, nearer_m):
    assert overshoot_m(gaps, wanted) == pytest.approx(nearer_m)


def test_the_hold_error_ends_with_the_visit():
    """The robot leaves after a second: its way off is no error of holding."""
    coming = [2.0 + 0.05 * k for k in range(32)]
    leaving = [3.55 - 0.05 * k for k in range(30)]
    walk = frames(line(*coming, *[3.55] * 10, *leaving), (5.0, 0.0, math.pi), every_s=0.1)
    visit = TargetStop("anna", Span(0.0, 4.1), Span(0.0, 3.1), 1.0, 0.0)
    assert measure(walk, Known(visits=(visit,))).stopping["anna"].hold_error_rms_m == pytest.approx(
        0.0, abs=1e-9
    )


def test_a_rest_on_the_way_is_not_the_stop():
    """It waits a second at a gap of 2.55 m and then goes on to 1.00 m."""
    waiting = [2.0] * 10
    coming = [2.0 + 0.05 * k for k in range(32)]
    found = approach([1.9, 1.95, *waiting, *coming, *[coming[-1]] * 20])
    assert found.stop_distance_error_m == pytest.approx(0.0, abs=1e-9)


def test_bearing_and_facing_errors_are_those_of_the_geometry():
    """Anna looks along y; the robot stands on her left, was wanted at 60 deg, and looks past her by 30."""
    east = [(4.0, 0.0, math.radians(30))]
    west = [(3.9, 0.0, math.radians(30))]
    walk = frames([*west, *east * 10], (5.0, 0.0, math.pi / 2), every_s=0.1)
    span = Span(0.0, 1.0)
    visit = TargetStop("anna", span, span, 0.55, 60.0)
    found = measure(walk, Known(visits=(visit,))).stopping["anna"]
    assert found.bearing_error_deg == pytest.approx(30.0)
    assert found.robot_facing_error_deg == pytest.approx(30.0)
    assert found.person_facing_error_deg == pytest.approx(30.0)
    assert found.visible_approach_share == 0.0


@pytest.mark.parametrize("bearing_deg", [-90.0, -45.0, 0.0, 30.0, 90.0])
def test_a_wanted_side_is_no_error(bearing_deg):
    """The robot stands 1 m from Anna, who looks along x, on the side that was wanted, and faces her."""
    angle = math.radians(bearing_deg)
    place = (5.0 + 1.45 * math.cos(angle), 1.45 * math.sin(angle), math.pi + angle)
    walk = frames([place] * 12, (5.0, 0.0, 0.0), every_s=0.1)
    span = Span(0.0, 1.0)
    found = measure(walk, Known(visits=(TargetStop("anna", span, span, 1.0, bearing_deg),))).stopping["anna"]
    for error in (found.bearing_error_deg, found.person_facing_error_deg, found.robot_facing_error_deg):
        assert error == pytest.approx(0.0, abs=1e-6)


def test_a_distance_that_is_wished_for_on_the_way_is_no_error_of_what_was_held_before():
    """It stands 1 m from Anna; after a second she wants 1.5 m, and it goes back."""
    robot = line(3.55, *[3.55] * 10, *[3.55 - 0.05 * k for k in range(1, 11)], *[3.05] * 20)
    walk = frames(robot, (5.0, 0.0, math.pi), every_s=0.1)
    span = Span(0.0, float(walk.time_s[-1]))
    docked = Span(0.0, 0.5)
    visit = TargetStop("anna", span, docked, 1.0, 0.0, distances_m=((0.0, 1.0), (1.0, 1.5)))
    found = measure(walk, Known(visits=(visit,))).stopping["anna"]
    assert found.hold_error_rms_m == pytest.approx(0.0, abs=1e-9)


def test_the_hold_error_is_the_root_mean_square_over_five_seconds():
    """At rest 0 m off, then she moves and it is 0.03 m off: the root of the mean of squares."""
    robot = line(3.5, 3.55, *[3.55] * 60)
    anna = [(5.0, 0.0, math.pi)] * 32 + [(5.03, 0.0, math.pi)] * 30
    walk = frames(robot, anna, every_s=0.1)
    span = Span(0.0, 6.1)
    found = measure(walk, Known(visits=(TargetStop("anna", span, span, 1.0, 0.0),))).stopping["anna"]
    after = [0.0] * 30 + [0.03] * 21  # the rest begins in the third frame; 5 s are 51 frames
    assert found.hold_error_rms_m == pytest.approx(math.sqrt(np.mean(np.square(after))))


def test_a_robot_that_docks_and_never_rests_stopped_where_it_docked():
    """It sways by a centimetre, as one that follows a noisy reading does."""
    found = approach([3.55 + 0.01 * (k % 2) for k in range(20)])
    assert found.stop_distance_error_m == pytest.approx(-0.01)


def test_somebody_who_was_never_reached_has_no_stop():
    found = approach([2.0 + 0.05 * k for k in range(10)], arrives=False)
    assert found.stop_distance_error_m is None
    assert found.hold_error_rms_m is None
    assert found.overshoot_m == 0.0


@given(st.floats(-math.pi, math.pi), st.floats(-50, 50), st.floats(-50, 50), st.integers(0, 2**32 - 1))
def test_figures_do_not_depend_on_where_the_origin_is_and_where_north_is(turn, dx, dy, seed):
    """Turning and shifting the whole world changes no figure."""
    rng = np.random.default_rng(seed)
    poses = rng.normal(size=(40, 3, 3)).cumsum(axis=0) * 0.1
    poses[:, 1:] += np.array([[3.0, 0, 0], [0, 3.0, 0]])
    c, s = math.cos(turn), math.sin(turn)
    turned = poses @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    turned += np.array([dx, dy, turn])
    turned[..., 2] = np.pi - np.remainder(np.pi - turned[..., 2], 2 * np.pi)
    poses[..., 2] = np.pi - np.remainder(np.pi - poses[..., 2], 2 * np.pi)
    time = np.arange(40) * 0.05
    visit = TargetStop("anna", Span(0, 2), Span(0, 2), 1.0, 20.0)
    known = Known(own_m={"anna": 1.2, "ben": 0.7}, visits=(visit,))
    one, two = (
        measure(Frames(("robot", "anna", "ben"), (R, 0.2, 0.2), time, each), known)
        for each in (poses, turned)
    )
    assert of_episode(one) == pytest.approx(of_episode(two), rel=1e-6, abs=1e-6)
    assert of_person(one, "anna") == pytest.approx(of_person(two, "anna"), rel=1e-6, abs=1e-5)


def test_an_empty_world_has_figures_too():
    """One frame, nobody there: nothing divides by nothing."""
    found = of_episode(measure(frames(line(0))))
    assert found["path_length_m"] == 0.0
    assert "min_clearance_m" not in found


def test_every_metric_gets_a_value():
    walk = frames(line(-4, -2, 0, 2, *[3.4] * 5), (5, 0, math.pi))
    visit = TargetStop("anna", Span(0, 8), Span(0, 8), 1.15, 0.0, docked_s=4.0, own_m=1.0)
    visit = replace(visit, chosen_distance_m=1.15, chosen_bearing_deg=0.0)
    plan = {"plan_cost_m": 3.0, "plan_gap": 0.0}
    alone = {"anna": np.array([(0.0, 5.0, 0.0)])}
    known = Known(Contacts(), own_m={"anna": 1.0}, visits=(visit,), shortest_m=3.0, undisturbed=alone, **plan)
    found = measure(walk, known)
    assert of_episode(found).keys() == EPISODE.keys()
    assert of_person(found, "anna").keys() == VISIT.keys()


@pytest.mark.parametrize("record", [Metrics, NearPeople, Stopping, DisturbedWalk])
def test_every_number_is_defined(record):
    defined = {each.name for each in definitions(record)}
    of_records = {"near_people", "disturbed_walks", "stopping"}
    names = {(field.metadata.get("metric") or field).name or field.name for field in fields(record)}
    assert names - of_records <= defined


def test_the_docking_error_is_the_gap_of_the_last_docking_against_the_person_s_own_distance():
    """Docked at 1 m of gap where 1.2 m would have been theirs; what was chosen and when is passed on."""
    walk = frames(line(0, 1, 2, 2.55), (4, 0, math.pi))
    docked = {"docked_s": 3.0, "own_m": 1.2, "chosen_distance_m": 1.1, "chosen_bearing_deg": -10.0}
    visit = TargetStop("anna", Span(0, 3), Span(0, 3), 1.0, 0.0, **docked)
    found = of_person(measure(walk, Known(visits=(visit,))), "anna")
    assert found["docking_error_m"] == pytest.approx(0.2)
    assert (found["docking_time_s"], found["chosen_distance_m"], found["chosen_bearing_deg"]) == (
        3.0,
        1.1,
        -10.0,
    )


def test_without_a_docking_there_is_no_docking_error():
    visit = TargetStop("anna", Span(0, 3), Span(0, 3), 1.0, 0.0, arrives=False)
    found = of_person(measure(frames(line(0, 1, 2, 2.5), (4, 0, math.pi)), Known(visits=(visit,))), "anna")
    assert not {"docking_error_m", "docking_time_s"} & found.keys()


@given(st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=2, max_size=6))
def test_all_walk_as_far_together_as_each_of_them(path):
    walk = frames(line(*range(len(path))), [(x + 20, y) for x, y in path], (30, 0))
    found = measure(walk, Known(own_m={"anna": 1.0, "ben": 1.0}))
    each = [of_person(found, name)["walked_m"] for name in ("anna", "ben")]
    assert sum(each) == pytest.approx(of_episode(found)["walked_m"])
    assert each[1] == 0.0


def test_the_longest_intrusion_of_the_run_is_the_longest_of_a_person():
    walk = frames(line(0, 1, 2, 3, 4, 5), (2, 0.6), (5, 3))
    found = measure(walk, Known(own_m={"anna": 1.0, "ben": 1.0}))
    each = [of_person(found, name)["longest_intrusion_s"] for name in ("anna", "ben")]
    assert max(each) == of_episode(found)["longest_intrusion_s"] > 0.0
    assert each[1] == 0.0


def test_a_visit_to_nobody_is_a_mistake():
    visit = TargetStop("zoe", Span(0, 1), Span(0, 1), 1.0, 0.0)
    with pytest.raises(ValueError, match="zoe"):
        measure(frames(line(0, 1), (5, 0)), Known(visits=(visit,)))
