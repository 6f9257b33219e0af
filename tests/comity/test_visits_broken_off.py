"""A visit that is broken off for somebody else and taken up again is two stretches of time."""

from __future__ import annotations

from pathlib import Path

import comity
from comity.monitoring.measuring import known_of, turns

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
    assert [whom for _, whom in turns(episode.events)] == ["anna", "bob", "anna"]
    (_, until_s, again_s) = (t for t, _ in turns(episode.events))
    known = known_of(
        episode.prepared, episode.visits, episode.events, revisions=episode.revisions, told=episode.told
    )
    anna, bob = (next(visit for visit in known.visits if visit.person == who) for who in ("anna", "bob"))
    assert [(each.start_s, each.end_s) for each in anna.breaks] == [(until_s, again_s)]
    assert not any(until_s <= t < again_s for span in anna.spans for t in (span.start_s, span.end_s))
    assert not bob.breaks
    assert episode.metrics.longest_intrusion_s > 5.0
    assert episode.metrics.compliance_share["anna"] < 1.0
    assert episode.metrics.failures_to_progress == 0
    assert episode.metrics.stalled_s < 1.0
