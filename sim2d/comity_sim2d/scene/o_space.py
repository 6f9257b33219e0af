"""The o-space: the space that people in conversation keep open between them, and that no one crosses."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from comity_fis.errors import WrongValueError
from comity_sim2d.kinds import require_each
from comity_sim2d.paths.personal_space import OUTLINE_POINTS, Box, Points, is_beyond, is_beyond_line
from comity_sim2d.pose import XY
from comity_sim2d.scene.person import Person

OPEN = 0.5
"""A group is open if the mean of its members' facing vectors (unit vectors) is longer than this (our choice):
it is 1 for two people side by side, 0.7 for two facing the corner between them, 0 in a circle."""


LEFT_M = 0.5
"""Distance from their original place at which a member has left the group [m] (our choice: a step)."""


@dataclass(frozen=True, slots=True)
class OSpace:
    """A disc between the members of an F-formation (Kendon 1990, "Conducting Interaction", chapter 7)."""

    x_m: float
    y_m: float
    radius_m: float
    members: tuple[str, ...] = ()
    is_closed: bool = False
    """Whether the group leaves no place in front of it for another person."""

    @property
    def words(self) -> str:
        """Its name in a sentence."""
        *others, last = self.members
        return f"the space between {', '.join(others)} and {last}"

    @property
    def xy(self) -> XY:
        """Its centre [m]."""
        return (self.x_m, self.y_m)

    def grown(self, by_m: float) -> OSpace:
        """The disc that the centre of a body of this radius keeps out of."""
        return replace(self, radius_m=self.radius_m + by_m)

    def leaving_out(self, xy: XY, slack_m: float) -> OSpace:
        """The same disc, shrunk until a point is outside it by the slack."""
        return replace(self, radius_m=min(self.radius_m, max(0.0, math.dist(self.xy, xy) - slack_m)))

    def is_beyond(self, box: Box) -> bool:
        """Whether all points in a box are certainly outside."""
        return is_beyond(box, self.xy, self.radius_m)

    def is_beyond_line(self, start: XY, end: XY) -> bool:
        """Whether all points of a straight line are certainly outside."""
        return is_beyond_line(start, end, self.xy, self.radius_m)

    def outline(self) -> Points:
        """A polygon around it."""
        angle = np.linspace(0.0, 2.0 * np.pi, OUTLINE_POINTS, endpoint=False)
        reach = self.radius_m / math.cos(math.pi / OUTLINE_POINTS)
        return np.asarray(np.array(self.xy) + reach * np.stack([np.cos(angle), np.sin(angle)], axis=1))

    def depth_m(self, points: Points) -> NDArray[np.float64]:
        """Depth of each point inside [m], negative outside; shape (n,)."""
        return np.asarray(self.radius_m - np.hypot(points[:, 0] - self.x_m, points[:, 1] - self.y_m))


def o_space(members: Sequence[Person]) -> OSpace:
    """The o-space of people who stand together.

    Its centre is the mean of one point in front of each member, as far ahead as the members stand from their
    own centre; it ends at the nearest body. (In Setti et al. 2015, "F-formation detection", PLoS ONE 10(5),
    each member votes for a point at a fixed stride; a stride that depends on the group's size is our choice.)

    Raises:
        ValueError: For fewer than two people.
    """
    require_each("o-space", "members", members, Person)
    if len(members) < 2:
        got, remedy = f"{len(members)}", "Add the others who stand there."
        raise WrongValueError(expected="members: at least two people", got=got, remedy=remedy)
    # Kendon's o-space is the overlap of the members' transactional segments, the ground in front of each that
    # they look at. Each member votes for a point in front of them (Setti et al. 2015), and the mean of the
    # votes is the centre. With a fixed stride, the votes of a large circle would fall short of its centre and
    # those of a small one beyond it. So the stride is the mean distance of the members from their own centre:
    # in a circle of any size all votes then coincide. The nearest body bounds the disc, so that it never
    # covers a member. The mean of the facing vectors tells shapes apart: in a circle they cancel out, side by
    # side they add up.
    count = len(members)
    middle = (sum(p.x_m for p in members) / count, sum(p.y_m for p in members) / count)
    stride = sum(math.dist(middle, p.xy) for p in members) / count
    votes = [person.pose.ahead(stride) for person in members]
    x, y = sum(vote[0] for vote in votes) / count, sum(vote[1] for vote in votes) / count
    radius = min(math.dist((x, y), person.xy) - person.radius_m for person in members)
    looks = [person.pose.ahead(1.0) for person in members]
    mean = (sum(xy[0] for xy in looks) / count - middle[0], sum(xy[1] for xy in looks) / count - middle[1])
    names = tuple(person.name for person in members)
    return OSpace(x, y, max(radius, 0.0), names, is_closed=math.hypot(*mean) < OPEN)


def those_left(members: Sequence[Person], people: Iterable[Person]) -> list[Person]:
    """The members who have not left a group, at their original poses; see `o_space_of_those_left`."""
    at = {person.name: person.xy for person in people}
    return [one for one in members if one.name in at and math.dist(one.xy, at[one.name]) <= LEFT_M]


def o_space_of_those_left(members: Sequence[Person], people: Iterable[Person]) -> OSpace | None:
    """The o-space of the members who have not left a group; None with fewer than two of them.

    A small step or a turn of the head does not change it; a member who comes back belongs to it again.

    Args:
        members: The members at their original poses.
        people: All people at their current poses; a missing member has left.
    """
    left = those_left(members, people)
    return o_space(left) if len(left) > 1 else None
