"""What is forbidden whoever the person is: held against the frames, not against what the robot believed.

Of nearness only what the robot brings about: who walks up to a robot that stands is not in its hands.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity.testing.metrics import causes
from comity_sim2d.metrics import clearances_m, speeds_m_s

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from comity.testing.trials.trial import Trial
    from comity_sim2d import Frames

NEAREST_M = 0.30
FASTEST_NEAR_M_S, NEAR_M = 0.5, 1.5
"""The project's own limits between bodies and on the speed near people (design choices)."""
_SLACK = 0.02
"""In metres and metres per second: a controller's overshoot, below what anybody would notice (our choice)."""
COMING_M_S = 0.02
"""The robot comes nearer where it moves towards somebody faster than this: slower is rest (our choice)."""


@dataclass(frozen=True, slots=True)
class Danger:
    """A limit that was passed."""

    limit: str
    got: str
    because: tuple[str, ...]


def dangers(trial: Trial) -> Iterator[Danger]:
    """Contacts, and whoever the robot came too near or near too fast: each at its worst moment."""
    frames, metrics = trial.episode.frames, trial.episode.metrics
    if things := (metrics.wall_contacts or 0) + (metrics.furniture_contacts or 0):
        yield _danger(trial, "no contact", f"{things} contacts with walls and furniture", 0.0)
    gaps, speeds, coming = clearances_m(frames), speeds_m_s(frames), coming_m_s(frames)
    for i, person in enumerate(frames.entities[1:]):
        gap = gaps[:, i]
        brought = np.where(coming[:, i] > COMING_M_S, gap[1:], np.inf)
        worst = int(np.argmin(brought)) + 1
        if brought[worst - 1] < NEAREST_M - _SLACK:
            t = float(frames.time_s[worst])
            yield _danger(trial, f"{NEAREST_M:g} m from {person}", f"{gap[worst]:.3f} m at t={t:.2f} s", t)
        near = np.where(np.minimum(gap[1:], gap[:-1]) < NEAR_M, speeds, 0.0)
        fastest = int(np.argmax(near))
        if near[fastest] > FASTEST_NEAR_M_S + _SLACK:
            t = float(frames.time_s[fastest])
            yield _danger(
                trial,
                f"at most {FASTEST_NEAR_M_S:g} m/s within {NEAR_M:g} m of {person}",
                f"{near[fastest]:.2f} m/s at t={t:.2f} s",
                t,
            )


def coming_m_s(frames: Frames) -> NDArray[np.float64]:
    """How fast the robot itself moved towards each person, wherever they went.

    Returns:
        An array (frames - 1, people) [m/s]: from a frame to the next, negative where it moved away.
    """
    places = frames.poses[:, :, :2]
    way = places[1:, :1] - places[:-1, :1]
    towards = places[:-1, 1:] - places[:-1, :1]
    apart = np.linalg.norm(towards, axis=2)
    seconds = np.diff(frames.time_s)[:, None]
    return np.asarray(
        np.einsum("tpc,tpc->tp", np.broadcast_to(way, towards.shape), towards) / (apart * seconds)
    )


def _danger(trial: Trial, limit: str, got: str, t: float) -> Danger:
    return Danger(limit, got, tuple(causes.at_time(trial, t)))
