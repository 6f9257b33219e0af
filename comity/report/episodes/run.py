"""The account of a run: before it, after it, and as a summary for people."""

from __future__ import annotations

import shlex
from dataclasses import replace
from itertools import combinations
from math import inf
from typing import TYPE_CHECKING, Any

from comity.answers.run import (
    ActAnswer,
    ActTowardsAnswer,
    LoopAnswer,
    PersonAnswer,
    PlannedInsteadAnswer,
    RunAnswer,
    VisitAnswer,
)
from comity.episode import fingerprint
from comity.monitoring.lateness import deadline_s, late_s
from comity.parameters.group_rules import group_rules
from comity.parameters.unread import notes_of_unread
from comity.report.episodes.attempts import repeated
from comity.report.episodes.facing import facing_error_deg
from comity.report.episodes.nearness import nearness_answers
from comity.report.episodes.revisions import door_answers, revision_answers
from comity.report.episodes.trace import disturbance_text
from comity.report.episodes.visit_reason import reason_of
from comity.report.episodes.why import OF_PLANS
from comity.report.plans.side import SIDES, toward
from comity.report.text import number, spans, table, words
from comity.report.values.inference import because, settled
from comity.report.values.wordings import unreviewed_text, wording_answers
from comity_domain import ENGINE
from comity_domain.choices.greeting import NO_GESTURE
from comity_executor import Utterance
from comity_fis.listing import listed
from comity_sim2d import HAND_OVER, PICK_UP, of_episode, of_person

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from rich.console import RenderableType

    from comity.episode import Episode
    from comity.live_episode import LiveEpisode
    from comity.output.run_folder import RunFolder
    from comity.preparation import PlannedEpisode
    from comity_domain import PlanStep
    from comity_executor import LoopReport, Visit
    from comity_fis import Inference, ParameterValue
    from comity_sim2d import ActEvent

SAME_CM = 0.05
"""Half of the last displayed digit [cm]: distances that differ by less are equal."""


def account_before(
    prepared: PlannedEpisode, folder: RunFolder, seed: int, *, robot: str | None = None
) -> RunAnswer:
    """The account before execution; `robot` is the name of a real robot."""
    return RunAnswer(
        status="running",
        outcome=None,
        scenario=prepared.file.scenario.name,
        robot=robot,
        rulebook=prepared.rulebook.name,
        rulebook_reason=prepared.chosen.why,
        group_rules=group_rules(prepared.rulebook),
        profiles={person: profile.name for person, profile in prepared.profiles.items()},
        seed=seed,
        episode=str(folder.path),
        reproduce=shlex.join(_command(folder, seed, prepared.engine)),
        trace_sha256=None,
        fingerprint=fingerprint(),
        simulated_s=0.0,
        at=prepared.day,
        visits=(),
        values={
            person: PersonAnswer(
                notes=inference.notes, parameters={name: settled(value) for name, value in inference.items()}
            )
            for person, inference in prepared.values.items()
        },
        metrics={},
        files=(),
    )


def _command(folder: RunFolder, seed: int, engine: str) -> list[str]:
    """The command that repeats the run."""
    option = [] if engine == ENGINE else ["--engine", engine]
    return ["comity", "run", str(folder / "scenario.yaml"), "--seed", str(seed), *option]


def account_after(before: RunAnswer, episode: Episode, folder: RunFolder) -> RunAnswer:
    """The account after execution, with its metrics."""
    measured = of_episode(episode.metrics)
    simulated_s, near = measured["duration_s"], nearness_answers(episode)
    return replace(
        before,
        status="done",
        outcome=episode.outcome,
        trace_sha256=episode.trace_sha256,
        simulated_s=simulated_s,
        bytes_per_minute=folder.bytes_per_minute(simulated_s),
        visits=tuple(visit_answers(episode)),
        acts=tuple(ActTowardsAnswer(person=act.person, **_facts(act)) for act in episode.acts),
        metrics=_floats(measured),
        revisions=tuple(revision_answers(episode.events, episode.revisions)),
        doors=tuple(door_answers(episode.door_turns)),
        disturbances=tuple(sorted([*episode.disturbances, *near], key=lambda one: one.t)),
        repeated=tuple(repeated(episode.events, episode.nodes)),
        figures={name: _floats(of_person(episode.metrics, name)) for name in episode.frames.entities[1:]},
        loop=_loop(episode.loop),
        files=folder.files(),
    )


def _floats(metrics: Mapping[str, float]) -> dict[str, float]:
    """Convert counts to floats, for example `2.0`."""
    return {name: float(value) for name, value in metrics.items()}


def _loop(report: LoopReport | None) -> LoopAnswer | None:
    if report is None:
        return None
    return LoopAnswer(
        ticks=report.ticks,
        late=len(report.overruns),
        longest_s=max((one.took_s for one in report.overruns), default=0.0),
        interrupted_by=report.interrupted_by,
    )


def account_under_way(before: RunAnswer, live: LiveEpisode) -> RunAnswer:
    """The account so far, with plan updates and door movements: an interrupted run keeps it."""
    return replace(
        before,
        revisions=tuple(revision_answers(live.events, live.revisions)),
        doors=tuple(door_answers(live.door_turns)),
        disturbances=live.disturbances,
    )


def visit_answers(episode: Episode) -> Iterator[VisitAnswer]:
    """All visits in the order in which the robot reached people; unreached people come last."""
    prepared = episode.prepared
    for visit in sorted(episode.visits, key=_reached_s):
        acts = tuple(ActAnswer(**_facts(event)) for event in _acts_for(visit.person, episode.acts))
        yield _visit(visit, episode, acts)
    planned = {visit.person for visit in episode.visits}
    for person, reason in prepared.asked.unreachable.items():
        if person in planned:
            continue
        yield VisitAnswer(
            person=person,
            profile=prepared.profiles[person].name,
            outcome="unreachable",
            distance_target_m=prepared.values[person]["conversational_distance"].number,
            distance_actual_m=None,
            centre_distance_actual_m=None,
            bearing_target_deg=None,
            bearing_actual_deg=None,
            facing_error_deg=None,
            pose_free=None,
            deviation_reason=None,
            docked_at_s=None,
            greeting=(),
            together_with=None,
            by_s=deadline_s(prepared.visitees, person),
            reason=reason,
        )


def _reached_s(visit: Visit) -> tuple[float, bool]:
    """Time at which the robot was with a person [s]; a person it docked at sorts before their company."""
    at_s = visit.docked_s if visit.greeted_s is None else visit.greeted_s
    return (inf if at_s is None else at_s, visit.together_with is not None)


def _acts_for(person: str, acts: Sequence[ActEvent]) -> Iterator[ActEvent]:
    """Acts directed at a person, and pick-ups for them."""
    for i, event in enumerate(acts):
        given = (e.person for e in acts[i:] if e.act == HAND_OVER and e.thing == event.thing)
        if person == (next(given, None) if event.act == PICK_UP else event.person):
            yield event


def _facts(event: ActEvent) -> dict[str, Any]:
    """Fields of an act, without its addressee."""
    return {
        "act": event.act,
        "start_s": event.t_start,
        "end_s": event.t_end,
        "text": event.text,
        "volume": event.volume,
        "rate": event.rate,
        "amplitude": event.amplitude,
        "thing": event.thing,
        "stopped": event.stopped,
        "latin": event.latin,
        **_words(event),
    }


def _words(event: ActEvent) -> dict[str, Any]:
    """Wordings of an utterance, if it has any."""
    said = event.utterance
    if not isinstance(said, Utterance):
        return {}
    spoken = said.spoken if said.spoken != event.text else None
    return {"spoken": spoken, "wordings": wording_answers(said.wordings)}


def _visit(visit: Visit, episode: Episode, acts: tuple[ActAnswer, ...]) -> VisitAnswer:
    prepared, docked, pose = episode.prepared, visit.docked_at, visit.pose
    values = episode.values[visit.person]
    stopped = episode.metrics.stopping.get(visit.person)
    return VisitAnswer(
        person=visit.person,
        profile=prepared.profiles[visit.person].name,
        outcome=visit.outcome,
        distance_target_m=values["conversational_distance"].number,
        distance_actual_m=docked.distance_m if docked else None,
        centre_distance_actual_m=docked.centre_distance_m if docked else None,
        approach_speed_target_m_s=values["approach_speed"].number,
        approach_speed_actual_m_s=stopped.speed_within_1_5_m_m_s if stopped else None,
        bearing_target_deg=visit.wanted.bearing_deg if visit.wanted else None,
        bearing_actual_deg=docked.bearing_deg if docked else None,
        facing_error_deg=facing_error_deg(visit, stopped),
        pose_free=pose.pose_free if pose else None,
        deviation_reason=visit.deviation_reason,
        unverified=visit.unverified,
        docked_at_s=visit.docked_s,
        greeting=visit.greeting,
        planned_instead=tuple(_planned_instead(episode.steps, values, visit.person)),
        agenda=visit.agenda,
        acts=acts,
        together_with=visit.together_with,
        by_s=deadline_s(prepared.visitees, visit.person),
        greeted_s=visit.greeted_s,
        late_s=late_s(prepared.visitees, visit),
        reason=reason_of(visit, episode),
        noticed=visit.noticed.kind if visit.noticed else None,
    )


def _planned_instead(
    steps: Iterable[PlanStep], values: Inference, person: str
) -> Iterator[PlannedInsteadAnswer]:
    """Categories chosen instead of the preferred ones; numbers are shown as target and actual."""
    for step in steps:
        for parameter, planned in step.parameters.items():
            inferred = values.parameters.get(parameter)
            if step.person != person or inferred is None or not isinstance(inferred.value, str):
                continue
            if planned not in (inferred.value, NO_GESTURE):
                yield PlannedInsteadAnswer(
                    parameter=parameter,
                    inferred=inferred.value,
                    planned=str(planned),
                    because=step.why.chosen or step.why.text,
                )


def reached_text(answer: RunAnswer) -> Iterator[RenderableType]:
    """The outcome, and the people in the order of visits, with times and actual values."""
    served = sum(visit.outcome == "greeted" for visit in answer.visits)
    late = sum(bool(visit.late_s) for visit in answer.visits)
    why = f": {answer.rulebook_reason}" if answer.rulebook_reason else ""
    yield f"\nRulebook {answer.rulebook}{why}"
    if answer.group_rules:
        used = (f"{group} in rules {spans(rules)}" for group, rules in answer.group_rules.items())
        yield f"  {', '.join(used)}"
    yield (
        f"{answer.scenario}: {answer.outcome}, {served} of {len(answer.visits)} greeted "
        f"{f'({late} late) ' if late else ''}in {answer.simulated_s:.1f} "
        + ("simulated seconds" if answer.robot is None else f"seconds with {answer.robot}")
        + (f", facts as of {answer.at}" if answer.at else "")
    )
    if answer.loop is not None and answer.loop.late:
        late_ticks = f"{answer.loop.late} of {answer.loop.ticks} ticks were late"
        yield f"  {late_ticks}, the longest took {answer.loop.longest_s:.2f} s"
    yield table(
        [_reached(visit) for visit in answer.visits],
        head=(
            "person",
            "profile",
            "outcome",
            "docked, greeted",
            "distance target → actual",
            "bearing target → actual",
            "greeting",
        ),
    )


def summary(answer: RunAnswer, episode: Episode) -> Iterator[RenderableType]:
    """Visits in order, with times, actual values, parameter values and their reasons."""
    yield from reached_text(answer)
    for visit in answer.visits:
        notes = (visit.reason or visit.deviation_reason, visit.unverified)
        yield from (f"  {visit.person}: {note}" for note in notes if note)
        yield from (
            f"  {visit.person}: {words(one.parameter)} {words(one.planned)} in the place of "
            f"{words(one.inferred)}: {one.because}"
            for one in visit.planned_instead
        )
        if visit.late_s:
            yield (
                f"  {visit.person}: greeted at {visit.greeted_s:.1f} s, {visit.late_s:.1f} s late "
                f"(by_s: {visit.by_s:g})"
            )
    yield from _touched(answer)
    yield from _differences(answer)
    yield from _happened(answer)
    yield from _revised(answer)
    yield from _done(answer)
    yield "\nWhy these values"
    for_all = notes_of_unread(episode.prepared.rulebook)
    yield from (f"  Note: {note}" for note in for_all)
    for visit in answer.visits:
        inference = episode.values[visit.person]
        yield f"  {visit.person} ({visit.profile})"
        yield from (f"    Note: {note}" for note in inference.notes if note not in for_all)
        yield table(
            [
                (
                    "  " + words(value.name),
                    _went_by(value, visit) + toward(episode.steps, visit.person, value.name),
                    because(value, inference.inputs),
                )
                for value in inference.parameters.values()
            ]
        )
    yield f"  {SIDES}"


def _went_by(value: ParameterValue, visit: VisitAnswer) -> str:
    """A value; for the approach speed also the actual maximum, after an arrow."""
    if value.name == "approach_speed" and visit.approach_speed_actual_m_s is not None:
        actual = number(visit.approach_speed_actual_m_s, value.unit)
        return f"{number(value.value)} → {actual}"
    return number(value.value, value.unit)


def _touched(answer: RunAnswer) -> Iterator[str]:
    """A warning if the robot touched something."""
    counts = {
        "people": answer.metrics.get("person_contacts"),
        "walls or doors": answer.metrics.get("wall_contacts"),
        "furniture": answer.metrics.get("furniture_contacts"),
    }
    told = [f"{what} {_times_in_words(count)}" for what, count in counts.items() if count]
    if told:
        yield f"  The robot touched {listed(told)}: `comity trace --events` says whom, when and why."


def _times_in_words(count: float) -> str:
    return {1.0: "once", 2.0: "twice"}.get(count, f"{count:g} times")


def _reached(visit: VisitAnswer) -> tuple[str, ...]:
    return (
        visit.person,
        visit.profile,
        visit.outcome.replace("_", " "),
        _times(visit),
        f"{visit.distance_target_m:.3f} → {number(visit.distance_actual_m, 'm')}",
        f"{number(visit.bearing_target_deg, digits=1)} → {number(visit.bearing_actual_deg, 'deg')}",
        (" + ".join(words(act) for act in visit.greeting) or "-")
        + (f", with {visit.together_with}" if visit.together_with else ""),
    )


def _times(visit: VisitAnswer) -> str:
    """Times of docking and of the end of the greeting, or a dash."""
    times_s = (visit.docked_at_s, visit.greeted_s)
    if times_s == (None, None):
        return "-"
    return ", ".join(number(t, digits=1) for t in times_s) + " s"


def _happened(answer: RunAnswer) -> Iterator[str]:
    """Faults, changes and messages with their times, and retried actions."""
    met = [one for one in answer.disturbances if one.kind != "walk"]
    if met or answer.repeated:
        yield "\nWhat happened on the way"
    for one in met:
        yield f"  t={one.t:.2f} s: {disturbance_text(one)}"
    for action in answer.repeated:
        first, *more = action.failed
        yield f"  {action.node} was tried {_times_in_words(action.attempts)}"
        yield f"    t={first.t:.2f} s: {first.because}"
        if more:
            yield f"    and failed {_times_in_words(len(more))} more, the last time at t={more[-1].t:.2f} s"


def _revised(answer: RunAnswer) -> Iterator[RenderableType]:
    """Plan updates during the episode."""
    if answer.revisions:
        yield "\nWhat became of the plan"
    for revision in answer.revisions:
        yield f"  t={revision.t:.2f} s: {OF_PLANS[revision.kind]}"
        yield from (f"    {text}" for text in revision.because)


def _done(answer: RunAnswer) -> Iterator[RenderableType]:
    """Acts with times and manner, requests to people who were only passed among them."""
    acts = [(act.person, act) for act in answer.acts if not act.stopped]
    if acts:
        yield "\nWhat was said and done"
        acts.sort(key=lambda pair: pair[1].start_s)
        yield table([(person, f"{act.start_s:.1f} s", *_told(act)) for person, act in acts])
        yield from filter(None, [unreviewed_text(one for _, act in acts for one in act.wordings)])


def _told(act: ActAnswer) -> tuple[str, str]:
    if act.text is not None:
        return (
            " ".join(filter(None, (f"“{act.text}”", act.latin and f"({act.latin})"))),
            f"volume {act.volume:.2f}, rate {act.rate:.2f}, {act.end_s - act.start_s:.1f} s",
        )
    if act.thing is not None:
        return f"{words(act.act)} {act.thing}", f"{act.end_s - act.start_s:.1f} s"
    return words(act.act), "" if act.amplitude is None else f"amplitude {act.amplitude:.2f}"


def _differences(answer: RunAnswer) -> Iterator[str]:
    """Differences between people in numbers: every pair of up to three people, else the extremes."""
    met = [visit for visit in answer.visits if visit.distance_actual_m is not None]
    pairs = list(combinations(met, 2))
    if len(met) > 3:
        ordered = sorted(met, key=lambda visit: visit.distance_actual_m or 0.0)
        pairs = [(ordered[0], ordered[-1])]
    for one, other in pairs:
        near, far = sorted((one, other), key=lambda visit: visit.distance_actual_m or 0.0)
        apart_cm = 100 * ((far.distance_actual_m or 0.0) - (near.distance_actual_m or 0.0))
        if apart_cm < SAME_CM:
            yield f"  The robot stopped as far from {far.person} as from {near.person}."
        else:
            yield f"  The robot stopped {apart_cm:.1f} cm farther from {far.person} than from {near.person}."
