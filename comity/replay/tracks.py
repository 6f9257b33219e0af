"""Compact time series: integers in thousandths (such as millimetres), delta-encoded."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_sim2d import Frames


def steps(numbers: Iterable[float]) -> list[int]:
    """The first number, then differences, in thousandths of a unit; one number if all differences are 0."""
    whole = [round(1000 * number) for number in numbers]
    if not any(b - a for a, b in pairwise(whole)):
        return whole[:1]
    return whole[:1] + [b - a for a, b in pairwise(whole)]


def tracks_of(frames: Frames) -> dict[str, object]:
    """Delta-encoded tracks of robot and people: times [ms], x and y [mm], headings [mrad]."""
    return {
        "count": len(frames),
        "t": steps(frames.time_s.tolist()),
        "bodies": [
            {
                "name": name,
                "radius": radius,
                "x": steps(frames.of(name)[:, 0].tolist()),
                "y": steps(frames.of(name)[:, 1].tolist()),
                "heading": steps(frames.of(name)[:, 2].tolist()),
            }
            for name, radius in zip(frames.entities, frames.radius_m, strict=True)
        ],
    }
