"""`comity visits`: one person met again and again, and what the robot learns."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import AsJson, At, PersonsRulebookName, day, print_json

if TYPE_CHECKING:
    from comity.adaptation.visits import Acquaintance, VisitRecord
    from comity.answers.visits import VisitsAnswer
    from comity.scenario import ComfortSpec

Profile = Annotated[str, typer.Argument(help="A shipped or stored profile, or a file.")]
Times = Annotated[int, typer.Option(min=1, max=200, help="How many visits.")]
Every = Annotated[int, typer.Option(min=0, max=3650, metavar="DAYS", help="Between two visits.")]
Wants = Annotated[
    str | None,
    typer.Option(
        "--wants",
        metavar="LOW..HIGH",
        help="The simulated person's comfort interval [m]; without it, drawn from the model's spread.",
    ),
]
Seed = Annotated[int, typer.Option(min=0, help="For what the person likes and shows, and for the sensors.")]
Picture = Annotated[
    Path | None, typer.Option(metavar="FILE", help="Draw the visits, as a .png, .svg or .pdf file.")
]
Keep = Annotated[
    bool,
    typer.Option("--keep", help="Remember the simulated visits of somebody who is kept, marked as such."),
]


def visits(
    profile: Profile,
    *,
    times: Times = 10,
    every: Every = 30,
    wants: Wants = None,
    rulebook: PersonsRulebookName = None,
    at: At = None,
    seed: Seed = 0,
    picture: Picture = None,
    keep: Keep = False,
    as_json: AsJson = False,
) -> None:
    """Meet one simulated person again and again, and learn how near they like the robot.

    Every visit is an episode in the world. The person has a comfort interval that the robot is not told; they
    step back, lean in, turn away, ask, or show nothing. Nothing of it is written. With --keep what a person
    who is kept on this machine was seen to do is remembered, marked as simulated: it then counts as if it
    had been theirs, until `comity profile reset` forgets it.

    Example: comity visits german_woman --times 10 --every 30 --wants 0.5..0.8
    """
    from datetime import date

    from comity.adaptation.visits import acquainted, interval_in_words, likes
    from comity.people.remembered import require_kept
    from comity.report.drawing import check_picture
    from comity.report.people.visits import summary, visits_answer
    from comity.report.text import show, unbroken

    check_picture(picture)
    comfort = interval_in_words(wants) if wants else None
    acquaintance, kept_as = acquainted(profile, rulebook, every_days=every, begin=day(at), seed=seed)
    if keep:
        require_kept(kept_as)
    comfort = comfort or likes(acquaintance)
    meetings = _met(acquaintance, comfort, times, quiet=as_json)
    remembered_as = kept_as if keep and _remembered(kept_as, meetings) else None
    answer = visits_answer(
        acquaintance,
        comfort,
        meetings,
        rulebook=acquaintance.rulebook,
        remembered_as=remembered_as,
        today=date.today(),
    )
    if picture:
        _draw(answer, picture)
    if as_json:
        print_json(answer)
        return
    show(*summary(answer))
    if picture:
        show(unbroken(f"\nPicture  {picture}"))


def _met(acquaintance: Acquaintance, comfort: ComfortSpec, times: int, *, quiet: bool) -> list[VisitRecord]:
    """All meetings, with a word on how far they are where a person watches."""
    from comity.adaptation.visits import meet
    from comity.commands.progress import watching
    from comity.live_episode import EpisodeProgress

    meetings = []
    with watching(f"{acquaintance.profile}: visit 1 of {times}", quiet=quiet) as watch:
        for meeting in meet(acquaintance, comfort, times):
            meetings.append(meeting)
            if watch:
                watch(EpisodeProgress(0.0, f"visit {len(meetings)} of {times}"))
    return meetings


def _remembered(kept_as: str | None, meetings: Sequence[VisitRecord]) -> bool:
    """Remember what was seen, marked as simulated; whether the person is kept still."""
    from comity.people.remembered import remember, require_kept

    seen = [meeting.seen for meeting in meetings if meeting.seen]
    return remember(require_kept(kept_as), [one.model_copy(update={"simulated": True}) for one in seen])


def _draw(answer: VisitsAnswer, picture: Path) -> None:
    from comity.report.drawing import write_picture
    from comity.report.people.visits_picture import visits_picture

    write_picture(picture, lambda: visits_picture(answer), private=True)
