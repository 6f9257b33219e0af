"""What was learnt with one person: the part of a value that outweighs where a person comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

from comity_fis.errors import InputError, WrongValueError, closest, shown
from comity_fis.inference.scalar import by_name
from comity_fis.inference.value import Contribution
from comity_fis.variables.parameter import NumericParameter, Parameter


@dataclass(frozen=True, slots=True)
class Learnt:
    """What meetings with one person taught about one numeric parameter, in the situation at hand."""

    offset: float
    """In the parameter's unit, added to culture and situation."""
    spread: float
    """Standard deviation of the person's own value around the result, in that unit."""
    text: str
    """Why, in one sentence: "4 visits, last on 2026-03-01: stepped back twice"."""

    def __post_init__(self) -> None:
        if not isfinite(self.offset):
            raise WrongValueError(expected="a finite offset", got=self.offset)
        if not (isfinite(self.spread) and self.spread >= 0):
            raise WrongValueError(expected="a finite spread of at least 0", got=self.spread)

    @property
    def contribution(self) -> Contribution:
        """The step that it adds to a value."""
        return Contribution("learnt", self.offset, self.text)


def refuse_unlearnable(learnt: Mapping[str, Learnt], parameters: Mapping[str, Parameter], book: str) -> None:
    """Refuse offsets for what is no numeric parameter.

    Raises:
        InputError: with the closest known name.
    """
    numeric = [name for name, parameter in parameters.items() if isinstance(parameter, NumericParameter)]
    for name in by_name(learnt, "what was learnt, by the name of a parameter"):
        if name not in numeric:
            raise InputError(
                expected=f"a numeric parameter of the rulebook {book} that something was learnt about",
                got=shown(name),
                remedy=closest(str(name), numeric),
            )
        if not isinstance(learnt[name], Learnt):
            raise InputError(
                expected=f"a Learnt for {name}",
                got=shown(learnt[name]),
                remedy="Give all three of it.",
            )
