"""Who shuffles their feet while the robot turns to them is docked to anew, and greeted."""

from __future__ import annotations

import math
from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import example, given
from hypothesis import strategies as st
from sampling import sampled

import comity

SCENARIO = """\
schema_version: 1
name: shuffling
place: {{width_m: 6, height_m: 5}}
robot: {{at_m: [1, {y:.2f}], facing_deg: 180, drive: differential}}
people:
  ben: {{at_m: [4, 2.5], facing_deg: 180}}
goals: [{{greet: ben}}]
changes: [{{at_s: {at_s:.2f}, person: ben, moves_to_m: [{to_x:.3f}, {to_y:.3f}], facing_deg: 180}}]
"""


@sampled(6)
@example(at_s=8.14, y=1.01, far_m=0.024, way_rad=-2.27)
@example(at_s=7.63, y=0.88, far_m=0.0156, way_rad=0.0)
@example(at_s=7.43, y=3.34, far_m=0.033, way_rad=0.93)
@given(
    at_s=st.floats(3.0, 12.0),
    y=st.floats(0.8, 4.2),
    far_m=st.floats(0.012, 0.045),
    way_rad=st.floats(-math.pi, math.pi),
)
def test_who_moves_by_centimetres_at_any_moment_is_greeted_soon(
    at_s: float, y: float, far_m: float, way_rad: float
) -> None:
    to = 4.0 + far_m * math.cos(way_rad), 2.5 + far_m * math.sin(way_rad)
    with TemporaryDirectory() as folder:
        path = Path(folder, "shuffling.scenario.yaml")
        path.write_text(SCENARIO.format(y=y, at_s=at_s, to_x=to[0], to_y=to[1]))
        episode = comity.run(str(path))
    # It turned away by 90 degrees to go 4 mm sideways, over and over, until the limit of 300 s; and it was
    # content 16 mm before its goal, which is too far off to be docked, until an attempt's 40 s were over.
    assert episode.outcome == "success"
    assert episode.frames.time_s[-1] < 30.0


UNSEEN = """\
schema_version: 1
name: shuffling unseen
place: {width_m: 6, height_m: 5}
robot: {at_m: [1, 1], facing_deg: 180, drive: differential, sensor: {field_of_view_deg: 60}}
people:
  ben: {at_m: [4, 2.5], facing_deg: 180}
goals: [{greet: ben}]
changes: [{at_s: 8.8, person: ben, moves_to_m: [3.97, 2.552], facing_deg: 180, speed_m_s: 1.0}]
"""


def test_who_shifted_to_the_side_and_nearer_while_it_turned_is_docked_to(tmp_path: Path) -> None:
    path = tmp_path / "unseen.scenario.yaml"
    path.write_text(UNSEEN)
    episode = comity.run(str(path))
    # Content beside its place, and too near to be docked, it stood there until an attempt's 40 s were over.
    assert episode.outcome == "success"
    assert episode.frames.time_s[-1] < 20.0
