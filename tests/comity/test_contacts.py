"""What the robot touched is counted for what it is."""

from __future__ import annotations

from dataclasses import replace

import pytest

import comity
from comity.monitoring.measuring import contacts
from comity.preparation import prepare
from comity.recording import record
from comity.report.episodes.facing import facing_error_deg
from comity.report.episodes.run import summary
from comity.scenario import load_scenario
from comity_sim2d import Contacts, Furniture, PassersBy, Person, RobotBody, Room, Scene, Touch, Wall

SCENE = Scene(
    Room.rectangle(8.0, 6.0),
    RobotBody(1.0, 1.0, 0.0),
    people=(Person("ada", 6.0, 3.0, 0.0),),
    walls=(Wall((3.0, 0.0), (3.0, 2.0)),),
    furniture=(Furniture.box("box", 5.0, 5.0, width_m=0.5, depth_m=0.5),),
    passers_by=PassersBy(1),
)


def test_a_bump_into_a_passer_by_is_one_with_a_person():
    """They are people of the frames, and not of the scene."""
    people = ("ada", "passer-by 1")
    touched = ("passer-by 1", "ada", "passer-by 1", "wall 1", "box", "room")
    found = contacts(SCENE, people, [Touch(float(t), entity) for t, entity in enumerate(touched)])
    assert found == Contacts(3, 2, 1)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    prepared = prepare(load_scenario("johanna"))
    return record(prepared, seed=0, out=tmp_path_factory.mktemp("run") / "run", views=())


@pytest.mark.parametrize(
    ("counts", "told"),
    [
        ({}, None),
        ({"person_contacts": 1.0}, "touched people once:"),
        ({"person_contacts": 2.0, "furniture_contacts": 3.0}, "touched people twice and furniture 3 times:"),
        ({"wall_contacts": 1.0}, "touched walls or doors once:"),
    ],
)
def test_a_contact_is_told_where_a_run_is_summed_up(recorded, counts, told):
    answer = replace(recorded.answer, metrics={**recorded.answer.metrics, **counts})
    lines = [line for line in summary(answer, recorded.episode) if isinstance(line, str)]
    touched = [line for line in lines if "touched" in line]
    assert len(touched) == (told is not None)
    assert not told or told in touched[0]


def test_the_facing_that_a_run_tells_is_that_at_rest():
    """The robot has docked to within 5 degrees, and turns on."""
    episode = comity.run("comity-bench-1/ward-round")
    account = {visit.person: visit for visit in episode.visits}
    for person, stop in episode.metrics.stopping.items():
        if stop.robot_facing_error_deg is not None:
            assert facing_error_deg(account[person], stop) == stop.robot_facing_error_deg
    assert any(stop.robot_facing_error_deg is not None for stop in episode.metrics.stopping.values())
