"""The study of visits through a hall in which passers-by walk about, and now and then stop before the robot.

`python tests/hall_study.py [SEEDS]` prints the table of docs/reference/docking.md: 200 seeds for each
kind of robot and of passers-by. The judge (`judging`) reads the frames.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import astuple, dataclass
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from fault_study import tracks_of
from judging import contacts_with_people
from studying import studied

from comity.live_episode import execute
from comity.preparation import PlannedEpisode, prepare
from comity.scenario import load_scenario

HALL = """\
schema_version: 1
name: hall
place: {{width_m: 8.0, height_m: 5.0}}
robot: {{at_m: [0.8, 2.5]{robot}}}
people:
  ann: {{profile: german_woman, at_m: [7.3, 2.5], facing_deg: 180}}
passers_by: {{{passing}}}
goals: [{{greet: ann}}]
limits: {{time_s: 90}}
"""
KINDS = {
    "omnidirectional, 4 who take it for a thing": ("", "count: 4, reacts: impassive"),
    "the same, only 2": ("", "count: 2, reacts: impassive"),
    "3 cm and 100 ms": (", sensor: {noise_m: 0.03, delay_s: 0.1}", "count: 4, reacts: impassive"),
    "two wheels": (", drive: differential", "count: 4, reacts: impassive"),
    "two wheels, 1 m/s³": (", drive: differential, max_jerk_m_s3: 1", "count: 4, reacts: impassive"),
    "omnidirectional, 4 who walk around it": ("", "count: 4"),
    "1 m/s³, 6 who walk around it": (", max_jerk_m_s3: 1", "count: 6"),
}
"""What the robot has besides, and who passes by."""


@dataclass(frozen=True)
class Crossing:
    """What came of one episode."""

    touches_by_robot: int
    served: bool
    took_s: float


@cache
def hall(kind: str) -> PlannedEpisode:
    """A hall of 8 x 5 m with somebody to greet at the other end."""
    robot, passing = KINDS[kind]
    with TemporaryDirectory() as folder:
        file = Path(folder) / "hall.scenario.yaml"
        file.write_text(HALL.format(robot=robot, passing=passing), encoding="utf-8")
        return prepare(load_scenario(str(file)))


def crossed(kind: str, seed: int) -> Crossing:
    """One episode, judged."""
    episode = execute(hall(kind), seed=seed)
    contacts = contacts_with_people(tracks_of(episode))
    by_robot = sum(contact.by_robot for contact in contacts)
    return Crossing(by_robot, episode.outcome == "success", episode.metrics.duration_s)


def crossings(kind: str, seeds: int) -> list[Crossing]:
    """The episodes of a kind with the seeds from 0 on."""
    rows = studied("halls", row, [(kind, seed) for seed in range(seeds)])
    return [Crossing(*each) for each in rows]


def row(kind: str, seed: int) -> tuple[int, bool, float]:
    """One episode as the study's file has it."""
    return astuple(crossed(kind, seed))


def table(seeds: int) -> Iterator[str]:
    """The rows of the docs, as they are done."""
    yield "| robot and passers-by | episodes | with contact by the robot | served | median | slowest |"
    yield "|---|---|---|---|---|---|"
    for kind in KINDS:
        found = crossings(kind, seeds)
        took = [one.took_s for one in found]
        touched = sum(one.touches_by_robot > 0 for one in found)
        served = sum(one.served for one in found)
        yield (
            f"| {kind} | {len(found)} | {touched} | {served / len(found):.2%} "
            f"| {np.median(took):.1f} s | {max(took):.1f} s |"
        )


if __name__ == "__main__":
    for line in table(int(sys.argv[1]) if len(sys.argv) > 1 else 200):
        print(line, flush=True)
