"""Pseudonymised copy of a run: the same files, with filtered content."""

from __future__ import annotations

import csv
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from comity.answers.plan import PlanAnswer
from comity.answers.run import RunAnswer, SharedAnswer
from comity.output import run_folder
from comity.output.csv_text import csv_text
from comity.output.run_folder import INTERRUPTED, RunFolder, claimed, damaged, place_for
from comity.people.profile import Profile
from comity.recording import VIEWS, Recorded, View, record, show
from comity.replay.frames_file import frames_of
from comity.scenario import MapPlace, Scenario, ScenarioFile, load_scenario
from comity.sharing.extra import Extra
from comity.sharing.names import RunNames, goal_of, names_in
from comity.sharing.person import CLOSED, Filter, plain_words
from comity.system.library import shipped
from comity.system.own_files import create_private, read_regular
from comity_executor import TraceFile, read_nodes, read_trace
from comity_fis import InputError, Where, load_rulebook, shipped_rulebooks
from comity_fis.validation.yaml_file import dump_yaml
from comity_sim2d import FramesFile

if TYPE_CHECKING:
    from comity.preparation import PlannedEpisode
    from comity.scenario import PersonSpec
    from comity_executor import TraceEvent

FOLDER = "shared"
"""Default folder: `runs/shared-1` and so on, independent of the run's name."""
ABOUT = "A run with pseudonyms: its values are in run.json, and do not follow from these profiles."


@dataclass(frozen=True, slots=True)
class SharedRun:
    """An pseudonymised run."""

    folder: RunFolder
    answer: RunAnswer


@dataclass(frozen=True, slots=True)
class _Original:
    """The original run, with its filter."""

    folder: RunFolder
    account: RunAnswer
    file: ScenarioFile
    names: RunNames
    people: Filter
    title: str
    """Name of the scenario, if it ships with Comity and contains no person's name."""

    @property
    def scenario(self) -> Scenario:
        return self.file.scenario


def share(
    folder: RunFolder,
    out: Path | None = None,
    extras: Collection[Extra] = (),
    views: Collection[View] = VIEWS,
) -> SharedRun:
    """Write an pseudonymised copy of a run, with pseudonyms, age bands, relative times and no free text.

    Times are relative to the run's start and are kept; the date is removed. Rules, facts and spoken words are
    removed. Numbers, tracks and the tree are kept, and are still personal data.

    Args:
        folder: The original run.
        out: Output folder; None for the next free `runs/shared-<n>`.
        extras: Additional facts to share: culture, gender.
        views: Views to create: page, picture, GIF.

    Raises:
        InputError: if the run is damaged or still in progress, or the folder cannot be used.
    """
    original = _read(folder, frozenset(extras))
    target = place_for(out, FOLDER)
    if target.resolve() == folder.path.resolve():
        raise InputError(
            expected="another folder than that of the run itself",
            got=str(target),
            remedy="Name a new one with --out.",
            where=Where("share"),
        )
    with claimed(target, new=out is None) as shared:
        return _written(original, shared, views)


def record_shared(
    prepared: PlannedEpisode,
    *,
    out: Path | None = None,
    extras: Collection[Extra] = (),
    views: Collection[View] = VIEWS,
    **options: Any,
) -> Recorded:
    """Run an episode, and keep only its pseudonymised copy.

    The original is kept in a private temporary folder until the end, and removed then, also after Ctrl-C; if
    the program is killed, it remains among the system's temporary files.

    Args:
        prepared: The scenario with its plan.
        out: Output folder; None for the next free `runs/shared-<n>`.
        extras: Additional facts to share: culture, gender.
        views: Views to create: page, picture, GIF.
        options: Options of `record`.
    """
    place_for(out, FOLDER)
    with TemporaryDirectory(prefix="comity-") as private:
        path = Path(private) / "run"
        try:
            recorded = record(prepared, out=path, views=(), **options)
        except BaseException:
            if (path / run_folder.FRAMES).is_file():
                share(RunFolder(path), out, extras, views=())
            raise
        shared = share(recorded.folder, out, extras, views)
        return Recorded(recorded.episode, shared.folder, shared.answer)


def _read(folder: RunFolder, extras: frozenset[Extra]) -> _Original:
    account = folder.read(run_folder.RUN, RunAnswer)
    if account.status == "running":
        raise InputError(
            expected="a run that has ended",
            got="one that goes on, or was killed",
            remedy="Wait for its end, or run the scenario again.",
            where=Where(str(folder.path)),
        )
    file = load_scenario(str(folder / run_folder.SCENARIO))
    book = load_rulebook(file.file.part("rulebook"))
    nodes = read_nodes(folder / run_folder.TRACE)
    words = plain_words(book) | {node.action for node in nodes}
    names = names_in(file.scenario, words).with_nodes(nodes)
    is_known = account.scenario in shipped("scenario") and account.scenario not in file.scenario.people
    title = account.scenario if is_known else "scenario"
    return _Original(folder, account, file, names, Filter(extras, plain_words(book)), title)


def _written(original: _Original, shared: RunFolder, views: Collection[View]) -> SharedRun:
    """Write all files; views are created from them, as for any run."""
    folder, names = original.folder, original.names
    shared.write(run_folder.SCENARIO, dump_yaml(_scenario(original)))
    for table in sorted((folder / run_folder.TABLES).glob("*.csv")):
        shared.write(f"{run_folder.TABLES}/{table.name}", table.read_text(encoding="utf-8"))
    plan = names.answer(folder.read(run_folder.PLAN, PlanAnswer))
    shared.write(run_folder.PLAN, replace(plan, scenario=original.title))
    _copy_trace(folder / run_folder.TRACE, shared / run_folder.TRACE, names)
    frames = frames_of(folder / run_folder.FRAMES)
    renamed = replace(frames, entities=tuple(names.word(name) for name in frames.entities))
    with FramesFile(create_private(shared / run_folder.FRAMES)) as file:
        file.keep(renamed)
    if (folder / run_folder.READINGS).is_file():
        shared.write(run_folder.READINGS, _readings(folder / run_folder.READINGS, names))
    answer = _account(original, shared)
    shared.write(run_folder.RUN, answer)
    if answer.status == "done":
        show(shared, views)
    answer = replace(answer, files=shared.files())
    shared.write(run_folder.RUN, answer)
    return SharedRun(shared, answer)


def _account(original: _Original, shared: RunFolder) -> RunAnswer:
    account, extras = original.account, original.people.extras
    digest = sha256(read_regular(shared / run_folder.TRACE)).hexdigest() if account.trace_sha256 else None
    return replace(
        original.names.answer(account),
        at=None,
        robot="a real robot" if account.robot else None,
        scenario=original.title,
        rulebook=account.rulebook if account.rulebook in shipped_rulebooks() else "own rulebook",
        episode=shared.path.name,
        trace_sha256=digest,
        shared=SharedAnswer(culture=Extra.CULTURE in extras, gender=Extra.GENDER in extras),
        bytes_per_minute=shared.bytes_per_minute(account.simulated_s),
        error=account.error and (account.error if account.error == INTERRUPTED else "not told"),
        files=(),
    )


def _copy_trace(source: Path, target: Path, names: RunNames) -> None:
    nodes = [names.node(node) for node in read_nodes(source)]
    events = [_event(event, names) for event in read_trace(source)]
    with TraceFile(create_private(target), nodes) as file:
        file.keep(events, nodes)


def _event(event: TraceEvent, names: RunNames) -> TraceEvent:
    causes = tuple(told for cause in event.because if (told := names.cause(cause)))
    return replace(event, of=names.node(event.of), because=causes)


def _readings(path: Path, names: RunNames) -> str:
    """The readings of a file with pseudonyms.

    Raises:
        InputError: if the file is damaged.
    """
    try:
        heading, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
        shared = [(names.word(person), *map(float, numbers)) for person, *numbers in rows]
    except (OSError, ValueError, IndexError) as error:
        raise damaged(path, error) from None
    return csv_text(heading, shared)


def _scenario(original: _Original) -> dict[str, Any]:
    """The scenario, reduced to what a picture of the run needs."""
    scenario, names = original.scenario, original.names
    told = scenario.model_dump(
        mode="json",
        by_alias=True,
        exclude_none=True,
        include={"schema_version", "keep_to", "limits", "passers_by", "robot"},
    )
    return {
        **told,
        "name": original.title,
        "about": ABOUT,
        "rulebook": original.file.file.part("rulebook").data,
        "place": _place(scenario, names),
        "robot": _where(told["robot"], names),
        "people": {names.word(name): _person(original, name) for name in scenario.people},
        "groups": {names.word(name): list(map(names.word, group)) for name, group in scenario.groups.items()},
        "goals": [goal_of(goal, names) for goal in scenario.goals],
        "already": [{"greeted": names.word(one.greeted)} for one in scenario.already],
    }


def _person(original: _Original, name: str) -> dict[str, Any]:
    person: PersonSpec = original.scenario.people[name]
    assert isinstance(person.profile, Profile)  # a run's scenario contains it
    kept = {"at_m", "at", "facing_deg", "posture", "radius_m", "carrying", "noise_db", "noisy"}
    told = person.model_dump(mode="json", exclude_none=True, include=kept)
    situation = {key: fact for key, fact in person.situation.items() if fact in CLOSED.get(key, ())}
    return {
        **_where(told, original.names),
        "profile": original.people.profile(
            person.profile, original.scenario.at or original.account.at, original.names.word(name)
        ),
        **({"situation": situation} if situation else {}),
    }


def _where(told: dict[str, Any], names: RunNames) -> dict[str, Any]:
    """A position with pseudonymised robot and person."""
    keys = [key for key in ("name", "at", "carrying") if isinstance(told.get(key), str)]
    named: dict[str, Any] = {key: names.word(told[key]) for key in keys}
    if isinstance(told.get("at"), dict):
        named["at"] = {key: names.word(room) for key, room in told["at"].items()}
    return told | named


def _place(scenario: Scenario, names: RunNames) -> dict[str, Any]:
    place = scenario.place.model_dump(mode="json", by_alias=True, exclude_none=True)
    if not isinstance(scenario.place, MapPlace):
        return place | {"furniture": _renamed(place["furniture"], names)}
    drawn = place["map"]
    walls = [{key: value for key, value in wall.items() if key != "name"} for wall in drawn["walls"]]
    keyed = {
        key: {names.word(name): one for name, one in drawn[key].items()}
        for key in ("rooms", "doors", "locations")
    }
    furniture = _renamed(drawn["furniture"], names)
    about = {"name": "map", "about": "", "walls": walls, "furniture": furniture}
    doors = {names.word(name): state for name, state in place["doors"].items()}
    return place | {"map": drawn | keyed | about, "doors": doors}


def _renamed(pieces: Iterable[dict[str, Any]], names: RunNames) -> list[dict[str, Any]]:
    return [piece | {"name": names.word(piece["name"])} for piece in pieces]
