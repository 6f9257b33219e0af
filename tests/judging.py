"""An independent judge: reads frames.csv and recomputes what an episode claims, with geometry of its own.

It shares no code with the packages on purpose. Conventions: distance between the nearest points of two discs;
bearing in degrees from where the person faces to the robot's centre, positive to the person's left.
"""

from __future__ import annotations

import csv
import itertools
import math
from dataclasses import dataclass, replace
from pathlib import Path


@dataclass(frozen=True)
class Body:
    """One row of frames.csv."""

    t: float
    x: float
    y: float
    heading_rad: float
    radius_m: float


@dataclass(frozen=True)
class Rest:
    """The robot at rest near a person."""

    t: float
    distance_m: float
    bearing_deg: float
    facing_error_deg: float


def read_tracks(frames_csv: Path) -> dict[str, list[Body]]:
    """Every entity's rows in the order of time."""
    tracks: dict[str, list[Body]] = {}
    with frames_csv.open(newline="") as file:
        reader = csv.DictReader(file)
        assert reader.fieldnames == ["t", "entity", "x", "y", "heading_rad", "radius_m"]
        for row in reader:
            body = Body(*(float(row[key]) for key in ("t", "x", "y", "heading_rad", "radius_m")))
            tracks.setdefault(row["entity"], []).append(body)
    return tracks


def nearest_stop(tracks: dict[str, list[Body]], person: str, robot: str = "robot") -> Rest:
    """The first rest (slower than 2 cm/s for 0.3 s) where the robot stood nearest to a person."""
    rests = [(tracks[robot][i], tracks[person][i]) for i in _rests(tracks[robot])]
    assert rests, f"the robot never came to rest near {person}"
    closest = min(gap(*pair) for pair in rests)
    body, met = next(pair for pair in rests if gap(*pair) < closest + 0.01)
    towards_robot = math.atan2(body.y - met.y, body.x - met.x)
    towards_person = math.atan2(met.y - body.y, met.x - body.x)
    return Rest(
        t=body.t,
        distance_m=gap(body, met),
        bearing_deg=turn_deg(met.heading_rad, towards_robot),
        facing_error_deg=abs(turn_deg(body.heading_rad, towards_person)),
    )


def gap(one: Body, other: Body) -> float:
    """Metres between the nearest points of two discs; negative where they overlap."""
    return math.hypot(one.x - other.x, one.y - other.y) - one.radius_m - other.radius_m


def turn_deg(start_rad: float, end_rad: float) -> float:
    """The signed turn from one direction to another, in (-180, 180]."""
    turn = math.degrees(end_rad - start_rad) % 360.0
    return turn - 360.0 if turn > 180.0 else turn


def speeds(track: list[Body]) -> list[tuple[Body, float]]:
    """Each row after the first with the speed that led to it, in m/s."""
    return [
        (b, math.hypot(b.x - a.x, b.y - a.y) / (b.t - a.t)) for a, b in itertools.pairwise(track) if b.t > a.t
    ]


def _rests(track: list[Body], slower_than_m_s: float = 0.02, for_s: float = 0.3) -> list[int]:
    """The rows from which on the body rests for a while."""
    moved = speeds(track)
    rests = []
    for i, body in enumerate(track):
        ahead = [speed for later, speed in moved[i : i + 20] if later.t <= body.t + for_s + 1e-9]
        if i and ahead and max(ahead) < slower_than_m_s:
            rests.append(i)
    return rests


PUSHING_M = 0.02
"""Who is so near and comes nearer pushes: a body that is pushed moves on between two rows. So does whoever
overlaps by so much, even if they go away: what moves two such bodies apart is not the robot's wheels."""


@dataclass(frozen=True)
class Contact:
    """The robot and something else touched."""

    t: float
    entity: str
    by_robot: bool
    """The robot came at it faster than it came at the robot, and nobody was pushing the robot."""


def contacts_with_people(tracks: dict[str, list[Body]], robot: str = "robot") -> list[Contact]:
    """Every contact with a body, as it begins; between two rows both are taken to move straight."""
    found = []
    for name, track in tracks.items():
        if name == robot:
            continue
        touching = gap(tracks[robot][0], track[0]) <= 0.0
        for (me, me_next), (it, it_next) in zip(
            itertools.pairwise(tracks[robot]), itertools.pairwise(track), strict=True
        ):
            touches = _closest(me, me_next, it, it_next) <= me.radius_m + it.radius_m
            if touches and not touching:
                mine, its = _speed_towards(me, me_next, it), _speed_towards(it, it_next, me)
                found.append(Contact(me_next.t, name, by_robot=mine > 0.02 and mine >= its))
            touching = touches
    return sorted((_unpushed(contact, tracks, robot) for contact in found), key=lambda contact: contact.t)


def contacts_with_things(
    tracks: dict[str, list[Body]],
    things: dict[str, tuple[list[tuple[float, float]], float]],
    robot: str = "robot",
) -> list[Contact]:
    """Every contact of the robot with lines that stand still, as it begins.

    Args:
        tracks: Everybody's rows.
        things: By name the corners of a line or of a closed outline, and half of its thickness.
        robot: Its name.
    """
    found = []
    for name, (corners, half_m) in things.items():
        touching = True
        for body in tracks[robot]:
            touches = touches_lines(body, corners, half_m)
            if touches and not touching:
                found.append(Contact(body.t, name, by_robot=True))
            touching = touches
    return sorted((_unpushed(contact, tracks, robot) for contact in found), key=lambda contact: contact.t)


def touches_lines(body: Body, corners: list[tuple[float, float]], half_m: float) -> bool:
    """Whether a disc touches lines with half a thickness."""
    return any(_to_line(body, *line) <= body.radius_m + half_m for line in itertools.pairwise(corners))


def _unpushed(contact: Contact, tracks: dict[str, list[Body]], robot: str) -> Contact:
    """Whoever is pushed into somebody did not come at them."""
    i = next(i for i, body in enumerate(tracks[robot]) if body.t == contact.t)
    others = [track for name, track in tracks.items() if name not in (robot, contact.entity)]
    pushed = any(
        gap(tracks[robot][k], track[k]) < -PUSHING_M
        or (
            gap(tracks[robot][k], track[k]) <= PUSHING_M
            and _speed_towards(track[k], track[k + 1], tracks[robot][k]) > 0.0
        )
        for track in others
        for k in range(max(i - 2, 0), i)
    )
    return replace(contact, by_robot=False) if pushed else contact


def _closest(me: Body, me_next: Body, it: Body, it_next: Body) -> float:
    """The least distance between two centres that move straight at the same time."""
    x, y = me.x - it.x, me.y - it.y
    dx, dy = me_next.x - it_next.x - x, me_next.y - it_next.y - y
    square = dx * dx + dy * dy
    share = min(1.0, max(0.0, -(x * dx + y * dy) / square)) if square else 0.0
    return math.hypot(x + share * dx, y + share * dy)


def _speed_towards(one: Body, one_next: Body, other: Body) -> float:
    apart = math.hypot(other.x - one.x, other.y - one.y)
    way = (one_next.x - one.x) * (other.x - one.x) + (one_next.y - one.y) * (other.y - one.y)
    return way / apart / (one_next.t - one.t)


def _to_line(body: Body, start: tuple[float, float], end: tuple[float, float]) -> float:
    """From a centre to the nearest point of a straight line."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    square = dx * dx + dy * dy
    share = ((body.x - start[0]) * dx + (body.y - start[1]) * dy) / square if square else 0.0
    share = min(1.0, max(0.0, share))
    return math.hypot(body.x - start[0] - share * dx, body.y - start[1] - share * dy)
