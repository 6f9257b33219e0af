"""The study of walkers: random rooms in which the robot is to greet a person who walks.

`python tests/walkers_study.py [ROOMS]` prints the table of docs/how-to/people-who-move.md, of 200 rooms
without a number. The rooms are those of `encounter_study`; in each the first person walks:

- `stops`: stops for a robot that comes up to them and turns to them;
- `passes`: walks on, whatever the robot does;
- `shies`: keeps away from the robot (HuNavSim's `scared`);
- `accompanied`: walks at 0.4 m/s at most, and has agreed that the robot goes along.

The others stand, or pass by. Judged from the frames alone: how long the robot went after the person from
behind, and whether it came nearer to a person who had declined.
"""

from __future__ import annotations

import math
import random
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from encounter_study import judged, random_scene
from studying import studied

from comity_domain import Plan, PlanStep, StepExplanation
from comity_executor import Execution
from comity_fis import load_rulebook
from comity_sim2d import DockingPose, Frames, PassersBy, Scene, SceneError, Walk, World

KINDS = {"stops": 0.40, "passes": 0.25, "shies": 0.15, "accompanied": 0.20}
"""How often each kind of walker is drawn."""
LIMIT_S, AGAIN_S = 120.0, 5.0
"""An episode ends after the first; a person who declined is asked for again for the second."""
BRAKES_S = 1.0
"""In this time a robot that drives at 0.5 m/s has come to rest, with a lag of 100 ms as well."""
MET, DECLINED, MISSED = "met", "declined", "missed"

BEHIND_DEG, NEAR_M, WALKS_M_S, CLOSES_M_S = 120.0, 3.6, 0.15, 0.1
"""The robot follows from behind: it is at a greater bearing from where the person faces and at a smaller
distance between the centres, the person walks faster, and the robot drives towards them faster (our choice;
the distance is where Hall's social space ends, The Hidden Dimension, 1966)."""


def random_walker(seed: int) -> tuple[str, Scene]:
    """The kind of walker and the room of a seed."""
    rng = random.Random(seed)
    kind = rng.choices(list(KINDS), list(KINDS.values()))[0]
    while True:
        scene = random_scene(rng)
        corners = np.array(scene.room.corners)
        low, high = corners.min(axis=0) + 0.5, corners.max(axis=0) - 0.5
        points = (low + (high - low) * (rng.random(), rng.random()) for _ in range(rng.randint(1, 3)))
        route = tuple((float(x), float(y)) for x, y in points)
        slow = kind == "accompanied"
        walk = Walk(
            route,
            loop=len(route) > 1 and rng.random() < 0.6,
            speed_m_s=rng.uniform(0.2, 0.4) if slow else rng.uniform(0.3, 1.4),
            pauses_s=(rng.uniform(0.0, 3.0),) * len(route) if rng.random() < 0.5 else (),
            stops=kind == "stops",
            accompanied=slow,
        )
        walker = replace(scene.people[0], walk=walk, reacts="scared" if kind == "shies" else None)
        passers_by = PassersBy(rng.choice((0, 0, 1, 2))) if rng.random() < 0.5 else None
        scene = replace(scene, people=(walker, *scene.people[1:]), passers_by=passers_by)
        try:
            World(scene, seed)
        except SceneError:  # a point that cannot be walked to, or no room for the passers-by
            continue
        return kind, scene


def plan_of_one_visit(distance_m: float) -> Plan:
    """To reach the first person, and greet them in words and with a wave."""
    parameters = {"conversational_distance": distance_m, "approach_bearing": 0.0, "approach_speed": 0.4}
    parameters = {**parameters, "volume": 0.5, "speech_rate": 1.0}
    why = StepExplanation("by hand", ())
    steps = (
        PlanStep("Reach_user", ("robot", "p0", "front"), None, parameters, 0, why),
        PlanStep("Greet_person", ("robot", "p0", "both", "wave"), None, parameters, 0, why),
    )
    return Plan(engine="none", optimal=False, reproducible=True, cost=0, steps=steps)


def episode(seed: int) -> dict[str, object]:
    """One visit to the walker, and what the judge says of it."""
    kind, scene = random_walker(seed)
    world = World(scene, seed)
    values = load_rulebook("bruno2017").infer({"individualism": 67.0, "gender": "female"})
    distance_m = scene.people[0].personal_distance_m or 0.64
    execution = Execution(plan_of_one_visit(distance_m), world.robot, {"p0": values})
    while execution.tick() == "running" and world.time_s < LIMIT_S:
        world.step()
    execution.stop("the time is up", halt="timed_out")
    visit = execution.visits[0]
    answer: dict[str, object] = {
        "seed": seed,
        "kind": kind,
        "outcome": {"greeted": MET, "declined": DECLINED}.get(visit.outcome, MISSED),
        "time_s": round(world.time_s, 2),
        "why": visit.failure,
        "behind_s": round(longest_behind_s(world.frames), 2),
    }
    if visit.outcome == "declined":
        answer["approached_m"] = round(approached_again_m(world, distance_m), 3)
    return answer | judged(scene, world.frames)


def approached_again_m(world: World, distance_m: float) -> float:
    """How much nearer the robot drives, once at rest, where it is sent again to a person who declined [m]."""
    world.robot.navigate("p0", DockingPose(distance_m, 0.0), speed_m_s=0.7)
    world.run(BRAKES_S)
    before = len(world.frames.time_s)
    world.run(AGAIN_S)
    robot, walker = (world.frames.of(name)[before:, :2] for name in ("robot", "p0"))
    apart = (walker - robot)[:-1]
    nearer_m = (np.diff(robot, axis=0) * apart).sum(axis=1) / np.maximum(np.hypot(*apart.T), 1e-9)
    return float(np.maximum(nearer_m, 0.0).sum())


def longest_behind_s(frames: Frames, person: str = "p0") -> float:
    """The longest time without a break in which the robot drove after a person who walked away [s]."""
    robot, walker, time_s = frames.of("robot"), frames.of(person), frames.time_s
    step_s = np.diff(time_s)
    apart = walker[:-1, :2] - robot[:-1, :2]
    away_m = np.hypot(*apart.T)
    walked, driven = (np.diff(track[:, :2], axis=0) / step_s[:, None] for track in (walker, robot))
    bearing = np.arctan2(-apart[:, 1], -apart[:, 0]) - walker[:-1, 2]
    behind = np.abs(np.angle(np.exp(1j * bearing))) > math.radians(BEHIND_DEG)
    closes = (driven * apart).sum(axis=1) / np.maximum(away_m, 1e-9) > CLOSES_M_S
    follows = behind & closes & (away_m < NEAR_M) & (np.hypot(*walked.T) > WALKS_M_S)
    longest_s = now_s = 0.0
    for is_behind, dt in zip(follows.tolist(), step_s.tolist(), strict=True):
        now_s = now_s + dt if is_behind else 0.0
        longest_s = max(longest_s, now_s)
    return longest_s


def episodes(count: int) -> list[dict[str, object]]:
    """The judged visits of the seeds 0, 1, ..."""
    return studied("walkers", episode, [(seed,) for seed in range(count)])


def table(answers: list[dict[str, object]]) -> Iterator[str]:
    """The table of the documentation."""
    yield (
        "| the person | rooms | met | declined | missed | followed from behind for over 1 s | longest "
        "| approached after declining | contacts by the robot |"
    )
    yield "|---" * 9 + "|"
    for kind in (*KINDS, "all"):
        chosen = [answer for answer in answers if kind in (answer["kind"], "all")]
        outcomes, count = Counter(answer["outcome"] for answer in chosen), max(len(chosen), 1)
        shares = " | ".join(f"{outcomes[outcome] / count:.0%}" for outcome in (MET, DECLINED, MISSED))
        behind_s = [float(str(answer["behind_s"])) for answer in chosen]
        yield (
            f"| {kind} | {len(chosen)} | {shares} | {sum(s > 1.0 for s in behind_s) / count:.0%} "
            f"| {max(behind_s, default=0.0):.1f} s "
            f"| {sum(float(str(answer.get('approached_m', 0.0))) > 0.1 for answer in chosen)} "
            f"| {sum(int(str(answer['by_robot'])) for answer in chosen)} |"
        )


if __name__ == "__main__":
    print(*table(episodes(int(sys.argv[1]) if len(sys.argv) > 1 else 200)), sep="\n")
