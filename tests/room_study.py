"""The study of random rooms: whole episodes among people who stand, walk on errands and pass by.

`python tests/room_study.py [ROOMS]` prints a table of 1,000 rooms of the kind `stand`, and 500 each of `walk`
(some walk along routes of the scenario) and `mix` (passers-by, too), one of 40 rooms in which people stay,
step aside or let the robot pass when it asks, one that compares profiles in the same rooms, and one of
robots that do not see all round. Rooms are drawn from a wide range: one to three parts with doorways,
furniture, both drives, noise and delay of the sensors, short sight. The judge (`judging`) reads the frames.
"""

from __future__ import annotations

import math
import random
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from fault_study import tracks_of
from judging import contacts_with_people
from numpy.typing import NDArray
from studying import studied

from comity.live_episode import execute
from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario
from comity_fis.errors import ComityError
from comity_sim2d import Frames, RobotBody, Sensor, World
from comity_sim2d.robot.reduced_margin import least_margin_m

Numbers = NDArray[np.float64]
KINDS = ("stand", "walk", "mix")
ANSWERS = {"stay": "", "step aside": ", steps_aside: true", "let pass": ", lets_pass: true"}
"""The rooms of the kind `stand` by what people do when the robot asks to pass: everyone declares the facts
that a reduced margin depends on, and the robot has the least margin that it can keep."""
MANY = {"stand": 1000, "walk": 500, "mix": 500, "stay": 40, "step aside": 40, "let pass": 40}
ROOMS_BY_PROFILE = 20
"""Of each kind; nine profiles meet the same rooms."""
NAMES = ("ada", "ben", "cyd", "dot", "eli", "fay", "gus", "hal")
PROFILES = (
    "arab_man", "arab_woman", "british_elder", "german_man", "german_woman", "indian_man", "japanese_woman",
    "swedish_regular", "unknown",
)  # fmt: skip
VIEWS_DEG, ROOMS_BY_VIEW = (360, 180, 120, 60), 60
"""Fields of view of robots that meet the same rooms of the kinds `walk` and `mix`, so many of each."""
APART_M = 0.6
"""So far from one another people, ends of walks and the middles of furniture are."""
DRAWS = 60
FLOOR_M, SLACK_M = 0.30, 0.005
"""What the robot keeps from people, and by how much its route may cut that."""
CUTS_M, SLOW_M_S = 0.02, 0.21
"""By how much a robot cuts its bends, and how fast it leaves a margin, a tick's change included."""
DECLARED = "age: 40, hearing: good, sight: good, mobility: full"
MOVES_M_S = 0.02
"""Slower towards a person, it stands."""


def room(kind: str, seed: int, draw: int = 0, profile: str | None = None, view_deg: float = 360.0) -> str:
    """The text of a scenario; some draws put people onto furniture, and are refused.

    Args:
        kind: One of `KINDS` or `ANSWERS`.
        seed: Decides the room.
        draw: Further rooms of this seed.
        profile: Of everybody; without it each person has one by chance.
        view_deg: The robot's field of view.
    """
    answers = kind in ANSWERS
    drawn = "stand" if answers else kind
    dice = random.Random(f"{drawn} {seed} {draw}")
    wide, high = dice.uniform(6.0, 10.5), dice.uniform(4.6, 7.5)
    taken: list[tuple[float, float]] = []

    def spot() -> tuple[float, float]:
        while True:
            xy = round(dice.uniform(0.5, wide - 0.5), 3), round(dice.uniform(0.5, high - 0.5), 3)
            if all(math.dist(xy, other) > APART_M for other in taken):
                taken.append(xy)
                return xy

    lines = ["schema_version: 1", f"name: {kind}-{seed}"]
    lines += [f"place:\n  width_m: {wide:.3f}\n  height_m: {high:.3f}", *_walls(dice, wide, high)]
    if pieces := dice.randint(0, 4):
        lines.append("  furniture:")
        for i in range(pieces):
            size = f"{dice.uniform(0.3, 1.4):.3f}, {dice.uniform(0.3, 1.0):.3f}"
            x, y = spot()
            lines.append(
                f"    - {{name: box {i}, box_m: [{x}, {y}, {size}], angle_deg: {dice.uniform(0, 180):.1f}}}"
            )
    lines += [f"robot: {{at_m: {list(spot())}, {_robot(dice, answers, view_deg)}}}", "people:"]
    for name in NAMES:
        walks = drawn != "stand" and dice.random() < 0.45
        way = f", walks: {_walk(dice, spot)}" if walks else ""
        way += f", situation: {{{DECLARED}}}{ANSWERS[kind]}" if answers else ""
        turned = f"facing_deg: {dice.uniform(-180, 180):.1f}"
        chosen = dice.choice(PROFILES)  # thrown in any case: the rest of the room is the same
        lines.append(f"  {name}: {{profile: {profile or chosen}, at_m: {list(spot())}, {turned}{way}}}")
    if kind == "mix":
        lines.append(f"passers_by: {{count: {dice.randint(1, 5)}, reacts: regular}}")
    goals = dice.sample(NAMES, dice.randint(1, 3))
    lines += ["goals:", *(f"  - greet: {name}" for name in goals)]
    lines.append(f"limits: {{time_s: {dice.choice([90, 150])}, planning_s: 10}}")
    return "\n".join(lines) + "\n"


def _walls(dice: random.Random, wide: float, high: float) -> list[str]:
    """Walls that divide the floor, each with a doorway."""
    rooms = dice.choice([1, 1, 2, 3])
    found = []
    for i in range(1, rooms):
        x, gap = wide * i / rooms, dice.uniform(1.0, 1.6)
        low = dice.uniform(0.3, high - gap - 0.3)
        found += [
            f"[[{x:.3f}, 0.0], [{x:.3f}, {low:.3f}]]",
            f"[[{x:.3f}, {low + gap:.3f}], [{x:.3f}, {high:.3f}]]",
        ]
    return [f"  walls_m: [{', '.join(found)}]"] if found else []


def _robot(dice: random.Random, reduces_margin: bool, view_deg: float) -> str:
    noise, delay = dice.choice([(0.0, 0.0), (0.0, 0.0), (0.03, 0.1), (0.05, 0.2)])
    sensor = [f"noise_m: {noise}, delay_s: {delay}"] if noise else []
    sensor += ["range_m: 3.9"] if dice.random() < 0.2 else []
    sensor += ["hidden_by_walls: true"] if dice.random() < 0.5 else []
    sensor += [f"field_of_view_deg: {view_deg:g}"] if view_deg < 360.0 else []
    drive = dice.choice(["omnidirectional", "differential"])
    jerk = dice.choice([20.0, 20.0, 1.0])
    text = f"facing_deg: {dice.uniform(-180, 180):.1f}, drive: {drive}, max_jerk_m_s3: {jerk}"
    text += f", sensor: {{{', '.join(sensor)}}}" if sensor else ""
    return text + (f", margin_m: {_margin_m(noise, delay, jerk):g}" if reduces_margin else "")


def _margin_m(noise_m: float, delay_s: float, jerk_m_s3: float) -> float:
    """The least margin that the robot can keep [m], in whole millimetres, and the full one at most."""
    sensor = Sensor(sigma_m=noise_m, delay_s=delay_s)
    least_m = least_margin_m(RobotBody(0.0, 0.0, max_jerk_m_s3=jerk_m_s3, sensor=sensor))
    return min(FLOOR_M, math.ceil(1000.0 * least_m) / 1000.0)


def _walk(dice: random.Random, spot: Any) -> str:
    points = [list(spot()) for _ in range(dice.randint(2, 3))]
    loop, stops = dice.random() < 0.8, dice.random() < 0.4
    return (
        f"{{route: {points}, loop: {str(loop).lower()}, speed_m_s: {dice.choice([0.4, 0.7, 1.1, 1.6])}, "
        f"pause_s: {dice.choice([0, 1, 3])}, stops: {str(stops).lower()}}}"
    )


def prepared(kind: str, seed: int, profile: str | None = None, view_deg: float = 360.0) -> PlannedEpisode:
    """The planned episode of the first draw that is a room."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / f"{kind}{seed}.scenario.yaml"
        for draw in range(DRAWS):
            file.write_text(room(kind, seed, draw, profile, view_deg), encoding="utf-8")
            try:
                case = prepare(load_scenario(str(file)))
                World(
                    case.scene, seed
                )  # refuses walks through walls, and more passers-by than there is room for
            except ComityError:
                continue
            return case
    raise AssertionError(f"no room in {DRAWS} draws")


def episode(kind: str, seed: int, profile: str | None = None, view_deg: float = 360.0) -> dict[str, Any]:
    """What came of one room, judged."""
    case = prepared(kind, seed, profile, view_deg)
    start = time.process_time()
    got = execute(case, seed=seed)
    cpu_s, tracks = time.process_time() - start, tracks_of(got)
    simulated_s = float(got.frames.time_s[-1])
    contacts = contacts_with_people(tracks)
    return {
        "kind": kind,
        "seed": seed,
        "profile": profile,
        "view_deg": view_deg,
        "noisy": case.scene.robot.sensor.sigma_m > 0.0,
        "drive": case.scene.robot.drive,
        "outcome": got.outcome,
        "served": sum(visit.outcome == "greeted" for visit in got.visits),
        "asked": len(got.visits),
        "by_robot": sum(contact.by_robot for contact in contacts),
        "by_people": sum(not contact.by_robot for contact in contacts),
        "intrusions": intrusions(got.frames),
        **inside_margins(got.frames),
        "margin_m": case.scene.robot.margin_m,
        "below_margin": intrusions(got.frames, case.scene.robot.margin_m),
        "passages": sum(told.kind == "passage" and "keeps" not in told.text for told in got.disturbances),
        "simulated_s": simulated_s,
        "cpu_ms": 1000.0 * cpu_s / simulated_s,
    }


def distances(frames: Frames) -> tuple[Numbers, Numbers, Numbers]:
    """From the robot to each person: the vector and the distance between the centres, and the gap [m]."""
    at = frames.poses[:, :, :2]
    apart = at[:, 1:] - at[:, :1]
    far_m = np.hypot(apart[..., 0], apart[..., 1])
    return apart, far_m, far_m - frames.radius_m[1:] - frames.radius_m[0]


def intrusions(frames: Frames, floor_m: float = FLOOR_M) -> int:
    """How often the robot's own motion began to bring it nearer to a person than the floor."""
    at = frames.poses[:, :, :2]
    apart, far_m, gap_m = distances(frames)
    moved = np.diff(at[:, 0], axis=0)[:, None]
    closing = (
        (moved * apart[:-1]).sum(axis=2) / np.maximum(far_m[:-1], 1e-9) / np.diff(frames.time_s)[:, None]
    )
    own = (gap_m[1:] < floor_m - SLACK_M) & (closing > MOVES_M_S)
    return int(own[0].sum() + (own[1:] & ~own[:-1]).sum())


def inside_margins(frames: Frames) -> dict[str, float]:
    """How long the robot drove inside the margin of somebody who stood, and how long fast past them [s]."""
    steps_s = np.diff(frames.time_s)
    apart, far_m, gap_m = (each[1:] for each in distances(frames))
    velocity = np.diff(frames.poses[:, :, :2], axis=0) / steps_s[:, None, None]
    speed = np.hypot(velocity[..., 0], velocity[..., 1])
    drives, stands = speed[:, :1] > MOVES_M_S, speed[:, 1:] < MOVES_M_S
    inside = (gap_m < FLOOR_M - CUTS_M) & stands & drives
    closing = (velocity[:, :1] * apart).sum(axis=2) / np.maximum(far_m, 1e-9)
    past = inside & (speed[:, :1] > SLOW_M_S) & (closing > -speed[:, :1] / 2)  # not away: 60 degrees off
    return {
        "inside_s": float(steps_s[inside.any(axis=1)].sum()),
        "fast_past_s": float(steps_s[past.any(axis=1)].sum()),
        "nearest_m": float(gap_m[inside].min(initial=FLOOR_M)),
    }


def tables(rooms: int | None = None) -> Iterator[str]:
    """The tables of the docs.

    Args:
        rooms: Of each kind; without it the numbers of `MANY`.
    """
    yield from table([line for kind in KINDS for line in rooms_of(kind, rooms or MANY[kind])])
    yield ""
    yield from by_answer([line for kind in ANSWERS for line in rooms_of(kind, rooms or MANY[kind])])
    yield ""
    yield from by_profile(profile_rows(rooms or ROOMS_BY_PROFILE))
    yield ""
    yield from by_view(view_rows(rooms or ROOMS_BY_VIEW))


def rooms_of(kind: str, rooms: int) -> list[dict[str, Any]]:
    """The judged episodes of a kind of room with the seeds from 0 on."""
    return studied("rooms", episode, [(kind, seed) for seed in range(rooms)])


def profile_rows(rooms: int) -> list[dict[str, Any]]:
    """So many rooms of each kind, each with everybody of one profile, for every profile."""
    cases = [(kind, seed, profile) for kind in KINDS for seed in range(rooms) for profile in PROFILES]
    return studied("rooms", episode, cases)


def view_rows(rooms: int) -> list[dict[str, Any]]:
    """So many rooms with walkers of each kind, for every field of view."""
    cases = [
        (kind, seed, None, view) for kind in ("walk", "mix") for seed in range(rooms) for view in VIEWS_DEG
    ]
    return studied("rooms", episode, cases)


TOTALS = ("by_robot", "by_people", "intrusions", "inside_s", "fast_past_s", "served", "asked", "simulated_s")


def table(lines: list[dict[str, Any]]) -> Iterator[str]:
    """The table by kind of room."""
    yield (
        "| rooms | episodes | contacts by the robot | by people | nearer than 0.30 m by itself "
        "| simulated hours | seconds inside a margin | seconds fast past a person "
        "| visits served | seconds, median | ms of CPU a simulated second, median / 90th percentile |"
    )
    yield "|---" * 11 + "|"
    for kind in KINDS:
        for noisy in (False, True):
            chosen = [line for line in lines if (line["kind"], line["noisy"]) == (kind, noisy)]
            if not chosen:
                continue
            total = {key: sum(line[key] for line in chosen) for key in TOTALS}
            took = np.median([line["simulated_s"] for line in chosen])
            median, high = np.percentile([line["cpu_ms"] for line in chosen], (50, 90))
            yield (
                f"| {kind}, {'noisy' if noisy else 'perfect'} sensors | {len(chosen)} | {total['by_robot']} "
                f"| {total['by_people']} | {total['intrusions']} | {total['simulated_s'] / 3600.0:.1f} "
                f"| {total['inside_s']:.0f} | {total['fast_past_s']:.0f} "
                f"| {total['served'] / total['asked']:.1%} "
                f"| {took:.0f} | {median:.0f} / {high:.0f} |"
            )


def by_answer(lines: list[dict[str, Any]]) -> Iterator[str]:
    """The table by what people do when they are asked to let the robot pass, in the same rooms."""
    yield (
        "| people, and the robot's margin | rooms | visits served | seconds, mean | contacts by the robot "
        "| by people | passages | nearer than 0.30 m by itself | nearer than its margin |"
    )
    yield "|---" * 9 + "|"
    keys = ("by_robot", "by_people", "passages", "intrusions", "below_margin", "served", "asked")
    for reduced in (True, False):
        for kind in ANSWERS:
            chosen = [
                line for line in lines if line["kind"] == kind and (line["margin_m"] < FLOOR_M) == reduced
            ]
            if not chosen:
                continue
            total = {key: sum(line[key] for line in chosen) for key in keys}
            took_s = np.mean([line["simulated_s"] for line in chosen])
            yield (
                f"| {kind}, {'less than 0.30 m' if reduced else '0.30 m'} | {len(chosen)} "
                f"| {total['served'] / total['asked']:.1%} | {took_s:.1f} | {total['by_robot']} "
                f"| {total['by_people']} | {total['passages']} | {total['intrusions']} "
                f"| {total['below_margin']} |"
            )


OUTCOMES = ("served_share", "simulated_s", "intrusions")
"""What is compared between profiles."""


def differences(lines: list[dict[str, Any]], profile: str, outcome: str) -> tuple[float, float]:
    """Mean difference of a profile from `unknown` in the same rooms, and its Monte Carlo standard error."""
    values = {(each["profile"], each["kind"], each["seed"]): _outcomes(each)[outcome] for each in lines}
    rooms = sorted({key[1:] for key in values})
    found = np.array([values[profile, *room] - values["unknown", *room] for room in rooms])
    return float(found.mean()), float(found.std(ddof=1) / math.sqrt(len(found)))


def _outcomes(line: dict[str, Any]) -> dict[str, float]:
    return line | {"served_share": line["served"] / line["asked"]}


def by_profile(lines: list[dict[str, Any]]) -> Iterator[str]:
    """The table by profile: means of `unknown`, and differences from it in the same rooms."""
    yield "| everybody is | rooms | visits served | seconds | nearer than 0.30 m by itself |"
    yield "|---" * 5 + "|"
    unknown = [_outcomes(line) for line in lines if line["profile"] == "unknown"]
    means = (float(np.mean([line[outcome] for line in unknown])) for outcome in OUTCOMES)
    served, took, near = means
    yield f"| `unknown` | {len(unknown)} | {served:.1%} | {took:.1f} | {near:.3f} |"
    for profile in (each for each in PROFILES if each != "unknown"):
        found = dict(zip(OUTCOMES, (differences(lines, profile, each) for each in OUTCOMES), strict=True))
        served, took, near = (
            f"{100 * found['served_share'][0]:+.1f} ± {200 * found['served_share'][1]:.1f} points",
            f"{found['simulated_s'][0]:+.1f} ± {2 * found['simulated_s'][1]:.1f}",
            f"{found['intrusions'][0]:+.3f} ± {2 * found['intrusions'][1]:.3f}",
        )
        yield f"| `{profile}` | {len(unknown)} | {served} | {took} | {near} |"


def by_view(lines: list[dict[str, Any]]) -> Iterator[str]:
    """The table by the robot's field of view, in the same rooms."""
    yield "| field of view | rooms | contacts by the robot | by people | visits served | simulated hours |"
    yield "|---" * 6 + "|"
    for view in VIEWS_DEG:
        chosen = [line for line in lines if line["view_deg"] == view]
        total = {key: sum(line[key] for line in chosen) for key in TOTALS}
        yield (
            f"| {view}° | {len(chosen)} | {total['by_robot']} | {total['by_people']} "
            f"| {total['served'] / total['asked']:.1%} | {total['simulated_s'] / 3600.0:.1f} |"
        )


if __name__ == "__main__":
    print(*tables(int(sys.argv[1]) if len(sys.argv) > 1 else None), sep="\n")
