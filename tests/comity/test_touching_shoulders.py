"""People who stand so close that noise has them in one place keep no plan from being made."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import load_scenario

PAIRS = """\
schema_version: 1
name: pairs
place: {width_m: 9, height_m: 6}
robot: {at_m: [1, 3], sensor: {noise_m: 0.03, delay_s: 0.1}}
people:
  ann: {profile: german_woman, at_m: [7, 3], facing_deg: 180}
  cat: {at_m: [4.0, 5.3], facing_deg: 0}
  dan: {at_m: [4.405, 5.3], facing_deg: 180}
  eve: {at_m: [4.0, 0.21], facing_deg: 0}
  fay: {at_m: [4.405, 0.21], facing_deg: 180}
  gil: {at_m: [8.0, 0.7], facing_deg: 0}
  hal: {at_m: [8.405, 0.7], facing_deg: 180}
goals: [{greet: ann}]
faults: [{at_s: 1, fault: wheel stuck, for_s: 12}]
"""


@pytest.mark.parametrize("seed", range(6))
def test_a_robot_that_was_stuck_plans_anew_past_people_whom_noise_has_overlap(tmp_path: Path, seed) -> None:
    path = tmp_path / "pairs.scenario.yaml"
    path.write_text(PAIRS)
    episode = execute(prepare(load_scenario(str(path))), seed=seed)
    assert episode.outcome == "success"
    assert episode.frames.time_s[-1] < 30.0
    reasons = [cause.text for event in episode.events for cause in event.because]
    assert not any("overlap" in reason or "expected" in reason for reason in reasons)
