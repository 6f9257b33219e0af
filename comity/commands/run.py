"""`comity run`: an episode from the plan to the picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import As, AsJson, At, OptionalRulebookName, Seed, day, pairs, print_json

if TYPE_CHECKING:
    from rich.console import RenderableType

    from comity.recording import Recorded

Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="The run folder; runs/<scenario>-<n> without it."),
]
Learn = Annotated[bool, typer.Option("--learn", help="Remember how each person took the robot's coming.")]
Open = Annotated[bool, typer.Option("--open", help="Open the page in the browser.")]


def run(
    scenario: Annotated[str, typer.Argument(help="A shipped scenario or a file.")] = "johanna",
    *,
    as_: As = [],  # noqa: B006  (Typer copies it)
    rulebook: OptionalRulebookName = None,
    at: At = None,
    seed: Seed = 0,
    out: Out = None,
    learn: Learn = False,
    open_: Open = False,
    as_json: AsJson = False,
) -> None:
    """Run an episode: plan it, execute it, say what was reached.

    Writes a run folder with the plan, the trace, all frames, a picture, a GIF and a page that shows the
    episode. With --learn it also adds what was noticed of every person with a profile of their own to what
    is known of them; without it, a run changes nothing there. Exit code 1: somebody could not be served.
    """
    from comity.adaptation.learning import in_words, keep, observed, refuse_nobody_kept
    from comity.commands.progress import watching
    from comity.output.run_folder import place_for
    from comity.preparation import prepare
    from comity.recording import record
    from comity.report.episodes.run import summary
    from comity.report.text import show
    from comity.scenario import load_scenario

    file = load_scenario(scenario)
    place_for(out, file.scenario.name)  # before the planning: a folder that cannot be used costs no wait
    with watching(f"{file.scenario.name}: planning", quiet=as_json) as watch:
        people = pairs(as_, "--as", "guest=german_man")
        prepared = prepare(file, profiles=people, rulebook=rulebook, at=day(at), learn=learn, seed=seed)
        if learn:
            refuse_nobody_kept(prepared)
        recorded = record(prepared, seed=seed, out=out, watch=watch)
    seen = observed(recorded.episode, day(at)) if learn else {}
    kept = keep(seen)
    if as_json:
        print_json(recorded.answer)
    else:
        show(*summary(recorded.answer, recorded.episode), *_written(recorded))
        if learn:
            show(*in_words(seen, kept))
    if open_:
        _open(recorded)
    raise typer.Exit(0 if recorded.answer.outcome == "success" else 1)


def _written(recorded: Recorded) -> tuple[RenderableType, ...]:
    from comity.output.run_folder import PICTURE, REPLAY
    from comity.report.episodes.trace import size_text
    from comity.report.text import unbroken

    return (
        unbroken(f"\nPage     {recorded.folder / REPLAY}"),
        unbroken(f"Picture  {recorded.folder / PICTURE}"),
        unbroken(f"Folder   {recorded.folder.path}"),
        f"Size     {size_text(recorded.answer.bytes_per_minute)}",
    )


def _open(recorded: Recorded) -> None:
    import webbrowser

    from comity.output.run_folder import REPLAY

    webbrowser.open((recorded.folder / REPLAY).resolve().as_uri())
