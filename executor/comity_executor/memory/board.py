"""What leaves share: typed entries on py_trees' blackboard, with declared readers and writers.

py_trees keeps one blackboard for the whole process. Every execution has a namespace of its own there, so that
two of them never meet, and unregisters it at its end. A leaf that uses an entry without having declared so
gets py_trees' AttributeError, and fails with it.
"""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from copy import copy
from dataclasses import dataclass
from itertools import count
from types import MappingProxyType
from typing import Any, Generic, Literal, Self, TypeVar, overload

from py_trees.behaviour import Behaviour
from py_trees.blackboard import Blackboard, Client
from py_trees.common import Access

from comity_executor.memory.write import Write, in_words

Value = TypeVar("Value")
_NUMBERS = count(1)


class Unset:
    """No value yet."""


UNSET = Unset()


@dataclass(frozen=True, slots=True)
class Shared:
    """One thing that leaves share: an entry of the blackboard as it is now."""

    key: str
    """Relative to the namespace of the execution, `johanna/docked`."""
    value: object
    readers: tuple[str, ...]
    """Names of the leaves that only read it."""
    writers: tuple[str, ...]
    """Names of the leaves that write it, and may read it."""


class Namespace:
    """The part of py_trees' blackboard that belongs to one execution, `/comity/1`.

    Args:
        clock: The world's time [s], for the history of what is written.
    """

    def __init__(self, clock: Callable[[], float]) -> None:
        self.name = f"/comity/{next(_NUMBERS)}"
        self.owner = Client(name="execution", namespace=self.name)
        """The execution's own client: it has access to every key."""
        self.history: list[Write] = []
        """Every value that an entry got, without those at first."""
        self._clock = clock
        self._last: dict[str, str] = {}
        """The last value of each key, in words."""
        self._keys: dict[str, None] = {}
        """All of them, relative to the name, in the order in which they were opened."""
        self._values: dict[str, object] = {}
        """The last value of each key: py_trees' blackboard may be cleared by another user of the process."""
        self._kept: Mapping[str, Shared] | None = None
        """What there was at the end; None before it."""
        self._clients = [self.owner]
        self._release = weakref.finalize(self, _unregister, self._clients, self.name)
        self._release.atexit = False

    def client_of(self, leaf: Behaviour) -> Client:
        """The client of a leaf here, attached to it where it has none yet."""
        for client in leaf.blackboards:
            if client.namespace == self.name:
                return client
        client = leaf.attach_blackboard_client(name=leaf.name, namespace=self.name)
        self._clients.append(client)
        return client

    def open(self, key: str, value: object) -> None:
        """Give a key its first value, if there is one."""
        self._keys[key] = None
        self.owner.register_key(key, access=Access.WRITE)
        if value is not UNSET:
            self.owner.set(key, value)
            self._values[key] = value
            self._last[key] = in_words(value)

    def read(self, client: Client, key: str) -> Any:
        """The value of a key; after the end, what it was then.

        Raises:
            AttributeError: The client has not declared that it reads it.
        """
        if self._kept is not None:
            return self._kept[key].value
        try:
            return client.get(key)
        except KeyError:
            if key not in self._values:
                raise
            self.owner.set(key, self._values[key])  # the blackboard was cleared: put it back
            return self._values[key]

    def write(self, client: Client, key: str, value: object) -> None:
        """Give a key another value, and note it in the history.

        Raises:
            AttributeError: The client has not declared that it writes it.
        """
        client.set(key, value)
        self._values[key] = value
        words = in_words(value)
        if self._last.get(key) != words:
            self._last[key] = words
            self.history.append(Write(key, words, self._clock(), client.name))

    def shared(self) -> Mapping[str, Shared]:
        """All that has a value, by key, in the order in which the keys were opened."""
        if self._kept is not None:
            return self._kept
        stored = (
            (key, Blackboard.storage.get(f"{self.name}/{key}", self._values.get(key, UNSET)))
            for key in self._keys
        )
        return {
            key: Shared(key, value, self._users("read", key), self._users("write", key))
            for key, value in stored
            if value is not UNSET
        }

    def _users(self, access: Literal["read", "write"], key: str) -> tuple[str, ...]:
        """The names of the leaves that have declared this access."""
        place, leaves = f"{self.name}/{key}", self._clients[1:]
        return tuple(dict.fromkeys(leaf.name for leaf in leaves if place in getattr(leaf, access)))

    def close(self) -> None:
        """Take everything off the blackboard; what was read here can still be read."""
        if self._kept is None:
            self._kept = self.shared()
            self._release()


def _unregister(clients: list[Client], name: str) -> None:
    for client in clients:
        with suppress(KeyError):  # where Blackboard.clear() was called, which forgets all clients
            client.unregister()
    for key in [key for key in Blackboard.storage if key.startswith(f"{name}/")]:  # put back after that
        del Blackboard.storage[key]
        Blackboard.metadata.pop(key, None)


class Entry(Generic[Value]):
    """An entry of a board, as an attribute that has a type.

    Args:
        at_first: Its value when the board is opened; without one it is to be written before it is read.
    """

    def __init__(self, at_first: Value | Unset = UNSET) -> None:
        self.at_first = at_first

    def __set_name__(self, owner: type[Board], name: str) -> None:
        self._name = name

    @overload
    def __get__(self, board: None, owner: type[Board]) -> Self: ...
    @overload
    def __get__(self, board: Board, owner: type[Board]) -> Value: ...
    def __get__(self, board: Board | None, owner: type[Board]) -> Value | Self:
        """Read it."""
        return self if board is None else board.read(self._name)

    def __set__(self, board: Board, value: Value) -> None:
        """Write it."""
        board.write(self._name, value)


class Board:
    """Entries that stand together, as one of their users sees them. Subclasses name them.

    Args:
        space: Where they are.
        place: The names that their keys begin with, `johanna` and `agenda-1`.
        elsewhere: Entries of another board that take the place of own ones, by name.
    """

    def __init__(
        self, space: Namespace, *place: str, elsewhere: Mapping[str, Board] = MappingProxyType({})
    ) -> None:
        self.space = space
        self._client = space.owner
        self._keys = {name: "/".join((*map(_quoted, place), name)) for name in self.entries()}
        for name, entry in self.entries().items():
            if name in elsewhere:
                self._keys[name] = elsewhere[name]._keys[name]
            else:
                space.open(self._keys[name], entry.at_first)

    @classmethod
    def entries(cls) -> Mapping[str, Entry[Any]]:
        """The entries by name."""
        return {name: entry for name, entry in vars(cls).items() if isinstance(entry, Entry)}

    def seen_by(self, leaf: Behaviour, *, reads: Iterable[str] = (), writes: Iterable[str] = ()) -> Self:
        """The same board as a leaf uses it.

        Args:
            leaf: Who.
            reads: Names of entries that it only reads; those of other boards are passed over.
            writes: Names of entries that it writes; it may read them, too.
        """
        seen = copy(self)
        seen._client = self.space.client_of(leaf)
        for names, access in ((reads, Access.READ), (writes, Access.WRITE)):
            for name in self._keys.keys() & set(names):
                seen._client.register_key(self._keys[name], access=access)
        return seen

    def read(self, name: str) -> Any:
        """The value of an entry."""
        return self.space.read(self._client, self._keys[name])

    def write(self, name: str, value: object) -> None:
        """Give an entry another value."""
        self.space.write(self._client, self._keys[name], value)


def _quoted(name: str) -> str:
    """A name as part of a key: a dot or a slash in it would mean something to py_trees."""
    return name.replace("%", "%25").replace(".", "%2E").replace("/", "%2F")
