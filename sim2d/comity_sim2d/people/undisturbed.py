"""Counterfactual walks: how people would have walked without the robot, with the same seed and doors."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from comity_sim2d.clock import Clock
from comity_sim2d.maps.doorways import DoorTurn, turned
from comity_sim2d.people.pedestrians import Pedestrians
from comity_sim2d.pose import Pose, Twist
from comity_sim2d.scene.obstacles import floor_plan
from comity_sim2d.scene.person import Person
from comity_sim2d.scene.scene import Scene

AWAY = Pose(-1e4, -1e4, 0.0)
"""Place of the robot far from all people [m]."""


def undisturbed_walks(
    scene: Scene, seed: int, ticks: int, *, control_hz: int = 20, turns: Iterable[DoorTurn] = ()
) -> dict[str, NDArray[np.float64]]:
    """Positions at each tick of people who may move, and of passers-by, if the robot were far away.

    Args:
        scene: As it was at the start.
        seed: Seed of the world.
        ticks: Number of control ticks, 0 or more.
        control_hz: Control rate of the world [Hz].
        turns: Doors opened or shut in the world; they are here too, at the same times.

    Returns:
        Times [s], x and y [m] by name, each of shape (ticks + 1, 3); empty if no person may move.
    """
    movers = [person.name for person in scene.people if person.may_move]
    if not movers and scene.passers_by is None:
        return {}
    clock = Clock(control_hz)
    people = {person.name: person for person in scene.people}
    traffic, states = Pedestrians(scene, clock, seed), dict[str, bool]()
    coming = sorted(turns, key=lambda turn: turn.t)

    def put(person: Person) -> None:
        people[person.name] = person

    rows = [_row(people, movers, traffic)]
    for _ in range(ticks):
        while coming and coming[0].t <= clock.now_s:
            turn = coming.pop(0)
            states[turn.door] = turn.is_open
            traffic.use_plan(floor_plan(scene, turned(scene.doors, states)))
        clock.tick += 1
        if traffic.is_due:
            traffic.decide(AWAY, Twist(0.0, 0.0, 0.0))
        traffic.step(people, put)
        rows.append(_row(people, movers, traffic))
    times_s = np.arange(ticks + 1, dtype=np.float64) * clock.step_s
    tracks = np.array(rows)
    names = (*movers, *traffic.names)
    return {name: np.column_stack([times_s, tracks[:, i]]) for i, name in enumerate(names)}


def _row(people: dict[str, Person], movers: list[str], traffic: Pedestrians) -> NDArray[np.float64]:
    """Positions of the movers and the passers-by [m], shape (people, 2)."""
    at = np.array([people[name].xy for name in movers]).reshape(-1, 2)
    return np.concatenate([at, traffic.poses[:, :2]])
