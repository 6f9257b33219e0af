"""When, and near which person, a minimum or maximum metric of an episode occurred."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity.monitoring.parameter_updates import later_distances_m
from comity.parameters.passing import own_distance_m
from comity.testing.amounts import causes
from comity.testing.amounts.course import MOTIONS
from comity.testing.amounts.happened import walking
from comity.testing.amounts.shaping import told_of
from comity.testing.trials.visits import approached
from comity_domain.problem.bound_parameters import DISTANCE
from comity_executor import Limits
from comity_fis.proxemics import COMFORT_M
from comity_sim2d.metrics import (
    clearances_m,
    intrusion_of,
    own_distances_m,
    seconds_to_collision,
    speeds_m_s,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from comity.episode import Episode
    from comity.scenario import Scenario
    from comity_sim2d import Frames
    from comity_sim2d.metrics.intrusion import Intrusion, IntrusionSpan


_NEAR = (*MOTIONS, "Keep_distance", "Wait_for_way")
"""Actions that determine the robot's position; utterances do not."""


@dataclass(frozen=True, slots=True)
class Moment:
    """A time of an episode, and the person near the robot then."""

    t: float
    """Start [s]."""
    person: str | None = None
    """The person, possibly a passer-by; None if no person is involved."""
    preposition: str = ""
    """Preposition before the person's name: `to`, `with`, `beside`."""

    def __str__(self) -> str:
        whom = f"{self.preposition} {self.person} " if self.person else ""
        return f"{whom}at t={self.t:.2f} s"


def moment_of(frames: Frames, metric: str) -> Moment | None:
    """When and near whom a metric, such as `min_clearance_m`, was extreme; None for other metrics."""
    if metric == "min_clearance_m":
        return _least(frames, clearances_m(frames), "to")
    if metric == "min_centre_distance_m":
        return _least(frames, clearances_m(frames) + np.array(frames.radius_m[1:]) + frames.radius_m[0], "to")
    if metric == "min_time_to_collision_s":
        return _least(frames, seconds_to_collision(frames), "with")
    if metric == "max_speed_m_s":
        return Moment(float(frames.time_s[int(np.argmax(speeds_m_s(frames))) + 1]))
    return None


def of_moment(episode: Episode, moment: Moment) -> Iterator[str]:
    """Why the robot acted as it did then, and the distances preferred by that person and the visited one.

    For the highest speed, which involves no person: what limits speeds.
    """
    if moment.person is None:
        yield from _of_speed(episode, moment)
        return
    yield from of_their_way(episode.prepared.file.scenario, moment.person, moment.t)
    yield from causes.at_time(episode.history, moment.t, _NEAR)
    people = dict.fromkeys((moment.person, *approached(episode.prepared.plan)))
    known = episode.prepared.values
    yield from told_of(known, episode.told, ((name, DISTANCE) for name in people if name in known))


def _of_speed(episode: Episode, moment: Moment) -> Iterator[str]:
    doing = causes.at_time(episode.history, moment.t, _NEAR)
    yield from (line for line in doing if line.startswith(("t=", "again")))
    own_m_s, cruise_m_s = episode.prepared.scene.robot.max_speed_m_s, Limits().cruise_speed_m_s
    whose = "the robot's `max_speed_m_s`" if own_m_s <= cruise_m_s else "as fast as it cruises"
    yield f"limit     on its way at most {min(own_m_s, cruise_m_s):g} m/s, {whose}"
    stops = approached(episode.prepared.plan)
    yield from told_of(episode.prepared.values, episode.told, ((name, "approach_speed") for name in stops))


def of_their_way(scenario: Scenario, person: str | None, until_s: float) -> Iterator[str]:
    """What made a person (or passer-by) walk up to a time; nothing for people who stood."""
    if person in scenario.people and (keys := walking(scenario, person, until_s)):
        yield f"walks     {', '.join(keys)}"


def of_stay(episode: Episode, stay: IntrusionSpan) -> Iterator[str]:
    """Distance of the robot during a stay within a person's preferred distance, and the reasons for both."""
    frames = episode.frames
    during = (frames.time_s >= stay.start_s) & (frames.time_s <= stay.start_s + stay.length_s)
    gaps_m = clearances_m(frames)[during, frames.entities.index(stay.person) - 1]
    values = episode.prepared.values.get(stay.person)
    start_m = COMFORT_M if values is None else own_distance_m(values)
    later = later_distances_m(episode.told).get(stay.person, ())
    own_m = own_distances_m(np.array([stay.start_s]), start_m, later)[0]
    yield f"distance  {gaps_m.min():.3f} m at the nearest, their own {own_m:.3f} m"
    yield from of_their_way(episode.prepared.file.scenario, stay.person, stay.start_s + stay.length_s)
    yield from causes.at_time(episode.history, stay.start_s)
    if values is not None:
        yield from causes.of_parameter(episode, DISTANCE, stay.person, stay.start_s)


def intrusion(episode: Episode) -> Intrusion:
    """Spans in which the robot was within a person's preferred distance without visiting or leaving them."""
    return intrusion_of(episode.frames, episode.known)


def _least(frames: Frames, values: NDArray[np.float64], preposition: str) -> Moment | None:
    """The first frame with the minimum of `values`, shape (n, people); None without people."""
    if not values.size:
        return None
    row, column = np.unravel_index(int(np.argmin(values)), values.shape)
    return Moment(float(frames.time_s[row]), frames.entities[1 + int(column)], preposition)
