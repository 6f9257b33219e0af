"""What a simulated second costs: a visit in a hall full of people, with everything on, against other crowds.

Ours is the world, the people, the behaviour tree, the recording and the metrics, at 20 Hz with people who
decide at 10 Hz; theirs is the people alone, at 10 Hz. Everybody walks in a square hall of 8 m2 for each: as
passers-by, and as people of the scenario on walks, whom the robot senses, tracks and plans with. The random
rooms of `room_study` are timed besides.
"""

from __future__ import annotations

import math
import sys
import time
import tracemalloc
from collections.abc import Callable
from functools import partial
from importlib import import_module
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any

from tests.bench.contest import Bench, Contestant, ContestantError, in_turn
from tests.bench.environment import NotInstalledError
from tests.bench.rows import Row

STEP_S = 0.1
"""Of the others: ir-sim's default, and what our people decide at."""
SPACE_M2 = 8.0
GROWTH = (1, 10, 50, 100, 200, 500)
MEMORY_S = 600.0
RUN_S = 20.0
ROOMS = 200


def run(bench: Bench) -> list[Row]:
    """The contest at 10 and 50 people, parts, walks, random rooms, growth, and the memory of ten minutes."""
    rows: list[Row] = []
    for people in (10,) if bench.quick else (10, 50):
        rows += _contest(bench, people)
        rows += _parts(people)
        prepared = _prepared(people, walks=True)
        turns = {"comity, everything on": partial(_episode, prepared)}
        rows += in_turn(
            turns, rounds=bench.rounds, suite="world", task=f"{people} people on walks", per="simulated s"
        )
    rows += _rooms(3 if bench.quick else ROOMS)
    rows += _growth((1, 10) if bench.quick else GROWTH)
    return rows + _memory(10.0 if bench.quick else MEMORY_S)


def _contest(bench: Bench, people: int) -> list[Row]:
    prepared = _prepared(people)
    others = bench.contestants(
        Contestant("ir-sim, social force", "irsim_crowd", "ir-sim"),
        Contestant("ir-sim, social force, batched", "irsim_crowd", "ir-sim"),
        Contestant("PySocialForce", "pysocialforce_crowd", "pysocialforce"),
        Contestant("JuPedSim, collision-free speed", "jupedsim_crowd", "jupedsim"),
    )
    turns: dict[str, Callable[[], float]] = {"comity, everything on": lambda: _episode(prepared)}
    rows: list[Row] = []
    for other in others:
        try:
            other.ask("build", description=_description(people, batched="batched" in other.name))
        except (NotInstalledError, ContestantError) as error:
            rows.append(Row(suite="world", task=f"{people} people", contestant=other.name, note=str(error)))
        else:
            turns[other.name] = lambda it=other: it.ask("one", calls=20)["seconds"] / STEP_S
    rows += in_turn(turns, rounds=bench.rounds, suite="world", task=f"{people} people", per="simulated s")
    for other in others:
        other.close()
    return rows


def _description(people: int, *, batched: bool) -> dict[str, Any]:
    """The hall for the others: everybody somewhere, on the way to somewhere else."""
    side, dice = math.sqrt(SPACE_M2 * people), Random(0)
    cells = int(side)
    spots = [((i + 0.5) * side / cells, (j + 0.5) * side / cells) for i in range(cells) for j in range(cells)]
    starts, goals = (dice.sample(spots, people + 1) for _ in range(2))
    return {
        "inputs": {},
        "side_m": side,
        "step_s": STEP_S,
        "starts": starts,
        "goals": goals,
        "batched": batched,
    }


def _prepared(people: int, *, walks: bool = False) -> Any:
    """A visit at the other end of the hall, planned; the others pass by, or are people on walks."""
    from comity.preparation import prepare
    from comity.scenario import load_scenario

    side = round(math.sqrt(SPACE_M2 * people), 3)
    others = _walks(people - 1, side) if walks else f"passers_by: {{count: {people - 1}}}"
    scenario = f"""
schema_version: 1
name: hall
place: {{width_m: {side}, height_m: {side}}}
robot: {{at_m: [1.0, 1.0]}}
people:
  host: {{profile: german_woman, at_m: [{side - 1.5}, {side - 1.5}], facing_deg: 225}}
{others}
goals: [{{greet: host}}]
limits: {{time_s: 90}}
"""
    with TemporaryDirectory(prefix="comity-bench-") as name:
        file = Path(name) / "hall.scenario.yaml"
        file.write_text(scenario)
        return prepare(load_scenario(str(file)))


def _walks(count: int, side: float) -> str:
    """People who walk to and fro between three spots of the hall each, away from the robot and the host."""
    dice, cells = Random(0), int(side)
    spots = [((i + 0.5) * side / cells, (j + 0.5) * side / cells) for i in range(cells) for j in range(cells)]
    ends = ((1.0, 1.0), (side - 1.5, side - 1.5))
    free = [spot for spot in spots if all(math.dist(spot, end) > 1.0 for end in ends)]
    lines = []
    for i, (x, y) in enumerate(dice.sample(free, count)):
        route = [[round(value, 2) for value in spot] for spot in dice.sample(free, 2)]
        lines.append(f"  w{i}: {{at_m: [{x:.2f}, {y:.2f}], walks: {{route: {route}, loop: true}}}}")
    return "\n".join(lines)


def _rooms(count: int) -> list[Row]:
    """Random rooms in which people walk, with noise and both drives: the median and the 90th percentile."""
    sys.path.insert(0, str(Path(__file__).parents[2]))
    study = import_module("room_study")
    costs = sorted(study.episode("walk", seed)["cpu_ms"] / 1000.0 for seed in range(count))
    share = {"median": 0.5, "90th percentile": 0.9}
    return [
        Row(
            suite="world",
            task=f"{count} random rooms, {name}",
            contestant="comity, everything on",
            seconds=(costs[min(count - 1, int(at * count))],),
            per="simulated s",
        )
        for name, at in share.items()
    ]


def _episode(prepared: Any) -> float:
    from comity.live_episode import execute

    start = time.process_time()
    episode = execute(prepared)
    return (time.process_time() - start) / float(episode.frames.time_s[-1])


def _parts(people: int) -> list[Row]:
    """Where the time goes, by stopwatches around the parts of one episode."""
    from comity.live_episode import LiveEpisode

    live = LiveEpisode(_prepared(people))
    world, execution = live._world, live._execution
    spent: dict[str, float] = {}
    for name, owner, method in (
        ("people, forces", world._traffic, "decide"),
        ("people, steps", world._traffic, "step"),
        ("bodies", world._physics, "run"),
        ("robot", world.robot, "control"),
        ("senses and frames", world, "_observe"),
        ("tree", execution, "tick"),
    ):
        _time(spent, name, owner, method)
    start = time.process_time()
    live.run()
    simulated = world.time_s
    spent["everything"] = time.process_time() - start
    return [
        Row(
            suite="world",
            task=f"{people} people, by part",
            contestant=name,
            seconds=(seconds / simulated,),
            per="simulated s",
            note=f"{seconds / spent['everything']:.0%}",
        )
        for name, seconds in spent.items()
    ]


def _time(spent: dict[str, float], name: str, owner: Any, method: str) -> None:
    real, spent[name] = getattr(owner, method), 0.0

    def timed(*arguments: Any, **options: Any) -> Any:
        start = time.process_time()
        try:
            return real(*arguments, **options)
        finally:
            spent[name] += time.process_time() - start

    setattr(owner, method, timed)


def _world(people: int) -> Any:
    from comity_sim2d import PassersBy, RobotBody, Room, Scene, World

    side = max(4.0, math.sqrt(SPACE_M2 * people))
    return World(Scene(Room.rectangle(side, side), RobotBody(1.0, 1.0), passers_by=PassersBy(people)))


def _growth(sizes: tuple[int, ...]) -> list[Row]:
    rows = []
    for people in sizes:
        world = _world(people)
        world.run(1.0)
        start = time.process_time()
        world.run(RUN_S)
        seconds = (time.process_time() - start) / RUN_S
        note = f"{1 / seconds:.0f} s per processor s, {seconds / 20 / people * 1e6:.2f} us a head a tick"
        rows.append(
            Row(
                suite="world",
                task=f"growth, {people} people",
                contestant="comity, world alone",
                seconds=(seconds,),
                per="simulated s",
                note=note,
            )
        )
    return rows


def _memory(simulated_s: float) -> list[Row]:
    world = _world(10)
    tracemalloc.start()
    world.run(simulated_s)
    peak = tracemalloc.get_traced_memory()[0]
    tracemalloc.stop()
    return [
        Row(
            suite="world",
            task=f"{simulated_s:.0f} s, 10 people",
            contestant="comity, world alone",
            peak_bytes=peak,
            note="held at the end: frames of all bodies at every tick",
        )
    ]
