"""Personal space: the space that a passing robot leaves to a person, and the cost of entering it.

The space reaches the person's own distance to the sides and the rear, and 1.5 times as far to the front: half
an ellipse in front and half a circle behind, as in Kirby's personal space ("Social Robot Navigation", PhD
thesis, Carnegie Mellon University, 2010, CMU-RI-TR-10-13). Like every distance here it is measured between
the nearest points of the two bodies.

The cost function is our own. A person who is passed at a gap loses the share 1 - gap / own of their own
distance, and a straight path past them costs own * share ** 2. Between two people the sum is smallest if both
lose the same share, so the person with the larger own distance keeps more. A bell-shaped cost does the
opposite in narrow passages: deep inside a large space it is flat, and the path yields to the smaller one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.pose import XY

Points = NDArray[np.float64]
"""Points in rows, shape (n, 2) [m]."""
Box = tuple[float, float, float, float]
"""The lowest x and y and the highest x and y [m]."""
FRONT = 1.5
"""Reach of the space to the front, in own distances; to the sides and the rear it is 1."""
OUTLINE_POINTS = 96


def bounding_box(points: Points) -> Box:
    """The axis-aligned bounding box of some points."""
    (x, y), (far_x, far_y) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return x, y, far_x, far_y


def is_beyond(box: Box, centre: XY, radius_m: float) -> bool:
    """Whether a box is farther than a radius from a centre, along an axis."""
    x, y, far_x, far_y = box
    return not (
        x - radius_m <= centre[0] <= far_x + radius_m and y - radius_m <= centre[1] <= far_y + radius_m
    )


def is_beyond_line(start: XY, end: XY, centre: XY, radius_m: float) -> bool:
    """Whether a straight line is farther than a radius from a centre."""
    (x, y), (far_x, far_y), (cx, cy) = start, end, centre
    along_x, along_y = far_x - x, far_y - y
    square = along_x * along_x + along_y * along_y
    share = ((cx - x) * along_x + (cy - y) * along_y) / square if square > 0.0 else 0.0
    share = min(max(share, 0.0), 1.0)
    return math.hypot(x + share * along_x - cx, y + share * along_y - cy) > radius_m


@dataclass(frozen=True, slots=True)
class PersonalSpace:
    """One person's space, as it applies to the centre of a robot."""

    x_m: float
    y_m: float
    heading_rad: float
    contact_m: float
    """Distance between the centres when the bodies touch [m]."""
    own_m: float
    """The person's own distance, between the surfaces [m]."""
    floor_m: float
    """Minimum distance between the centres, which the robot keeps at any cost [m]."""
    front: float = FRONT

    @property
    def xy(self) -> XY:
        """Position of the person [m]."""
        return (self.x_m, self.y_m)

    def discomfort(self, points: Points) -> NDArray[np.float64]:
        """Cost per metre of path at each point, 0 at the edge and beyond; shape (n,).

        At a centre distance r, in a circular space of radius R, the cost is such that it adds up to own * (1
        - gap / own) ** 2 along every straight line at that gap (inverse Abel transform): 2 / (pi * own) * (R
        * acosh(R / r) - sqrt(R ** 2 - r ** 2)). To the front, R is the longer reach.
        """
        cost = np.zeros(len(points))
        dx, dy = points[:, 0] - self.x_m, points[:, 1] - self.y_m
        square = dx * dx + dy * dy
        near = np.flatnonzero(square < (self.contact_m + self._longest_m) ** 2)
        if self.own_m > 0.0 and len(near):  # as most points are near no person
            distance = np.sqrt(np.maximum(square[near], self.contact_m**2))  # overlaps cost what contacts do
            ahead = math.cos(self.heading_rad) * dx[near] + math.sin(self.heading_rad) * dy[near]
            reach = self.contact_m + self._own(ahead / distance)
            ratio = np.maximum(reach / distance, 1.0)
            root = np.sqrt(ratio * ratio - 1.0)
            cost[near] = 2.0 / (np.pi * self.own_m) * (reach * np.log(ratio + root) - distance * root)
        return cost

    def depth_m(self, points: Points) -> NDArray[np.float64]:
        """Depth of each point inside the edge [m], negative outside; shape (n,)."""
        distance, own = self._polar(points)
        return np.asarray(np.maximum(self.contact_m + own, self.floor_m) - distance)

    def is_beyond(self, box: Box) -> bool:
        """Whether all points in a box are certainly outside: quicker than `depth_m`."""
        return is_beyond(box, self.xy, self._reach_m)

    def is_beyond_line(self, start: XY, end: XY) -> bool:
        """Whether all points of a straight line are certainly outside: quicker than `depth_m`."""
        return is_beyond_line(start, end, self.xy, self._reach_m)

    def outline(self) -> Points:
        """The edge as a polygon around the person."""
        angle = np.linspace(0.0, 2.0 * np.pi, OUTLINE_POINTS, endpoint=False)
        unit = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        edge = np.maximum(self.contact_m + self._own(np.cos(angle - self.heading_rad)), self.floor_m)
        return np.asarray(np.array(self.xy) + unit * edge[:, None])

    def leaving_out(self, xy: XY, slack_m: float, *, least_m: float) -> PersonalSpace:
        """The space shrunk until a point is outside it by the slack, but not below a minimum floor."""
        distance = math.dist(self.xy, xy)
        if distance - slack_m >= self._reach_m:
            return self  # as nearly all people are
        own = self._own_towards(xy)
        if max(self.contact_m + own, self.floor_m) <= distance - slack_m:
            return self
        share = max(0.0, distance - slack_m - self.contact_m) / max(own, 1e-6)
        floor = min(self.floor_m, max(distance - slack_m, least_m))
        return replace(self, own_m=self.own_m * min(share, 1.0), floor_m=floor)

    def without_comfort(self) -> PersonalSpace:
        """The minimum distance alone, equal in all directions: the person's heading has no effect."""
        return replace(self, own_m=0.0, heading_rad=0.0, front=1.0)

    @property
    def _reach_m(self) -> float:
        """Radius around the centre that contains the space [m]."""
        return max(self.contact_m + self._longest_m, self.floor_m)

    @property
    def _longest_m(self) -> float:
        """The own distance in its longest direction [m]."""
        return self.own_m * max(1.0, self.front)

    def _polar(self, points: Points) -> tuple[NDArray[np.float64], NDArray[np.float64] | float]:
        """Distance of each point from the person's centre, and their own distance in that direction [m]."""
        dx, dy = points[:, 0] - self.x_m, points[:, 1] - self.y_m
        if self.front == 1.0:
            return np.hypot(dx, dy), self.own_m  # the same all around
        return np.hypot(dx, dy), self._own(np.cos(np.arctan2(dy, dx) - self.heading_rad))

    def _own_towards(self, xy: XY) -> float:
        """The own distance towards one point: `_own` for a single point, ten times faster."""
        along = max(math.cos(math.atan2(xy[1] - self.y_m, xy[0] - self.x_m) - self.heading_rad), 0.0)
        return self.own_m / math.sqrt(1.0 - (1.0 - self.front**-2) * along**2)

    def _own(self, cosine: NDArray[np.float64]) -> NDArray[np.float64]:
        """The own distance at an angle off the heading with this cosine: elliptical to the front."""
        along = np.maximum(cosine, 0.0)
        return np.asarray(self.own_m / np.sqrt(1.0 - (1.0 - self.front**-2) * along**2))
