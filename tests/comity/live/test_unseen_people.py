"""Unseen is not absent: whom the tracker dropped, or who walked out of sight, may be where the robot goes."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from gliding import SCENARIO, Gliding, gliding, written
from hypothesis import given
from hypothesis import strategies as st

from comity.live.people_seen import GROWS_M, PeopleSeen
from comity.live.start import as_seen
from comity.live_episode import LiveEpisode
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_executor import PersonTrack
from comity_sim2d import Person, Pose, RobotBody, Room, Scene, Sensor, Wall

ROOM = Room.rectangle(12.0, 8.0)


def scene(*, walls: tuple[Wall, ...] = (), range_m: float = 5.0) -> Scene:
    robot = RobotBody(1.0, 4.0, 0.0, sensor=Sensor(range_m=range_m))
    return Scene(ROOM, robot, (Person("anna", 4.0, 4.0, 0.0),), walls=walls)


def track(x: float, t: float, speed: float = 0.0) -> PersonTrack:
    return PersonTrack(1, x, 4.0, t, 0.0, (speed, 0.0), person="anna", identified_s=t)


@given(gone_s=st.floats(0.05, 20.0), away_m=st.floats(0.5, 6.0), speed=st.sampled_from([0.0, 0.8]))
def test_whom_the_tracker_dropped_within_range_may_be_as_far_as_they_can_have_walked(gone_s, away_m, speed):
    """At 1.4 m/s, by 2 m at most: nearer than that the robot has to stand, and farther it may go on."""
    seen = PeopleSeen(scene())
    eye = Pose(4.0 - away_m, 4.0, 0.0)
    seen.take_in([track(4.0, 0.0, speed)], eye, 0.0)
    seen.take_in([], eye, gone_s)
    bodies_m = 0.25 + seen.people[0].radius_m
    assert (seen.may_be_at(eye, gone_s) is not None) == (away_m <= bodies_m + min(GROWS_M, 1.4 * gone_s))


@given(gone_s=st.floats(0.05, 60.0))
def test_who_stood_and_is_merely_out_of_range_is_where_they_were(gone_s):
    seen = PeopleSeen(scene(range_m=2.0))
    seen.take_in([track(4.0, 0.0)], Pose(2.0, 4.0, 0.0), 0.0)
    seen.take_in([], Pose(1.0, 4.0, 0.0), gone_s)
    assert seen.of("anna").grown_m(gone_s) == 0.0
    assert seen.obstacles(gone_s)[0].radius_m == seen.people[0].radius_m


def test_who_walked_out_of_range_may_come_back():
    seen = PeopleSeen(scene(range_m=2.0))
    seen.take_in([track(4.0, 0.0, 0.8)], Pose(2.0, 4.0, 0.0), 0.0)
    seen.take_in([], Pose(1.0, 4.0, 0.0), 1.0)
    assert seen.of("anna").grown_m(1.0) == pytest.approx(1.4)
    assert seen.may_be_at(Pose(2.5, 4.0, 0.0), 2.0) is not None


def test_nobody_comes_through_a_wall():
    wall = Wall((3.0, 0.0), (3.0, 8.0))
    seen = PeopleSeen(scene(walls=(wall,)))
    seen.take_in([track(4.0, 0.0, 0.8)], Pose(2.5, 4.0, 0.0), 0.0)
    seen.take_in([], Pose(2.5, 4.0, 0.0), 5.0)
    assert seen.of("anna").grown_m(5.0) == GROWS_M
    assert seen.may_be_at(Pose(2.5, 4.0, 0.0), 5.0) is None


@pytest.mark.parametrize("comes_back", ["seen", "free"])
def test_the_obstacle_is_gone_when_they_are_seen_again_or_their_floor_is_seen_free(comes_back):
    seen, eye = PeopleSeen(scene()), Pose(3.0, 4.0, 0.0)
    seen.take_in([track(4.0, 0.0)], eye, 0.0)
    seen.take_in([], eye, 2.0)
    assert seen.may_be_at(eye, 2.0) is not None
    if comes_back == "seen":
        seen.take_in([track(4.5, 2.1)], eye, 2.1)
    else:
        seen.take_in([], eye, 2.1, is_free=lambda x, y, radius_m: math.dist((x, y), (4.0, 4.0)) < 0.1)
    assert seen.may_be_at(eye, 2.1) is None


@pytest.mark.parametrize("person", ["host", "guest"])
def test_the_robot_stands_while_a_person_may_have_come_to_it_and_goes_on_when_they_are_seen(here, person):
    """Judged from where it truly went; the run tells when it stood, and why."""
    robot = gliding()
    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    sleep, gone = robot.sleep, (103.5, 108.0)

    def sleep_and_drop(seconds: float) -> None:
        sleep(seconds)
        robot.dropped = {person} if gone[0] <= robot.t < gone[1] else set()

    robot.sleep = sleep_and_drop
    live.run()
    x, y, _ = robot.people[person]
    for t, px, py, speed in robot.path:
        reach_m = min(GROWS_M, 1.4 * (t - 0.4 - gone[0]))  # a tick, and the lease, later
        inside_m = reach_m - 0.05  # it enters by a tick of its way, and stands
        if gone[0] + 0.4 < t < gone[1] and math.dist((px, py), (x, y)) - 0.45 <= inside_m:
            assert speed == 0.0
    assert live.so_far().outcome == "success"
    stood = [one for one in live.disturbances if f"{person} was seen last" in one.text]
    assert all(one.end_s == pytest.approx(gone[1] - 100.0, abs=0.11) for one in stood)
    assert stood or person == "guest"


def test_a_stranger_whom_the_scenario_does_not_know_is_gone_around(here):
    """A track without a name on the wanted pose: the robot takes another one."""
    robot = gliding()
    prepared = prepare(as_seen(load_scenario(written(here, SCENARIO)), robot))
    step = next(step for step in prepared.plan.steps if step.person == "guest")
    away = step.parameters["conversational_distance"] + 0.45
    angle = math.radians(180.0 + step.parameters["approach_bearing"])
    robot.people["passer"] = (6.0 + away * math.cos(angle), 3.0 + away * math.sin(angle), 0.0)
    live = LiveEpisode(prepared, robot=robot)
    live.run()
    guest = next(visit for visit in live.so_far().visits if visit.person == "guest")
    assert guest.outcome == "greeted"
    assert guest.pose is not None
    assert not guest.pose.pose_free
    x, y, _ = robot.people["passer"]
    assert math.dist((robot.x, robot.y), (x, y)) > 0.45 + 0.3


def swapped(robot: Gliding, *, sure: bool) -> None:
    """The tracker mixes the two up when they meet, and does not make sure of it unless it says so."""
    sleep, place = robot.sleep, dict(robot.people)

    def sleep_and_meet(seconds: float) -> None:
        sleep(seconds)
        near = 101.0 <= robot.t < 102.0
        robot.people = {"host": place["host"], "guest": (3.6, 3.0, 180.0) if near else place["guest"]}
        if robot.t >= 102.0:
            robot.called = {"host": "guest", "guest": "host"}
            robot.sure_of = {} if sure else {"host": 101.5, "guest": 101.5}
        elif near:
            robot.sure_of = {"host": 101.0, "guest": 101.0}

    robot.sleep = sleep_and_meet


def test_after_a_meeting_nobody_is_met_nearer_touched_or_named_by_the_others_facts(here):
    """The tracker swaps the two and never makes sure: both are met as strangers are, or farther."""
    text = SCENARIO.replace(
        "profile: german_man", "profile: {name: karl, settings: {conversational_distance: 1.6}}"
    ).replace("profile: arab_woman}", "profile: arab_woman, situation: {touch_consent: given}}")
    robot = gliding()
    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, text)), robot)), robot=robot)
    swapped(robot, sure=False)
    live.run()
    episode = live.so_far()
    assert episode.uncertain == {"host", "guest"}
    met = [(t, what) for t, command, what in robot.log if command == "perform" and t > 101.1]
    assert met
    for _, act in met:
        assert act.act not in ("handshake",)
        assert "Host" not in (act.text or "")
        assert "Guest" not in (act.text or "")
    for visit in episode.visits:
        assert visit.docked_at.distance_m >= 1.6 - 0.011


def test_once_the_robot_has_made_sure_everybody_is_met_as_themselves(here):
    """It has made sure that whom it now calls guest is the guest: their own distances count again."""
    robot = gliding()
    prepared = prepare(as_seen(load_scenario(written(here, SCENARIO)), robot))
    live = LiveEpisode(prepared, robot=robot)
    swapped(robot, sure=True)
    live.run()
    for visit in live.so_far().visits:
        wanted = prepared.values[visit.person]["conversational_distance"].number
        assert visit.docked_at.distance_m == pytest.approx(wanted, abs=0.011)
    assert any("Guest" in (act.text or "") for act in robot.told("perform"))


def raising(_: object) -> None:
    raise OSError("no answer")


FAULTS = {
    "localisation raises": {"tells": raising},
    "localisation is a text": {"tells": lambda _: "here"},
    "a place that is none": {"tells": lambda here: replace(here, x_m=math.nan)},
    "a place outside the room": {"tells": lambda here: replace(here, x_m=-5.0)},
    "a time to come": {"tells": lambda here: replace(here, stamp_s=here.stamp_s + 100.0)},
    "a time that is none": {"tells": lambda here: replace(here, stamp_s=math.nan)},
    "tracks raises": {"tells_of_people": raising},
    "tracks of nobody": {"tells_of_people": lambda _: [None]},
    "tracks of long ago": {
        "tells_of_people": lambda tracks: [replace(one, stamp_s=one.stamp_s - 5.0) for one in tracks]
    },
}


@pytest.mark.parametrize("fault", FAULTS)
def test_what_cannot_be_believed_is_silence(here, fault):
    """For four seconds it says what is none: within 0.5 s the base stands, and goes on afterwards."""
    robot = gliding()
    sleep, honest = robot.sleep, {name: getattr(robot, name) for name in FAULTS[fault]}

    def sleep_and_fail(seconds: float) -> None:
        sleep(seconds)
        vars(robot).update(FAULTS[fault] if 103.0 <= robot.t < 107.0 else honest)

    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    robot.sleep = sleep_and_fail
    live.run()
    assert live.so_far().outcome == "success"
    stood = [one for one in live.disturbances if one.kind == "fault"]
    assert stood[0].t == pytest.approx(3.5, abs=0.2)
    assert stood[0].end_s == pytest.approx(7.0, abs=0.2)
    assert {v for t, _, _, v in robot.path if 103.8 < t < 107.0} == {0.0}


@pytest.mark.parametrize("call", ["now_s", "sleep"])
def test_a_broken_clock_ends_the_run_as_stopped(here, call):
    robot = gliding()
    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    own = getattr(robot, call)

    def breaking(*given: float) -> float | None:
        if robot.t >= 103.0:
            raise OSError("no clock")
        return own(*given)

    setattr(robot, call, breaking)
    live.run()
    assert live.so_far().outcome in ("stopped", "stop_unconfirmed")
    assert robot.told("stop")


def test_two_tracks_of_one_person_are_two_bodies_and_nobody_is_sure(here):
    robot = gliding()
    robot.people["other"] = (5.4, 3.4, 0.0)
    robot.called["other"] = "guest"
    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    live.run()
    episode = live.so_far()
    assert "guest" in episode.uncertain
    for x, y, _ in (robot.people["guest"], robot.people["other"]):
        assert min(math.dist((px, py), (x, y)) for _, px, py, v in robot.path if v == 0.0) >= 0.45 + 0.29


def test_a_dropped_frame_is_neither_a_loss_nor_a_doubt(here):
    """The tracker drops somebody for two ticks, again and again."""
    robot = gliding()
    sleep = robot.sleep

    def sleep_and_drop(seconds: float) -> None:
        sleep(seconds)
        robot.dropped = {"host", "guest"} if round(robot.t / 0.05) % 20 < 2 else set()

    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    robot.sleep = sleep_and_drop
    live.run()
    episode = live.so_far()
    assert episode.outcome == "success"
    assert episode.uncertain == frozenset()
    assert episode.disturbances == ()


def test_in_doubt_nobody_is_approached_faster_than_any_of_them_likes(here):
    robot = gliding()
    robot.sure_of = {"host": None, "guest": None}
    prepared = prepare(as_seen(load_scenario(written(here, SCENARIO)), robot))
    live = LiveEpisode(prepared, robot=robot)
    live.run()
    slowest = min(values["approach_speed"].number for values in prepared.values.values())
    for values in live.so_far().values.values():
        assert values["approach_speed"].number <= slowest + 1e-9


def test_a_base_whose_goal_stays_succeeded_after_it_was_stopped_has_stopped(here):
    robot = gliding()
    stop, motion = robot.stop, robot.motion

    def stay(goal: object = None) -> None:
        was = motion()
        stop(goal)
        robot.motion = lambda: replace(motion(), state=was.state) if was.state == "succeeded" else motion()

    def go(goal: object, go=robot.go) -> object:
        robot.motion = motion
        return go(goal)

    robot.stop, robot.go = stay, go
    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    live.run()
    assert live.so_far().outcome == "success"


def test_a_place_that_is_centimetres_inside_furniture_ends_nothing(here):
    """Localisation is off by 4 cm beside the cupboard while a new plan is made there."""
    text = SCENARIO.replace(
        "height_m: 6}", "height_m: 6, furniture: [{name: cupboard, box_m: [0.0, 2.0, 1.0, 2.0]}]}"
    )
    text += "changes:\n  - {at_s: 1.0, person: host, says: {conversational_distance: 2.0}}\n"
    robot = gliding(x=1.3, y=3.0)
    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, text)), robot)), robot=robot)
    sleep = robot.sleep

    def sleep_and_err(seconds: float) -> None:
        sleep(seconds)
        is_off = 100.9 <= robot.t < 101.3
        robot.tells = (lambda here: replace(here, x_m=1.21, y_m=3.0)) if is_off else lambda here: here

    robot.sleep = sleep_and_err
    live.run()
    assert live.so_far().outcome == "success"


def test_where_the_sensor_is_short_it_stops_where_they_were_seen_last_and_says_so(here):
    """The tracker sees bodies that are 1.2 m from its middle, and he wants it 1.09 m + 0.25 m away."""
    text = SCENARIO.replace("robot: {at_m: [1, 1]}", "robot: {at_m: [1, 1], sensor: {range_m: 1.2}}")
    robot = gliding()
    prepared = prepare(as_seen(load_scenario(written(here, text)), robot))
    sleep = robot.sleep

    def sleep_and_see(seconds: float) -> None:
        sleep(seconds)
        at = {name: place[:2] for name, place in robot.people.items()}
        robot.dropped = {name for name in at if math.dist((robot.x, robot.y), at[name]) - 0.2 > 1.2}

    robot.sleep = sleep_and_see
    live = LiveEpisode(prepared, robot=robot)
    live.run()
    host = next(visit for visit in live.so_far().visits if visit.person == "host")
    assert host.outcome == "greeted"
    wanted = prepared.values["host"]["conversational_distance"].number
    assert host.docked_at.distance_m == pytest.approx(wanted, abs=0.011)
    assert "not verified" in host.unverified
    docks = [goal.speed_m_s for goal in robot.told("go") if (goal.to, goal.kind) == ("host", "dock")]
    assert docks
    assert max(docks) <= 0.3
