"""People on foot from a scenario: a visit among them, again from the same seed, and keys that cannot be."""

from __future__ import annotations

import numpy as np
import pytest

from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_fis import InputError

HALL = """
schema_version: 1
name: hall
place: {{width_m: 8.0, height_m: 6.0}}
robot: {{at_m: [1.0, 1.0]}}
people:
  ines: {{at_m: [6.8, 4.8], facing_deg: 225}}
  omar: {{at_m: [1.5, 4.5], {omar}}}
passers_by: {{{passing}}}
goals: [{{greet: ines}}]
"""
PACING = "walks: {route: [[5.0, 1.5], [1.5, 4.5]], loop: true, pause_s: 2}, reacts: surprised"


def hall(folder, omar: str = PACING, passing: str = "count: 4"):
    file = folder / "hall.scenario.yaml"
    file.write_text(HALL.format(omar=omar, passing=passing))
    return load_scenario(str(file))


def test_somebody_is_greeted_among_people_who_move(tmp_path):
    prepared = prepare(hall(tmp_path))
    one, other = execute(prepared, seed=3), execute(prepared, seed=3)
    assert one.outcome == "success"
    assert one.visits[0].person == "ines"
    assert len(one.frames.entities) == 1 + 2 + 4
    assert one.frames.poses.tobytes() == other.frames.poses.tobytes()
    assert one.trace_sha256 == other.trace_sha256
    assert np.ptp(one.frames.of("omar")[:, :2], axis=0).max() > 0.4


@pytest.mark.parametrize(
    ("omar", "passing", "line", "message"),
    [
        ("walks: {route: [[90.0, 1.5]]}", "count: 1", 8, "points that can be walked to"),
        (
            "walks: {route: [[5, 1], [2, 2]], pause_s: [1]}",
            "count: 1",
            8,
            "2 in all, got 1. Write as many pauses",
        ),
        ("posture: seated, reacts: curious", "count: 1", 8, "somebody who stands"),
        ("reacts: courious", "count: 1", 8, "curious"),
        ("facing_deg: 0", "count: 900", 9, "room"),
        ("facing_deg: 0", "count: 2, between: [[1, 1]]", 9, "two different points"),
    ],
)
def test_what_cannot_be_names_its_line(tmp_path, omar, passing, line, message):
    with pytest.raises(InputError, match=message) as refused:
        prepare(hall(tmp_path, omar, passing))
    assert f":{line}" in str(refused.value)


def test_whether_there_is_room_is_asked_with_the_seed_of_the_run(comity, tmp_path):
    """A run that has no room for its passers-by is refused before anything is written."""
    hall(tmp_path, "facing_deg: 0", "count: 100")
    said = comity("run", str(tmp_path / "hall.scenario.yaml"), "--seed", "1", "--out", str(tmp_path / "run"))
    assert (said.code, said.out) == (2, "")
    assert "hall.scenario.yaml:9: passers_by: expected passers-by for whom there is room" in said.err
    assert not (tmp_path / "run").exists()


CORRIDOR = """
schema_version: 1
name: corridor
place: {{width_m: 8.0, height_m: 1.4}}
robot: {{at_m: [0.8, 0.7], sensor: {{field_of_view_deg: 120}}}}
people:
  ann: {{profile: german_woman, at_m: [7.2, 0.7], facing_deg: 180}}
passers_by: {{count: 2, reacts: {reacts}}}
goals: [{{greet: ann}}]
"""


@pytest.mark.parametrize("reacts", ["surprised", "curious", "threatening"])
def test_a_robot_with_a_narrow_view_waits_for_passers_by_in_a_corridor(tmp_path, reacts):
    """Where they are it knows without looking."""
    file = tmp_path / "corridor.scenario.yaml"
    file.write_text(CORRIDOR.format(reacts=reacts))
    episode = execute(prepare(load_scenario(str(file))), seed=0)
    assert episode.outcome in ("success", "failed")
    assert episode.metrics.person_contacts == 0


STUDY = """
schema_version: 1
name: pacer
place: {{map: apartment}}
robot: {{at: front door}}
people:
  guest:
    at_m: [7.0, 5.0]
    facing_deg: -90
    walks: {{route: [[7.4, 7.6], [7.0, 5.0]], loop: true, speed_m_s: {speed}, stops: {stops}}}
faults: [{{fault: door closes, at_s: {shut_s}, door: study, for_s: {for_s}}}]
goals: [{{greet: guest}}]
"""


@pytest.mark.parametrize(
    ("speed", "stops", "shut_s", "for_s"), [(0.4, "false", 0, 8), (0.4, "true", 1, 30), (1.0, "true", 3, 8)]
)
def test_who_paces_behind_a_door_that_shuts_and_opens_is_met_or_declines(
    tmp_path, speed, stops, shut_s, for_s
):
    """In a room so narrow that nobody gets past them: the robot waits before it until they turn round."""
    file = tmp_path / "pacer.scenario.yaml"
    file.write_text(STUDY.format(speed=speed, stops=stops, shut_s=shut_s, for_s=for_s))
    ran = execute(prepare(load_scenario(str(file))), seed=0)
    assert [turn.is_open for turn in ran.door_turns] == [False, True]
    assert ran.visits[0].outcome in ("greeted", "declined")
    assert ran.metrics.touches == 0


WEDGED = """\
schema_version: 1
name: wedged
place: {width_m: 7.86, height_m: 7.32, furniture: [{name: box, box_m: [5.19, 2.88, 0.67, 1.1]}]}
robot:
  at_m: [6.78, 3.08]
  facing_deg: -95
  drive: differential
  sensor: {range_m: 3.47, hidden_by_walls: true}
people:
  ada:
    profile: japanese_woman
    at_m: [2.16, 5.88]
    facing_deg: -80
    walks: {route: [[0.93, 3.83], [1.0, 0.47]], loop: true, speed_m_s: 1.12, pause_s: 3}
  ben:
    profile: german_man
    at_m: [3.11, 4.96]
    facing_deg: 174
    walks: {route: [[4.6, 2.88], [3.48, 6.94]], loop: true, speed_m_s: 0.33, stops: true}
passers_by: {count: 3, reacts: impassive}
goals: [{greet: ada}, {greet: ben}]
limits: {time_s: 60}
"""


def test_passers_by_who_are_wedged_beside_the_robot_do_not_hold_it_up_for_good(tmp_path):
    """Two of them stand between it and the box; the rest of the hall is free."""
    file = tmp_path / "wedged.scenario.yaml"
    file.write_text(WEDGED)
    episode = execute(prepare(load_scenario(str(file)), seed=60), seed=60)
    assert episode.metrics.path_length_m > 2.0
    assert episode.metrics.person_contacts == 0
