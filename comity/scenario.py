"""A scenario: a place, a robot, people who declared what they like, and what the robot is asked to do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    model_validator,
)

from comity.people.dated import Day
from comity.people.fact import Fact, Number
from comity.people.learnt_file import LearntValue
from comity.people.profile import Profile
from comity.specification.change import Change
from comity.specification.fault import Fault
from comity.specification.goal_check import GoalCheck
from comity.specification.goals import Goal, greeted
from comity.specification.matrix import Markers, Matrix
from comity.specification.on_foot import PassersBySpec, Walks
from comity.specification.scenario_check import NameCheck
from comity.system import library
from comity_fis import Where
from comity_fis.errors import WrongValueError
from comity_fis.learning.signals import SIGNALS, Signal
from comity_fis.proxemics import PERSON_MARGIN_M
from comity_fis.validation.yaml_file import YamlFile, read_yaml
from comity_sim2d.maps.file import Degrees, FurniturePiece, MapFile, Metres, Name, Point, WallLine
from comity_sim2d.robot.reduced_margin import BODY_MARGIN_M
from comity_sim2d.scene.person import PERSON_RADIUS_M
from comity_sim2d.scene.robot_body import ROBOT_RADIUS_M
from comity_sim2d.scene.robot_reaction import RobotReaction

_FILE = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)


def _but_posture(name: str) -> str:
    if name == "posture":
        raise WrongValueError(
            expected="what has no key of its own in `situation`",
            got=repr(name),
            remedy="Write `posture: ...` beside `situation`.",
        )
    return name


Decibels = Annotated[Number, Field(ge=0, le=140)]
ANYWHERE = "random"


class Place(BaseModel):
    """One room with its inner walls and furniture; the origin is its lower left corner."""

    model_config = _FILE

    width_m: Number = Field(gt=0, le=200)
    height_m: Number = Field(gt=0, le=200)
    walls_m: tuple[WallLine, ...] = Field(
        default=(), description="Inner walls, each from a point to a point."
    )
    furniture: tuple[FurniturePiece, ...] = ()
    noise_db: Decibels | None = Field(default=None, description="dB(A); loud noise makes speech useless.")
    noisy: bool = Field(default=False, description="Speech is useless here, at any distance.")


class MapPlace(BaseModel):
    """A map, with its doors as they are in this scenario."""

    model_config = _FILE

    map: Name | MapFile = Field(description="A shipped map, a file, or a map written out.")
    doors: Mapping[Name, Literal["open", "closed"]] = Field(
        default_factory=dict, description="By name; the others are as in the map."
    )
    noise_db: Decibels | None = Field(default=None, description="dB(A); loud noise makes speech useless.")
    noisy: bool = Field(default=False, description="Speech is useless here, at any distance.")


def _kind_of_place(place: object) -> str:
    return (
        "on a map" if isinstance(place, MapPlace) or (isinstance(place, dict) and "map" in place) else "room"
    )


class RandomPlace(BaseModel):
    """Somewhere in a room, drawn with the seed."""

    model_config = _FILE

    random_in: Name = Field(description="A room of the map.")


class Placement(BaseModel):
    """Where a person is and which way they face."""

    model_config = _FILE

    at_m: Point | None = None
    at: Name | RandomPlace | None = Field(
        default=None,
        description="Instead of at_m: a location of the map; `random`, which is anywhere; or a room to be "
        "random in.",
    )
    facing_deg: Degrees | None = Field(
        default=None,
        description="Counter-clockwise from the x axis; without it as the location says, at random at a "
        "random place, else 0.",
    )

    @model_validator(mode="after")
    def _one_place(self) -> Placement:
        if (self.at_m is None) == (self.at is None):
            raise WrongValueError(
                expected="either `at_m` or `at`",
                got="neither" if self.at is None else "both",
                remedy="Add a line `at_m: [x, y]`." if self.at is None else "Remove one of them.",
            )
        return self


class SensorSpec(BaseModel):
    """How the robot's knowledge of where people stand differs from the truth; by default it does not."""

    model_config = _FILE

    noise_m: Number = Field(default=0.0, ge=0, le=1, description="Standard deviation on each coordinate.")
    delay_s: Number = Field(default=0.0, ge=0, le=2, description="Age of what is known.")
    range_m: Number = Field(
        default=1000.0,
        ge=0.75,
        le=1000,
        description="Nobody farther is seen; from the robot's centre, `radius_m` inside its body, to theirs.",
    )
    field_of_view_deg: Number = Field(
        default=360.0, ge=5, le=360, description="About where the robot faces, half of it to either side."
    )
    hidden_by_walls: bool = Field(default=False, description="Whether walls hide who is behind them.")


class RobotStart(Placement):
    """The robot and where it starts."""

    name: Name = "robot"
    radius_m: Number = Field(
        default=ROBOT_RADIUS_M,
        ge=0.05,
        le=1.0,
        description="Of the disc that its body takes. Distances to people count from its edge.",
    )
    drive: Literal["omnidirectional", "differential"] = Field(
        default="omnidirectional", description="In any direction, or on two wheels: forwards and back."
    )
    max_speed_m_s: Number = Field(default=0.7, ge=0.01, le=3)
    max_acceleration_m_s2: Number = Field(default=0.5, ge=0.05, le=10)
    max_jerk_m_s3: Number = Field(
        default=20.0,
        ge=0.1,
        le=1000,
        description="How fast the acceleration may change; below `max_acceleration_m_s2` a second, the robot "
        "accelerates less than it may, by so much in a second.",
    )
    emergency_deceleration_m_s2: Number = Field(
        default=2.0, ge=0.05, le=100, description="How hard it brakes while its emergency stop is pressed."
    )
    sensor: SensorSpec = SensorSpec()
    gesture_reach_m: Mapping[Name, Annotated[Number, Field(ge=0, le=3)]] = Field(
        default_factory=dict,
        description="How far beyond its body each of its gestures reaches; a gesture is out where a "
        "wall or somebody is nearer than that.",
    )
    carrying: Name | None = Field(
        default=None, description="What it has in its hands: that rules out all gestures but a nod."
    )
    margin_m: Number = Field(
        default=PERSON_MARGIN_M,
        ge=BODY_MARGIN_M,
        le=PERSON_MARGIN_M,
        description="Clearance from bodies. Less than the default holds for adults alone who stand, let the "
        "robot pass and declared that they walk unaided, hear and see well, where no other way is left.",
    )


class ComfortSpec(BaseModel):
    """At which distances a person is at ease, and how they show when they are not: hidden from the robot."""

    model_config = _FILE

    wants_m: tuple[Metres, Metres] = Field(
        description="Nearer than the first is too close, farther than the second too far."
    )
    shows: tuple[Signal, ...] = Field(
        default=SIGNALS[:-1], description="What this person does; nothing about what none of these shows."
    )
    chance: Number = Field(default=1.0, ge=0, le=1, description="Of showing a discomfort at all.")


class PersonSpec(Placement):
    """A person in the place. Without a profile nothing is known about them, which is fine."""

    profile: Name | Profile = Field(
        default="unknown", description="A shipped profile, a file, or a profile written out."
    )
    posture: Literal["standing", "seated"] = Field(
        default="standing", description="Who is seated may be on furniture: they sit on it."
    )
    radius_m: Number = Field(
        default=PERSON_RADIUS_M,
        ge=0.1,
        le=2.0,
        description="Of the disc that their body takes, with a wheelchair, a walking frame or a chair.",
    )
    situation: Mapping[Annotated[str, AfterValidator(_but_posture)], Fact] = Field(
        default_factory=dict, description="What holds here and now, by the name of a rulebook's variable."
    )
    comfort: ComfortSpec | None = Field(default=None, description="Without it the person does not react.")
    guardian_consent: bool = Field(
        default=False, description="Of a child: the guardian has consented to the study."
    )
    walks: Walks | None = Field(default=None, description="Where they walk; without it they stay.")
    reacts: RobotReaction | None = Field(
        default=None, description="What they do about the robot (HuNavSim's reactions); without it nothing."
    )
    steps_aside: bool = Field(
        default=False, strict=True, description="Whether they step aside for a robot that asks to pass."
    )
    lets_pass: bool = Field(
        default=False, strict=True, description="Whether they say yes to a robot that asks to pass."
    )
    learnt: Mapping[Name, LearntValue] | None = Field(
        default=None,
        description="What was learnt with the person, as a run writes it; goes before the store.",
    )
    carrying: Name | None = Field(
        default=None, description="What they have in their hands: that rules out a handshake."
    )
    noise_db: Decibels | None = Field(default=None, description="Around this person, instead of the place's.")
    noisy: bool | None = Field(default=None, description="Around this person, instead of the place's.")


class Already(BaseModel):
    """A goal that is true before the robot starts."""

    model_config = _FILE

    greeted: Name


class LimitsSpec(BaseModel):
    """When to give up, in simulated seconds."""

    model_config = _FILE

    time_s: Number = Field(default=300.0, gt=0, le=36_000, description="The whole episode.")
    resumes: bool = Field(
        default=False,
        strict=True,
        description="Whether the robot is told to resume once its stop is released (it plans again then); "
        "without it an episode in which the stop is pressed ends there, at rest.",
    )
    planning_s: Number = Field(
        default=30.0, gt=0, le=3_600, description="The search for a plan (real seconds)."
    )
    attend_s: Number | None = Field(
        default=None,
        ge=0,
        le=60,
        description="How long the robot watches how each person takes it; without it 4 s where somebody "
        "reacts, and not at all where nobody does.",
    )
    replans: Annotated[int, Field(strict=True)] = Field(
        default=4, ge=0, le=100, description="New plans in a row without anything being done."
    )
    replan_pause_s: Number = Field(
        default=2.0,
        gt=0,
        le=3_600,
        description="Before the second of them; before each further one twice as long as before the last.",
    )
    patience_s: Number = Field(
        default=60.0,
        ge=0,
        le=36_000,
        description="How long a way that is known to be shut is waited for, in all until somebody is served; "
        "attempts are not used up.",
    )
    reach_attempts: Annotated[int, Field(strict=True)] = Field(
        default=2, ge=1, le=100, description="Attempts to reach a person, the first included."
    )
    reach_s: Number = Field(default=40.0, gt=0, le=3_600, description="One attempt to reach a person.")
    act_s: Number = Field(default=10.0, gt=0, le=3_600, description="One utterance or gesture.")
    act_pause_s: Number = Field(
        default=1.0, gt=0, le=3_600, description="One that was broken off is tried again so much later."
    )
    blocked_s: Number = Field(
        default=2.0,
        gt=0,
        le=3_600,
        description="So long the robot waits for a way that is blocked; then it asks who is in it to let it "
        "pass, or the attempt has failed where it is a thing.",
    )
    passing_s: Number = Field(
        default=6.0, gt=0, le=3_600, description="So long whoever was asked has to make way."
    )
    detour_m: Number = Field(
        default=3.0,
        gt=0,
        le=1_000,
        description="Metres. Somebody in the way is gone round at once where it is at most so much longer, "
        "else asked first.",
    )
    unseen_s: Number = Field(
        default=1.0,
        gt=0,
        le=3_600,
        description="A docked robot that loses sight of the person stays docked for so long.",
    )
    planning_mb: Annotated[int, Field(strict=True)] = Field(
        default=2048,
        ge=100,
        le=1_000_000,
        description="Without effect since visits are planned without a process of their own; files that "
        "name it stay valid.",
    )


class Scenario(BaseModel):
    """What happens, to whom and where; `comity schema scenario` prints this as a JSON schema."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, title="Comity scenario")

    schema_version: Literal[1]
    name: Name
    about: str = ""
    rulebook: Name | Mapping[str, Any] | None = Field(
        default=None,
        description="A shipped rulebook, a file, or a rulebook written out. Without it `evidence` where a "
        "real robot or a stored profile takes part; else `bruno2017`.",
    )
    at: Day | None = Field(
        default=None, description="The day on which dated facts are taken; without it the day of the run."
    )
    site_language: Name | None = Field(
        default=None,
        description="The language of the place, by code or name: what the robot speaks to a person who "
        "stated none that it has words in; English without it.",
    )
    wordings: tuple[Name | Mapping[str, Any], ...] = Field(
        default=(),
        max_length=50,
        description="Wordings of the site's own, each a file or written out; they go before those that ship.",
    )
    place: Annotated[
        Annotated[Place, Tag("room")] | Annotated[MapPlace, Tag("on a map")], Discriminator(_kind_of_place)
    ]
    robot: RobotStart
    people: Mapping[Name, PersonSpec] = Field(min_length=1)
    groups: Mapping[Name, tuple[Name, ...]] = Field(
        default_factory=dict, description="People who stand together and may be greeted at once, by a name."
    )
    passers_by: PassersBySpec | None = Field(
        default=None, description="People besides, whom nobody planned for."
    )
    keep_to: Literal["right", "left"] = Field(
        default="right", description="The side on which people who walk evade one another."
    )
    adults_only: bool = Field(
        default=False,
        description="For a real robot: the operator states that nobody is under 18 whose age is not known.",
    )
    child_study: bool = Field(
        default=False,
        description="For a real robot: this is a study with children, for which each has `guardian_consent`.",
    )
    already: tuple[Already, ...] = Field(default=(), description="What is true before the robot starts.")
    goals: tuple[Goal, ...] = Field(min_length=1)
    changes: tuple[Change, ...] = Field(
        default=(), max_length=1000, description="What happens while the robot is at it."
    )
    faults: tuple[Fault, ...] = Field(
        default=(), max_length=1000, description="What goes wrong while the robot is at it."
    )
    limits: LimitsSpec = LimitsSpec()
    expect: tuple[str | Mapping[str, str], ...] = Field(
        default=(), max_length=200, description="What a test holds, one sentence each; see `comity test`."
    )
    matrix: Matrix = Matrix()
    markers: Markers = Markers()

    def visited(self) -> tuple[str, ...]:
        """The people who are still to be greeted, in the order of the goals."""
        done = {fact.greeted for fact in self.already}
        return tuple(name for _, name in greeted(self.goals) if name not in done)


@dataclass(frozen=True, slots=True)
class ScenarioFile:
    """A scenario together with the file it came from, so that later complaints can name a line."""

    file: YamlFile
    scenario: Scenario
    real_robot: bool = False
    """Whether a real robot is to carry it out."""
    reduced_margin: bool = False
    """Whether the operator of a real robot allows it to pass people at the reduced margin that is set."""

    def __post_init__(self) -> None:
        scenario = self.scenario
        names = NameCheck(scenario.people, self.where)
        names.goals(greeted(scenario.goals))
        names.already(fact.greeted for fact in scenario.already)
        names.groups(scenario.groups)
        names.happening("changes", (change.person for change in scenario.changes))
        names.happening("faults", (getattr(fault, "person", None) for fault in scenario.faults))
        self.goal_check.order()
        self.goal_check.after()

    @property
    def goal_check(self) -> GoalCheck:
        """What the goals must agree on."""
        scenario = self.scenario
        done = {fact.greeted for fact in scenario.already}
        return GoalCheck(scenario.goals, scenario.people, done, self.where)

    def where(self, *location: str | int) -> Where:
        """The place of a value in the file."""
        return self.file.where(location)

    @property
    def folder(self) -> Path:
        """Where relative paths in the scenario start from."""
        return self.file.path.parent


def load_scenario(name: str) -> ScenarioFile:
    """A shipped scenario by name, or one from a file.

    Raises:
        InputError: if there is none, or the file does not hold a scenario.
    """
    path, called = library.find("scenario", name)
    file = read_yaml(path, called)
    return ScenarioFile(file, file.check(Scenario))
