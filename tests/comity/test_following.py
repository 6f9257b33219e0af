"""People who shuffle, drift or walk off while they are greeted, in the world with its physics."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from comity.episode import Episode
from comity.live_episode import LiveEpisode
from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario
from comity.schedule import Stage

ROOM = """\
schema_version: 1
name: room
place: {width_m: 10, height_m: 6}
robot: {at_m: [1, 3]}
people:
  bob: {profile: arab_man, at_m: [5, 3], facing_deg: 180}
goals: [{greet: bob}]
"""


@dataclass(frozen=True)
class BacksAway:
    """Bob goes straight back while he is greeted."""

    by_m: float
    speed_m_s: float
    at_s: float = 0.0

    def happen(self, stage: Stage) -> Iterator[None]:
        world = stage.world
        while not world.events:
            yield
        start_m = world.people[0].x_m
        while (x_m := world.people[0].x_m) < start_m + self.by_m - 1e-9:
            (bob,) = world.people
            x_m = min(start_m + self.by_m, x_m + self.speed_m_s * world.step_s)
            world.move_person("bob", x_m, bob.y_m, bob.heading_rad)
            yield


@pytest.fixture
def room(here) -> PlannedEpisode:
    (here / "room.scenario.yaml").write_text(ROOM)
    return prepare(load_scenario("room.scenario.yaml"))


def greeted(prepared: PlannedEpisode, *happenings: BacksAway) -> Episode:
    live = LiveEpisode(prepared, happenings=happenings)
    live.run()
    episode = live.so_far()
    assert episode.outcome == "success"
    assert episode.metrics.touches == 0
    done = [act.act for act in episode.acts if not act.stopped]
    assert sorted(done) == ["nod", "say"], "each once"
    return episode


def approaches(episode: Episode) -> int:
    return sum(e.node == "Reach_user(bob)" and e.status == "running" for e in episode.events)


def end_distance_m(episode: Episode) -> float:
    robot, bob = episode.frames.poses[-1, :2, 0]
    return float(bob - robot) - sum(episode.frames.radius_m[:2])


def test_a_shuffle_of_the_feet_switches_no_branch(room) -> None:
    episode = greeted(room, BacksAway(0.18, 0.4))
    assert approaches(episode) == 1
    assert sum(e.node == "docked?(bob)" for e in episode.events) == 2, "not docked, then docked"


def test_who_drifts_is_followed_at_their_distance(room) -> None:
    """At 0.2 m/s for as long as the greeting takes: the hold follows, and nothing is begun anew."""
    episode = greeted(room, BacksAway(0.28, 0.2))
    wanted_m = episode.values["bob"]["conversational_distance"].number
    assert approaches(episode) == 1
    assert end_distance_m(episode) == pytest.approx(wanted_m, abs=0.05)


def test_who_walks_off_is_docked_to_again_and_no_act_that_was_done_is_repeated(room) -> None:
    episode = greeted(room, BacksAway(1.3, 1.0))
    assert approaches(episode) == 2
    episode.assert_halted("nod", by="docked?(bob) -> failure")
    wanted_m = episode.values["bob"]["conversational_distance"].number
    assert episode.visits[0].docked_at.distance_m == pytest.approx(wanted_m, abs=0.01)


def test_speech_and_gesture_run_at_the_same_time(room) -> None:
    episode = greeted(room)
    say, nod = sorted(episode.acts, key=lambda act: act.act, reverse=True)
    assert max(say.t_start, nod.t_start) < min(say.t_end, nod.t_end)
