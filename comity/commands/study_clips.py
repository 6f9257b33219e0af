"""`comity study clips`: films of the same visit with one parameter changed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from comity.commands.options import AsJson, ScenarioName, print_json

Vary = Annotated[
    str,
    typer.Option(
        "--vary",
        metavar="KEY=V1,V2",
        help="A key of the scenario by its path, as in a study, and its values.",
    ),
]
ClipsOut = Annotated[
    Path, typer.Option("--out", metavar="DIR", help="A new folder for films, pages and key.")
]
ClipsSeed = Annotated[int, typer.Option("--seed", min=0, help="The same for all films.")]


def clips(
    scenario: ScenarioName, *, vary: Vary, out: ClipsOut, seed: ClipsSeed = 0, as_json: AsJson = False
) -> None:
    """Film a visit under each value of one parameter, for people to judge.

    The names of the films tell nothing; which is which stands in a key of its own. What else differs as a
    result, such as duration, path, speed and gaze, is listed: people may answer because of that. GIF, and
    MP4 where ffmpeg or imageio-ffmpeg is installed.

    Example: comity study clips johanna --vary rulebook=bruno2017,evidence --out clips
    """
    from comity.report.text import show
    from comity.study.clips.making import make_clips
    from comity.study.clips.telling import clips_text
    from comity.study.clips.variation import varied

    answer = make_clips(varied(scenario, vary, seed), out)
    if as_json:
        print_json(answer)
    else:
        show(*clips_text(answer))
