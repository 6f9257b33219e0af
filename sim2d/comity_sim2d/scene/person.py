"""A person in a scene: pose, movement, and preferences."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d.kinds import TRUTH, require_kinds
from comity_sim2d.pose import XY, Pose
from comity_sim2d.scene.comfort import Comfort
from comity_sim2d.scene.margin_facts import MarginFacts
from comity_sim2d.scene.robot_reaction import SEEN_M, RobotReaction, require_reaction
from comity_sim2d.scene.walk import Walk
from comity_sim2d.scene_error import (
    SceneError,
    require_between,
    require_finite,
    require_one_of,
    require_text,
    unknown,
)

POSTURES = ("standing", "seated")
PERSON_RADIUS_M = 0.20
"""Default radius of the disc [m]: an adult's shoulders."""


@dataclass(frozen=True, slots=True)
class Person:
    """A person in the room, as a disc with a heading."""

    name: str
    x_m: float
    y_m: float
    heading_rad: float
    radius_m: float = PERSON_RADIUS_M
    posture: str = "standing"
    """One of `POSTURES`; a seated person's disc stands for the chair as well, or is on furniture."""
    personal_distance_m: float | None = None
    """Distance that a passing robot should keep, between surfaces, if possible [m]; None: the default."""
    approach_speed_m_s: float | None = None
    """Maximum speed of a robot within 1.5 m of the body, as the person asked [m/s]; None: the general
    limit."""
    comfort: Comfort | None = None
    """Preferred distances and their signals, hidden from the robot; None: the person does not react."""
    walk: Walk | None = None
    """The person's walk; None: they stay where they are."""
    reacts: RobotReaction | None = None
    """The person's reaction to the robot; None: a walking person takes it for another person."""
    steps_aside: bool = False
    """Whether the person steps out of the way of a robot that asks to pass."""
    lets_pass: bool = False
    """Whether the person agrees to such a request; both are hidden from the robot."""
    margin_facts: MarginFacts = field(default_factory=MarginFacts)
    """Declared facts about being passed at a reduced margin."""
    margin_m: float = PERSON_MARGIN_M
    """Current clearance of routes past the person, between surfaces [m]; lower while the robot has
    permission."""

    def __post_init__(self) -> None:
        require_text("people", "name", self.name)
        require_finite(self.name, x_m=self.x_m, y_m=self.y_m, heading_rad=self.heading_rad)
        require_between(self.name, "radius_m", self.radius_m, 0.05, 2.0)
        if self.personal_distance_m is not None:
            require_between(self.name, "personal_distance_m", self.personal_distance_m, 0.0, 10.0)
        if self.approach_speed_m_s is not None:
            require_between(self.name, "approach_speed_m_s", self.approach_speed_m_s, 0.001, 10.0)
        require_one_of(self.name, "posture", self.posture, POSTURES)
        if self.comfort is not None:
            require_kinds(self.name, comfort=(self.comfort, Comfort | None))
        if self.walk is not None:
            require_kinds(self.name, walk=(self.walk, Walk | None))
        if self.reacts is not None:
            require_reaction(self.name, self.reacts)
        if self.posture != "standing" and (self.may_move or self.steps_aside):
            raise SceneError(
                entity=self.name,
                field="walk" if self.walk else "reacts" if self.may_move else "steps_aside",
                expected="somebody who stands, to walk, to step aside or to go up to a robot or away from it",
                got=f"somebody {self.posture}",
                remedy="Leave it out, or let them stand.",
            )
        self._check_passing()

    def _check_passing(self) -> None:
        answers = {name: (getattr(self, name), TRUTH) for name in ("steps_aside", "lets_pass")}
        require_kinds(self.name, **answers, margin_facts=(self.margin_facts, MarginFacts))
        require_between(self.name, "margin_m", self.margin_m, 0.0, PERSON_MARGIN_M)
        if self.may_move and (self.steps_aside or self.lets_pass):
            raise SceneError(
                entity=self.name,
                field="steps_aside" if self.steps_aside else "lets_pass",
                expected="somebody who stays where they stand until they are asked to let the robot pass",
                got=f"{self.name}, who {'walks' if self.walk else f'is {self.reacts}'}",
                remedy="Leave it out, or let them stand.",
            )

    @property
    def may_move(self) -> bool:
        """Whether the person walks, or does so because of the robot's mere presence."""
        return self.walk is not None or self.reacts in SEEN_M

    @property
    def xy(self) -> XY:
        """Position [m]."""
        return (self.x_m, self.y_m)

    def gap_m(self, xy: XY, radius_m: float) -> float:
        """The gap between this person's body and a disc, negative where they overlap [m]."""
        return math.dist(xy, self.xy) - self.radius_m - radius_m

    @property
    def pose(self) -> Pose:
        """Pose of the person."""
        return Pose(self.x_m, self.y_m, self.heading_rad)


def find_person(people: tuple[Person, ...], name: str) -> Person:
    """The person of that name.

    Raises:
        ValueError: Where there is none.
    """
    if isinstance(name, str):
        for person in people:
            if person.name == name:
                return person
    raise unknown("a person of the scene", name, [person.name for person in people])
