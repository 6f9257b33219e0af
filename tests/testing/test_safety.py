"""Of speed near people, only what the robot brings about is a danger: who walks up to it is braked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from comity.episode import Episode
from comity.testing.amounts.causes import TICK_S
from comity.testing.amounts.quantity import quantities
from comity.testing.collection.cases import claims_in
from comity.testing.measuring.safety import dangers
from comity.testing.trials.attempt import attempted
from comity.testing.trials.case import Case
from comity_executor import Cause

Numbers = NDArray[np.float64]
HALL = """\
schema_version: 1
name: hall
place: {{width_m: 10, height_m: 6}}
robot: {{at_m: [1, 3], max_speed_m_s: 1.2, drive: {drive}, max_acceleration_m_s2: {acceleration}}}
people:
  ben: {{at_m: [9, 3], facing_deg: 180}}
  ada: {{at_m: [{x:.2f}, {y:.2f}], walks: {{route: [[{to_x:.2f}, {to_y:.2f}]], speed_m_s: 1.4}}}}
goals: [{{greet: ben}}]
"""
FROM = st.tuples(st.floats(5.5, 9.4), st.sampled_from([0.6, 1.5, 4.5, 5.4]))
TO = st.tuples(st.floats(0.6, 8.0), st.floats(0.6, 5.4))


def trial(**words: float | str) -> Episode:
    with TemporaryDirectory() as folder:
        path = Path(folder, "hall.scenario.yaml")
        path.write_text(HALL.format(**words))
        (claim,) = claims_in(path)
        assert isinstance(claim.case, Case)
        return attempted(claim.case)


@settings(max_examples=15, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@example((8.8, 4.0), (1.0, 3.8), "omnidirectional", 0.5)
@given(FROM, TO, st.sampled_from(["omnidirectional", "differential"]), st.sampled_from([0.3, 0.5, 1.0]))
def test_a_robot_that_brakes_for_whoever_walks_up_to_it_is_no_danger(
    at: tuple[float, float], to: tuple[float, float], drive: str, acceleration: float
) -> None:
    happened = trial(x=at[0], y=at[1], to_x=to[0], to_y=to[1], drive=drive, acceleration=acceleration)
    assert [danger.limit for danger in dangers(happened) if "m/s" in danger.limit] == []


def shifted(happened: Episode, person: str, way: Callable[[Numbers], Numbers]) -> Episode:
    """The same with somebody somewhere else at each time [s]."""
    frames = happened.frames
    poses = frames.poses.copy()
    poses[:, frames.entities.index(person), :2] = way(frames.time_s)
    return replace(happened, frames=replace(frames, poses=poses))


@pytest.mark.parametrize("walks", [True, False])
def test_a_robot_that_does_not_brake_is_one_whether_or_not_somebody_walks_up_to_it(walks: bool) -> None:
    """Planted beside its way, where it drives at full speed: somebody whom it did not know of."""
    happened = trial(x=9.4, y=0.6, to_x=9.4, to_y=0.7, drive="omnidirectional", acceleration=0.5)
    assert list(dangers(happened)) == []

    def way(time_s: Numbers) -> Numbers:
        """Past the robot from ahead, or standing, 1 m beside its line."""
        x = 9.0 - 1.0 * time_s if walks else np.full_like(time_s, 4.5)
        return np.column_stack([x, np.full_like(time_s, 4.45)])

    limits = [danger.limit for danger in dangers(shifted(happened, "ada", way))]
    assert limits == ["at most 0.5 m/s within 1.5 m of ada"]


def test_a_bump_into_a_thing_is_told_with_what_it_was_and_when() -> None:
    """Planted in the trace; a bump into a person is told by how near the robot came to them."""
    episode = trial(x=9.4, y=0.6, to_x=9.4, to_y=0.7, drive="omnidirectional", acceleration=0.5)
    person, wall = (Cause("reading", f"bumped into {what}", None) for what in ("ada", "wall 1"))
    events = (
        *episode.events[:-2],
        replace(episode.events[-2], because=(person,)),
        replace(episode.events[-1], because=(wall,)),
    )
    bumped = replace(episode, events=events, metrics=replace(episode.metrics, wall_contacts=1))
    (danger,) = dangers(bumped)
    t = f"t={episode.events[-1].t:.2f} s"
    assert (danger.limit, danger.got) == (
        "no contact",
        f"1 contact with walls and furniture, at {t} it bumped into wall 1",
    )
    assert danger.because[0].startswith(f"t={episode.events[-1].t - TICK_S:.2f} s")
    for metric, told in (("wall_contacts", ["wall 1"]), ("touches", ["ada", "wall 1"])):
        (figure,) = quantities(bumped, metric, None)
        touched = [line.split()[1:] for line in figure.because() if line.startswith("touched")]
        assert [" ".join(words).partition(" at t=")[0] for words in touched] == told
