"""Safety limits that hold for every person, checked against the frames, not the robot's beliefs.

Only nearness caused by the robot counts. A person may walk up to a robot that stands, or to one that drives
as long as it brakes for them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING

import numpy as np

from comity.testing.amounts import causes
from comity.testing.amounts.touching import THINGS, before_bump, bumps
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_fis.validation.complaint import counted
from comity_sim2d.base.drive import NEAR_PEOPLE_M, NEAR_PEOPLE_M_S, SPEED_SHARE
from comity_sim2d.base.smoothing import acceleration_within
from comity_sim2d.metrics import clearances_m, speeds_m_s

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from comity.episode import Episode
    from comity_executor import History
    from comity_sim2d import Frames, RobotBody

_SLACK = 0.02
"""Tolerance [m] and [m/s]: a controller's overshoot, below what people notice (our choice)."""
COMING_M_S = 0.02
"""Minimum speed towards a person that counts as approaching [m/s]; slower motion counts as rest (our
choice)."""
TAKES_IN_S = 0.15
"""Reaction time to perceive a person, decide and act [s]: one tick each at 20 Hz."""


@dataclass(frozen=True, slots=True)
class Danger:
    """A violated limit."""

    limit: str
    got: str
    because: tuple[str, ...]


def dangers(episode: Episode) -> Iterator[Danger]:
    """Contacts, and people whom the robot came too near or approached too fast: the worst moment of each."""
    frames, metrics, history = episode.frames, episode.metrics, episode.history
    if things := (metrics.wall_contacts or 0) + (metrics.furniture_contacts or 0):
        got = f"{counted(things, 'contact')} with walls and furniture"
        because: tuple[str, ...] = ()
        for t, into in islice(bumps(frames.entities[1:], episode.events, THINGS), 1):
            got, because = f"{got}, at t={t:.2f} s it bumped into {into}", tuple(before_bump(history, t))
        yield Danger("no contact", got, because)
    gaps, speeds = clearances_m(frames), speeds_m_s(frames)
    coming, come = coming_m_s(frames), _they_come_m_s(frames)
    for i, person in enumerate(frames.entities[1:]):
        gap = gaps[:, i]
        least_m = _least_m(episode, person)
        spare = np.where(coming[:, i] > COMING_M_S, gap[1:] - least_m[1:], np.inf)
        worst = int(np.argmin(spare)) + 1
        if spare[worst - 1] < -_SLACK:
            t, limit = float(frames.time_s[worst]), f"{least_m[worst]:g} m from {person}"
            yield _danger(history, limit, f"{gap[worst]:.3f} m at t={t:.2f} s", t)
        near = np.minimum(gap[1:], gap[:-1]) < NEAR_PEOPLE_M
        begun = near & ~np.concatenate(([False], near[:-1])) & (come[:, i] > COMING_M_S)
        most = _most_m_s(frames.time_s, speeds, begun, episode.prepared.scene.robot)
        over = np.where(near, speeds - most, -np.inf)
        worst = int(np.argmax(np.where(over > _SLACK, speeds, -np.inf)))
        if over[worst] > _SLACK:
            t = float(frames.time_s[worst])
            yield _danger(
                history,
                f"at most {NEAR_PEOPLE_M_S:g} m/s within {NEAR_PEOPLE_M:g} m of {person}",
                f"{speeds[worst]:.2f} m/s at t={t:.2f} s",
                t,
            )


def _least_m(episode: Episode, person: str) -> NDArray[np.float64]:
    """Minimum distance to a person at each frame [m], shape (n,): smaller while they let the robot pass."""
    time_s = episode.frames.time_s
    least_m = np.full(len(time_s), PERSON_MARGIN_M)
    for one in episode.disturbances:
        end_s = one.t if one.end_s is None else one.end_s
        if one.kind == "passage" and one.about == person and end_s > one.t:
            passes = (time_s >= one.t) & (time_s <= end_s)
            least_m[passes] = episode.prepared.scene.robot.margin_m
    return least_m


def coming_m_s(frames: Frames) -> NDArray[np.float64]:
    """Speed of the robot towards each person, without the person's own motion.

    Returns:
        An array (frames - 1, people) [m/s], from each frame to the next; negative when moving away.
    """
    places = frames.poses[:, :, :2]
    return _towards_m_s(frames, places[1:, :1] - places[:-1, :1], places[:-1, 1:] - places[:-1, :1])


def _they_come_m_s(frames: Frames) -> NDArray[np.float64]:
    """Speed of each person towards the robot [m/s], shape (frames - 1, people)."""
    places = frames.poses[:, :, :2]
    return _towards_m_s(frames, places[1:, 1:] - places[:-1, 1:], places[:-1, :1] - places[:-1, 1:])


def _towards_m_s(
    frames: Frames, way: NDArray[np.float64], towards: NDArray[np.float64]
) -> NDArray[np.float64]:
    apart, seconds = np.linalg.norm(towards, axis=2), np.diff(frames.time_s)[:, None]
    along = np.einsum("tpc,tpc->tp", np.broadcast_to(way, towards.shape), towards)
    return np.asarray(along / (apart * seconds))


def _most_m_s(
    time_s: NDArray[np.float64], speeds: NDArray[np.float64], begun: NDArray[np.bool_], body: RobotBody
) -> NDArray[np.float64]:
    """Maximum speed near a person between frames [m/s]; higher for a while after they approached.

    If a person walks to within `NEAR_PEOPLE_M` of the robot, it brakes normally from its present speed.

    Args:
        time_s: Times of the frames [s], shape (n,).
        speeds: Speeds of the robot from each frame to the next [m/s], shape (n - 1,).
        begun: Whether the person came that near by their own motion then; shape (n - 1,).
        body: The robot's body.
    """
    most = np.full(len(speeds), NEAR_PEOPLE_M_S)
    braking = SPEED_SHARE * acceleration_within(body.max_acceleration_m_s2, body.max_jerk_m_s3)
    late_s = TAKES_IN_S + body.sensor.delay_s + 2.0 * body.max_acceleration_m_s2 / body.max_jerk_m_s3
    for first in np.flatnonzero(begun).tolist():
        after_s = time_s[first:-1] - time_s[first]
        braked = speeds[first] - braking * np.maximum(after_s - late_s, 0.0)
        most[first:] = np.maximum(NEAR_PEOPLE_M_S, braked)
    return most


def _danger(history: History, limit: str, got: str, t: float) -> Danger:
    return Danger(limit, got, tuple(causes.at_time(history, t)))
