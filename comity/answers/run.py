"""What `comity run` answers: visits, what was said and done, and what became of the plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from typing import Any, Literal

from pydantic import model_validator

from comity.answers.base import Outcome
from comity.answers.inference import SettledAnswer
from comity.answers.plan import StepAnswer
from comity.answers.wording import WordingAnswer
from comity_executor.memory.visit import Deed
from comity_fis.learning.signals import Signal
from comity_fis.record import Record

DisturbanceKind = Literal["change", "fault", "message", "walk", "passage", "operator", "nearness", "reading"]
"""A change or a fault of the scenario, what a person says, a walk of a person, a person who was passed at a
reduced margin or let the robot pass in vain, a word of a real robot's operator, the robot nearer to a
person than they like, or what a real robot reads that looks like a mistake in its code."""
PlanStatus = Literal["rebound", "replanned", "not_replanned"]
"""What becomes of a plan under way."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ActAnswer(Record):
    """One utterance or gesture, as it was done."""

    act: str
    """`say`, a gesture's name, `pick_up` or `hand_over`."""
    start_s: float
    end_s: float
    """When it ended, or was broken off."""
    text: str | None
    """What was said; null for a gesture."""
    volume: float | None
    """Of an utterance, 0 to 1."""
    rate: float | None
    """Of an utterance, as a fraction of the normal rate."""
    amplitude: float | None
    """Of a gesture, 0 to 1."""
    thing: str | None = None
    """What was picked up or handed over."""
    stopped: bool
    """Whether it was broken off."""
    latin: str | None = None
    """The text in Latin letters, where it is written in others; else null."""
    spoken: str | None = None
    """The text with the pronunciation that a person stated in place of their name, where they did; else
    null."""
    wordings: tuple[WordingAnswer, ...] = ()
    """What the text is made of; empty for a scenario's own words and for gestures."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ActTowardsAnswer(ActAnswer):
    """An act and the person it was for, who may only have been passed."""

    person: str
    """Of `pick_up` the place instead."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedInsteadAnswer(Record):
    """A parameter for which the plan takes another value than the one that was inferred."""

    parameter: str
    inferred: str
    planned: str
    because: str
    """Why the plan takes it."""


NEWER = {
    "distance_target_m": "distance_wanted_m",
    "distance_actual_m": "distance_reached_m",
    "centre_distance_actual_m": "centre_distance_reached_m",
    "bearing_target_deg": "bearing_wanted_deg",
    "bearing_actual_deg": "bearing_reached_deg",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class VisitAnswer(Record):
    """What was aimed at and what came of it at one person."""

    person: str
    profile: str
    outcome: str
    distance_target_m: float
    """Between the nearest points of the two bodies."""
    distance_actual_m: float | None
    """The same, at rest before the person."""
    centre_distance_actual_m: float | None
    """The same between the centres."""
    approach_speed_target_m_s: float | None = None
    """The most within 1.5 m of the person's body; null where none was planned."""
    approach_speed_actual_m_s: float | None = None
    """The fastest there on the way in; null if the robot never came so near."""
    bearing_target_deg: float | None
    bearing_actual_deg: float | None
    facing_error_deg: float | None
    """At rest, or as it docked where it never rested; null if it never docked."""
    pose_free: bool | None
    """Whether the wanted pose was free; null if the robot never chose one."""
    deviation_reason: str | None
    unverified: str | None = None
    """Why the robot did not see the person when it docked, at the target distance from where they were last
    seen; null where it saw them."""
    docked_at_s: float | None
    greeting: tuple[str, ...]
    planned_instead: tuple[PlannedInsteadAnswer, ...] = ()
    """Where the plan takes something else than what was inferred for the person."""
    agenda: tuple[Deed, ...] = ()
    """What was to be done after the greeting, in order."""
    acts: tuple[ActAnswer, ...] = ()
    """Everything that was said and done."""
    together_with: str | None = None
    """Before whom the robot stood, where it greeted a group at once."""
    by_s: float | None = None
    """By when the greeting was to be over; null: whenever."""
    greeted_s: float | None = None
    """When the last act of the greeting was done; null where it was not."""
    late_s: float | None = None
    """How much later than `by_s` that was, 0 in time; null where either of them is null."""
    reason: str | None
    """Why the visit did not succeed."""
    noticed: Signal | None = None
    """How the person took it; null where the robot did not attend to that."""
    distance_wanted_m: float | None = None
    """The older name of the same with `target` or `actual`; gone with the next release."""
    distance_reached_m: float | None = None
    """The older name of the same with `target` or `actual`; gone with the next release."""
    centre_distance_reached_m: float | None = None
    """The older name of the same with `target` or `actual`; gone with the next release."""
    bearing_wanted_deg: float | None = None
    """The older name of the same with `target` or `actual`; gone with the next release."""
    bearing_reached_deg: float | None = None
    """The older name of the same with `target` or `actual`; gone with the next release."""

    def __post_init__(self) -> None:
        """Give the older of two names the value of the newer one."""
        for newer, older in NEWER.items():
            object.__setattr__(self, older, getattr(self, newer))

    @model_validator(mode="before")
    @classmethod
    def _of_older_files(cls, given: dict[str, Any]) -> dict[str, Any]:
        """Read the newer of two names from the older one, which alone is in the files of older versions."""
        return {newer: given[older] for newer, older in NEWER.items() if older in given} | given


@dataclass(frozen=True, slots=True, kw_only=True)
class PersonAnswer(Record):
    """One person's parameters in a run."""

    notes: tuple[str, ...]
    parameters: Mapping[str, SettledAnswer]


@dataclass(frozen=True, slots=True, kw_only=True)
class RevisionAnswer(Record):
    """What became of the plan while it was under way."""

    t: float
    kind: PlanStatus
    """rebound: the same choices with new numbers; replanned: another plan; not_replanned: the tree failed and
    no other plan took over, or the planner broke down."""
    because: tuple[str, ...]
    """What changed, how that is known, and the numbers."""
    cost: int | None = None
    """Of the plan from then on; null where there is none."""
    steps: tuple[StepAnswer, ...] = ()
    """What is left to do from then on."""
    unserved: Mapping[str, str] = field(default_factory=dict)
    """Who is left and cannot be served as things stand, and why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DoorTurnAnswer(Record):
    """A door that was opened or shut."""

    t: float
    door: str
    open: bool
    """From then on."""


@dataclass(frozen=True, slots=True)
class Disturbance(Record):
    """Something that happened while the plan was under way, whether or not the robot noticed.

    `passage` is the robot past a person at the reduced margin, or why not though they let it pass or would;
    `nearness` is the robot nearer to a person than they like, with the reason.
    """

    t: float
    """When it began."""
    end_s: float | None
    """When it was over; null where it was not by the end."""
    kind: DisturbanceKind
    about: str
    """The person, door or part of the robot."""
    text: str
    """What happened, in words."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FailedAttemptAnswer(Record):
    """An attempt that failed, and was followed by another one."""

    t: float
    """When it failed."""
    because: str
    """Why, with the fault behind it where one is known."""


@dataclass(frozen=True, slots=True, kw_only=True)
class AttemptsAnswer(Record):
    """An action that was tried again."""

    node: str
    attempts: int
    """How often it was tried, with the last time."""
    failed: tuple[FailedAttemptAnswer, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class LoopAnswer(Record):
    """How the loop of a real robot kept its rate."""

    ticks: int
    late: int
    """Ticks that took longer than their share of time."""
    longest_s: float
    """The longest of those."""
    interrupted_by: str | None
    """`SIGINT` or `SIGTERM`; null where it came to its own end."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SharedAnswer(Record):
    """What a run that can be passed on has beside pseudonyms, age bands, relative times and no free text."""

    culture: bool
    gender: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class RunAnswer(Record):
    """`comity run --json`, and `run.json` in the run folder."""

    status: Literal["running", "done", "crashed"]
    outcome: Outcome | None
    scenario: str
    robot: str | None = None
    """The real robot that carried it out; null for the simulated one."""
    rulebook: str
    rulebook_reason: str = ""
    """Why this one decided."""
    group_rules: Mapping[str, tuple[int, ...]] = field(default_factory=dict)
    """By `gender` and `nationality`, the numbers of its rules that go by it."""
    profiles: Mapping[str, str]
    at: date | None = None
    """The day of the facts; null where none depends on it."""
    seed: int
    episode: str
    reproduce: str
    trace_sha256: str | None
    fingerprint: str
    simulated_s: float
    visits: tuple[VisitAnswer, ...]
    """In the order of the visits; people whom the robot never reached come last."""
    values: Mapping[str, PersonAnswer] = field(default_factory=dict)
    """By person: the parameters and what each is made of."""
    acts: tuple[ActTowardsAnswer, ...] = ()
    """Everything that was said and done, in order, also to people who are passed."""
    metrics: Mapping[str, float]
    """Of the episode; `comity metrics` says what each means. What has no value is left out."""
    figures: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """By person: how the robot stopped before them, and kept its distance."""
    revisions: tuple[RevisionAnswer, ...] = ()
    """What became of the plan while it was under way, in order."""
    doors: tuple[DoorTurnAnswer, ...] = ()
    """Every door that was opened or shut while it was under way, in order."""
    disturbances: tuple[Disturbance, ...] = ()
    """Changes, faults, messages and walks of people, by time."""
    repeated: tuple[AttemptsAnswer, ...] = ()
    """Actions that were tried again after a failure."""
    loop: LoopAnswer | None = None
    """Of a real robot; null in the simulated world."""
    bytes_per_minute: Mapping[str, int] = field(default_factory=dict)
    """Of the trace, the readings and the frames, per simulated minute, by file."""
    files: tuple[str, ...]
    error: str | None = None
    shared: SharedAnswer | None = None
    """Of a run with pseudonyms, which can be passed on; else null."""
