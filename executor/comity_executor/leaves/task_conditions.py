"""The conditions of the tree on the agenda of a visit."""

from __future__ import annotations

from collections.abc import Sequence

from comity_executor.memory.task import Task
from comity_executor.memory.visit_context import VisitContext
from comity_executor.nodes.cause import Account
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Condition, Ports
from comity_fis.listing import listed


class IsServed(Condition):
    """`served?`: is the person greeted, and the whole agenda done?"""

    def __init__(self, meeting: VisitContext, tasks: Sequence[Task]) -> None:
        super().__init__(NodeId.of("served?", meeting.person), meeting.greet_grounds)
        self._meeting = meeting.seen_by(self, reads=("greet", "performed", "attended", "done_before"))
        self._tasks = [task.seen_by(self, reads=("done_s",)) for task in tasks]

    def check(self) -> bool:
        """Once true, it stays true."""
        greeted = all(map(self._meeting.is_done, self._meeting.acts)) and self._meeting.is_attended
        return greeted and all(task.memory.done_s is not None for task in self._tasks)

    def explain(self) -> Account | None:
        """The next task."""
        left = [task.step.action for task in self._tasks if task.memory.done_s is None]
        return Account(f"still to do: {', '.join(left)}" if left else "all is done")


class IsTaskDone(Condition):
    """`said?`, `given?`, `waited?`, `left?`: is this task done?"""

    def __init__(self, task: Task) -> None:
        super().__init__(NodeId.of(f"{task.effect}?", *task.about), task.provenance)
        self._task = task.seen_by(self, reads=("done_s",))

    @property
    def ports(self) -> Ports:
        """The task."""
        return self._task.ports

    def check(self) -> bool:
        """Once true, it stays true."""
        return self._task.memory.done_s is not None

    def explain(self) -> Account | None:
        """Time at which the task was done."""
        done_s = self._task.memory.done_s
        return Account("not done yet" if done_s is None else f"done since {done_s:.2f} s", done_s)


class AreActsDone(Condition):
    """`taken_leave?`: are all acts of the farewell done?"""

    def __init__(self, task: Task) -> None:
        super().__init__(NodeId.of("taken_leave?", *task.about), task.provenance)
        self._task = task.seen_by(self, reads=("performed",))

    def check(self) -> bool:
        """Once true, it stays true."""
        return all(act in self._task.memory.performed for act in self._task.acts)

    def explain(self) -> Account | None:
        """The missing acts."""
        missing = [act for act in self._task.acts if act not in self._task.memory.performed]
        text = f"{listed(missing)} not done yet" if missing else f"{listed(self._task.acts)} done"
        return Account(text, parameter="greeting_modality")


class IsTaskActDone(Condition):
    """`done?`: was this act of a task performed, so that a second docking does not repeat it?"""

    def __init__(self, task: Task, act: str) -> None:
        super().__init__(NodeId.of("done?", act, *task.about), task.provenance)
        self._task = task.seen_by(self, reads=("performed",))
        self._act = act

    @property
    def ports(self) -> Ports:
        """The act and its task."""
        return {**self._task.ports, "act": self._act}

    def check(self) -> bool:
        """Once true, it stays true."""
        return self._act in self._task.memory.performed

    def explain(self) -> Account | None:
        """Whether it was performed."""
        return Account(f"{self._act} {'is done' if self.check() else 'not done yet'}")


class IsTaken(Condition):
    """`taken?`: does the robot hold the object to hand over, or has it handed it over?"""

    def __init__(self, task: Task) -> None:
        super().__init__(NodeId.of("taken?", *task.about), task.fetch_provenance)
        self._task = task.seen_by(self, reads=("performed", "handing_over"))

    @property
    def ports(self) -> Ports:
        """The object, and the person it is for."""
        return {"thing": self._task.thing, "person": self._task.person}

    def check(self) -> bool:
        """Check the robot's hands."""
        return self._task.is_taken()

    def explain(self) -> Account | None:
        """The object in the hands."""
        return Account(f"the robot holds {self._task.carrier.carried() or 'nothing'}")
