"""Checks that the names in a binding exist in the domain, the problem or the rulebook."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from comity_domain.custom.binding.people import BoundPeople
from comity_domain.custom.binding.refusal import Location, refused
from comity_domain.custom.reading.reading import CustomProblem
from comity_fis.errors import closest


@dataclass(frozen=True, slots=True)
class BoundNames:
    """Rejects unknown names, each of which would silently bind nothing."""

    own: CustomProblem
    people: BoundPeople

    def once(self, names: Iterable[str], place: Location) -> None:
        """Reject names that differ only in case: PDDL ignores case, so one would silently win."""
        seen: dict[str, str] = {}
        for name in names:
            if (first := seen.setdefault(name.lower(), name)) != name:
                remedy = "Keep one of them: PDDL does not tell capitals apart."
                raise refused((*place, name), f"one of {first} and {name}", name, remedy)

    def argument(self, argument: str, known: Iterable[str], action: str, place: Location) -> None:
        """Reject an unknown argument of an action."""
        if argument.lower() not in known:
            remedy = closest(argument.lower().lstrip("?"), known)
            raise refused(place, f"an argument of the action {action}", argument, remedy)

    def parameter(self, name: str, place: Location) -> None:
        """Reject an unknown parameter of the rulebook."""
        rulebook = self.people.rulebook
        if name not in rulebook.parameters:
            remedy = closest(name, rulebook.parameters)
            raise refused(place, f"a parameter of the rulebook {rulebook.name}", name, remedy)

    def known(self, name: str, known: Iterable[str], what: str, place: Location) -> None:
        """Reject a name that is not in `known`; `what` describes the expected kind for the message."""
        names = list(known)
        if name.lower() not in names:
            raise refused(place, what, name, closest(name, map(self.own.as_written, names)))
