"""`comity run`: an episode from the plan to the picture."""

from __future__ import annotations

import sys
from contextlib import nullcontext, redirect_stdout
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from comity.commands.options import (
    As,
    AsJson,
    At,
    EngineName,
    OptionalRulebookName,
    ScenarioName,
    Seed,
    With,
    day,
    open_page,
    pairs,
    print_json,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

    from rich.console import RenderableType

    from comity.live.operator import Operator
    from comity.recording import Recorded, View
    from comity.sharing.extra import Extra
    from comity_executor import MapRobot

Out = Annotated[
    Path | None,
    typer.Option(metavar="DIR", help="The run folder; runs/<scenario>-<n> without it."),
]
Learn = Annotated[bool, typer.Option("--learn", help="Remember how each person took the robot's coming.")]
Gif = Annotated[bool, typer.Option("--gif", help="Write a GIF of the episode, too; it takes a while.")]
Pseudonyms = Annotated[
    bool,
    typer.Option(
        "--pseudonyms",
        help="Keep only a run that can be passed on, with no name and no free text; see `comity share`.",
    ),
]
PictureFile = Annotated[
    Path | None,
    typer.Option("--picture", metavar="FILE", help="Draw it there, too, as a .png, .svg or .pdf file."),
]
NoPictures = Annotated[bool, typer.Option("--no-pictures", help="Leave the picture out.")]
RobotName = Annotated[
    str | None,
    typer.Option(
        "--robot", metavar="MODULE:CLASS", help="A real robot of yours in the place of the simulated one."
    ),
]
AdultsOnly = Annotated[
    bool, typer.Option("--adults-only", help="With --robot: whoever does not state an age is an adult.")
]
ReducedMargin = Annotated[
    bool,
    typer.Option(
        "--reduced-margin",
        help="With --robot: you, the robot's operator, allow it to pass people at the scenario's margin_m.",
    ),
]
SiteLanguage = Annotated[
    str | None,
    typer.Option(
        metavar="LANGUAGE",
        help="The language of the place, by code or name: spoken where a person stated none that the robot "
        "has words in. English without it.",
    ),
]
OwnWordings = Annotated[
    list[str],
    typer.Option(metavar="FILE", help="Wordings of yours, before those that ship; may be repeated."),
]
Unreviewed = Annotated[
    bool,
    typer.Option(
        "--unreviewed-wordings",
        help="With --robot: say wordings that nobody who speaks the language has reviewed, too. Without it "
        "the robot says the name and a plain greeting in the language of the place instead.",
    ),
]
AsShadow = Annotated[
    bool,
    typer.Option("--shadow", help="Sense, plan and explain, but command nothing: others drive the robot."),
]
WithOperator = Annotated[
    bool,
    typer.Option(
        "--operator",
        help="With --robot: plans wait for approval, and words are taken from standard input (a line each): "
        "approve, skip PERSON, nearer PERSON, farther PERSON, mark TEXT, stop, resume.",
    ),
]
MaxSpeed = Annotated[
    float | None,
    typer.Option(
        "--max-speed", metavar="V", min=0.01, help="Go no faster than V m/s, whatever the scenario says."
    ),
]
Open = Annotated[bool, typer.Option("--open", help="Open the page in the browser.")]


def run(
    scenario: ScenarioName = "johanna",
    *,
    as_: As = [],  # noqa: B006  (Typer copies it)
    rulebook: OptionalRulebookName = None,
    at: At = None,
    seed: Seed = 0,
    engine: EngineName = "comity",
    out: Out = None,
    learn: Learn = False,
    robot: RobotName = None,
    adults_only: AdultsOnly = False,
    reduced_margin: ReducedMargin = False,
    unreviewed_wordings: Unreviewed = False,
    site_language: SiteLanguage = None,
    wordings: OwnWordings = [],  # noqa: B006  (Typer copies it)
    shadow: AsShadow = False,
    operator: WithOperator = False,
    max_speed: MaxSpeed = None,
    open_: Open = False,
    gif: Gif = False,
    picture: PictureFile = None,
    no_pictures: NoPictures = False,
    pseudonyms: Pseudonyms = False,
    with_: With = [],  # noqa: B006
    as_json: AsJson = False,
) -> None:
    """Run an episode: plan it, execute it, say what was reached.

    Writes a run folder with the plan, the trace, all frames, a picture and a page that shows the episode;
    with --gif a GIF, too, which `comity replay RUN --gif FILE` can also make later. With --learn it also adds
    what was noticed of each person with a profile of their own to what is known of them; without it, a run
    changes nothing there. With --pseudonyms the folder holds no name and no free text, and nothing else is
    kept. With --robot a robot of your own carries it out, on the scenario's map and from
    where it is and sees people. Exit code 1: a person could not be served.
    """
    from comity.adaptation.learning import refuse_nobody_kept
    from comity.commands.progress import watching
    from comity.live.start import as_seen, for_adults, slowed, with_reduced_margin
    from comity.output.run_folder import place_for
    from comity.parameters.speaking import at_site
    from comity.preparation import prepare
    from comity.report.drawing import check_picture
    from comity.scenario import load_scenario
    from comity.sharing.run import FOLDER

    _require_pseudonyms(with_, pseudonyms)
    file = for_adults(slowed(load_scenario(scenario), max_speed), adults_only=adults_only)
    file = at_site(file, language=site_language, wordings=wordings)
    # Before the planning: a folder that cannot be used costs no wait.
    place_for(out, FOLDER if pseudonyms else file.scenario.name)
    check_picture(picture)
    needs = {
        "--adults-only": adults_only,
        "--reduced-margin": reduced_margin,
        "--unreviewed-wordings": unreviewed_wordings,
        "--shadow": shadow,
        "--operator": operator,
    }
    with redirect_stdout(sys.stderr) if as_json else nullcontext():  # a robot's code may print
        base = _robot(robot, needs=needs, shadow=shadow)
        if base is not None:
            file = with_reduced_margin(as_seen(file, base), allowed=reduced_margin)
        people = pairs(as_, "--as", "guest=german_man")
        with watching(f"{file.scenario.name}: planning", quiet=as_json) as watch:
            prepared = prepare(
                file, profiles=people, rulebook=rulebook, at=day(at), learn=learn, seed=seed, engine=engine
            )
            if learn:
                refuse_nobody_kept(prepared.file.scenario.visited(), prepared.kept_as)
            recorded = _recording(with_, pseudonyms)(
                prepared,
                seed=seed,
                out=out,
                views=_views(gif, no_pictures),
                watch=watch,
                robot=base,
                operator=_operator() if operator else None,
                called=f"{robot} (shadow: nothing was commanded)" if shadow else robot,
                unreviewed_wordings=unreviewed_wordings,
            )
    if picture is not None:
        _draw(recorded, picture)
    learnt = _learnt(recorded, at) if learn else ()
    _tell(recorded, learnt, picture=picture, pseudonyms=pseudonyms, as_json=as_json)
    if open_:
        from comity.output.run_folder import REPLAY

        open_page(recorded.folder / REPLAY)
    raise typer.Exit(0 if recorded.answer.outcome == "success" else 1)


def _require_pseudonyms(extras: Sequence[Extra], pseudonyms: bool) -> None:
    from comity_fis import InputError

    if extras and not pseudonyms:
        raise InputError(
            expected="--pseudonyms", got="--with without it", remedy="Add --pseudonyms, or leave --with out."
        )


def _recording(extras: Sequence[Extra], pseudonyms: bool) -> Callable[..., Recorded]:
    """What carries the episode out and writes it down."""
    from comity.recording import record
    from comity.sharing.run import record_shared

    return partial(record_shared, extras=extras) if pseudonyms else record


def _learnt(recorded: Recorded, at: str | None) -> Iterable[RenderableType]:
    """Remember what was noticed of people, and say so."""
    from comity.adaptation.learning import in_words, keep, observed

    seen = observed(recorded.episode, day(at))
    return in_words(seen, keep(seen))


def _tell(
    recorded: Recorded,
    learnt: Iterable[RenderableType],
    *,
    picture: Path | None,
    pseudonyms: bool,
    as_json: bool,
) -> None:
    from comity.report.episodes.run import reached_text, summary
    from comity.report.text import show

    if as_json:
        print_json(recorded.answer)
    else:
        told = reached_text(recorded.answer) if pseudonyms else summary(recorded.answer, recorded.episode)
        show(*told, *_written(recorded, picture), *learnt)
    if recorded.folder.is_open_to_others():
        path = recorded.folder.path
        note = f"others on this machine may look into {path}, not into its files"
        print(f"Note: {note}; `chmod 700 {path}` ends it.", file=sys.stderr)


def _robot(name: str | None, *, needs: Mapping[str, bool], shadow: bool) -> MapRobot | None:
    """The robot that was named, if one was; in its shadow, where nothing is to be commanded."""
    from comity.live.loading import load_robot
    from comity.live.shadow import Shadow
    from comity_fis import InputError

    if name is None:
        for option, is_given in needs.items():
            if is_given:
                raise InputError(
                    expected="a real robot",
                    got=f"{option} without --robot",
                    remedy="Add `--robot MODULE:CLASS`.",
                )
        return None
    base = load_robot(name)
    return Shadow(base) if shadow else base


def _operator() -> Operator:
    """Who types words into standard input."""
    from comity.live.operator import Operator, listen

    def tell(text: str) -> None:
        print(text, file=sys.stderr, flush=True)

    operator = Operator(approves=True, tell=tell)
    listen(sys.stdin, operator, refuse=tell)
    return operator


def _views(gif: bool, no_pictures: bool) -> tuple[View, ...]:
    asked: dict[View, bool] = {"page": True, "picture": not no_pictures, "gif": gif}
    return tuple(view for view in asked if asked[view])


def _written(recorded: Recorded, picture: Path | None) -> Iterator[RenderableType]:
    """Which files there are to look at."""
    from comity.output.run_folder import ANIMATION, PICTURE, REPLAY
    from comity.report.episodes.trace import size_text
    from comity.report.text import unbroken

    yield ""
    for label, name in (("Page", REPLAY), ("Picture", PICTURE), ("GIF", ANIMATION)):
        if name in recorded.answer.files:
            yield unbroken(f"{label:8} {recorded.folder / name}")
    if picture is not None:
        yield unbroken(f"Picture  {picture}")
    yield unbroken(f"Folder   {recorded.folder.path}")
    yield f"Size     {size_text(recorded.answer.bytes_per_minute)}"


def _draw(recorded: Recorded, path: Path) -> None:
    from comity.replay.pictures import write_picture

    write_picture(recorded.folder, path)
