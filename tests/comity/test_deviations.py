"""Whoever was not approached as planned is told why, whatever they do afterwards."""

from __future__ import annotations

import comity

CORRIDOR = """\
schema_version: 1
name: corridor
place: {width_m: 14, height_m: 0.9}
robot: {at_m: [0.6, 0.45], drive: differential}
people:
  cy: {at_m: [7.0, 0.6], facing_deg: 90, comfort: {wants_m: [1.2, 1.5]}}
goals: [{greet: cy}]
"""


def test_the_reason_of_a_deviation_stays_where_the_person_turns_away(tmp_path):
    """They stand across the corridor, with no room before them, and then turn away from the robot."""
    path = tmp_path / "corridor.scenario.yaml"
    path.write_text(CORRIDOR)
    (visit,) = comity.run(str(path)).visits
    assert visit.noticed is not None
    assert visit.noticed.kind == "turn_away"
    assert visit.pose is not None
    assert not visit.pose.pose_free
    assert "is blocked by the room's outer wall" in str(visit.deviation_reason)
