"""Goals for robots and reports on them: every goal has an identifier and a state.

A base may accept a goal late, reject it or abort it, and another program may replace it; a late cancel must
not hit the next goal. So the robot gives each goal an identifier, and reports name it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf
from typing import Literal, Protocol, get_args

from comity_executor.speech.address import without_names
from comity_executor.speech.manner import NORMAL, Manner
from comity_executor.speech.utterance import Utterance

GoalId = int | str
"""Identifier of a goal or an act: a number, or the text of a UUID. It is never reused."""
GoalState = Literal[
    "accepted", "running", "succeeded", "declined", "rejected", "aborted", "preempted", "stopped"
]
STATES: tuple[str, ...] = get_args(GoalState)
"""Allowed states of a goal or an act.

`accepted`: it will begin. `running`. `succeeded`: it is reached; a docked robot keeps holding its pose, and
is `running` again when it has to follow the person. `declined`: the person to be reached does not want it.
`rejected`: it never began. `aborted`: the robot gave it up. `preempted`: another goal replaced it. `stopped`:
it was stopped on command.
"""
DECLINED: GoalState = "declined"
LOST = ("rejected", "aborted", "preempted", "stopped")
"""States of a goal that will not be reached."""


class RelativePose(Protocol):
    """A docking pose relative to a person, so that it moves along with them."""

    @property
    def distance_m(self) -> float:
        """Distance between the nearest points of the two bodies [m]."""
        ...

    @property
    def bearing_deg(self) -> float:
        """Bearing in (-180, 180], positive to the person's left [deg]."""
        ...

    @property
    def pose_free(self) -> bool:
        """Whether it is the target pose."""
        ...

    @property
    def deviation_reason(self) -> str | None:
        """Why it is not the target pose; None if it is."""
        ...


@dataclass(frozen=True, slots=True)
class PlannedPose:
    """The planned pose, before the robot checks whether it is free."""

    distance_m: float
    bearing_deg: float
    pose_free: bool = True
    deviation_reason: str | None = None
    unverified: str | None = None
    """Why the robot might not see the person from there; None if it would."""


def unverified(pose: RelativePose | None) -> str | None:
    """Why a robot might not see the person from a pose; None if it would, or does not say."""
    reason: str | None = getattr(pose, "unverified", None)
    return reason


@dataclass(frozen=True, slots=True)
class MotionGoal:
    """A motion goal for the base.

    `navigate`: take the shortest route until close to the pose. `dock`: move precisely onto the pose and hold
    it, following the person. `face`: turn on the spot towards the person. `go_to`: go to the location of an
    object, and face it.
    """

    kind: Literal["navigate", "dock", "face", "go_to"]
    to: str
    """A person; for `go_to`, a place."""
    pose: RelativePose | None = None
    """Pose near the person, for `navigate` and `dock`: any pose, not only a chosen one."""
    speed_m_s: float = inf
    """Maximum speed [m/s]; infinite for `face`, which does not travel."""
    near_m_s: float = inf
    """Maximum speed within 1.5 m of the person's body, from every side, for `navigate` [m/s]; for `dock` it
    is `speed_m_s`."""
    detour_m: float = inf
    """Maximum additional length of a detour around people, for `navigate` and `go_to` [m]. If the detour is
    longer, or there is none, the robot approaches the obstructing people and is `blocked_by` them until they
    make way."""
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    """The person's other parameters, by name (`other_parameters`); a robot uses those that it knows."""


@dataclass(frozen=True, slots=True)
class ActGoal:
    """A goal to speak, gesture, pick up or hand over."""

    act: str
    """`say` or `ask_to_pass` with a text, `pick_up` or `hand_over` with a thing, or a gesture's name."""
    to: str
    """The addressee; for `pick_up`, the place."""
    text: str | None = None
    """The text to say, in the script of its language."""
    thing: str | None = None
    manner: Manner = NORMAL
    """Volume and rate of speech, amplitude of gestures."""
    utterance: Utterance | None = None
    """The wordings that `text` is made of, with their facts; None for a gesture or a plan's own text."""
    parameters: Mapping[str, float | str] = field(default_factory=dict)
    """The person's other parameters, as in a motion goal, and those of the planned task, such as its field
    `seconds`, besides its thing."""

    @property
    def language(self) -> str | None:
        """The language of the text as a BCP 47 tag; None if unknown."""
        return self.utterance.language if self.utterance else None

    @property
    def latin(self) -> str | None:
        """The text in Latin letters."""
        return self.utterance.latin if self.utterance else self.text

    @property
    def spoken(self) -> str | None:
        """The text for a speech synthesiser, with the pronunciation that a person gave for their name."""
        return self.utterance.spoken if self.utterance else self.text

    def without(self, people: Collection[str]) -> ActGoal:
        """A copy that does not name these people."""
        if self.utterance is None:
            return self if self.text is None else replace(self, text=without_names(self.text, people))
        utterance = self.utterance.without(people)
        return replace(self, text=utterance.text, utterance=utterance)


def speech(
    act: str, to: str, words: Utterance | str, *, thing: str | None = None, manner: Manner = NORMAL
) -> ActGoal:
    """Make a goal for an act of speech.

    Args:
        act: `say` or `ask_to_pass`.
        to: The addressee.
        words: The utterance, or the plan's own text.
        thing: The object handed over with it.
        manner: Volume and rate.
    """
    if isinstance(words, str):
        return ActGoal(act, to, words, thing, manner)
    return ActGoal(act, to, words.text, thing, manner, words)


class GoalStatus(Protocol):
    """The progress of a goal or an act."""

    @property
    def goal(self) -> GoalId | None:
        """Identifier; None if there has been no goal yet."""
        ...

    @property
    def state(self) -> str:
        """One of `STATES`; any other word is an error."""
        ...

    @property
    def text(self) -> str:
        """A reason for readers, in particular if it is blocked or lost; may be empty."""
        ...


class Motion(GoalStatus, Protocol):
    """The progress of the newest motion goal."""

    @property
    def stamp_s(self) -> float:
        """Time of the base's last report, by the robot's clock [s]; outdated reports are ignored."""
        ...

    @property
    def remaining_m(self) -> float | None:
        """Length of the remaining path [m]; None if unknown."""
        ...

    @property
    def is_blocked(self) -> bool:
        """Whether it makes no progress, for the reason in `text`."""
        ...

    @property
    def blocked_by(self) -> Sequence[str]:
        """Names of all obstructing people to ask; empty if only objects obstruct the path."""
        ...

    @property
    def is_at_rest(self) -> bool:
        """Whether the base neither moves nor turns, by its own measurement."""
        ...


@dataclass(frozen=True, slots=True)
class ActStatus:
    """A `GoalStatus` for robots without a class of their own."""

    goal: GoalId | None
    state: GoalState
    text: str = ""


@dataclass(frozen=True, slots=True)
class MotionStatus:
    """A `Motion` for robots without a class of their own."""

    goal: GoalId | None
    state: GoalState
    text: str = ""
    stamp_s: float = 0.0
    remaining_m: float | None = None
    is_blocked: bool = False
    blocked_by: tuple[str, ...] = ()
    is_at_rest: bool = False
