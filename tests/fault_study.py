"""The study of faults: random schedules in rooms and a flat, what came of each, and what was possible.

`python tests/fault_study.py [SCHEDULES]` prints the table of docs/how-to/let-things-go-wrong.md, of
1,000 schedules.

The judge (`judging`) reads the frames. The oracle knows neither plan nor tree: with everybody and every door
where they are after the last fault, can a disc get from the robot to where each person can be greeted?
"""

from __future__ import annotations

import json
import math
import random
import sys
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from judging import Body, contacts_with_people, contacts_with_things, speeds
from numpy.typing import NDArray
from places import FLAT
from pydantic import TypeAdapter
from studying import studied

from comity.episode import Episode
from comity.live_episode import LiveEpisode
from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario
from comity.schedule import Happening
from comity.simulation.faults import Faults
from comity.specification.fault import Fault
from comity_executor import Limits, NodeId, leaves_of
from comity_sim2d import Scene

OUTCOMES = ("success", "partial", "failed", "stopped")
AT_REST_M_S = 0.02
CELL_M = 0.05
WALL_M, PERSON_M = 0.32, 0.32
"""The robot's radius and 7 cm off everything that stands still; 32 cm between bodies: the margins by which
the robot goes, and 2 cm more."""
NEAREST_M, FARTHEST_M = 0.45, 1.20
"""Within these, between the bodies, and in front of a person or beside them, somebody can be greeted."""
WALKS_M_S, GREETS_S = 0.3, 15.0
"""So slowly at the least the robot gets there, and so long at the most it takes to greet somebody."""

ROOM = """\
schema_version: 1
name: room
place:
  width_m: 8
  height_m: 6
  walls_m: [[[4, 6], [4, 4.2]]]
  furniture: [{name: table, box_m: [3.2, 2.5, 1.6, 0.9]}, {name: sofa, box_m: [5.4, 0.3, 2.0, 0.8]}]
robot: {at_m: [1, 1], facing_deg: 45}
people:
  host: {profile: german_man, at_m: [1.8, 4.4], facing_deg: -60}
  guest: {profile: arab_woman, at_m: [6.6, 4.3], facing_deg: 225}
  marta: {at_m: [6.4, 2.2], facing_deg: 90}
goals: [{greet: host}, {greet: guest}]
"""
VISITS = f"""\
{FLAT}  host: {{profile: german_woman, at_m: [3.0, 1.4], facing_deg: 90}}
  marta: {{at_m: [6.2, 3.0], facing_deg: 180}}
goals: [{{greet: guest}}, {{greet: host}}]
"""
PROFILES = ("arab_woman", "german_man", "japanese_woman", "indian_man", "unknown")
ROOMS = 8


def random_room(number: int) -> str:
    """A room of some size with a table, one or two people to greet and one more."""
    dice = random.Random(number)
    width, height = dice.uniform(6.0, 9.0), dice.uniform(5.0, 8.0)
    spots = [(width * i, height * j) for i in (0.25, 0.5, 0.75) for j in (0.3, 0.7)]
    dice.shuffle(spots)
    start, table, marta, *rest = spots
    guests = rest[: dice.randint(1, 2)]
    people = "".join(
        f"  p{i}: {{profile: {dice.choice(PROFILES)}, at_m: [{x:.2f}, {y:.2f}], "
        f"facing_deg: {dice.uniform(-180, 180):.0f}}}\n"
        for i, (x, y) in enumerate(guests)
    )
    sensor = "{noise_m: 0.01, delay_s: 0.1}" if number % 2 else "{}"
    return (
        f"schema_version: 1\nname: random room\nplace:\n  width_m: {width:.2f}\n  height_m: {height:.2f}\n"
        f"  furniture: [{{name: table, box_m: [{table[0] - 0.3:.2f}, {table[1] - 0.2:.2f}, 0.6, 0.4]}}]\n"
        f"robot: {{at_m: [{start[0]:.2f}, {start[1]:.2f}], sensor: {sensor}}}\npeople:\n{people}"
        f"  marta: {{at_m: [{marta[0]:.2f}, {marta[1]:.2f}]}}\n"
        f"goals: [{', '.join(f'{{greet: p{i}}}' for i in range(len(guests)))}]\n"
    )


@dataclass(frozen=True)
class Place:
    """Where schedules are tried, and how long the visits take there while nothing goes wrong."""

    prepared: PlannedEpisode
    leaves: tuple[NodeId, ...]
    faultless_s: float


def place_of(seed: int) -> Place:
    """Two in ten schedules are tried in the room, three in the flat, the others in random rooms."""
    kind = seed % 10
    if kind < 2:
        return place(ROOM)
    return place(VISITS if kind < 5 else random_room(seed // 10 % ROOMS))


@cache
def place(text: str) -> Place:
    """The place of a scenario."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "faults.scenario.yaml"
        path.write_text(text)
        prepared = prepare(load_scenario(str(path)))
    leaves = leaves_of(prepared.plan, prepared.values, Limits.attentive(prepared.attend_s))
    return Place(prepared, leaves, float(_ran(prepared, ()).frames.time_s[-1]))


def schedule(seed: int, there: Place) -> list[dict[str, Any]]:
    """One to three faults of any kind, at any time of the visits, as a scenario has them."""
    dice = random.Random(seed)
    people = [person.name for person in there.prepared.scene.people]
    doors = [door.name for door in there.prepared.scene.doors if door.kind != "opening"]
    kinds = ["wheel stuck", "speech fails", "sensor blind", "person walks off", "person in the way"]
    kinds += ["planner fails", "leaf raises", *(["door closes"] if doors else [])]

    def fault() -> dict[str, Any]:
        kind = dice.choice(kinds)
        found: dict[str, Any] = {"at_s": round(dice.uniform(0.0, there.faultless_s), 2), "fault": kind}
        for_s = round(dice.uniform(0.5, 5.0), 2)
        if kind in ("wheel stuck", "speech fails", "sensor blind", "person in the way"):
            found["for_s"] = for_s
        if kind == "person walks off":
            found |= {"person": dice.choice(people), "by_m": round(dice.uniform(0.5, 3.0), 2)}
            found["facing_deg"] = round(dice.uniform(-180.0, 180.0))
        if kind == "person in the way":
            found["person"] = "marta"
        if kind == "door closes":
            found |= {"door": dice.choice(doors)} | ({"for_s": 3 * for_s} if dice.random() < 0.7 else {})
        if kind == "planner fails":
            found["calls"] = dice.randint(1, 3)
        if kind == "leaf raises":
            found |= {"leaf": dice.choice(there.leaves).name, "times": dice.randint(1, 3)}
        return found

    return [fault() for _ in range(dice.randint(1, 3))]


def episode(seed: int) -> dict[str, Any]:
    """One schedule, and what judge and oracle say of it."""
    there = place_of(seed)
    faults = schedule(seed, there)
    answer: dict[str, Any] = {"seed": seed, "place": there.prepared.file.scenario.name, "faults": faults}
    try:
        ran = played(there, faults, seed)
    except Exception as error:
        return answer | {"exception": f"{type(error).__name__}: {error}"}
    seconds = float(ran.frames.time_s[-1])
    return answer | judged(ran, faults) | {"seconds": seconds, "ratio": seconds / there.faultless_s}


def played(there: Place, faults: list[dict[str, Any]], seed: int) -> Episode:
    """The visits of a place with these faults."""
    entries = TypeAdapter(tuple[Fault, ...]).validate_python(faults)
    file = there.prepared.file
    file = replace(file, scenario=file.scenario.model_copy(update={"faults": entries}))
    return _ran(there.prepared, Faults(file, there.prepared.scene, there.leaves).happenings(), seed)


def _ran(prepared: PlannedEpisode, happenings: tuple[Happening, ...], seed: int = 0) -> Episode:
    live = LiveEpisode(prepared, seed=seed, happenings=happenings)
    live.run()
    return live.so_far()


def judged(ran: Episode, faults: list[dict[str, Any]]) -> dict[str, Any]:
    """What came of it: from the frames, the floor plan and the schedule, but for the outcome itself."""
    tracks, scene = tracks_of(ran), ran.prepared.scene
    contacts = [*contacts_with_people(tracks), *contacts_with_things(tracks, outlines(scene, set()))]
    return {
        "outcome": ran.outcome,
        "at_rest": max(speed for _, speed in speeds(tracks["robot"])[-3:]) < AT_REST_M_S,
        "by_robot": [contact.entity for contact in contacts if contact.by_robot],
        "possible": is_possible(ran, tracks, faults),
    }


def is_possible(ran: Episode, tracks: dict[str, list[Body]], faults: list[dict[str, Any]]) -> bool:
    """Whether whoever was not greeted when the last fault was over could still be reached from there."""
    scene, scenario, over_s = ran.prepared.scene, ran.prepared.file.scenario, over(faults)
    shut = doors_shut(scene, faults)
    robot = next((body for body in tracks["robot"] if body.t >= over_s), tracks["robot"][-1])
    done = {act.person for act in ran.acts if not act.stopped and act.t_end <= over_s}
    left = [name for name in scenario.visited() if name not in done]
    return all(is_reachable(scene, shut, tracks, robot, name) for name in left) and in_time(ran, over_s)


def over(faults: list[dict[str, Any]]) -> float:
    """When the last fault is over; whoever walks gets 4 s for it, there and back."""
    walks_s = {"person walks off": 4.0, "person in the way": 8.0}
    return max(f["at_s"] + f.get("for_s", 0.0) + walks_s.get(f["fault"], 0.0) for f in faults)


def tracks_of(ran: Episode) -> dict[str, list[Body]]:
    """The frames as the judge reads them."""
    tracks: dict[str, list[Body]] = {name: [] for name in ran.frames.entities}
    for t, entity, x, y, heading, radius in ran.frames.rows():
        tracks[entity].append(Body(t, x, y, heading, radius))
    return tracks


def doors_shut(scene: Scene, faults: list[dict[str, Any]]) -> set[str]:
    """Those that are shut in the end: from the start, or for good, whatever else shuts them for a while."""
    from_start = {door.name for door in scene.doors if not door.is_open}
    return from_start | {fault["door"] for fault in faults if "door" in fault and "for_s" not in fault}


def in_time(ran: Episode, over_s: float) -> bool:
    """Whether the limit leaves time for everybody after the last fault, whatever was done before it."""
    scenario, scene = ran.prepared.file.scenario, ran.prepared.scene
    xs, ys = zip(*scene.room.corners, strict=True)
    farthest_m = 2 * (max(xs) - min(xs) + max(ys) - min(ys))
    return over_s + len(scenario.visited()) * (farthest_m / WALKS_M_S + GREETS_S) <= scenario.limits.time_s


def outlines(scene: Scene, shut: set[str]) -> dict[str, tuple[list[tuple[float, float]], float]]:
    """All that stands still, as lines with half a thickness."""
    found = {"room": ([*scene.room.corners, scene.room.corners[0]], 0.0)}
    found |= {piece.name: ([*piece.corners, piece.corners[0]], 0.0) for piece in scene.furniture}
    found |= {f"wall {i}": ([w.start, w.end], w.thickness_m / 2) for i, w in enumerate(scene.walls)}
    found |= {
        f"door {door.name}": ([door.start, door.end], door.thickness_m / 2)
        for door in scene.doors
        if door.name in shut
    }
    return found


def is_reachable(scene: Scene, shut: set[str], tracks: dict[str, list[Body]], robot: Body, name: str) -> bool:
    """Whether a flood of 5 cm cells gets from the robot to where a person can be greeted in the end."""
    met = tracks[name][-1]
    lines = outlines(scene, shut)
    xs, ys = zip(*scene.room.corners, strict=True)
    x, y = np.meshgrid(
        np.arange(min(xs), max(xs), CELL_M), np.arange(min(ys), max(ys), CELL_M), indexing="ij"
    )
    free = np.ones(x.shape, dtype=bool)
    for corners, half_m in lines.values():
        for start, end in pairwise(corners):
            free &= _to_line(x, y, start, end) > WALL_M + half_m
    people = [track[-1] for entity, track in tracks.items() if entity != "robot"]
    for person in people:
        free &= np.hypot(x - person.x, y - person.y) > person.radius_m + robot.radius_m + PERSON_M
    away = np.hypot(x - met.x, y - met.y) - met.radius_m - robot.radius_m
    turn = np.arctan2(y - met.y, x - met.x) - met.heading_rad
    goal = free & (away >= NEAREST_M) & (away <= FARTHEST_M) & (np.cos(turn) > 0.0)
    cells = zip(*np.nonzero(goal & _flooded(free, x, y, robot)), strict=True)
    return any(_sees((float(x[cell]), float(y[cell])), (met.x, met.y), lines) for cell in cells)


def _flooded(free: NDArray[np.bool_], x: NDArray[np.float64], y: NDArray[np.float64], robot: Body) -> Any:
    """The free cells that hang together with one within 15 cm of the robot, which may stand at a margin."""
    reached = free & (np.hypot(x - robot.x, y - robot.y) < 0.15)
    queue = deque(zip(*np.nonzero(reached), strict=True))
    while queue:
        i, j = queue.popleft()
        for k, m in ((i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)):
            if 0 <= k < free.shape[0] and 0 <= m < free.shape[1] and free[k, m] and not reached[k, m]:
                reached[k, m] = True
                queue.append((k, m))
    return reached


def _to_line(x: Any, y: Any, start: tuple[float, float], end: tuple[float, float]) -> Any:
    dx, dy = end[0] - start[0], end[1] - start[1]
    share = np.clip(((x - start[0]) * dx + (y - start[1]) * dy) / (dx * dx + dy * dy), 0.0, 1.0)
    return np.hypot(x - start[0] - share * dx, y - start[1] - share * dy)


def _sees(here: tuple[float, float], there: tuple[float, float], lines: dict[str, Any]) -> bool:
    """Whether no wall, door or furniture is between two places."""
    return not any(
        _crosses(here, there, start, end) for corners, _ in lines.values() for start, end in pairwise(corners)
    )


def _crosses(a: Any, b: Any, c: Any, d: Any) -> bool:
    def side(p: Any, q: Any, r: Any) -> bool:
        return (q[0] - p[0]) * (r[1] - p[1]) > (q[1] - p[1]) * (r[0] - p[0])

    return side(a, c, d) != side(b, c, d) and side(a, b, c) != side(a, b, d)


def is_lost(answer: dict[str, Any]) -> bool:
    """Whether the goal was within reach and not met."""
    return bool(answer["possible"]) and answer["outcome"] != "success"


def table(answers: list[dict[str, Any]]) -> Iterator[str]:
    """The table of the documentation."""
    yield "| schedules with | schedules | within reach | of these met | median time | contacts by the robot |"
    yield "|---" * 6 + "|"
    kinds = sorted({fault["fault"] for answer in answers for fault in answer["faults"]})
    for kind in (*kinds, None):
        chosen = [a for a in answers if kind is None or any(f["fault"] == kind for f in a["faults"])]
        yield row(kind or "any", chosen)
    broken = [a for a in answers if "exception" in a]
    moving = [a for a in answers if not a.get("at_rest", True)]
    outcomes = ", ".join(sorted({answer["outcome"] for answer in answers if "outcome" in answer}))
    yield f"\n{len(broken)} exceptions, {len(moving)} not at rest, outcomes {outcomes}"
    for answer in answers:
        if "exception" in answer or is_lost(answer) or answer["by_robot"] or not answer["at_rest"]:
            yield json.dumps(answer)


def row(kind: str, answers: list[dict[str, Any]]) -> str:
    """What came of schedules that have one kind of fault."""
    answers = [answer for answer in answers if "exception" not in answer]
    possible = [answer for answer in answers if answer["possible"]]
    met = [answer for answer in possible if answer["outcome"] == "success"]
    ratio = median(a["ratio"] if a in met else math.inf for a in possible) if possible else math.nan
    contacts = sum(len(answer["by_robot"]) for answer in answers)
    share = len(met) / max(1, len(possible))
    return f"| {kind} | {len(answers)} | {len(possible)} | {share:.1%} | {ratio:.2f} x | {contacts} |"


def answers_of(count: int) -> list[dict[str, Any]]:
    """The judged episodes of the seeds from 0 on."""
    return studied("faults", episode, [(seed,) for seed in range(count)])


if __name__ == "__main__":
    print(*table(answers_of(int(sys.argv[1]) if len(sys.argv) > 1 else 1000)), sep="\n")
