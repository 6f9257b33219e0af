"""`comity study collect`: a session with one participant, each answer on disk before the next question."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, At, day, print_json

if TYPE_CHECKING:
    from collections.abc import Callable


CollectionName = Annotated[
    Path, typer.Argument(metavar="COLLECTION.yaml", help="What is asked; `comity schema collection`.")
]
SessionsFolder = Annotated[
    Path, typer.Argument(metavar="SESSIONS", help="What `comity study sessions` wrote.")
]
ParticipantCode = Annotated[
    str, typer.Option("--participant", metavar="CODE", help="Of the allocation, such as P07.")
]
Experimenter = Annotated[str, typer.Option("--by", metavar="WHO", help="Who asks, and records the consent.")]
CollectOut = Annotated[
    Path | None,
    typer.Option("--out", metavar="DIR", help="Of the answers; `collected` in SESSIONS without it."),
]
DistanceRobot = Annotated[
    str | None,
    typer.Option(
        "--robot", metavar="MODULE:CLASS", help="Enter stops this robot and reads the distance from it."
    ),
]
Withdraw = Annotated[
    bool, typer.Option("--withdraw", help="The participant agrees no more: delete all their answers.")
]


def collect(
    collection: CollectionName,
    sessions: SessionsFolder,
    *,
    participant: ParticipantCode,
    by: Experimenter,
    out: CollectOut = None,
    robot: DistanceRobot = None,
    withdraw: Withdraw = False,
    at: At = None,
    as_json: AsJson = False,
) -> None:
    """Ask one participant for consent, facts, stop distances and answers, in the allocated order.

    Without consent nothing is stored. Each answer is on disk before the next question; after Ctrl-C or a
    crash the same command goes on. Answers are read from standard input, a line each. Exit code 1: questions
    are left, or there is no consent.

    Example: comity study collect calm.collection.yaml sessions --participant P07 --by Kim
    """
    from datetime import date

    from comity.report.text import show
    from comity.study.collecting.allocation_table import session_of
    from comity.study.collecting.asking import Asker
    from comity.study.collecting.collection_file import load_collection
    from comity.study.collecting.session import Collector
    from comity.study.collecting.telling import collect_answer, collect_text
    from comity_fis.validation.one_line import one_line

    asked = load_collection(collection)
    session = session_of(sessions, participant)
    asked.require_conditions(session.conditions)
    collector = Collector(
        asked,
        session,
        out or sessions / "collected",
        one_line(by),
        day(at) or date.today(),
        Asker(sys.stdin, sys.stderr),
        None if robot is None or withdraw else _reading(robot, collection, asked.written.medium),
    )
    if withdraw:
        answer = collect_answer(collector, "withdrawn", collector.withdraw())
    else:
        answer = collect_answer(collector, *collector.carry_out())
    if as_json:
        print_json(answer)
    else:
        show(*collect_text(answer))
    raise typer.Exit(0 if answer.status in ("done", "withdrawn") else 1)


def _reading(robot: str, collection: Path, medium: str) -> Callable[[], float]:
    """What stops a robot and reads its distance."""
    from comity.live.loading import load_robot
    from comity.study.collecting.robot_distance import stopped_at
    from comity_fis import InputError, Where

    if medium != "robot":
        raise InputError(
            expected="`medium: robot` of a collection with --robot",
            got=medium,
            remedy="Leave --robot out.",
            where=Where(str(collection)),
        )
    made = load_robot(robot)
    return lambda: stopped_at(made)
