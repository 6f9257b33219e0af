"""Episodes in which people move at random and sensors are noisy; each can be run again with interventions."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario
from comity_executor import Execution, History, Intervention, Limits
from comity_sim2d import Sensor, World
from tests.scenarios.every import SCENARIOS as EVERY

LIMIT_S = 30.0
PROFILES = ("arab_woman", "german_man", "japanese_woman", "indian_man", "unknown")


@dataclass(frozen=True)
class Walk:
    """A person goes somewhere, little by little."""

    person: str
    start: int
    """The first control tick: of the episode, or since the robot docked before this person."""
    off: bool
    """Whether they wait for the robot and walk off in mid-greeting."""
    ticks: int
    step_m: tuple[float, float]
    """In each tick."""
    turn_rad: float


@dataclass(frozen=True)
class Disturbed:
    """One episode: a scenario by name or number, and a seed for what people do and what the sensors see."""

    scenario: str | int
    seed: int

    def run(self, *interventions: Intervention, until_s: float = LIMIT_S) -> History:
        prepared = prepared_for(self.scenario)
        dice = random.Random(f"{self.scenario} {self.seed}")
        sensor = Sensor(sigma_m=dice.choice((0.0, 0.01, 0.02)), delay_s=dice.choice((0.0, 0.1)))
        scene = replace(prepared.scene, robot=replace(prepared.scene.robot, sensor=sensor))
        world = World(scene, self.seed, route_map=prepared.route_map)
        limits = replace(
            Limits.attentive(prepared.attend_s),
            reach_timeout_s=dice.choice((5.0, 15.0, 40.0)),
            act_timeout_s=dice.choice((1.2, 10.0)),
        )
        walks = [_walk(dice, [person.name for person in scene.people]) for _ in range(dice.randint(1, 8))]
        execution = Execution(prepared.plan, world.robot, prepared.values, limits, interventions)
        tick, docked = 0, dict[str, int]()
        while execution.tick() == "running" and world.time_s < until_s:
            for visit in execution.visits:
                if visit.docked_s is not None:
                    docked.setdefault(visit.person, tick)
            for walk in walks:
                since = tick - docked.get(walk.person, tick) if walk.off else tick
                if walk.start <= since < walk.start + walk.ticks:
                    _move(world, walk)
            world.step()
            tick += 1
        return History(execution.nodes, execution.events)


def _walk(dice: random.Random, people: list[str]) -> Walk:
    """A shuffle of the feet, a step, or a few metres; now or later."""
    off = dice.random() < 0.5
    length_m = dice.choice((0.5, 1.5) if off else (0.05, 0.2, 0.5, 1.5, 3.0))
    speed_m_s, direction = dice.uniform(0.3, 1.3), dice.uniform(-math.pi, math.pi)
    ticks = max(1, round(20 * length_m / speed_m_s))
    step = length_m / ticks
    return Walk(
        person=dice.choice(people),
        start=dice.randint(1, 15) if off else dice.randrange(400),
        off=off,
        ticks=ticks,
        step_m=(step * math.cos(direction), step * math.sin(direction)),
        turn_rad=dice.choice((0.0, 0.0, dice.uniform(-2.0, 2.0))) / ticks,
    )


def _move(world: World, walk: Walk) -> None:
    """Nobody walks out of the room; people walk through furniture, which the tree does not mind."""
    (person,) = (person for person in world.people if person.name == walk.person)
    xs, ys = zip(*world.scene.room.corners, strict=True)
    x = min(max(person.x_m + walk.step_m[0], min(xs) + 0.3), max(xs) - 0.3)
    y = min(max(person.y_m + walk.step_m[1], min(ys) + 0.3), max(ys) - 0.3)
    world.move_person(walk.person, x, y, person.heading_rad + walk.turn_rad)


@cache
def prepared_for(scenario: str | int) -> PlannedEpisode:
    """A scenario of the project by its name, a random one by its number; planned once."""
    if isinstance(scenario, str):
        return prepare(load_scenario(str(EVERY[scenario])))
    with TemporaryDirectory() as folder:
        path = Path(folder) / "random.scenario.yaml"
        path.write_text(random_scenario(scenario))
        return prepare(load_scenario(str(path)))


def random_scenario(number: int) -> str:
    """A room of some size with a table and one to three people somewhere."""
    dice = random.Random(number)
    width, height = dice.uniform(6.0, 9.0), dice.uniform(5.0, 8.0)
    spots = [(width * i, height * j) for i in (0.25, 0.5, 0.75) for j in (0.3, 0.7)]
    dice.shuffle(spots)
    start, table, *rest = spots
    people = "".join(
        f"  p{i}: {{profile: {dice.choice(PROFILES)}, at_m: [{x:.2f}, {y:.2f}], "
        f"facing_deg: {dice.uniform(-180, 180):.0f}}}\n"
        for i, (x, y) in enumerate(rest[: dice.randint(1, 3)])
    )
    goals = "".join(f"  - greet: p{i}\n" for i in range(people.count("\n")))
    box = f"[{table[0] - 0.3:.2f}, {table[1] - 0.2:.2f}, 0.6, 0.4]"
    return (
        f"schema_version: 1\nname: random\nplace:\n  width_m: {width:.2f}\n  height_m: {height:.2f}\n"
        f"  furniture:\n    - {{name: table, box_m: {box}}}\n"
        f"robot:\n  at_m: [{start[0]:.2f}, {start[1]:.2f}]\npeople:\n{people}goals:\n{goals}"
    )


SCENARIOS: tuple[str | int, ...] = (*sorted(EVERY), *range(10))
