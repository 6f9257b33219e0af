"""The limits of a base: speeds from which it can still stop, take bends and respect people.

Velocities are commanded once per tick and held, so all formulas are exact for this discrete motion.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from comity_sim2d.base.smoothing import LONGEST_S, acceleration_within, window_ticks
from comity_sim2d.pose import XY
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.robot_body import RobotBody

SPEED_SHARE, BEND_SHARE = 0.6, 0.8
"""Shares of the acceleration limit for changing speed and direction: at a right angle they add up to all of
it."""
NEAR_PEOPLE_M = 1.5
NEAR_PEOPLE_M_S = 0.5
"""Maximum speed within `NEAR_PEOPLE_M` of a person's body [m/s] (safety limit, our choice)."""
REDUCED_M_S = 0.2
"""Maximum speed within `NEAR_PEOPLE_M` of a person who is passed at a reduced margin [m/s] (our choice)."""
NEAR_PEOPLE_SLACK_M = 0.03
"""Extra distance at which that limit applies [m]: one tick's travel, so that it also holds between ticks."""
KEEP_OFF_M, KEEP_OFF_WITHIN_M = 0.15, 2.0
"""Gap to a body below which the robot never drives by itself [m], if a route is wrong or a person stops on
it. Half of the minimum gap of routes, so it never affects a correct one (our choice). People farther away
than `KEEP_OFF_WITHIN_M` [m] are ignored."""
PAST_S = 1.0
"""Within `KEEP_OFF_M` of a person the robot passes no faster than gap / `PAST_S` [s], and moves away at any
speed: with noise and delay the person may be nearer, and farther ahead, than they seem (our choice)."""
ROUNDING_M_S = 1e-9
MAX_TURN_RAD_S = 1.5
MAX_TURN_RAD_S2 = 3.0


def stopping_speed(distance: float, deceleration: float, step_s: float) -> float:
    """The speed from which a body stops exactly after a distance [m/s]; the discrete form of sqrt(2 a d).

    In n ticks, each slower by x = a dt, a body covers dt (n v - x n (n - 1) / 2), and stops after the last
    tick if that speed was at most x; n is the smallest such number of ticks. The formula holds for angles,
    too.
    """
    slower = deceleration * step_s
    ticks = math.ceil((math.sqrt(1.0 + 8.0 * distance / (slower * step_s)) - 1.0) / 2.0)
    return distance / (ticks * step_s) + slower * (ticks - 1) / 2.0 if ticks else 0.0


def hardest_braking(body: RobotBody) -> float:
    """The deceleration of a body in an emergency [m/s^2]."""
    return max(body.emergency_deceleration_m_s2, body.max_acceleration_m_s2)


def stopping_time_s(body: RobotBody) -> float:
    """Maximum time to stop from full speed with normal braking [s]."""
    braking = SPEED_SHARE * acceleration_within(body.max_acceleration_m_s2, body.max_jerk_m_s3)
    return body.max_speed_m_s / braking + LONGEST_S


def mean_braking(body: RobotBody, step_s: float) -> float:
    """Mean deceleration of a stop from full speed, which a jerk limit prolongs [m/s^2]."""
    within = acceleration_within(body.max_acceleration_m_s2, body.max_jerk_m_s3)
    lag_s = (window_ticks(within, body.max_jerk_m_s3, step_s) - 1) * step_s
    return body.max_speed_m_s / (body.max_speed_m_s / within + lag_s)


def hardest_change(body: RobotBody, step_s: float) -> tuple[float, float]:
    """Deceleration of one tick of emergency braking: speed [m/s] and turning rate [rad/s].

    The turning rate is such that the rim slows down equally.
    """
    slower_m_s = hardest_braking(body) * step_s
    return slower_m_s, slower_m_s / body.radius_m


def limit_change(now: XY, wanted: XY, most: float) -> XY:
    """The velocity nearest to the target that differs from the current one by at most `most` [m/s]."""
    dx, dy = wanted[0] - now[0], wanted[1] - now[1]
    change = math.hypot(dx, dy)
    if change <= most:
        return wanted
    return (now[0] + dx * most / change, now[1] + dy * most / change)


def limit_speed(velocity: XY, most: float) -> XY:
    """The same direction, at most this fast."""
    speed = math.hypot(*velocity)
    return velocity if speed <= most else (velocity[0] * most / speed, velocity[1] * most / speed)


def speed_near_people(
    xy: XY,
    speed_m_s: float,
    robot_radius_m: float,
    people: Iterable[Person],
    *,
    braking: float,
    step_s: float,
    most_m_s: Callable[[Person], float] = lambda _: NEAR_PEOPLE_M_S,
) -> float:
    """The speed from which the robot, braking in time, keeps the limit near every person [m/s].

    Args:
        xy: Position of the robot's centre [m].
        speed_m_s: Its current speed [m/s], which it may keep until the next command.
        robot_radius_m: Its radius [m].
        people: The people and their positions.
        braking: The assumed deceleration [m/s^2].
        step_s: The tick plus the lag of the body behind its commands [s].
        most_m_s: The limit within `NEAR_PEOPLE_M` of a person's body; never above `NEAR_PEOPLE_M_S`.
    """
    slow_m = robot_radius_m + NEAR_PEOPLE_M + NEAR_PEOPLE_SLACK_M + speed_m_s * step_s
    fastest = math.inf
    for person in people:
        ahead = math.dist(xy, person.xy) - person.radius_m - slow_m
        limit = min(most_m_s(person), NEAR_PEOPLE_M_S)
        fastest = min(fastest, math.sqrt(limit**2 + 2.0 * braking * max(ahead, 0.0)))
    return fastest


def speed_within_sight(clear_m: float, *, blind_s: float, braking: float) -> float:
    """The speed from which the robot can stop before a person who comes into view [m/s].

    Args:
        clear_m: Their gap to its body at that moment, less the gap that it keeps [m].
        blind_s: Time until it brakes [s]: one tick, plus the delays of its base and its sensor.
        braking: The assumed deceleration [m/s^2].
    """
    return braking * (math.sqrt(blind_s**2 + 2.0 * max(clear_m, 0.0) / braking) - blind_s)


def keep_off_people(
    xy: XY,
    velocity: XY,
    robot_radius_m: float,
    people: Iterable[Person],
    *,
    braking: float,
    step_s: float,
    keep_m: Callable[[Person], float] = lambda _: KEEP_OFF_M,
) -> XY:
    """The velocity without the part that leads to a person's body, whatever the route [m/s].

    Within `KEEP_OFF_M` of a body, the speed past it is limited, too (`PAST_S`).

    Args:
        xy: Position of the robot's centre [m].
        velocity: The velocity command [m/s].
        robot_radius_m: Its radius [m].
        people: The people and their positions.
        braking: The assumed deceleration [m/s^2].
        step_s: The tick [s].
        keep_m: The gap that the robot keeps to a person, at least `KEEP_OFF_M` [m].
    """
    near: list[tuple[XY, float]] = []
    """Direction to each person near the robot, and the maximum speed in that direction [m/s]."""
    for person in people:
        apart = math.dist(xy, person.xy)
        if apart > KEEP_OFF_WITHIN_M or not apart:
            continue
        ux, uy = (person.x_m - xy[0]) / apart, (person.y_m - xy[1]) / apart
        closing = velocity[0] * ux + velocity[1] * uy
        gap_m = apart - person.radius_m - robot_radius_m
        most_m_s = stopping_speed(max(gap_m - keep_m(person), 0.0), braking, step_s)
        near.append(((ux, uy), most_m_s))
        if gap_m < KEEP_OFF_M:
            past = (velocity[0] - closing * ux, velocity[1] - closing * uy)
            past = limit_speed(past, max(gap_m, 0.0) / PAST_S)
            velocity = (past[0] + min(closing, 0.0) * ux, past[1] + min(closing, 0.0) * uy)
        elif (excess := closing - most_m_s) > 0.0:
            velocity = (velocity[0] - excess * ux, velocity[1] - excess * uy)
    # What was taken away for one person may lead to another one: then the robot slows down as a whole.
    share = 1.0
    for (ux, uy), most_m_s in near:
        closing = velocity[0] * ux + velocity[1] * uy
        if closing > most_m_s + ROUNDING_M_S:
            share = min(share, most_m_s / closing)
    return (velocity[0] * share, velocity[1] * share)


def turn_rate(now_rad_s: float, angle_rad: float, step_s: float) -> float:
    """The next turning rate towards a remaining angle, within the limits of the base [rad/s].

    Args:
        now_rad_s: The current turning rate [rad/s].
        angle_rad: The remaining angle, signed [rad].
        step_s: The tick [s].
    """
    speed = min(MAX_TURN_RAD_S, stopping_speed(abs(angle_rad), SPEED_SHARE * MAX_TURN_RAD_S2, step_s))
    wanted = math.copysign(speed, angle_rad)
    most = MAX_TURN_RAD_S2 * step_s
    return now_rad_s + min(max(wanted - now_rad_s, -most), most)
