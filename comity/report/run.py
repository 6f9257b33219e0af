"""The account of a run: before it, after it, and as a summary for people."""

from __future__ import annotations

import shlex
from itertools import combinations
from typing import TYPE_CHECKING, Any

from comity.answers import ActAnswer, PersonAnswer, RunAnswer, SettledAnswer, VisitAnswer
from comity.episode import fingerprint
from comity.report.inference import because
from comity.report.side import SIDES, toward
from comity.report.text import number, table, words
from comity_sim2d import of_episode, of_person

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from rich.console import RenderableType

    from comity.episode import Episode
    from comity.preparation import Prepared
    from comity.run_folder import RunFolder
    from comity_executor import Visit
    from comity_fis import Inference
    from comity_sim2d import ActEvent


def account_before(prepared: Prepared, folder: RunFolder, seed: int) -> RunAnswer:
    """What can be said before the world moves."""
    return RunAnswer(
        status="running",
        outcome=None,
        scenario=prepared.file.scenario.name,
        rulebook=prepared.rulebook.name,
        profiles={person: profile.name for person, profile in prepared.profiles.items()},
        seed=seed,
        episode=str(folder.path),
        reproduce=shlex.join(["comity", "run", str(folder / "scenario.yaml"), "--seed", str(seed)]),
        trace_sha256=None,
        fingerprint=fingerprint(),
        simulated_s=0.0,
        at=prepared.day,
        visits=(),
        values={person: _person(inference) for person, inference in prepared.values.items()},
        metrics={},
        files=(),
    )


def _person(inference: Inference) -> PersonAnswer:
    """What the robot went by: no curve, no rules, which `comity explain` has."""
    values = {name: value.as_json() for name, value in inference.parameters.items()}
    kept = SettledAnswer.model_fields.keys()
    return PersonAnswer.model_validate(
        {
            "notes": inference.notes,
            "parameters": {
                name: {key: value[key] for key in value if key in kept} for name, value in values.items()
            },
        }
    )


def account_after(before: RunAnswer, episode: Episode, folder: RunFolder) -> RunAnswer:
    """What happened, in numbers."""
    measured = of_episode(episode.metrics)
    simulated_s = measured.pop("duration_s")
    return before.model_copy(
        update={
            "status": "done",
            "outcome": episode.outcome,
            "trace_sha256": episode.trace_sha256,
            "simulated_s": simulated_s,
            "bytes_per_minute": folder.bytes_per_minute(simulated_s),
            "visits": tuple(_visits(episode)),
            "metrics": measured,
            "figures": {name: of_person(episode.metrics, name) for name in episode.frames.entities[1:]},
            "files": folder.files(),
        }
    )


def _visits(episode: Episode) -> Iterator[VisitAnswer]:
    prepared = episode.prepared
    for visit in episode.visits:
        acts = tuple(_act(event) for event in episode.acts if event.person == visit.person)
        yield _visit(visit, prepared, acts)
    for person, reason in prepared.asked.unreachable.items():
        yield VisitAnswer(
            person=person,
            profile=prepared.profiles[person].name,
            outcome="unreachable",
            distance_wanted_m=prepared.values[person]["conversational_distance"].number,
            distance_reached_m=None,
            centre_distance_reached_m=None,
            bearing_wanted_deg=None,
            bearing_reached_deg=None,
            facing_error_deg=None,
            pose_free=None,
            deviation_reason=None,
            docked_at_s=None,
            greeting=(),
            together_with=None,
            reason=reason,
        )


def _act(event: ActEvent) -> ActAnswer:
    return ActAnswer(
        act=event.act,
        start_s=event.t_start,
        end_s=event.t_end,
        text=event.text,
        volume=event.volume,
        rate=event.rate,
        amplitude=event.amplitude,
        stopped=event.stopped,
    )


def _visit(visit: Visit, prepared: Prepared, acts: tuple[ActAnswer, ...]) -> VisitAnswer:
    docked, pose = visit.docked_at, visit.pose
    parameters = _reach_parameters(visit.person, prepared)
    return VisitAnswer(
        person=visit.person,
        profile=prepared.profiles[visit.person].name,
        outcome=visit.outcome,
        distance_wanted_m=prepared.values[visit.person]["conversational_distance"].number,
        distance_reached_m=docked.distance_m if docked else None,
        centre_distance_reached_m=docked.centre_distance_m if docked else None,
        bearing_wanted_deg=parameters.get("approach_bearing"),
        bearing_reached_deg=docked.bearing_deg if docked else None,
        facing_error_deg=docked.facing_error_deg if docked else None,
        pose_free=pose.pose_free if pose else None,
        deviation_reason=visit.deviation_reason,
        docked_at_s=visit.docked_s,
        greeting=visit.greeting,
        acts=acts,
        together_with=visit.together_with,
        reason=visit.failure,
        noticed=visit.noticed.kind if visit.noticed else None,
    )


def _reach_parameters(person: str, prepared: Prepared) -> Mapping[str, Any]:
    """Of the stop before somebody; nothing where the robot stops before another one, or not at all."""
    stops = (
        step.parameters
        for step in prepared.plan.steps
        if step.action == "Reach_user" and step.person == person
    )
    return next(stops, {})


def summary(answer: RunAnswer, episode: Episode) -> Iterator[RenderableType]:
    """Who was visited, which values were used and why, what was reached."""
    served = sum(visit.outcome == "greeted" for visit in answer.visits)
    yield (
        f"\n{answer.scenario}: {answer.outcome}, {served} of {len(answer.visits)} greeted "
        f"in {answer.simulated_s:.1f} simulated seconds" + (f", facts as of {answer.at}" if answer.at else "")
    )
    yield table(
        [_reached(visit) for visit in answer.visits],
        head=(
            "person",
            "profile",
            "outcome",
            "distance wanted → reached",
            "bearing wanted → reached",
            "greeting",
        ),
    )
    for visit in answer.visits:
        note = visit.reason or visit.deviation_reason
        if note:
            yield f"  {visit.person}: {note}"
    yield from _differences(answer)
    yield from _done(answer)
    yield "\nWhy these values"
    for visit in answer.visits:
        inference = episode.prepared.values[visit.person]
        yield f"  {visit.person} ({visit.profile})"
        yield from (f"    Note: {note}" for note in inference.notes)
        yield table(
            [
                (
                    "  " + words(value.name),
                    number(value.value, value.unit) + toward(episode.prepared.plan, visit.person, value.name),
                    because(value, inference.inputs),
                )
                for value in inference.parameters.values()
            ]
        )
    yield f"  {SIDES}"


def _reached(visit: VisitAnswer) -> tuple[str, ...]:
    return (
        visit.person,
        visit.profile,
        visit.outcome.replace("_", " "),
        f"{visit.distance_wanted_m:.3f} → {number(visit.distance_reached_m, 'm')}",
        f"{number(visit.bearing_wanted_deg, digits=1)} → {number(visit.bearing_reached_deg, 'deg')}",
        (" + ".join(words(act) for act in visit.greeting) or "-")
        + (f", with {visit.together_with}" if visit.together_with else ""),
    )


def _done(answer: RunAnswer) -> Iterator[RenderableType]:
    """What was said and done, and how."""
    acts = [(visit.person, act) for visit in answer.visits for act in visit.acts if not act.stopped]
    if acts:
        yield "\nWhat was said and done"
        yield table([(person, *_told(act)) for person, act in acts])


def _told(act: ActAnswer) -> tuple[str, str]:
    if act.text is not None:
        return (
            f"“{act.text}”",
            f"volume {act.volume:.2f}, rate {act.rate:.2f}, {act.end_s - act.start_s:.1f} s",
        )
    return words(act.act), "" if act.amplitude is None else f"amplitude {act.amplitude:.2f}"


def _differences(answer: RunAnswer) -> Iterator[str]:
    """How differently people were met, in numbers: every pair of up to three, and the extremes of more."""
    met = [visit for visit in answer.visits if visit.distance_reached_m is not None]
    pairs = list(combinations(met, 2))
    if len(met) > 3:
        ordered = sorted(met, key=lambda visit: visit.distance_reached_m or 0.0)
        pairs = [(ordered[0], ordered[-1])]
    for one, other in pairs:
        near, far = sorted((one, other), key=lambda visit: visit.distance_reached_m or 0.0)
        apart_cm = 100 * ((far.distance_reached_m or 0.0) - (near.distance_reached_m or 0.0))
        yield f"  The robot stopped {apart_cm:.1f} cm farther from {far.person} than from {near.person}."
