"""However soft the base, the last frames of a run show the robot at rest."""

from __future__ import annotations

import numpy as np
import pytest

import comity

SCENARIO = """\
schema_version: 1
name: soft
place: {{width_m: 30.0, height_m: 6.0}}
robot: {{at_m: [1.0, 3.0], drive: {drive}, max_acceleration_m_s2: 0.15, max_jerk_m_s3: 0.1}}
people:
  far: {{at_m: [28.0, 3.0], facing_deg: 180}}
goals: [{{greet: far}}]
limits: {{time_s: {stop_s}}}
"""


@pytest.mark.parametrize("drive", ["omnidirectional", "differential"])
@pytest.mark.parametrize("stop_s", [10.0, 20.0])
def test_a_soft_base_that_is_stopped_in_the_middle_has_come_to_rest_in_the_end(tmp_path, drive, stop_s):
    """It rolled on for longer than the 5 s after which the run ended."""
    path = tmp_path / "soft.scenario.yaml"
    path.write_text(SCENARIO.format(drive=drive, stop_s=stop_s))
    frames = comity.run(str(path)).frames
    steps = np.diff(frames.poses[-10:, 0, :2], axis=0)
    assert np.hypot(*steps.T).max() * 20.0 <= 0.01
