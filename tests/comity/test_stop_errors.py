"""A run that docked says how exactly it stopped, however noisy its sensors are."""

from __future__ import annotations

from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

import comity

VISIT = """
schema_version: 1
name: visit
place: {{width_m: 6.0, height_m: 4.5}}
robot: {{at_m: [0.8, 0.9], sensor: {{noise_m: {noise_m}, delay_s: {delay_s}}}}}
people:
  guest: {{at_m: [4.6, 3.2], facing_deg: 205}}
goals:
  - greet: guest
"""


@settings(max_examples=15)
@given(noise_m=st.floats(0.0, 0.05), delay_s=st.sampled_from([0.0, 0.1, 0.2]), seed=st.integers(0, 99))
def test_a_run_that_docked_has_its_stop_errors(
    noise_m: float, delay_s: float, seed: int, tmp_path_factory
) -> None:
    path: Path = tmp_path_factory.mktemp("noise") / "visit.scenario.yaml"
    path.write_text(VISIT.format(noise_m=round(noise_m, 3), delay_s=delay_s), encoding="utf-8")
    episode = comity.run(path, seed=seed)
    docked = {visit.person for visit in episode.visits if visit.docked_s is not None}
    stops = episode.metrics.stopping
    assert {person for person in stops if stops[person].stop_distance_error_m is not None} == docked
    assert all(abs(stops[person].stop_distance_error_m or 0.0) < 0.1 for person in docked)
