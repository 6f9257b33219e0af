"""What metrics need to know about an episode beyond its frames."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import chain

import numpy as np

from comity_fis.errors import InputError, unknown_word
from comity_sim2d.frames import Frames
from comity_sim2d.kinds import MOST_EXACT, TRUTH, require_kinds, require_numbers, require_pairs
from comity_sim2d.metrics.intrusion import Since
from comity_sim2d.metrics.motion import Numbers, Span
from comity_sim2d.metrics.stopping import TargetStop
from comity_sim2d.scene_error import is_number, require_tuple, require_whole, shown


@dataclass(frozen=True, slots=True)
class Contacts:
    """Number of contacts of the robot that began, by what it touched; the world knows them."""

    people: int = 0
    walls: int = 0
    furniture: int = 0

    def __post_init__(self) -> None:
        for what in ("people", "walls", "furniture"):
            require_whole("contacts", what, getattr(self, what), 0, MOST_EXACT)


@dataclass(frozen=True, slots=True)
class Known:
    """What metrics need to know about an episode beyond its frames."""

    contacts: Contacts | None = None
    """None: contacts with people are counted from the frames, those with objects are unknown."""
    own_m: Mapping[str, float] = field(default_factory=dict)
    """Each person's own distance [m], by name; `proxemics.COMFORT_M` for people who are not in it."""
    later_m: Mapping[str, Since] = field(default_factory=dict)
    """Changes of a person's own distance, by name: times [s] and distances [m], in order of time."""
    visits: tuple[TargetStop, ...] = ()
    """In the order of the visits."""
    engaged: Mapping[str, tuple[Span, ...]] | None = None
    """Spans in which the robot was on its way to each person or with them, by name; None: as in `visits`."""
    shortest_m: float | None = None
    """Length of the shortest sufficient path [m]."""
    groups: tuple[tuple[str, ...], ...] = ()
    """The members of each group that stands together at the start."""
    success: bool = True
    plan_cost_m: float | None = None
    """Cost of the first plan [m of path]."""
    plan_gap: float | None = None
    """Relative optimality gap of that cost, in [0, 1]."""
    undisturbed: Mapping[str, Numbers] = field(default_factory=dict)
    """Walks without the robot, by person or passer-by: ascending times [s], x and y [m], shape (m, 3)."""

    def __post_init__(self) -> None:
        contacts, success = (self.contacts, Contacts | None), (self.success, TRUTH)
        require_kinds("what is known", contacts=contacts, own_m=(self.own_m, Mapping), success=success)
        require_kinds(
            "what is known", later_m=(self.later_m, Mapping), engaged=(self.engaged, Mapping | None)
        )
        require_kinds("what is known", undisturbed=(self.undisturbed, Mapping))
        for pairs in self.later_m.values():
            require_pairs("what is known", "later_m", pairs, "(since_s, distance_m)")
        require_tuple("what is known", "visits", self.visits, TargetStop, "visits, each a TargetStop")
        require_tuple("what is known", "groups", self.groups, tuple, "groups, each a tuple of names")
        require_numbers("what is known", shortest_m=self.shortest_m)
        require_numbers("what is known", plan_cost_m=self.plan_cost_m, plan_gap=self.plan_gap)


def checked(frames: Frames, known: Known | None) -> Known:
    """The known facts, checked to concern only people in the frames."""
    require_kinds("figures", frames=(frames, Frames), known=(known, Known | None))
    if len(frames) == 0:
        raise InputError(expected="at least one frame", got="none", remedy="Let the world run first.")
    known = known or Known()
    for member in chain.from_iterable(known.groups):
        _require_person("groups", member, frames.entities[1:])
    for name, walk in known.undisturbed.items():
        _require_person("undisturbed", name, frames.entities[1:])
        if not (np.ndim(walk) == 2 and len(walk) > 0 and np.shape(walk)[1] == 3):
            expected = "undisturbed walks of the shape (m, 3): time, x and y"
            got = f"{np.shape(walk)} of {name}"
            raise InputError(expected=expected, got=got, remedy="Take those of `undisturbed_walks`.")
    _check_own("own_m", known.own_m.items(), frames.entities[1:])
    later = ((name, distance_m) for name, pairs in known.later_m.items() for _, distance_m in pairs)
    _check_own("later_m", later, frames.entities[1:])
    return known


def _check_own(what: str, distances: Iterable[tuple[str, float]], people: tuple[str, ...]) -> None:
    for name, distance_m in distances:
        _require_person(what, name, people)
        if not (is_number(distance_m) and 0.0 <= distance_m < math.inf):
            raise InputError(
                expected=f"distances of 0 m or more in {what}",
                got=f"{shown(distance_m)} of {name}",
                remedy="Leave out whose distance is not known.",
            )


def _require_person(what: str, name: str, people: tuple[str, ...]) -> None:
    if name not in people:
        raise unknown_word(f"{what} of people of the frames", name, people)
