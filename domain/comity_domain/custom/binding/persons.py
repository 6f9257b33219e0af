"""Checks that an argument bound as a person can be one: PDDL does not say which objects are people."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from comity_domain.custom.binding.people import BoundPeople
from comity_domain.custom.reading.reading import CustomProblem

if TYPE_CHECKING:
    from unified_planning.model import Type

MOST_NAMED = 3


def strangers(own: CustomProblem, people: BoundPeople, type_: Type) -> tuple[str, ...]:
    """The objects of a type that are not people, as the files name them.

    An object is a person if it is named, or has the type of a named object. If none is named, all objects may
    be people without a profile.

    Args:
        own: The problem.
        people: The named people, all of them objects of the problem.
        type_: Type of an argument that is bound as a person.
    """
    named = [own.problem.object(name.lower()) for name in people.known]
    people_too = {one.name for person in named for one in own.problem.objects(person.type)}
    return tuple(
        own.as_written(one.name) for one in own.problem.objects(type_) if named and one.name not in people_too
    )


def can_be_people(own: CustomProblem, people: BoundPeople, types: Mapping[str, Type]) -> tuple[str, ...]:
    """The arguments that can only be people.

    Args:
        own: The problem.
        people: As for `strangers`.
        types: Types of all arguments, by name.
    """
    return tuple(
        name
        for name, type_ in types.items()
        if any(True for _ in own.problem.objects(type_)) and not strangers(own, people, type_)
    )


def first_named(names: tuple[str, ...]) -> str:
    """The first names, and the number of the others."""
    more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
    return ", ".join(names[:MOST_NAMED]) + more
