"""The picture and the GIF of a run, drawn from its folder."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, TypedDict

from comity.replay.planned_routes import planned_routes
from comity.replay.saved_run import read_run
from comity.report.text import words
from comity.system.own_files import writing, written_whole
from comity_domain.problem.bound_parameters import BEARING, DISTANCE
from comity_sim2d import ActEvent, DoorTurn, PlannedRoute, Ring, draw_picture, write_gif
from comity_sim2d.pictures.animation import MARK as GIF_MARK

if TYPE_CHECKING:
    from pathlib import Path

    from comity.answers.plan import StepAnswer
    from comity.answers.run import ActAnswer, VisitAnswer
    from comity.output.run_folder import RunFolder
    from comity.replay.saved_run import SavedRun

__all__ = ["GIF_MARK", "draw_run", "film_run", "film_stimulus", "rings_of", "write_picture"]


def draw_run(run: SavedRun, path: Path) -> None:
    """Write a PNG, SVG or PDF, by suffix: planned route, driven path, each person's preferred distance."""
    draw_picture(path, run.scene, run.frames, title=_title(run), **_shown(run))


def write_picture(folder: RunFolder, path: Path) -> None:
    """Draw the picture of a run into a private file, which only the user may read.

    Raises:
        InputError: if it cannot be written.
    """
    with writing(path), written_whole(path, private=True) as part:
        draw_run(read_run(folder), part)


def film_run(run: SavedRun, path: Path) -> None:
    """Write a GIF of the whole episode."""
    write_gif(path, run.scene, run.frames, title=run.account.scenario, ending=_title(run), **_shown(run))


def film_stimulus(run: SavedRun, path: Path, speed: float) -> None:
    """Write a GIF that reveals no values: no distances, no route, no title.

    Args:
        run: The run.
        path: Path of the GIF.
        speed: Playback speed, in simulated seconds per second.
    """
    people = tuple(replace(person, personal_distance_m=None) for person in run.scene.people)
    scene = replace(run.scene, people=people)
    write_gif(path, scene, run.frames, events=_acts(run), door_turns=_door_turns(run), speed=speed)


class _Shown(TypedDict):
    """Arguments that picture and GIF share, besides the scene and its frames."""

    rings: list[Ring]
    events: list[ActEvent]
    door_turns: list[DoorTurn]
    planned: tuple[PlannedRoute, ...]


def _shown(run: SavedRun) -> _Shown:
    return {
        "rings": rings_of(run),
        "events": _acts(run),
        "door_turns": _door_turns(run),
        "planned": planned_routes(run),
    }


def rings_of(run: SavedRun) -> list[Ring]:
    """Rings for people who were visited or not reached, in the order of the visits."""
    planned = _reach_steps(run)
    return [
        _ring(visit, planned.get(visit.person))
        for visit in run.account.visits
        if visit.together_with is None and visit.outcome != "skipped"
    ]


def _ring(visit: VisitAnswer, planned: StepAnswer | None) -> Ring:
    wanted_m = float(planned.parameters[DISTANCE]) if planned else visit.distance_target_m
    bearing_deg = visit.bearing_target_deg
    if bearing_deg is None:
        bearing_deg = float(planned.parameters[BEARING]) if planned else 0.0
    return Ring(
        person=visit.person,
        wanted_m=wanted_m,
        reached_m=visit.distance_actual_m,
        bearing_deg=bearing_deg,
        reached_bearing_deg=visit.bearing_actual_deg,
        facing_error_deg=visit.facing_error_deg,
        label=_label(visit),
        time_s=visit.docked_at_s,
    )


def _label(visit: VisitAnswer) -> str:
    """The profile's name, and below it remarks on the visit."""
    remark = visit.reason or visit.deviation_reason or (visit.unverified and "not verified")
    if visit.outcome == "unreachable":
        remark = "could not be served"
    late = f"{visit.late_s:.1f} s late" if visit.late_s else None
    return "\n".join(filter(None, (words(visit.profile), remark, late)))


def _reach_steps(run: SavedRun) -> dict[str, StepAnswer]:
    """The approach step for each person, from the last plan that has one."""
    later = (step for revision in run.account.revisions for step in revision.steps)
    steps = (step for step in (*run.plan.steps, *later) if step.action == "Reach_user")
    return {step.arguments[1]: step for step in steps}


def _acts(run: SavedRun) -> list[ActEvent]:
    """All acts; for runs that do not list them, those in the visits."""
    account = run.account
    listed = [(act.person, act) for act in account.acts]
    told: list[tuple[str, ActAnswer]] = [(one.person, act) for one in account.visits for act in one.acts]
    return [
        ActEvent(
            t_start=act.start_s,
            t_end=act.end_s,
            act=act.act,
            person=person,
            text=act.text,
            stopped=act.stopped,
            volume=act.volume,
            rate=act.rate,
            amplitude=act.amplitude,
            thing=act.thing,
            latin=act.latin,
        )
        for person, act in listed or told
    ]


def _door_turns(run: SavedRun) -> list[DoorTurn]:
    return [DoorTurn(turn.t, turn.door, turn.open) for turn in run.account.doors]


def _title(run: SavedRun) -> str:
    return f"{run.account.scenario}: {run.account.outcome or run.account.status}"
