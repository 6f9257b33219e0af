"""What `comity run` answers: visits, what was said and done, and what became of the plan."""

from __future__ import annotations

from collections.abc import Mapping
from datetime import date
from typing import Literal

from pydantic import Field, model_validator

from comity.answers.base import Answer, Outcome
from comity.answers.inference import ContributionAnswer, PartAnswer
from comity.answers.plan import StepAnswer
from comity.answers.wording import WordingAnswer
from comity_fis.inference.value import Origin
from comity_fis.learning.signals import Signal

PlanStatus = Literal["rebound", "replanned", "not_replanned"]
"""What becomes of a plan under way."""


class ActAnswer(Answer):
    """One utterance or gesture, as it was done."""

    act: str = Field(description="`say`, a gesture's name, `pick_up` or `hand_over`.")
    start_s: float
    end_s: float = Field(description="When it ended, or was broken off.")
    text: str | None = Field(description="What was said; null for a gesture.")
    volume: float | None = Field(description="Of an utterance, 0 to 1.")
    rate: float | None = Field(description="Of an utterance, as a fraction of the normal rate.")
    amplitude: float | None = Field(description="Of a gesture, 0 to 1.")
    thing: str | None = Field(default=None, description="What was picked up or handed over.")
    stopped: bool = Field(description="Whether it was broken off.")
    latin: str | None = Field(
        default=None, description="The text in Latin letters, where it is written in others; else null."
    )
    spoken: str | None = Field(
        default=None,
        description="The text with the pronunciation that a person stated in place of their name, where they "
        "did; else null.",
    )
    wordings: tuple[WordingAnswer, ...] = Field(
        default=(), description="What the text is made of; empty for a scenario's own words and for gestures."
    )


class ActTowardsAnswer(ActAnswer):
    """An act and the person it was for, who may only have been passed."""

    person: str = Field(description="Of `pick_up` the place instead.")


class DeedAnswer(Answer):
    """One thing on the agenda of a visit."""

    action: str
    arguments: tuple[str, ...]
    done_s: float | None = Field(description="When it was done; null where it was not.")


class PlannedInsteadAnswer(Answer):
    """A parameter for which the plan takes another value than the one that was inferred."""

    parameter: str
    inferred: str
    planned: str
    because: str = Field(description="Why the plan takes it.")


OLDER = "The older name of the same with `target` or `actual`; gone with the next release."
NEWER = {
    "distance_target_m": "distance_wanted_m",
    "distance_actual_m": "distance_reached_m",
    "centre_distance_actual_m": "centre_distance_reached_m",
    "bearing_target_deg": "bearing_wanted_deg",
    "bearing_actual_deg": "bearing_reached_deg",
}


class VisitAnswer(Answer):
    """What was aimed at and what came of it at one person."""

    person: str
    profile: str
    outcome: str
    distance_target_m: float = Field(description="Between the nearest points of the two bodies.")
    distance_actual_m: float | None = Field(description="The same, at rest before the person.")
    centre_distance_actual_m: float | None = Field(description="The same between the centres.")
    approach_speed_target_m_s: float | None = Field(
        default=None, description="The most within 1.5 m of the person's body; null where none was planned."
    )
    approach_speed_actual_m_s: float | None = Field(
        default=None, description="The fastest there on the way in; null if the robot never came so near."
    )
    bearing_target_deg: float | None
    bearing_actual_deg: float | None
    facing_error_deg: float | None = Field(
        description="At rest, or as it docked where it never rested; null if it never docked."
    )
    pose_free: bool | None = Field(
        description="Whether the wanted pose was free; null if the robot never chose one."
    )
    deviation_reason: str | None
    unverified: str | None = Field(
        default=None,
        description="Why the robot did not see the person when it docked, at the target distance from where "
        "they were last seen; null where it saw them.",
    )
    docked_at_s: float | None
    greeting: tuple[str, ...]
    planned_instead: tuple[PlannedInsteadAnswer, ...] = Field(
        default=(), description="Where the plan takes something else than what was inferred for the person."
    )
    agenda: tuple[DeedAnswer, ...] = Field(
        default=(), description="What was to be done after the greeting, in order."
    )
    acts: tuple[ActAnswer, ...] = Field(default=(), description="Everything that was said and done.")
    together_with: str | None = Field(
        default=None, description="Before whom the robot stood, where it greeted a group at once."
    )
    by_s: float | None = Field(
        default=None, description="By when the greeting was to be over; null: whenever."
    )
    greeted_s: float | None = Field(
        default=None, description="When the last act of the greeting was done; null where it was not."
    )
    late_s: float | None = Field(
        default=None,
        description="How much later than `by_s` that was, 0 in time; null where either of them is null.",
    )
    reason: str | None = Field(description="Why the visit did not succeed.")
    noticed: Signal | None = Field(
        default=None, description="How the person took it; null where the robot did not attend to that."
    )
    distance_wanted_m: float | None = Field(default=None, description=OLDER)
    distance_reached_m: float | None = Field(default=None, description=OLDER)
    centre_distance_reached_m: float | None = Field(default=None, description=OLDER)
    bearing_wanted_deg: float | None = Field(default=None, description=OLDER)
    bearing_reached_deg: float | None = Field(default=None, description=OLDER)

    @model_validator(mode="before")
    @classmethod
    def _older_keys(cls, given: object) -> object:
        """The older of two names has the value of the newer one, and the other way round in older files."""
        if not isinstance(given, dict):
            return given
        both = dict(given)
        for newer, older in NEWER.items():
            name = newer if newer in both else older
            if name in both:
                both[newer] = both[older] = both[name]
        return both


class SettledAnswer(Answer):
    """A value and what it is made of."""

    value: float | str
    unit: str | None
    spread: float | None
    origin: Origin
    contributions: tuple[ContributionAnswer, ...]
    parts: tuple[PartAnswer, ...]
    note: str


class AskAnswer(Answer):
    """`comity profile ask --json`."""

    name: str
    parameter: Literal["conversational_distance"]
    answer_m: float | None = Field(description="Null where it was left open, or taken back with `unknown`.")
    counts_as: Literal["setting", "observation"] | None = Field(
        description="Null where the question was left open."
    )
    at: date = Field(description="The day of the answer.")
    situation: Mapping[str, str | float] = Field(description="In which an observation counts.")
    value: SettledAnswer | None = Field(description="How near the robot comes from now on, and why.")


class PersonAnswer(Answer):
    """One person's parameters in a run."""

    notes: tuple[str, ...]
    parameters: Mapping[str, SettledAnswer]


class RevisionAnswer(Answer):
    """What became of the plan while it was under way."""

    t: float
    kind: PlanStatus = Field(
        description="rebound: the same choices with new numbers; replanned: another plan; not_replanned: the "
        "tree failed and no other plan took over, or the planner broke down."
    )
    because: tuple[str, ...] = Field(description="What changed, how that is known, and the numbers.")
    cost: int | None = Field(default=None, description="Of the plan from then on; null where there is none.")
    steps: tuple[StepAnswer, ...] = Field(default=(), description="What is left to do from then on.")
    unserved: Mapping[str, str] = Field(
        default={}, description="Who is left and cannot be served as things stand, and why."
    )


class DoorTurnAnswer(Answer):
    """A door that was opened or shut."""

    t: float
    door: str
    open: bool = Field(description="From then on.")


class DisturbanceAnswer(Answer):
    """Something that happened while the plan was under way, whether or not the robot noticed.

    `passage` is the robot past a person at the reduced margin, or why not though they let it pass;
    `nearness` is the robot nearer to a person than they like, with the reason.
    """

    t: float = Field(description="When it began.")
    end_s: float | None = Field(description="When it was over; null where it was not by the end.")
    kind: Literal["change", "fault", "message", "walk", "passage", "operator", "nearness"]
    about: str = Field(description="The person, door or part of the robot.")
    text: str = Field(description="What happened, in words.")


class FailedAttemptAnswer(Answer):
    """An attempt that failed, and was followed by another one."""

    t: float = Field(description="When it failed.")
    because: str = Field(description="Why, with the fault behind it where one is known.")


class AttemptsAnswer(Answer):
    """An action that was tried again."""

    node: str
    attempts: int = Field(description="How often it was tried, with the last time.")
    failed: tuple[FailedAttemptAnswer, ...]


class LoopAnswer(Answer):
    """How the loop of a real robot kept its rate."""

    ticks: int
    late: int = Field(description="Ticks that took longer than their share of time.")
    longest_s: float = Field(description="The longest of those.")
    interrupted_by: str | None = Field(
        description="`SIGINT` or `SIGTERM`; null where it came to its own end."
    )


class SharedAnswer(Answer):
    """What a run that can be passed on has beside pseudonyms, age bands, relative times and no free text."""

    culture: bool
    gender: bool


class RunAnswer(Answer):
    """`comity run --json`, and `run.json` in the run folder."""

    status: Literal["running", "done", "crashed"]
    outcome: Outcome | None
    scenario: str
    robot: str | None = Field(
        default=None, description="The real robot that carried it out; null for the simulated one."
    )
    rulebook: str
    rulebook_reason: str = Field(default="", description="Why this one decided.")
    group_rules: Mapping[str, tuple[int, ...]] = Field(
        default={}, description="By `gender` and `nationality`, the numbers of its rules that go by it."
    )
    profiles: Mapping[str, str]
    at: date | None = Field(default=None, description="The day of the facts; null where none depends on it.")
    seed: int
    episode: str
    reproduce: str
    trace_sha256: str | None
    fingerprint: str
    simulated_s: float
    visits: tuple[VisitAnswer, ...] = Field(
        description="In the order of the visits; people whom the robot never reached come last."
    )
    values: Mapping[str, PersonAnswer] = Field(
        default={}, description="By person: the parameters and what each is made of."
    )
    acts: tuple[ActTowardsAnswer, ...] = Field(
        default=(), description="Everything that was said and done, in order, also to people who are passed."
    )
    metrics: Mapping[str, float] = Field(
        description="Of the episode; `comity metrics` says what each means. What has no value is left out."
    )
    figures: Mapping[str, Mapping[str, float]] = Field(
        default={}, description="By person: how the robot stopped before them, and kept its distance."
    )
    revisions: tuple[RevisionAnswer, ...] = Field(
        default=(), description="What became of the plan while it was under way, in order."
    )
    doors: tuple[DoorTurnAnswer, ...] = Field(
        default=(), description="Every door that was opened or shut while it was under way, in order."
    )
    disturbances: tuple[DisturbanceAnswer, ...] = Field(
        default=(), description="Changes, faults, messages and walks of people, by time."
    )
    repeated: tuple[AttemptsAnswer, ...] = Field(
        default=(), description="Actions that were tried again after a failure."
    )
    loop: LoopAnswer | None = Field(default=None, description="Of a real robot; null in the simulated world.")
    bytes_per_minute: Mapping[str, int] = Field(
        default={}, description="Of the trace, the readings and the frames, per simulated minute, by file."
    )
    files: tuple[str, ...]
    error: str | None = None
    shared: SharedAnswer | None = Field(
        default=None, description="Of a run with pseudonyms, which can be passed on; else null."
    )
