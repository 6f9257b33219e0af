"""All data of one run for the page, as plain lists and dictionaries."""

from __future__ import annotations

from typing import TYPE_CHECKING

from comity.output.run_folder import BLACKBOARD
from comity.replay.groups_data import groups_data
from comity.replay.place_data import place_data
from comity.replay.planned_routes import planned_routes
from comity.replay.plans_data import plans_data, stages_of
from comity.replay.saved_run import read_run
from comity.replay.tracks import tracks_of
from comity.replay.tree_data import tree_data
from comity.replay.values_data import values_data
from comity.report.episodes.trace import load
from comity_executor import read_blackboard
from comity_fis.record import plain
from comity_sim2d.pictures.person_colours import DISTINCT, person_colour

if TYPE_CHECKING:
    from comity.output.run_folder import RunFolder
    from comity.replay.saved_run import SavedRun


SHOWN = (
    "status",
    "outcome",
    "scenario",
    "robot",
    "rulebook",
    "profiles",
    "at",
    "seed",
    "trace_sha256",
    "visits",
    "metrics",
    "doors",
    "disturbances",
    "error",
)
"""Entries of a run's account that the page shows."""


def episode_data(folder: RunFolder) -> dict[str, object]:
    """The page's data of a run.

    Raises:
        InputError: if a file of the run is missing or damaged.
    """
    run, recorded = read_run(folder), load(folder)
    account, frames, history = run.account, run.frames, recorded.history
    return {
        "name": folder.path.resolve().name,
        "about": run.file.scenario.about,
        "ending": recorded.ending,
        "end": max(history.end_s, frames.time_s[-1].item() if len(frames) else 0.0),
        "account": {name: plain(getattr(account, name)) for name in SHOWN},
        "place": place_data(run.scene),
        "groups": groups_data(run.scene, frames),
        "people": [_person(name, run) for name in run.values],
        "robot": run.file.scenario.robot.name,
        "carrying": run.file.scenario.robot.carrying,
        "tracks": tracks_of(frames),
        "tree": tree_data(history, run.values),
        "blackboard": _blackboard(folder),
        "plans": plans_data(run.plan, account),
        "routes": _routes(run),
        "values": values_data(run.cast.rulebook, stages_of(run.cast, run.values, account.revisions)),
    }


def _routes(run: SavedRun) -> list[list[object]]:
    """Planned routes as `[t, [[x, y], ...]]` [s], [m], to the millimetre."""
    return [
        [route.time_s, [[round(x, 3), round(y, 3)] for x, y in route.points]] for route in planned_routes(run)
    ]


def _blackboard(folder: RunFolder) -> list[list[object]]:
    """Blackboard writes as `[t, entry, value, leaf]`; empty for a run of an older version without them."""
    path = folder / BLACKBOARD
    writes = read_blackboard(path) if path.is_file() else ()
    return [[one.t, one.entry, one.value, one.leaf] for one in writes]


def _person(name: str, run: SavedRun) -> dict[str, object]:
    person = run.file.scenario.people[name]
    place = [one.name for one in run.scene.people].index(name)
    colour = person_colour(place)
    return {
        "name": name,
        "posture": person.posture,
        "visited": name in run.file.scenario.visited(),
        "carrying": person.carrying,
        "colour": {"light": colour.on_light, "dark": colour.on_dark, "distinct": place < len(DISTINCT)},
    }
