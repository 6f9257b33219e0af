"""Records a run on disk: its files, when they are written, and its summary."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any, Literal

from comity.answers.run import RunAnswer
from comity.episode import Episode
from comity.live_episode import EpisodeProgress, LiveEpisode
from comity.output import run_folder
from comity.output.resolved import resolved_files
from comity.output.run_folder import RunFolder
from comity.people.consents import require_consent
from comity.report.episodes.run import account_after, account_before, account_under_way
from comity.report.plans.plan import plan_answer
from comity.system.own_files import create_private, written_whole
from comity_executor import NO_ACTS, BlackboardFile, MakeAct, ReadingsFile, TraceFile
from comity_sim2d import Frames, FramesFile

if TYPE_CHECKING:
    from comity.live.operator import Operator
    from comity.preparation import PlannedEpisode
    from comity_executor import MapRobot

View = Literal["page", "picture", "gif"]
"""Presentations of an episode: `replay.html`, `picture.png` and `episode.gif`."""
VIEWS: tuple[View, ...] = ("page", "picture")
"""Default views; a GIF takes several times as long as everything else."""


@dataclass(frozen=True, slots=True)
class Recorded:
    """An episode, its folder, and its summary."""

    episode: Episode
    folder: RunFolder
    answer: RunAnswer


def record(
    prepared: PlannedEpisode,
    *,
    seed: int = 0,
    out: Path | None = None,
    views: Collection[View] = VIEWS,
    watch: Callable[[EpisodeProgress], None] | None = None,
    acts: Mapping[str, MakeAct] = NO_ACTS,
    robot: MapRobot | None = None,
    operator: Operator | None = None,
    called: str | None = None,
    unreviewed_wordings: bool = False,
) -> Recorded:
    """Run an episode and write its folder: the summary says `running` at first, and `done` at the end.

    Args:
        prepared: The scenario with its plan.
        seed: Seed of the sensor noise.
        out: The folder; None: the next free one below `runs`.
        views: Presentations to create.
        watch: Called with the progress of the episode.
        acts: Custom behaviours that replace the robot's acts, by name of the act.
        robot: A real robot that replaces the simulated one.
        operator: The operator of the robot.
        called: Name of the run in the summary.
        unreviewed_wordings: Whether a real robot may use wordings that nobody has reviewed.

    Raises:
        InputError: The folder cannot be used, `acts` names no act, or a stored person did not consent to
            recording; nothing is written then.
    """
    for name in filter(None, prepared.kept_as.values()):
        require_consent(name, "record")
    live = LiveEpisode(
        prepared,
        seed=seed,
        acts=acts,
        robot=robot,
        operator=operator,
        unreviewed_wordings=unreviewed_wordings,
    )
    while True:
        path = run_folder.place_for(out, prepared.file.scenario.name)
        try:
            with run_folder.claimed(path, new=out is None) as folder:
                account = account_before(prepared, folder, seed, robot=called)
                return _recorded(prepared, folder, live, account, views=views, watch=watch)
        except FileExistsError:
            continue  # another run took the number


def _recorded(
    prepared: PlannedEpisode,
    folder: RunFolder,
    live: LiveEpisode,
    account: RunAnswer,
    *,
    views: Collection[View],
    watch: Callable[[EpisodeProgress], None] | None,
) -> Recorded:
    folder.write(run_folder.RUN, account)
    try:
        for name, text in resolved_files(prepared).items():
            folder.write(name, text)
        folder.write(run_folder.PLAN, plan_answer(prepared))
        episode = _run(live, folder, account, watch)
        answer = account_after(account, episode, folder)
        folder.write(run_folder.RUN, answer)
        show(folder, views)
    except BaseException as error:
        crash: dict[str, Any] = {"status": "crashed", "error": _words(error), "files": folder.files()}
        folder.write(run_folder.RUN, replace(account_under_way(account, live), **crash))
        raise
    answer = replace(answer, files=folder.files())
    folder.write(run_folder.RUN, answer)
    return Recorded(episode, folder, answer)


def page_of(episode: Episode) -> str:
    """The HTML page of an episode, even if it was run without a folder."""
    from comity.replay import replay_page

    prepared = episode.prepared
    with TemporaryDirectory() as place:
        folder = RunFolder(Path(place) / prepared.file.scenario.name)
        folder.path.mkdir()
        for name, text in resolved_files(prepared).items():
            folder.write(name, text)
        folder.write(run_folder.PLAN, plan_answer(prepared))
        with _records(folder, episode) as records:
            records.keep(episode, episode.frames)
        account = account_before(prepared, folder, episode.seed)
        folder.write(run_folder.RUN, account_after(account, episode, folder))
        return replay_page(folder)


@dataclass(frozen=True, slots=True)
class _Records:
    """The files that grow while an episode runs."""

    trace: TraceFile
    frames: FramesFile
    readings: ReadingsFile
    blackboard: BlackboardFile

    def keep(self, happened: Episode | LiveEpisode, new: Frames) -> None:
        """Write what is not on disk yet.

        Args:
            happened: The episode so far.
            new: Frames that are not written yet.
        """
        self.trace.keep(happened.events, happened.nodes)
        self.frames.keep(new)
        self.readings.keep(happened.readings)
        self.blackboard.keep(happened.writes)


@contextmanager
def _records(folder: RunFolder, happens: Episode | LiveEpisode) -> Iterator[_Records]:
    with (
        TraceFile(create_private(folder / run_folder.TRACE), happens.nodes) as trace,
        FramesFile(create_private(folder / run_folder.FRAMES)) as frames,
        ReadingsFile(create_private(folder / run_folder.READINGS)) as readings,
        BlackboardFile(create_private(folder / run_folder.BLACKBOARD)) as blackboard,
    ):
        yield _Records(trace, frames, readings, blackboard)


def _words(error: BaseException) -> str:
    """The reason why a run ended; exceptions that end the program (Ctrl-C, SIGTERM) interrupted it."""
    stopped = isinstance(error, KeyboardInterrupt | SystemExit)
    return run_folder.INTERRUPTED if stopped else f"{type(error).__name__}: {error}"


def _run(
    live: LiveEpisode,
    folder: RunFolder,
    account: RunAnswer,
    watch: Callable[[EpisodeProgress], None] | None,
) -> Episode:
    """Run to the end; however it ends, the records are on disk (all but the last second after SIGKILL)."""
    with _records(folder, live) as records:
        told = 0

        def keep() -> None:
            records.keep(live, live.frames_since(records.frames.count))
            nonlocal told
            news = len(live.revisions) + len(live.door_turns) + len(live.disturbances)
            if news > told:
                folder.write(run_folder.RUN, account_under_way(account, live))
                told = news

        def keep_and_tell(progress: EpisodeProgress) -> None:
            keep()
            if watch:
                watch(progress)

        try:
            live.run(keep_and_tell)
        finally:
            keep()
    return live.so_far()


def show(folder: RunFolder, views: Collection[View]) -> None:
    """Create the requested views from the records; plotting libraries are only imported here."""
    if "picture" in views or "gif" in views:
        from comity.replay.pictures import draw_run, film_run
        from comity.replay.saved_run import read_run

        run = read_run(folder)
        if "picture" in views:
            with written_whole(folder / run_folder.PICTURE, private=True) as picture:
                draw_run(run, picture)
        if "gif" in views:
            with written_whole(folder / run_folder.ANIMATION, private=True) as animation:
                film_run(run, animation)
    if "page" in views:
        from comity.replay import replay_page

        folder.write(run_folder.REPLAY, replay_page(folder))
