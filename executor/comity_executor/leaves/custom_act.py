"""A custom behaviour as an act of a greeting or of an agenda.

The surrounding tree is unchanged: the act is done once, within the timeout for acts, and retried on failure.
The behaviour may have children. As in our leaves, an exception in one of its behaviours is a FAILURE with the
exception's text.
"""

from __future__ import annotations

from py_trees.behaviour import Behaviour
from py_trees.common import Status
from py_trees.decorators import Decorator

from comity_executor.memory.task import Task
from comity_executor.memory.visit_context import MakeAct, VisitContext
from comity_executor.nodes.identity import NodeId
from comity_executor.nodes.leaf import Ports
from comity_executor.nodes.node import preorder
from comity_executor.robots.raised import raised

_RESULTS = (Status.RUNNING, Status.SUCCESS, Status.FAILURE)


class CustomAct(Decorator):
    """Returns its child's result; a SUCCESS is recorded, so that a second docking does not repeat the act.

    Args:
        act: The name of the act.
        about: Arguments in the node's name.
        make: Makes the behaviour.
        of: The greeting or task that it belongs to, which records it.

    Raises:
        TypeError: If `make` returns something other than a behaviour.
    """

    def __init__(self, act: str, about: tuple[str, ...], make: MakeAct, of: VisitContext | Task) -> None:
        inner = NodeId(act, about, of.person)
        behaviour = make(inner.name, of.person)
        if not isinstance(behaviour, Behaviour):
            raise TypeError(
                f"acts[{act!r}]: expected a py_trees Behaviour for {inner.name}, got {behaviour!r}; "
                "give a class or a function of the node's name and the person that makes one"
            )
        for node in preorder(behaviour):
            _Guard(node)
        vars(behaviour)["node_id"] = inner
        self.node_id = NodeId("Custom_act", (act, *about), of.person)
        super().__init__(self.node_id.name, behaviour)
        self._act = act
        self._of = of.seen_by(self, writes=("performed", "performed_s", "done_s"))

    @property
    def ports(self) -> Ports:
        """The act, and the person to whom it is done."""
        return {"act": self._act, "person": self._of.person}

    def update(self) -> Status:
        """Return the child's status."""
        if self.decorated.status is Status.SUCCESS:
            self._of.note_done(self._act)
        return self.decorated.status


class _Guard:
    """Turns an exception in a behaviour into a FAILURE, so that none leaves the tick."""

    def __init__(self, node: Behaviour) -> None:
        self._node = node
        self._initialise, self._update, self._terminate = node.initialise, node.update, node.terminate
        self._error: Exception | None = None
        vars(node).update(initialise=self.begin, update=self.step, terminate=self.end)

    def begin(self) -> None:
        """Initialise the behaviour; if that raises, the next step is a FAILURE."""
        self._error = None
        try:
            self._initialise()
        except Exception as error:
            self._note(error)

    def step(self) -> Status:
        """Tick the behaviour, unless its initialisation failed."""
        if self._error is None:
            try:
                if (status := self._update()) in _RESULTS:
                    return status
                self._note(TypeError(f"expected RUNNING, SUCCESS or FAILURE of update, got {status!r}"))
            except Exception as error:
                self._note(error)
        return Status.FAILURE

    def end(self, new_status: Status) -> None:
        """Terminate the behaviour."""
        try:
            self._terminate(new_status)
        except Exception as error:
            self._note(error)

    def _note(self, error: Exception) -> None:
        if self._error is None:  # the first error causes the others
            self._error = error
            self._node.feedback_message = raised(error)
