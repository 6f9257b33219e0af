"""Meeting a walking person: the robot waits ahead, in view and next to their path, and offers once.

A person who stops is approached like any other. One who passes by, turns away, speeds up or draws back has
declined. The robot accompanies only a person who agreed to it, and never from behind. That robots should come
into view from the front is from Satake et al. 2009, "How to approach humans? Strategies for social robots to
initiate interaction", HRI; the rest is our choice.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from comity_fis.proxemics import BEHIND_DEG, COMFORT_M, FACES_DEG, SOCIAL_M
from comity_sim2d.clock import Clock
from comity_sim2d.navigation.docking import Docked, DockingPose, docked
from comity_sim2d.navigation.pose_choice import Wish
from comity_sim2d.navigation.route_map import RouteMap
from comity_sim2d.navigation.yielding import Walker
from comity_sim2d.paths.personal_space import Points
from comity_sim2d.pose import XY, Pose, wrap_angle
from comity_sim2d.robot.retreat import Retreat
from comity_sim2d.robot.turning_away import TurningAway
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody
from comity_sim2d.scene.surroundings import Surroundings
from comity_sim2d.senses.sensing import SensedPeople
from comity_sim2d.senses.visibility_memory import Numbers

WALK_M = 0.3
"""A person who has moved by less than this has made a step, and does not walk [m] (our choice)."""
OFFER_M = 1.5
"""Distance before a walker at which the robot offers to talk, and stands [m]: within the close phase of
social distance (1.2 to 2.1 m, Hall, The Hidden Dimension, 1966). Farther for people with a large own
distance (`_offers_at_m`)."""
COME_M = 0.1
"""The robot has reached a person when this near to the distance of the visit [m] (our choice)."""
LEAVES_M = 0.5
"""Additional distance at which a walker has turned away [m] (our choice)."""
LOST_DEG = 120.0
"""Beyond this bearing from a walker's facing an accompanying robot has fallen behind [deg] (our choice)."""
NOTICED_S = 2.0
"""Time for which the robot has been visiting a walker before they can take it for an offer [s]: who passes
by or walks on sooner is missed, and has not declined (our choice)."""
SETTLES_S, FASTER, FASTER_M_S = 1.0, 1.5, 0.3
"""A walker speeds up if their mean speed over `SETTLES_S` [s] exceeds their initial one by the factor
`FASTER` and by `FASTER_M_S` [m/s] (our choice)."""
TURNED_COS = math.cos(math.radians(45.0))
"""A walker whose heading has changed by more than 45 degrees has turned away (our choice)."""
ALONG_M_S, SIDE_DEG = 0.5, 90.0
"""Maximum speed of a person that the robot accompanies [m/s], and its bearing at their side [deg]."""
AHEAD_S, LONGEST_M, STEP_M = 10.0, 8.0, 0.5
"""Candidate places next to a path: horizon in time [s] and path length [m], and step [m] (our choice)."""
EARLY_S, SLOWED = 1.0, 1.3
"""The robot arrives `EARLY_S` before the walker sees it; its path is assumed to take `SLOWED` times the
straight line's time at full speed (our choice)."""
TURNS_S = 2.0
"""Time that a differential drive takes to turn to a walker [s]: it stands that long before it offers to talk
(our choice)."""
RENEWS_S = 0.5
"""Interval at which a waiting place is chosen [s]."""
MOST_TRIED = 4
"""Maximum number of places that are tested for a route."""
OFFERS_DEG = 30.0
"""Maximum facing error at which the robot offers to talk to a walker [deg] (our choice)."""
OFF_M = 0.25
"""A place is kept while its distance from the walker's path changes by less [m] (our choice)."""


@dataclass(frozen=True, slots=True)
class _Offer:
    """A walker has seen the robot before them."""

    heading_rad: float
    """Their heading at the start [rad]."""
    mark: XY
    """Their position at the end of the last full `SETTLES_S` [m]."""
    mark_s: float
    pace_m_s: float | None = None
    """Their initial speed [m/s]; None before it is known."""


class WalkersMet:
    """Behaviour of one robot towards a walking person that it visits.

    Args:
        spec: The robot's body.
        senses: Believed positions of people.
        clock: Simulated time.
    """

    def __init__(self, spec: RobotBody, senses: SensedPeople, clock: Clock) -> None:
        self._spec, self._senses, self._clock = spec, senses, clock
        self.declined: dict[str, str] = {}
        """People who declined, and how: the robot does not approach them again."""
        self._person, self._since_s = "", -math.inf
        self._stood: XY | None = None
        """Where the person last stood, or was first seen [m]."""
        self._walks = self._along = False
        self._offer: _Offer | None = None
        self._retreat, self._turning_away = Retreat(clock), TurningAway()
        self._place: XY | None = None
        self._chosen_s = -math.inf

    def look(self, name: str, distance_m: float, robot: Pose, ways: RouteMap) -> XY | None:
        """Where to wait for a person [m]; None if the robot may approach them. Call it in every tick.

        Args:
            name: The person to visit.
            distance_m: Target distance at which it stops before them, between the surfaces [m].
            robot: Pose of the robot.
            ways: Its routes around standing people.
        """
        if name != self._person:
            self._person, self._stood, self._along, self._offer = name, None, False, None
            self._since_s = self._clock.now_s
            self._retreat.forget()
            self._turning_away.forget()
        walker = self._walker(name)
        if walker is None:  # they stopped or turned round: an offer still stands
            self._place = None
            self._note_pause(name, distance_m, robot)
            return None
        self._retreat.forget()
        self._turning_away.forget()
        stands = docked(robot, self._spec.radius_m, walker.person)
        gap_m, bearing_deg = stands.distance_m, abs(stands.bearing_deg)
        bodies_m = walker.person.radius_m + self._spec.radius_m
        aside_m = bodies_m + max(distance_m, walker.person.personal_distance_m or COMFORT_M)
        offer_m = _offers_at_m(aside_m, bodies_m)
        along = goes_along(self._spec, walker.person)
        if along and math.hypot(*walker.velocity) <= ALONG_M_S:
            stays = self._along and bearing_deg <= LOST_DEG and gap_m <= SOCIAL_M
            self._along = stays or _is_near(stands, offer_m)
        else:
            self._along = False
            self._note_offer(walker, stands, offer_m)
        if self._along:
            self._offer = None
            return None
        turns_s = 0.0 if self._spec.drive == "omnidirectional" else TURNS_S
        comes = bearing_deg <= FACES_DEG and gap_m <= offer_m + turns_s * math.hypot(*walker.velocity)
        if self._offer is not None or comes or (bearing_deg > BEHIND_DEG and gap_m < SOCIAL_M):
            self._place = None
        elif self._clock.now_s - self._chosen_s >= RENEWS_S:
            self._chosen_s = self._clock.now_s
            if self._place is None or not _is_beside(self._place, walker, aside_m):
                self._place = self._choose(walker, aside_m, robot.xy, ways)
        return self._place or (robot.xy if gap_m <= SOCIAL_M or comes else None)

    def _seen(self, name: str) -> Walker | None:
        """The person, if they move."""
        return next((each for each in self._senses.walkers if each.person.name == name), None)

    def _walker(self, name: str) -> Walker | None:
        """The person, if they walk forwards and have left the place where they stood."""
        walker = self._seen(name)
        if walker is None or self._stood is None:
            self._walks, self._stood = False, self._senses.person(name).xy
            return None
        if math.dist(self._stood, walker.person.xy) > WALK_M and _goes_where_they_face(walker):
            self._walks = True
        return walker if self._walks else None

    def _note_offer(self, walker: Walker, stands: Docked, offer_m: float) -> None:
        """Record that a walker sees the robot ahead, and how they decline."""
        person, now_s, offer = walker.person, self._clock.now_s, self._offer
        if offer is None:
            faces = stands.facing_error_deg <= OFFERS_DEG
            if self._is_noticed(person.name) and faces and _is_near(stands, offer_m):
                self._offer = _Offer(person.heading_rad, person.xy, now_s)
            return
        gap_m, bearing_deg = stands.distance_m, abs(stands.bearing_deg)
        if now_s - offer.mark_s >= SETTLES_S - 1e-9:
            pace_m_s = math.dist(offer.mark, person.xy) / (now_s - offer.mark_s)
            first_m_s = pace_m_s if offer.pace_m_s is None else offer.pace_m_s
            self._offer = _Offer(offer.heading_rad, person.xy, now_s, first_m_s)
            if pace_m_s > max(FASTER * first_m_s, first_m_s + FASTER_M_S):
                self._decline(person, f"sped up before the robot, to {pace_m_s:.1f} m/s")
        if bearing_deg > BEHIND_DEG or gap_m > offer_m + LEAVES_M:
            turned = math.cos(person.heading_rad - offer.heading_rad) < TURNED_COS
            how = "turned away from" if turned or bearing_deg <= BEHIND_DEG else "walked by"
            self._decline(person, f"{how} the robot, {gap_in_words(gap_m)} from it")

    def _is_noticed(self, name: str) -> bool:
        """Whether a person in view can have taken the robot's visit for an offer by now."""
        return self._clock.now_s - self._since_s >= NOTICED_S and self._senses.sees(name)

    def _note_pause(self, name: str, distance_m: float, robot: Pose) -> None:
        """Record that a person does not walk now.

        An offer stays valid. To a person who pauses on a walk the robot makes one by approaching, so they
        decline by walking on. Anyone declines by drawing back, or by turning away again and again.
        """
        person, now_s, offer = self._senses.person(name), self._clock.now_s, self._offer
        stands = docked(robot, self._spec.radius_m, person)
        reaches_m = distance_m + COME_M
        has_come = _is_near(stands, reaches_m) and self._is_noticed(name)
        if offer is None and has_come and person.walk is not None and not goes_along(self._spec, person):
            offer = _Offer(person.heading_rad, person.xy, now_s)
        if offer is not None:
            self._offer = replace(offer, mark=person.xy, mark_s=now_s, pace_m_s=None)
        agreed = person.walk is not None and person.walk.accompanied
        if self._retreat.look(self._seen(name), stands, robot.xy) and not agreed:
            self._decline(person, f"drew back from the robot, {gap_in_words(stands.distance_m)} from it")
        if self._turning_away.look(person.heading_rad, stands) and not agreed:
            self._decline(
                person, f"kept turning away from the robot, {gap_in_words(stands.distance_m)} from it"
            )

    def _decline(self, person: Person, how: str) -> None:
        self.declined[person.name] = how

    def _choose(self, walker: Walker, aside_m: float, xy: XY, ways: RouteMap) -> XY | None:
        """The waiting place that the robot reaches earliest; None where there is none.

        It is next to the walker's path ahead of them, if the robot gets there in time; else next to the line
        on which they walk, at a distance: a person who walks to and fro comes by there.
        """
        ahead_m, spots = self._beside(walker, aside_m, ways.surroundings)
        way_s = SLOWED * np.hypot(*(spots - np.array(xy)).T) / self._spec.max_speed_m_s
        seen_s = np.maximum(ahead_m - OFFER_M, 0.0) / math.hypot(*walker.velocity)
        in_time = (ahead_m > 0.0) & (way_s + EARLY_S <= seen_s)
        far = np.hypot(*(spots - np.array(walker.person.xy)).T) >= SOCIAL_M
        order = np.lexsort((way_s, ~in_time))
        for best in order[(in_time | far)[order]][:MOST_TRIED].tolist():
            spot = (float(spots[best, 0]), float(spots[best, 1]))
            if ways.reaches(xy, spot):
                return spot
        return None

    def _beside(self, walker: Walker, aside_m: float, place: Surroundings) -> tuple[Numbers, Points]:
        """Free places next to a walker's line, and how far ahead they are; shapes (n, 2) and (n,) [m].

        People are assumed to walk in a straight line between obstacles.
        """
        person, (vx, vy) = walker.person, walker.velocity
        speed_m_s = math.hypot(vx, vy)
        along, aside = np.array((vx, vy)) / speed_m_s, np.array((-vy, vx)) / speed_m_s
        steps_m = np.arange(STEP_M, min(AHEAD_S * speed_m_s + OFFER_M, LONGEST_M), STEP_M)
        marks_m, lines = [], []
        for sign in (1.0, -1.0):
            line = np.array(person.xy) + sign * steps_m[:, None] * along
            is_open = place.plan.are_free(line, person.radius_m) & place.plan.are_in_view(person.xy, line)
            count = int(np.logical_and.accumulate(is_open).sum())
            marks_m.append(sign * steps_m[:count])
            lines.append(line[:count])
        line, ahead_m = np.concatenate(lines), np.concatenate(marks_m)
        spots = np.concatenate([line + aside_m * aside, line - aside_m * aside])
        others = (each for each in place.people if each.name != person.name)
        around = place.with_people((*others, person))
        free = around.are_free([(x, y) for x, y in spots.tolist()], visited=person.name)
        return np.tile(ahead_m, 2)[free], spots[free]


def _is_beside(place: XY, walker: Walker, aside_m: float) -> bool:
    """Whether a walker who goes straight on passes a place at the waiting distance."""
    x, y = place[0] - walker.person.x_m, place[1] - walker.person.y_m
    vx, vy = walker.velocity
    speed_m_s = math.hypot(vx, vy)
    comes, off_m = (x * vx + y * vy) / speed_m_s > 0.0, abs(x * vy - y * vx) / speed_m_s
    return comes and abs(off_m - aside_m) <= OFF_M


def _is_near(stands: Docked, within_m: float) -> bool:
    """Whether the robot is near enough to talk, and in the person's view."""
    return stands.distance_m <= within_m and abs(stands.bearing_deg) <= FACES_DEG


def _offers_at_m(aside_m: float, bodies_m: float) -> float:
    """The gap at which the robot offers to talk [m].

    `OFFER_M`, but no less than the gap at which a walker whose path leads past the robot at `aside_m` begins
    to lose it from view: nearer, they would never see it ahead.
    """
    return max(OFFER_M, aside_m / math.sin(math.radians(FACES_DEG)) - bodies_m + COME_M)


def gap_in_words(gap_m: float) -> str:
    """A gap in words: at least 0 m, though by the noise of the sensor bodies may be believed to overlap."""
    return f"{max(0.0, gap_m):.1f} m"


def _goes_where_they_face(walker: Walker) -> bool:
    vx, vy = walker.velocity
    return abs(wrap_angle(math.atan2(vy, vx) - walker.person.heading_rad)) <= math.radians(FACES_DEG)


def pose_at_side(stands: Docked, wish: Wish) -> DockingPose:
    """The docking pose while accompanying: at the wished distance, on the robot's current side."""
    side, widest_deg = math.copysign(1.0, stands.bearing_deg or wish.bearing_deg), wish.widest_deg
    bearing_deg = side * min(SIDE_DEG, widest_deg)
    reason = f"{wish.person} walks: the robot goes along at their side"
    return DockingPose(wish.distance_m, bearing_deg, pose_free=False, deviation_reason=reason)


def goes_along(robot: RobotBody, person: Person) -> bool:
    """Whether the robot accompanies a walking person: they agreed, and it can face them meanwhile.

    A two-wheeled base faces its direction of travel; to face a person next to it, it has to stop.
    """
    return robot.drive == "omnidirectional" and person.walk is not None and person.walk.accompanied
