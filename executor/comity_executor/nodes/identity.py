"""The identity of a node: what it does and for which person; its name is for display alone."""

from __future__ import annotations

from dataclasses import dataclass

from py_trees.behaviour import Behaviour


@dataclass(frozen=True, slots=True)
class NodeId:
    """What a node does and for which person."""

    action: str
    """What it does or asks, without the person: `Dock_to_user`, `docked?`, `Timeout 40 s`."""
    about: tuple[str, ...] = ()
    """What the name has in brackets: an act, a thing, a place, the person."""
    person: str | None = None
    """The person in whose visit it is; None for nodes of the whole run."""

    @classmethod
    def of(cls, action: str, *about: str) -> NodeId:
        """The identity of a node about a person, who comes last."""
        return cls(action, about, about[-1])

    @property
    def name(self) -> str:
        """For display: `done?(say, johanna)`."""
        return f"{self.action}({', '.join(self.about)})" if self.about else self.action


def as_id(name: NodeId | str) -> NodeId:
    """An identity as it is; a bare name is an action about nobody."""
    return name if isinstance(name, NodeId) else NodeId(name)


def id_of(node: Behaviour) -> NodeId:
    """The identity of any node; py_trees' own and those of a user have their name alone."""
    found = getattr(node, "node_id", None)
    return found if isinstance(found, NodeId) else NodeId(node.name)
