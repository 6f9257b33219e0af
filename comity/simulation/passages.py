"""Passages at the reduced margin, detected from poses, and those that people gave way for in vain."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from comity.answers.run import Disturbance
from comity_executor.trees.passing import ASK
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.metrics import clearances_m
from comity_sim2d.people.stepping_out import HEARD_M, LEAST_ASIDE_M

if TYPE_CHECKING:
    from comity_sim2d import Frames, Person
    from comity_sim2d.robot.acts import ActEvent
    from comity_sim2d.robot.margins import MarginDecision

KEEPS = f"the robot keeps {PERSON_MARGIN_M:.2f} m from"
"""How it is told that the robot comes no nearer than the full margin."""
ANSWERS_S = 2.0
"""Time within which people who step aside have begun to, or made a short step [s]."""
SLACK_M = 1e-3
"""Tolerance of the full margin [m]: the precision of routes."""


def passages(
    frames: Frames,
    decisions: Iterable[MarginDecision],
    lacks: Callable[[float], str],
) -> Iterator[Disturbance]:
    """Passages nearer than the full margin, and answers that led to none, each with its reason.

    Args:
        frames: Poses of all bodies.
        decisions: Decisions about people who let the robot pass, in order.
        lacks: How much too narrow the robot's way is at a time [s], in words; empty if it is not.
    """
    gaps, time_s = clearances_m(frames), frames.time_s
    for one in decisions:
        if one.reasons:
            told = f"{KEEPS} {one.person}, who lets it pass"
            yield Disturbance(one.t, one.t, "passage", one.person, f"{told}: {'; '.join(one.reasons)}")
            continue
        gap_m = gaps[:, frames.entities.index(one.person) - 1]
        held = (time_s >= one.t) & (time_s <= (np.inf if one.end_s is None else one.end_s))
        near = np.flatnonzero(held & (gap_m < PERSON_MARGIN_M - SLACK_M))
        if near.size:
            start_s, end_s = float(time_s[near[0]]), float(time_s[near[-1]])
            text = f"the robot passes {one.person}, who lets it pass, at {gap_m[near].min():.2f} m"
            yield Disturbance(start_s, end_s, "passage", one.person, text)
        else:
            kept = f"{KEEPS} {one.person}, who lets it pass"
            text = f"{kept}: {lacks(one.t) or _in_vain(one, float(time_s[-1]))}"
            yield Disturbance(one.t, one.end_s, "passage", one.person, text)


def _in_vain(one: MarginDecision, last_s: float) -> str:
    """What lacked for a passage, and what would help, in words."""
    for_s = (last_s if one.end_s is None else one.end_s) - one.t
    leave = f"it might come to {one.clearance_m:.2f} m for {for_s:.1f} s only, until"
    if one.end_s is None:
        return f"{leave} the run ended"
    otherwise = "they moved, turned away, said something else or were out of its view"
    return f"{leave} {otherwise}; keep them still and in view"


def without_room(frames: Frames, acts: Iterable[ActEvent], people: Iterable[Person]) -> Iterator[Disturbance]:
    """First requests to step aside that a willing person heard and had no room to follow.

    Args:
        frames: Poses of all bodies.
        acts: What the robot did, in order.
        people: The people of the scene.
    """
    willing = {person.name for person in people if person.steps_aside and not person.lets_pass}
    for act in acts:
        if act.act != ASK or act.person not in willing or act.stopped:
            continue
        willing.remove(act.person)
        if frames.time_s[-1] < act.t_end + ANSWERS_S:
            continue
        then, later = np.searchsorted(frames.time_s, [act.t_end, act.t_end + ANSWERS_S])
        stood = frames.of(act.person)[then : later + 1, :2]
        heard = np.hypot(*(frames.poses[then, 0, :2] - stood[0])) <= HEARD_M
        if heard and np.hypot(*(stood - stood[0]).T).max() < LEAST_ASIDE_M:
            kept = f"{KEEPS} {act.person}, who was asked to let it pass"
            text = f"{kept}: no room to step aside by {LEAST_ASIDE_M:.2f} m"
            yield Disturbance(act.t_end, act.t_end, "passage", act.person, text)
