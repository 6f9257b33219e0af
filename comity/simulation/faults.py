"""Conversion of a scenario's faults to happenings, checked before execution."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, assert_never

from comity.schedule import Announced
from comity.simulation.breakdowns import (
    DoorTurns,
    LeafBreaksDown,
    PartFails,
    PlannerBreaksDown,
    StandInTheWay,
    WalkOff,
)
from comity.specification.fault import (
    DoorCloses,
    DoorOpens,
    LeafRaises,
    PersonInTheWay,
    PersonWalksOff,
    PlannerFails,
    SensorBlind,
    SpeechFails,
    WheelStuck,
    deed,
    in_words,
)
from comity_executor import is_called
from comity_fis import InputError, closest, unknown_word
from comity_sim2d.maps.doorways import furniture_in
from comity_sim2d.senses.active_faults import BASE, SENSORS, VOICE

if TYPE_CHECKING:
    from comity.scenario import ScenarioFile
    from comity.schedule import Happening
    from comity.specification.fault import Fault
    from comity_executor import NodeId
    from comity_sim2d import Scene

PARTS = {"wheel stuck": BASE, "speech fails": VOICE, "sensor blind": SENSORS}


@dataclass(frozen=True, slots=True)
class Faults:
    """The faults of one scenario.

    Args:
        file: The scenario.
        scene: The scene, with its doors.
        leaves: Leaves of the plan's tree.
    """

    file: ScenarioFile
    scene: Scene
    leaves: Collection[NodeId]

    def happenings(self) -> tuple[Happening, ...]:
        """All happenings, in the order of the file.

        Raises:
            InputError: for a leaf that is not in the tree; `require_doors` checks doors.
        """
        return tuple(self._happenings())

    def require_doors(self) -> None:
        """Refuse missing doors, doors without a leaf, and doors blocked by furniture; needs no plan.

        Raises:
            InputError: for the first such door.
        """
        for i, fault in enumerate(self.file.scenario.faults):
            if isinstance(fault, DoorCloses | DoorOpens):
                self._require_door(i, fault.door)
                if isinstance(fault, DoorCloses) or fault.for_s is not None:
                    self._require_room(i, fault.door)

    def _happenings(self) -> Iterator[Happening]:
        for i, fault in enumerate(self.file.scenario.faults):
            if isinstance(fault, LeafRaises):
                self._require_leaf(i, fault.leaf)
            yield Announced(_happening(fault), "fault", _about(fault), deed(fault))

    def _require_door(self, i: int, name: str) -> None:
        doors = [door.name for door in self.scene.doors if door.kind != "opening"]
        if name in doors:
            return
        raise InputError(
            expected="a door of the map that has a leaf",
            got=repr(name),
            remedy=closest(name, doors) if doors else "Use a map with doors, or remove this fault.",
            where=self.file.where("faults", i, "door"),
        )

    def _require_room(self, i: int, name: str) -> None:
        door = next(door for door in self.scene.doors if door.name == name)
        thing = furniture_in(door, self.scene.furniture)
        if thing is not None:
            raise InputError(
                expected="a door that nothing keeps open",
                got=f"{name!r}, in which {thing} stands",
                remedy=f"Move {thing} out of the door, or remove this fault.",
                where=self.file.where("faults", i, "door"),
            )

    def _require_leaf(self, i: int, leaf: str) -> None:
        if not any(is_called(one, leaf) for one in self.leaves):
            raise unknown_word(
                "a leaf of the plan's tree, with or without the person",
                leaf,
                {word for one in self.leaves for word in (one.name, one.action)},
                where=self.file.where("faults", i, "leaf"),
            )


def _about(fault: Fault) -> str:
    """The person, door, leaf or robot part with a fault."""
    match fault:
        case PersonWalksOff() | PersonInTheWay():
            return fault.person
        case DoorCloses() | DoorOpens():
            return fault.door
        case LeafRaises():
            return fault.leaf
        case _:
            return fault.fault.partition(" ")[0]


def _happening(fault: Fault) -> Happening:
    at_s, text = fault.at_s, in_words(fault)
    match fault:
        case WheelStuck() | SpeechFails() | SensorBlind():
            return PartFails(at_s, fault.for_s, PARTS[fault.fault], text)
        case PersonWalksOff():
            heading_rad = None if fault.facing_deg is None else math.radians(fault.facing_deg)
            return WalkOff(at_s, fault.person, fault.by_m, heading_rad, fault.speed_m_s, text)
        case PersonInTheWay():
            return StandInTheWay(at_s, fault.person, fault.for_s, fault.speed_m_s, text)
        case DoorCloses() | DoorOpens():
            opens = isinstance(fault, DoorOpens)
            return DoorTurns(at_s, fault.door, opens, fault.for_s, text)
        case PlannerFails():
            return PlannerBreaksDown(at_s, fault.calls, text)
        case LeafRaises():
            return LeafBreaksDown(at_s, fault.leaf, fault.times, text)
        case _:
            assert_never(fault)
