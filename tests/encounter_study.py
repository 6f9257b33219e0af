"""The study of encounters: random rooms with people who stand and people who walk, judged from the frames.

`python tests/encounter_study.py [EPISODES]` prints the table of docs/reference/docking.md: 10,000 rooms and a
fifth as many of each of the other two kinds. From seed 100,000 on, those who walk are passers-by who react to
the robot, each room's in one of the six ways. From seed 200,000 on, rooms are as the first, and the robot's
base takes up commands slowly.
"""

from __future__ import annotations

import heapq
import math
import random
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace

from judging import Body, contacts_with_people, contacts_with_things, touches_lines
from studying import studied

from comity_sim2d import (
    DockingPose,
    Frames,
    Furniture,
    PassersBy,
    Person,
    RobotBody,
    Room,
    RouteMap,
    Scene,
    SceneError,
    Sensor,
    Wall,
    World,
    docked,
    pose_blocker,
    side_name,
    spot_pose,
)
from comity_sim2d.scene.robot_reaction import REACTIONS

SIDES = {"front": 0.0, "left": 50.0, "right": -50.0}
PASSERS_BY_FROM, SOFT_FROM = 100_000, 200_000
"""Rooms of these seeds have passers-by; and in these the robot has a low limit of jerk."""
LIMIT_S, STANDS_S = 60.0, 10.0
CELL_M, OUT_M = 0.05, 0.15
XY = tuple[float, float]


def random_scene(rng: random.Random) -> Scene:
    """A room with furniture and two to six people, everything where chance puts it without overlapping."""
    while True:
        wide, high = rng.uniform(5.0, 9.0), rng.uniform(4.0, 7.0)

        def spot(wide: float = wide, high: float = high) -> XY:
            return rng.uniform(0.4, wide - 0.4), rng.uniform(0.4, high - 0.4)

        furniture = tuple(
            Furniture.box(
                f"box {i}",
                *spot(),
                width_m=rng.uniform(0.3, 1.3),
                depth_m=rng.uniform(0.3, 1.0),
                angle_rad=rng.uniform(0.0, math.pi),
            )
            for i in range(rng.randint(0, 6))
        )
        walls = tuple(
            Wall((x := rng.uniform(1.0, wide - 1.0), 0.0), (x, high / 2)) for _ in range(rng.randint(0, 1))
        )
        people = tuple(
            Person(
                f"p{i}", *spot(), rng.uniform(-math.pi, math.pi), personal_distance_m=rng.uniform(0.45, 1.2)
            )
            for i in range(rng.randint(2, 6))
        )
        sensor = Sensor(0.03, 0.1) if rng.random() < 0.5 else Sensor()
        drive = "differential" if rng.random() < 0.25 else "omnidirectional"
        robot = RobotBody(*spot(), rng.uniform(-3.0, 3.0), sensor=sensor, drive=drive)
        try:
            return Scene(Room.rectangle(wide, high), robot, people, walls, furniture)
        except SceneError:
            continue


def with_passers_by(scene: Scene, rng: random.Random) -> Scene:
    """The room with one to five passers-by who take the robot for one thing or another."""
    while True:
        passers_by = PassersBy(rng.randint(1, 5), reacts=rng.choice(REACTIONS))
        try:
            World(found := replace(scene, passers_by=passers_by))
        except SceneError:  # there is no room for so many
            continue
        return found


def with_soft_base(scene: Scene, rng: random.Random) -> Scene:
    """The room with a robot whose acceleration builds up for up to two seconds."""
    limits = {"max_acceleration_m_s2": rng.uniform(0.3, 1.5), "max_jerk_m_s3": 10.0 ** rng.uniform(-1.0, 0.7)}
    return replace(scene, robot=replace(scene.robot, **limits))


class Walks:
    """People who walk to and fro on straight lines, and do not look where they go, or wait for the robot."""

    def __init__(self, scene: Scene, rng: random.Random) -> None:
        self._ways: dict[str, tuple[XY, XY, float, bool]] = {}
        for person in scene.people[1:]:
            away, course = rng.uniform(1.0, 3.0), rng.uniform(-math.pi, math.pi)
            end = (person.x_m + away * math.cos(course), person.y_m + away * math.sin(course))
            if rng.random() < 0.7 and _is_open(scene, person, end):
                self._ways[person.name] = (person.xy, end, rng.uniform(0.4, 1.2), rng.random() < 0.5)
        self._way_m = dict.fromkeys(self._ways, 0.0)

    def __len__(self) -> int:
        return len(self._ways)

    def step(self, world: World) -> None:
        """A tick of everybody's walk."""
        for name, (start, end, speed, waits) in self._ways.items():
            person = next(person for person in world.people if person.name == name)
            length = math.dist(start, end)
            before, after = self._way_m[name], self._way_m[name] + speed / 20
            here, there = (_on(start, end, way, length) for way in (before, after))
            robot = world.robot.pose.xy
            nearer = math.dist(there, robot) < math.dist(here, robot)
            if waits and nearer and math.dist(there, robot) < 0.45 + 0.6:
                continue
            self._way_m[name] = after
            heading = math.atan2(there[1] - here[1], there[0] - here[0])
            world.move_person(person.name, *there, heading)


def _on(start: XY, end: XY, way_m: float, length: float) -> XY:
    """The place after so much way to and fro between two points."""
    share = abs((way_m / length + 1.0) % 2.0 - 1.0)
    return start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])


def _is_open(scene: Scene, person: Person, end: XY) -> bool:
    """Whether somebody can walk there in a straight line, and nobody stands in it."""
    others = [other.xy for other in scene.people if other is not person]
    for k in range(41):
        xy = (
            person.x_m + k / 40 * (end[0] - person.x_m),
            person.y_m + k / 40 * (end[1] - person.y_m),
        )
        if _blocked(scene, xy, person.radius_m + 0.05) or any(
            math.dist(xy, other) < 0.45 for other in others
        ):
            return False
    return True


def episode(seed: int) -> dict[str, object]:
    """One visit to p0, and what the judge says of it."""
    rng = random.Random(seed)
    scene = random_scene(rng)
    if seed >= SOFT_FROM:
        scene = with_soft_base(scene, rng)
    elif seed >= PASSERS_BY_FROM:
        scene = with_passers_by(scene, rng)
    walks = Walks(replace(scene, people=scene.people[:1]) if scene.passers_by else scene, rng)
    answer: dict[str, object] = {
        "seed": seed,
        "drive": scene.robot.drive,
        "noisy": scene.robot.sensor.sigma_m > 0.0,
        "walkers": len(walks),
    }
    if scene.passers_by:
        answer["passers_by"] = scene.passers_by.reacts
    if seed >= SOFT_FROM:
        answer["jerk_m_s3"] = round(scene.robot.max_jerk_m_s3, 2)
    wanted = rng.uniform(0.45, 1.2)
    free = list(_free_sides(scene, wanted))
    if not free:
        return answer | {"outcome": "no side is free"}
    side = rng.choice(free)
    pose = DockingPose(wanted, SIDES[side])
    world = World(scene, seed)
    outcome = _visit(world, walks, pose)
    stands = docked(world.robot.pose, scene.robot.radius_m, world.people[0])
    on_side = outcome == "docked" and side_name(stands.bearing_deg) == side
    return answer | judged(scene, world.frames) | {"outcome": outcome, "on_side": on_side}


def _free_sides(scene: Scene, distance_m: float) -> Iterator[str]:
    """The sides of p0 that planning takes for free."""
    routes = RouteMap(scene)
    for side, bearing in SIDES.items():
        goal = spot_pose(scene, "p0", distance_m, bearing).xy
        if pose_blocker(scene, "p0", distance_m, bearing) is None and routes.reaches(
            scene.robot.pose.xy, goal
        ):
            yield side


def _visit(world: World, walks: Walks, pose: DockingPose) -> str:
    """`docked`; `froze`: stood for 10 s though a way was free; `kept waiting`: there was none; `late`."""
    world.robot.navigate("p0", pose, speed_m_s=0.7)
    docks, still_since = False, 0.0
    while world.time_s < LIMIT_S:
        walks.step(world)
        before = world.robot.pose.xy
        world.step()
        motion = world.robot.motion()
        if motion.state == "succeeded" and docks:
            return "docked"
        if motion.state in {"succeeded", "stopped"}:
            world.robot.dock("p0", pose, speed_m_s=0.5)
            docks = True
        if world.robot.emergency() is not False:
            docks = False
        elif motion.text.startswith("bumped"):
            world.robot.navigate("p0", pose, speed_m_s=0.7)
        if math.dist(before, world.robot.pose.xy) > 0.001:
            still_since = world.time_s
        if world.time_s - still_since >= STANDS_S:
            return "froze" if _way_is_free(world, pose) else "kept waiting"
    return "late"


def judged(scene: Scene, frames: Frames) -> dict[str, object]:
    """The contacts, from the frames and the floor plan alone."""
    tracks: dict[str, list[Body]] = {name: [] for name in frames.entities}
    for t, entity, x, y, heading, radius in frames.rows():
        tracks[entity].append(Body(t, x, y, heading, radius))
    people = contacts_with_people(tracks)
    things = contacts_with_things(tracks, outlines(scene))
    return {
        "by_robot": sum(contact.by_robot for contact in (*people, *things)),
        "by_people": sum(not contact.by_robot for contact in people),
    }


def outlines(scene: Scene) -> dict[str, tuple[list[XY], float]]:
    """All that stands still, as lines."""
    found: dict[str, tuple[list[XY], float]] = {"room": ([*scene.room.corners, scene.room.corners[0]], 0.0)}
    for piece in scene.furniture:
        found[piece.name] = ([*piece.corners, piece.corners[0]], 0.0)
    for i, wall in enumerate(scene.walls):
        found[f"wall {i}"] = ([wall.start, wall.end], wall.thickness_m / 2)
    return found


def _way_is_free(world: World, pose: DockingPose) -> bool:
    """Whether a flood of 5 cm cells gets from the robot to the pose, by all margins and 2 cm more.

    Beside the robot only its body has to fit: it may have come nearer to things than its margins.
    """
    scene, goal = world.scene, spot_pose(world.scene, "p0", pose.distance_m, pose.bearing_deg).xy
    start = world.robot.pose.xy
    frames = world.frames
    bodies = zip(frames.poses[-1, 1:, :2].tolist(), frames.radius_m[1:], strict=True)
    discs = [(tuple(xy), radius_m + 0.25 + 0.32) for xy, radius_m in bodies]
    queue, seen = [(0.0, start)], {_cell(start)}
    while queue:
        _, (x, y) = heapq.heappop(queue)
        if math.dist((x, y), goal) < 2 * CELL_M:
            return True
        for dx, dy in ((CELL_M, 0.0), (-CELL_M, 0.0), (0.0, CELL_M), (0.0, -CELL_M)):
            there = (x + dx, y + dy)
            if _cell(there) in seen:
                continue
            seen.add(_cell(there))
            reach_m = scene.robot.radius_m if math.dist(there, start) < OUT_M else 0.32
            if not _blocked(scene, there, reach_m) and all(math.dist(there, at) > r for at, r in discs):
                heapq.heappush(queue, (math.dist(there, goal), there))
    return False


def _cell(xy: XY) -> tuple[int, int]:
    return round(xy[0] / CELL_M), round(xy[1] / CELL_M)


def _blocked(scene: Scene, xy: XY, reach_m: float) -> bool:
    """Whether a disc touches what stands still, by plain geometry."""
    body = Body(0.0, *xy, 0.0, reach_m)
    touching = any(touches_lines(body, *lines) for lines in outlines(scene).values())
    inside = any(_inside(xy, piece.corners) for piece in scene.furniture)
    return touching or inside or not _inside(xy, scene.room.corners)


def _inside(xy: XY, corners: Iterable[XY]) -> bool:
    """Whether a ray to the right crosses the outline an odd number of times."""
    points = list(corners)
    crossings = 0
    for (ax, ay), (bx, by) in zip(points, [*points[1:], points[0]], strict=True):
        if (ay > xy[1]) != (by > xy[1]) and xy[0] < ax + (xy[1] - ay) / (by - ay) * (bx - ax):
            crossings += 1
    return crossings % 2 == 1


def answers_of(count: int) -> list[dict[str, object]]:
    """The judged episodes of the seeds 0, 1, ..., and a fifth as many of the two other kinds of rooms."""
    firsts = {0: count, PASSERS_BY_FROM: count // 5, SOFT_FROM: count // 5}
    cases = [(seed,) for first, many in firsts.items() for seed in range(first, first + many)]
    return studied("encounters", episode, cases)


def table(answers: list[dict[str, object]]) -> Iterator[str]:
    """The table of the documentation."""
    yield (
        "| rooms | episodes | contacts by the robot | by people | froze | kept waiting | late | docked "
        "| on the side |"
    )
    yield "|---" * 9 + "|"
    rows = {
        "people stand, perfect sensors": lambda a: _is_plain(a) and not a["walkers"] and not a["noisy"],
        "people stand, 3 cm and 100 ms": lambda a: _is_plain(a) and not a["walkers"] and a["noisy"],
        "some walk, perfect sensors": lambda a: _is_plain(a) and a["walkers"] and not a["noisy"],
        "some walk, 3 cm and 100 ms": lambda a: _is_plain(a) and a["walkers"] and a["noisy"],
        "all of these": _is_plain,
        "passers-by who react": lambda a: "passers_by" in a,
        "a base with little jerk": lambda a: "jerk_m_s3" in a,
    }
    for text, belongs in rows.items():
        chosen = [a for a in answers if "by_robot" in a and belongs(a)]
        outcomes, count = Counter(a["outcome"] for a in chosen), max(len(chosen), 1)
        yield (
            f"| {text} | {len(chosen)} | {sum(a['by_robot'] for a in chosen)} "
            f"| {sum(a['by_people'] for a in chosen)} | {outcomes['froze'] / count:.2%} "
            f"| {outcomes['kept waiting'] / count:.2%} | {outcomes['late'] / count:.2%} "
            f"| {outcomes['docked'] / count:.2%} | {sum(a['on_side'] for a in chosen) / count:.2%} |"
        )


def _is_plain(answer: dict[str, object]) -> bool:
    return "passers_by" not in answer and "jerk_m_s3" not in answer


if __name__ == "__main__":
    print(*table(answers_of(int(sys.argv[1]) if len(sys.argv) > 1 else 10_000)), sep="\n")
