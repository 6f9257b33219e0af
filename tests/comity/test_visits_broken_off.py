"""A visit that is broken off for somebody else and taken up again is two stretches of time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import comity
from comity.monitoring.measuring import stretches

HALL = """\
schema_version: 1
name: hall
place: {width_m: 10, height_m: 6}
robot: {at_m: [1, 3]}
people:
  anna: {profile: german_man, at_m: [5, 5], facing_deg: -90}
  bob: {profile: arab_woman, at_m: [8, 1.5], facing_deg: 180}
goals:
  - greet: anna
  - greet: bob
  - {wait_s: 5, with: bob}
changes:
  - {at_s: 2, person: anna, moves_to_m: [7.4, 2.9], facing_deg: 30}
"""


def test_what_happens_while_somebody_else_is_visited_counts_as_that(tmp_path: Path):
    """She moves away, he is nearer now, and from where the robot stands with him it is too near to her."""
    file = tmp_path / "hall.scenario.yaml"
    file.write_text(HALL)
    episode = comity.run(str(file))
    assert [whom for whom, _ in stretches(episode.events)] == ["anna", "bob", "anna"]
    with_bob = stretches(episode.events)[1][1]
    known = episode.known
    anna, bob = (next(visit for visit in known.visits if visit.person == who) for who in ("anna", "bob"))
    assert anna.breaks == (with_bob,)
    assert [with_bob.start_s > span.end_s or with_bob.end_s <= span.start_s for span in anna.spans] == [
        True
    ] * 2
    assert not bob.breaks
    so_far = [event for event in episode.events if event.t < with_bob.end_s]
    assert stretches(so_far)[-1] == ("bob", replace(with_bob, end_s=so_far[-1].t)), "as far as it is known"
    assert episode.metrics.longest_intrusion_s > 5.0
    assert episode.metrics.compliance_share["anna"] < 1.0
    assert episode.metrics.failures_to_progress == 0
    assert episode.metrics.stalled_s < 1.0
