"""Unseen is not absent: whom the tracker dropped, or who walked out of sight, may be where the robot goes."""

from __future__ import annotations

import math

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


@pytest.mark.parametrize(
    "fault",
    [
        lambda robot: setattr(robot, "localisation", raising),
        lambda robot: setattr(robot, "tracks", raising),
        lambda robot: robot.people.update(guest=(math.nan, 3.0, 0.0)),
        lambda robot: robot.people.update(guest=(6.0, 3.0, 1e9)),
    ],
    ids=["localisation raises", "tracks raises", "a place that is none", "an angle of many turns"],
)
def test_whatever_the_robot_says_of_people_the_episode_has_an_outcome(here, fault):
    """For two seconds it raises, or says what is none; nothing of that leaves the run."""
    robot = gliding()
    sleep, place = robot.sleep, dict(robot.people)

    def sleep_and_fail(seconds: float) -> None:
        sleep(seconds)
        if 103.0 <= robot.t < 105.0:
            fault(robot)
        else:
            vars(robot).pop("localisation", None)
            vars(robot).pop("tracks", None)
            robot.people = dict(place)

    live = LiveEpisode(prepare(as_seen(load_scenario(written(here, SCENARIO)), robot)), robot=robot)
    robot.sleep = sleep_and_fail
    live.run()
    assert live.so_far().outcome == "success"


def raising() -> None:
    raise OSError("no answer")
