"""What is forbidden whoever the person is: held against the frames, not against what the robot believed."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from comity.testing import causes
from comity_sim2d.metrics import clearances_m, speeds_m_s

if TYPE_CHECKING:
    from comity.testing.trial import Trial

NEAREST_M = 0.30
FASTEST_NEAR_M_S, NEAR_M = 0.5, 1.5
"""The project's own limits between bodies and on the speed near people (design choices)."""
_SLACK = 0.02
"""In metres and metres per second: a controller's overshoot, below what anybody would notice (our choice)."""


@dataclass(frozen=True, slots=True)
class Danger:
    """A limit that was passed."""

    limit: str
    got: str
    because: tuple[str, ...]


def dangers(trial: Trial) -> Iterator[Danger]:
    """Contacts, and whoever the robot came too near or near too fast: each at its worst moment."""
    frames, metrics = trial.episode.frames, trial.episode.metrics
    if metrics.touches:
        yield _danger(trial, "no contact", f"{metrics.touches} contacts", 0.0)
    gaps, speeds = clearances_m(frames), speeds_m_s(frames)
    for i, person in enumerate(frames.entities[1:]):
        gap = gaps[:, i]
        worst = int(np.argmin(gap))
        if gap[worst] < NEAREST_M - _SLACK:
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


def _danger(trial: Trial, limit: str, got: str, t: float) -> Danger:
    return Danger(limit, got, tuple(causes.at_time(trial, t)))
