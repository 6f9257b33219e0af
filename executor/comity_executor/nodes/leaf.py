"""Leaves: conditions and actions.

An exception in a leaf is a FAILURE with the exception's text, so that the tree can continue with the next
person and the trace records it. An exception while ending one leaf does not prevent the others from being
ended.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import NoReturn

from py_trees.behaviour import Behaviour
from py_trees.common import Status

from comity_executor.nodes.cause import Account, Provenance
from comity_executor.nodes.fault import FaultError
from comity_executor.nodes.identity import NodeId, as_id
from comity_executor.robots.raised import raised

Ports = Mapping[str, str | float]
"""Port names are the same for all leaves of a class."""


def told_by(provenance: Provenance | None) -> Ports:
    """The person a plan step is about, and its parameters."""
    return {"person": provenance.step.person, **provenance.step.parameters} if provenance else {}


class Condition(Behaviour, ABC):
    """A condition on the world, evaluated in every tick.

    Args:
        name: The question, with a question mark, and the person.
        provenance: The plan step whose effect or progress it asks for.
    """

    if_it_raises = Status.FAILURE
    """Result if the condition raises an exception."""

    def __init__(self, name: NodeId | str, provenance: Provenance | None = None) -> None:
        self.node_id = as_id(name)
        super().__init__(self.node_id.name)
        self.provenance = provenance
        self.fault: FaultError | None = None
        """Exception to raise at its next tick."""
        self._error: Exception | None = None

    @property
    def ports(self) -> Ports:
        """Ports of this class for other engines, by name."""
        return told_by(self.provenance)

    @abstractmethod
    def check(self) -> bool:
        """Evaluate the condition."""

    def explain(self) -> Account | None:
        """Explanation of the last result."""
        return None

    def update(self) -> Status:
        """Ask."""
        self._error = None
        try:
            if self.fault is not None:
                _raise(self, self.fault)
            return Status.SUCCESS if self.check() else Status.FAILURE
        except Exception as error:
            self._error = error
            return self.if_it_raises

    def account(self) -> Account | None:
        """The exception or the explanation; also the leaf's feedback message."""
        account = _account(self._error) if self._error else _explained(self)
        self.feedback_message = account.words if account else ""
        return account


class Action(Behaviour, ABC):
    """Something the robot does; whatever ends it, `end` is called once to stop what `begin` started.

    Args:
        name: What it does, and for which person.
        provenance: The plan step that it carries out.
    """

    def __init__(self, name: NodeId | str, provenance: Provenance | None = None) -> None:
        self.node_id = as_id(name)
        super().__init__(self.node_id.name)
        self.provenance = provenance
        self.fault: FaultError | None = None
        """Exception to raise at its next tick."""
        self._error: Exception | None = None
        self._begun = False
        self.has_to_end_again = False
        """Whether its end raised an exception, so that what it began may still run."""

    @property
    def ports(self) -> Ports:
        """Ports of this class for other engines, by name."""
        return told_by(self.provenance)

    @property
    def broke_down(self) -> bool:
        """Whether an exception made it fail in its last round."""
        return self.status is Status.FAILURE and self._error is not None

    @property
    def is_under_way(self) -> bool:
        """Whether it has begun and not ended."""
        return self._begun

    def begin(self) -> None:
        """Give the first command."""
        return

    @abstractmethod
    def step(self) -> Status:
        """Advance the action; returns its status."""

    def end(self) -> None:
        """Stop what was begun; the action succeeded, failed or was halted."""
        return

    def explain(self) -> Account | None:
        """Explanation of the last step's result."""
        return None

    def initialise(self) -> None:
        """Begin; py_trees calls this in the first tick of every round."""
        self._begun, self._error = True, None
        self.feedback_message = ""
        if self.has_to_end_again:
            self.try_to_end()
        if self._error is not None:
            return  # what it began before may go on, and nothing new begins beside it
        try:
            self.begin()
        except Exception as error:
            self._error = error

    def update(self) -> Status:
        """Take a step, unless beginning failed."""
        if self._error is None:
            try:
                if self.fault is not None:
                    _raise(self, self.fault)
                return self.step()
            except Exception as error:
                self._error = error
        return Status.FAILURE

    def terminate(self, new_status: Status) -> None:
        """End, once per round: py_trees also terminates what finished long ago when it resets a branch."""
        if self._begun:
            self._begun = False
            self.try_to_end()

    def try_to_end(self) -> None:
        """End; where that raises, the execution tries again in its next tick."""
        self.has_to_end_again = False
        try:
            self.end()
        except Exception as error:
            self.has_to_end_again = True
            self._error = self._error or error  # the first one is the reason for the others

    def account(self) -> Account | None:
        """The exception or the explanation; also the leaf's feedback message."""
        account = _account(self._error) if self._error else _explained(self)
        self.feedback_message = account.words if account else ""
        return account


def _raise(leaf: Condition | Action, fault: FaultError) -> NoReturn:
    """What a leaf was told to raise, once."""
    leaf.fault = None
    raise fault


def _explained(leaf: Condition | Action) -> Account | None:
    """What a leaf says for itself; what it asks the robot for that may raise, too."""
    try:
        return leaf.explain()
    except Exception as error:
        return _account(error)


def _account(error: Exception) -> Account:
    if isinstance(error, FaultError):
        return Account("an exception", fault=str(error))
    return Account(raised(error))
