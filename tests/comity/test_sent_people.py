"""Changes and faults that send the same people: the last one leads, and nobody is torn to and fro."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from sampling import sampled

import comity as front_door
from comity.schedule import Happening, Schedule, Stage
from comity.simulation.breakdowns import StandInTheWay, WalkOff
from comity.simulation.happenings import GAP_M
from comity.simulation.happenings import WalkStart as Sent
from comity_sim2d import (
    Comfort,
    DockingPose,
    Frames,
    Furniture,
    PassersBy,
    Person,
    RobotBody,
    Room,
    Scene,
    Walk,
    World,
)
from comity_sim2d.people.social_force import FASTEST
from comity_sim2d.scene.robot_reaction import THREATENING_M_S
from comity_sim2d.senses import active_faults
from tests.comity.nobody import Nobody

TABLE = Furniture.box("table", 3.5, 2.5, width_m=1.0, depth_m=1.0)
ANN = Person("ann", 4.0, 5.0, -math.pi / 2)
BOB = Person("bob", 6.8, 3.0, math.pi)
PACES = Walk(((1.0, 5.0), (7.0, 5.0)), loop=True, speed_m_s=0.8)
KINDS: list[dict] = [
    {},
    {"posture": "seated", "comfort": Comfort(1.2, 1.5)},
    {"comfort": Comfort(1.2, 1.5, shows=("step_back",))},
    {"reacts": "curious"},
    {"reacts": "scared", "comfort": Comfort(1.2, 1.5)},
    {"walk": PACES},
    {"walk": replace(PACES, loop=False, pauses_s=(1.0, 1.0), stops=True), "reacts": "threatening"},
]
"""Whatever may move somebody besides: steps back, reactions to the robot, a walk of their own."""


def played(
    scene: Scene, happenings: list[Happening], seconds: float, *, visits: str = "bob", seed: int = 0
) -> World:
    """The robot comes up to somebody meanwhile."""
    world = World(scene, seed)
    stage, schedule = Stage(world, Nobody(), Nobody()), Schedule(happenings)
    world.robot.dock(visits, DockingPose(0.6, 0.0), speed_m_s=0.7)
    for _ in range(round(seconds / world.step_s)):
        schedule.step(stage)
        world.step()
    return world


def scene_with(*people: Person) -> Scene:
    return Scene(Room.rectangle(8.0, 6.0), RobotBody(1.0, 1.0), people, furniture=(TABLE,))


def longest_stride_m(frames: Frames, name: str) -> float:
    return max(math.dist(a[:2], b[:2]) for a, b in pairwise(frames.of(name).tolist()))


def place_of(world: World, name: str) -> tuple[float, float]:
    return next(person.xy for person in world.people if person.name == name)


TIMES = st.integers(0, 200).map(lambda tick: tick / 20)
SPEEDS = st.sampled_from([0.4, 1.0, 3.0])
PLACES = st.sampled_from([(7.3, 5.0), (1.0, 4.0), (4.0, 1.0), (2.5, 3.0), (5.5, 4.5)])
CHANGES = st.builds(Sent, TIMES, st.just("ann"), PLACES, st.sampled_from([None, 0.5]), SPEEDS)
FAULTS = st.one_of(
    st.builds(StandInTheWay, TIMES, st.just("ann"), st.sampled_from([0.5, 3.0]), SPEEDS, st.just("fault")),
    st.builds(WalkOff, TIMES, st.just("ann"), st.just(1.5), st.none(), SPEEDS, st.just("fault")),
)


@sampled(12)
@given(
    kind=st.sampled_from(KINDS),
    visits=st.sampled_from(["ann", "bob"]),
    happenings=st.lists(st.one_of(CHANGES, CHANGES, FAULTS), min_size=1, max_size=4),
)
def test_nobody_is_faster_than_whatever_moves_them_and_the_last_change_is_where_they_end(
    kind, visits, happenings
) -> None:
    world = played(scene_with(replace(ANN, **kind), BOB), happenings, 45.0, visits=visits)
    own_m_s = FASTEST * THREATENING_M_S if "reacts" in kind else FASTEST * PACES.speed_m_s if kind else 0.0
    fastest_m_s = max(own_m_s, *(each.speed_m_s for each in happenings))
    assert longest_stride_m(world.frames, "ann") <= fastest_m_s * world.step_s + 1e-9

    last = max((each for each in happenings if isinstance(each, Sent)), key=lambda it: it.at_s, default=None)
    ties = [each for each in happenings if last and each is not last and each.at_s == last.at_s]
    walks_off = any(isinstance(each, WalkOff) and last and each.at_s >= last.at_s for each in happenings)
    if last is None or ties or walks_off or kind.get("reacts") or kind.get("comfort"):
        return
    here = place_of(world, "ann")
    near_m = min(math.dist(here, xy) for xy in (world.robot.pose.xy, place_of(world, "bob")))
    assert math.dist(here, last.to_m) < 1e-6 or near_m < 0.45 + GAP_M + 3.0 * world.step_s


def test_a_later_change_takes_over_where_somebody_is_just_then() -> None:
    first, second = Sent(1.0, "ann", (7.3, 5.0), None, 1.0), Sent(3.0, "ann", (4.5, 1.0), 1.5, 1.0)
    world = played(scene_with(ANN, BOB), [first, second], 15.0)
    assert world.frames.of("ann")[:, 0].max() < 6.2, "she is not there yet"
    assert world.people[0].pose == pytest.approx((4.5, 1.0, 1.5))


def test_of_two_changes_at_one_time_the_one_that_is_written_later_counts() -> None:
    sent = [Sent(1.0, "ann", (7.3, 5.0), None, 1.0), Sent(1.0, "ann", (4.5, 1.0), None, 1.0)]
    assert place_of(played(scene_with(ANN, BOB), sent, 15.0), "ann") == pytest.approx((4.5, 1.0))


def test_who_is_sent_elsewhere_while_standing_in_the_way_goes_there() -> None:
    in_the_way = StandInTheWay(0.5, "ann", 10.0, 1.0, "ann stands in the way")
    world = played(scene_with(ANN, BOB), [in_the_way, Sent(3.0, "ann", (7.3, 5.0), None, 1.0)], 15.0)
    assert world.frames.of("ann")[:, 1].min() < 4.0, "she went to stand in the way"
    assert place_of(world, "ann") == pytest.approx((7.3, 5.0))
    assert world.faults.of(active_faults.person("ann")) is None


def test_who_goes_to_stand_in_the_way_in_the_middle_of_a_walk_ends_where_that_leads() -> None:
    in_the_way = StandInTheWay(2.0, "ann", 1.0, 1.0, "ann stands in the way")
    world = played(scene_with(ANN, BOB), [Sent(1.0, "ann", (7.3, 5.0), 0.5, 1.0), in_the_way], 25.0)
    assert world.frames.of("ann")[:, 1].min() < 4.0, "she went to stand in the way"
    assert place_of(world, "ann") == pytest.approx((7.3, 5.0))


def test_who_paces_stays_where_a_change_sends_them_and_paces_on_after_a_fault() -> None:
    pacing = scene_with(replace(ANN, walk=PACES), BOB)
    stays = played(pacing, [Sent(3.0, "ann", (4.5, 1.0), None, 1.0)], 30.0)
    assert place_of(stays, "ann") == pytest.approx((4.5, 1.0))
    paces = played(pacing, [StandInTheWay(3.0, "ann", 1.0, 1.0, "ann stands in the way")], 40.0)
    track = paces.frames.of("ann")
    assert track[:300, 1].min() < 4.5, "she left her walk"
    assert np.ptp(track[-300:, 0]) > 3.0, "and went on with it"


def test_who_reacts_to_the_robot_comes_back_to_where_a_change_sent_them() -> None:
    curious = scene_with(replace(ANN, reacts="curious"), BOB)
    track = played(curious, [Sent(1.0, "ann", (1.0, 4.5), -1.5, 1.0)], 70.0).frames.of("ann")
    there_m = np.hypot(track[:, 0] - 1.0, track[:, 1] - 4.5)
    arrived = int(there_m.argmin())
    assert there_m[arrived] < 1e-6
    assert there_m[arrived:].max() > 0.5, "she came up to the robot"
    assert there_m[-1] < 0.45


def test_who_turns_away_from_the_robot_does_not_pull_back_who_walks() -> None:
    """A reaction that is under way ends where a walk begins."""
    uneasy = replace(ANN, posture="seated", comfort=Comfort(1.2, 1.5, shows=("turn_away",)))
    scene = scene_with(uneasy)
    alone = played(scene, [], 15.0, visits="ann")
    (shown,) = alone.shown
    for late in range(1, 12):
        world = played(
            scene, [Sent(shown.t + late / 20, "ann", (7.3, 5.0), None, 1.0)], shown.t + 6.0, visits="ann"
        )
        assert longest_stride_m(world.frames, "ann") <= world.step_s + 1e-9
        assert place_of(world, "ann") == pytest.approx((7.3, 5.0))


@sampled(4)
@given(
    seed=st.integers(0, 10_000),
    kind=st.sampled_from([{}, {"reacts": "curious"}, {"comfort": Comfort(1.2, 1.5)}]),
    speed_m_s=SPEEDS,
)
@example(seed=0, kind={}, speed_m_s=1.0)
def test_nobody_who_is_sent_through_passers_by_overlaps_one(seed, kind, speed_m_s) -> None:
    ann, bob = Person("ann", 9.3, 1.1, math.pi, **kind), Person("bob", 3.5, 0.5, 0.0)
    passing = PassersBy(3, between=((1.0, 1.1), (9.0, 1.1)))
    corridor = Scene(Room.rectangle(10.0, 2.2), RobotBody(1.0, 0.5), (ann, bob), passers_by=passing)
    sent = [Sent(0.5, "ann", (2.0, 1.7), 0.0, speed_m_s), Sent(9.0, "ann", (8.0, 0.5), 0.0, speed_m_s)]
    frames = played(corridor, sent, 20.0, seed=seed).frames
    at, radii = frames.poses[:, 1:, 0] + 1j * frames.poses[:, 1:, 1], np.array(frames.radius_m[1:])
    one, other = np.triu_indices(len(radii), 1)
    gaps_m = np.abs(at[:, one] - at[:, other]) - radii[one] - radii[other]
    assert gaps_m.min() > -1e-9
    assert np.ptp(frames.of("ann")[:, 0]) > 1.0, "she gets on"


TWO_CHANGES = """\
schema_version: 1
name: two-changes
place: {width_m: 12, height_m: 6}
robot: {at_m: [1, 3]}
people:
  ann: {at_m: [4, 5], facing_deg: -90}
  bob: {at_m: [1, 5], facing_deg: -90}
goals:
  - greet: bob
  - greet: ann
changes:
  - {at_s: 1, person: ann, moves_to_m: [11, 5], facing_deg: 180}
  - {at_s: 3, person: ann, moves_to_m: [7, 2], facing_deg: 90}
"""


def test_a_scenario_that_changes_its_mind_is_run_as_it_is_written(here) -> None:
    (here / "two.scenario.yaml").write_text(TWO_CHANGES)
    episode = front_door.run("two.scenario.yaml")
    assert episode.outcome == "success"
    assert longest_stride_m(episode.frames, "ann") <= 0.05 + 1e-9
    assert episode.frames.of("ann")[-1].tolist() == pytest.approx([7.0, 2.0, math.pi / 2])
