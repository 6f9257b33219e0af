"""Records the acts of a real robot in the form of the simulated one's."""

from __future__ import annotations

from dataclasses import dataclass, replace

from comity_executor import ActGoal, ActStatus, GoalId, GoalStatus
from comity_executor.robots.goals import LOST
from comity_sim2d import ActEvent
from comity_sim2d.robot.acts import ASK_TO_PASS, is_spoken


@dataclass(slots=True)
class _Act:
    goal: GoalId
    """The robot's identifier of the act."""
    event: ActEvent
    is_over: bool = False


class ActRecord:
    """Acts by our own identifiers: text, since motion goals have numbers."""

    def __init__(self) -> None:
        self._acts: list[_Act] = []

    def begin(self, act: ActGoal, goal: GoalId, t: float) -> str:
        """Record the start of an act; returns our identifier for it.

        Args:
            act: The act.
            goal: The robot's identifier.
            t: The time [s].
        """
        spoken = is_spoken(act.act, act.text)
        event = ActEvent(
            t_start=t,
            t_end=t,
            act=act.act,
            person=act.to,
            text=act.text,
            volume=act.manner.volume if spoken else None,
            rate=act.manner.rate if spoken else None,
            amplitude=None if spoken or act.thing is not None else act.manner.amplitude,
            thing=act.thing,
            latin=None if act.latin == act.text else act.latin,
            utterance=act.utterance,
        )
        self._acts.append(_Act(goal, event))
        return f"act {len(self._acts)}"

    def goal_of(self, name: GoalId) -> GoalId:
        """The robot's identifier of an act."""
        return self._act(name).goal

    def note(self, name: GoalId, status: GoalStatus, t: float) -> GoalStatus:
        """Record the progress of an act; returns the status with our identifier."""
        act = self._act(name)
        if not act.is_over:
            act.event = replace(act.event, t_end=t, stopped=status.state in LOST)
            act.is_over = status.state == "succeeded" or status.state in LOST
        return ActStatus(name, status.state, status.text)  # type: ignore[arg-type]  # the tree refuses others

    def asked_to_pass(self, name: GoalId) -> str | None:
        """The person that a running act asks to let the robot pass, or None."""
        act = self._act(name)
        return act.event.person if act.event.act == ASK_TO_PASS and not act.is_over else None

    @property
    def events(self) -> tuple[ActEvent, ...]:
        """All acts in order of their start; a running one ends at its last update."""
        return tuple(act.event for act in self._acts)

    def _act(self, name: GoalId) -> _Act:
        return self._acts[int(str(name).removeprefix("act ")) - 1]
