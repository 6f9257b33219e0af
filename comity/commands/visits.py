"""`comity visits`: one person met again and again, and what the robot learns."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, At, RulebookName, day, print_json


def visits(
    profile: Annotated[str, typer.Argument(help="A shipped or stored profile, or a file.")],
    *,
    times: Annotated[int, typer.Option(min=1, max=200, help="How many visits.")] = 10,
    every: Annotated[int, typer.Option(min=0, max=3650, metavar="DAYS", help="Between two visits.")] = 30,
    wants: Annotated[
        str | None,
        typer.Option(
            "--wants",
            metavar="LOW..HIGH",
            help="The simulated person's comfort interval [m]; without it, drawn from the model's spread.",
        ),
    ] = None,
    rulebook: RulebookName = "bruno2017",
    at: At = None,
    seed: Annotated[
        int, typer.Option(min=0, help="For what the person likes and shows, and for the sensors.")
    ] = 0,
    picture: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Also draw the visits to this PNG.")
    ] = None,
    keep: Annotated[
        bool,
        typer.Option("--keep", help="Remember the simulated visits of somebody who is kept, marked as such."),
    ] = False,
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

    from comity.commands.progress import watching
    from comity.episode import Progress
    from comity.own_files import refuse_foreign, write_whole
    from comity.profile import load_profile
    from comity.remembered import remember, remembered, require_kept
    from comity.report.drawing import MARK
    from comity.report.text import show
    from comity.report.visits import summary, visits_answer
    from comity.visits import Acquaintance, interval_in_words, likes, meet

    comfort = interval_in_words(wants) if wants else None
    kept = load_profile(profile).kept_as
    keeper = require_kept(kept) if keep else None
    document = remembered(kept) if kept else None
    known = document.conversational_distance if document else ()
    begin = day(at) or max((seen.day for seen in known), default=date.today())
    acquaintance = Acquaintance(profile, rulebook, every, begin, seed, known)
    if picture:
        refuse_foreign({picture: MARK})
    comfort = comfort or likes(acquaintance)
    meetings = []
    with watching(f"{profile}: visit 1 of {times}", quiet=as_json) as watch:
        for meeting in meet(acquaintance, comfort, times):
            meetings.append(meeting)
            if watch:
                watch(Progress(0.0, f"visit {len(meetings)} of {times}"))
    seen = [meeting.seen for meeting in meetings if meeting.seen]
    if keeper and not remember(keeper, [one.model_copy(update={"simulated": True}) for one in seen]):
        keeper = None  # deleted meanwhile
    answer = visits_answer(
        acquaintance, comfort, meetings, rulebook=rulebook, remembered_as=keeper, today=date.today()
    )
    if picture:
        from comity.report.visits_picture import visits_picture

        write_whole(picture, visits_picture(answer))
    if as_json:
        print_json(answer)
        return
    show(*summary(answer))
    if picture:
        show(f"\nPicture  {picture}")
