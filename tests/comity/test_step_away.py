"""The step back after a farewell ends, whoever stands behind the robot: the next visit is not held up."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

from hypothesis import HealthCheck, example, given
from hypothesis import strategies as st
from sampling import sampled

import comity
from comity.episode import Episode
from comity_executor import Limits

LEAVE = """\
schema_version: 1
name: leave
place: {{width_m: 8, height_m: 5}}
robot: {{at_m: [4.6, 1.0], drive: {drive}, sensor: {{field_of_view_deg: {view_deg}}}}}
people:
  ben: {{profile: german_man, at_m: [2, 3], facing_deg: 0}}
  anna: {{at_m: [{x:.2f}, {y:.2f}], facing_deg: 180}}
goals: [{{greet: ben}}, {{take_leave: ben}}]
"""


def run(**words: object) -> Episode:
    with TemporaryDirectory() as folder:
        path = Path(folder, "leave.scenario.yaml")
        path.write_text(LEAVE.format(**words))
        return comity.run(str(path))


def step_away_s(episode: Episode) -> list[float]:
    begun = {
        event.path: event.t
        for event in episode.events
        if event.node == "Step_away(ben)" and event.status == "running"
    }
    ends = [event for event in episode.events if event.path in begun and event.status != "running"]
    return [event.t - begun[event.path] for event in ends]


@sampled(4, suppress_health_check=[HealthCheck.too_slow])
@example(4.35, 3.0, "omnidirectional", 360)  # it stood there for 291 s
@given(
    st.floats(4.2, 4.8),
    st.floats(2.5, 3.5),
    st.sampled_from(["omnidirectional", "differential"]),
    st.sampled_from([60, 360]),
)
def test_it_ends_whoever_stands_behind_the_robot(x: float, y: float, drive: str, view_deg: int) -> None:
    episode = run(x=x, y=y, drive=drive, view_deg=view_deg)
    assert episode.outcome == "success"
    assert 0.0 < max(step_away_s(episode)) <= Limits().act_timeout_s + 0.05


def test_whoever_keeps_it_from_stepping_back_is_named() -> None:
    episode = run(x=4.35, y=3.0, drive="omnidirectional", view_deg=360)
    (end,) = [
        event for event in episode.events if event.node == "Step_away(ben)" and event.status == "success"
    ]
    assert "no room to step away: anna is in the way" in [cause.text for cause in end.because]
