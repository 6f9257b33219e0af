"""The world of a real robot as far as it senses it, with the records that a run folder holds."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from comity.answers.run import Disturbance
from comity.live.robot_on_map import RobotOnMap
from comity_sim2d.frames import FrameRecorder, frame_row
from comity_sim2d.senses.active_faults import ActiveFaults

if TYPE_CHECKING:
    from comity.live.operator import Operator
    from comity_executor import MapRobot
    from comity_sim2d import ActEvent, Door, DoorTurn, Frames, Scene, Touch
    from comity_sim2d.people.reactions import Shown
    from comity_sim2d.robot.margins import MarginDecision

DIGITS = 4
"""Decimal places of metres, seconds and radians in frames: a real robot is no more accurate."""


class RealWorld:
    """An environment that evolves by itself.

    Args:
        base: The robot.
        scene: The map, and people's positions at planning time.
        operator: The operator, who may hold the robot.
    """

    def __init__(self, base: MapRobot, scene: Scene, operator: Operator | None = None) -> None:
        self.scene = scene
        self.robot = RobotOnMap(base, scene, operator)
        self.faults = ActiveFaults()
        """No injected faults: real ones occur by themselves."""
        people = ((person.name, person.radius_m) for person in scene.people)
        self._recorder = FrameRecorder([(scene.robot.name, scene.robot.radius_m), *people])
        self._recorded_s = -1.0
        self._halts: list[Disturbance] = []
        self.observe()

    def observe(self) -> None:
        """Read the robot's sensors and store a frame; the first one is at 0 s."""
        self.robot.sense()
        self._note_halt()
        now_s = 0.0 if self._recorded_s < 0.0 else round(self.robot.now_s(), DIGITS)
        if now_s <= self._recorded_s:
            return  # a simulated clock that has not advanced
        self._recorded_s = now_s
        poses = (self.robot.here, *(person.pose for person in self.robot.people))
        rows = (frame_row(pose) for pose in poses)
        self._recorder.record(now_s, [(round(x, DIGITS), round(y, DIGITS), turn) for x, y, turn in rows])

    def _note_halt(self) -> None:
        """Record the periods in which the base has to stand."""
        has_stood = bool(self._halts) and self._halts[-1].end_s is None
        reason = self.robot.is_blind
        if reason and not has_stood:
            told = f"{reason}: the base stands until that is over"
            self._halts.append(Disturbance(self.time_s, None, "fault", self.robot.name, told))
        elif has_stood and not reason:
            self._halts[-1] = replace(self._halts[-1], end_s=self.time_s)

    @property
    def disturbances(self) -> tuple[Disturbance, ...]:
        """Periods in which the base had to stand, with reasons, and readings that suggest a mistake."""
        return (*self._halts, *self.robot.odd_readings)

    @property
    def time_s(self) -> float:
        """Time of the last frame since the start [s]."""
        return max(0.0, self._recorded_s)

    @property
    def doors(self) -> tuple[Door, ...]:
        """The doors of the map: a real robot reports no changes of doors."""
        return self.scene.doors

    @property
    def door_turns(self) -> tuple[DoorTurn, ...]:
        """None."""
        return ()

    @property
    def frames(self) -> Frames:
        """Believed positions of everybody so far."""
        return self._recorder.frames()

    def frames_since(self, count: int) -> Frames:
        """The frames without the first `count`."""
        return self._recorder.frames(count)

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """The robot's acts."""
        return self.robot.events

    @property
    def robot_touches(self) -> tuple[Touch, ...]:
        """None: collisions are reported by the robot's stop."""
        return ()

    @property
    def margin_decisions(self) -> tuple[MarginDecision, ...]:
        """Decisions on passing people at the reduced margin, in order."""
        return self.robot.margin_decisions

    @property
    def shown(self) -> tuple[Shown, ...]:
        """None: only what the robot noticed is known."""
        return ()
