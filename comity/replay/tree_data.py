"""The tree, its events and their causes; each cause is stored once and referred to by index."""

from __future__ import annotations

from dataclasses import astuple
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from comity_executor import Cause, History, TraceEvent


def tree_data(history: History, people: Iterable[str]) -> dict[str, object]:
    """Nodes as `[name, kind, parent, action, person]`, events as `[t, path, status, halt, causes, grounds]`.

    Causes are indices into the list of causes. Grounds are the indices of the events that an event depends
    on; the one that triggered it comes first.
    """
    known = tuple(people)
    causes: dict[Cause, int] = {}
    place = {id(event): i for i, event in enumerate(history.events)}
    events = [
        [
            why.event.t,
            why.event.path,
            why.event.status,
            why.event.halt,
            [causes.setdefault(cause, len(causes)) for cause in why.event.because],
            [place[id(ground)] for ground in _grounds(why.switched_by, why.standing_on)],
        ]
        for why in history.whys()
    ]
    return {
        "nodes": [
            [node.name, node.kind, node.parent, node.action, node.person if node.person in known else None]
            for node in history.nodes
        ],
        "events": events,
        "causes": [astuple(cause) for cause in causes],
    }


def _grounds(first: TraceEvent | None, others: tuple[TraceEvent, ...]) -> tuple[TraceEvent, ...]:
    return (*((first,) if first else ()), *others)
