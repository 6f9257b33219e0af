"""Group intrusions: the robot enters the space that a group keeps open, without a visit to a member."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.frames import Frames
from comity_sim2d.metrics.intrusion import SLACK_M, Intrusion
from comity_sim2d.scene.o_space import LEFT_M, OSpace, o_space
from comity_sim2d.scene.person import Person


def group_intrusions(frames: Frames, groups: Sequence[Sequence[str]], intrusion: Intrusion) -> int:
    """Number of times the robot entered an o-space.

    A group's o-space is that of the first frame, and exists while all members are within `LEFT_M` of their
    initial places. Only frames count in which the robot neither visits nor leaves a member, as in
    `intrusion`.

    Args:
        frames: Frames of the episode.
        groups: The names of each group's members.
        intrusion: Says when the robot visited or left each person.
    """
    return sum(_entries(_inside(frames, group) & _passes(group, intrusion)) for group in groups)


def _inside(frames: Frames, group: Sequence[str]) -> NDArray[np.bool_]:
    """Frames with the robot's body in the o-space of a group that still stands there, shape (n,)."""
    members = [frames.entities.index(name) for name in group]
    space = _first_space(frames, members)
    moved = frames.poses[:, members, :2] - frames.poses[:1, members, :2]
    stands = (np.hypot(moved[..., 0], moved[..., 1]) <= LEFT_M).all(axis=1)
    reach = space.grown(frames.radius_m[0] - SLACK_M)
    return np.asarray(stands & (reach.depth_m(frames.poses[:, 0, :2]) > 0.0))


def _first_space(frames: Frames, members: Sequence[int]) -> OSpace:
    people = []
    for i in members:
        x_m, y_m, heading_rad = frames.poses[0, i].tolist()
        people.append(Person(frames.entities[i], x_m, y_m, heading_rad, radius_m=frames.radius_m[i]))
    return o_space(people)


def _passes(group: Sequence[str], intrusion: Intrusion) -> NDArray[np.bool_]:
    """Frames in which the robot neither visits nor leaves any member, shape (n,)."""
    columns = [intrusion.people.index(name) for name in group]
    return np.asarray(intrusion.passing[:, columns].all(axis=1))


def _entries(inside: NDArray[np.bool_]) -> int:
    """Number of runs of frames inside."""
    return int(inside[:1].sum() + (inside[1:] & ~inside[:-1]).sum())
