"""Checks that the options of a binding stand for categories or numbers that their parameter can have."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from comity_domain.custom.binding.binding import Binding, Option, OptionValue
from comity_domain.custom.binding.names import BoundNames
from comity_domain.custom.binding.refusal import BindingRefusedError, Location, refused
from comity_fis import NominalParameter, NumericParameter
from comity_fis.errors import closest

if TYPE_CHECKING:
    from unified_planning.model import Type


def check_option(names: BoundNames, argument: str, option: Option, type_: Type, place: Location) -> None:
    """Reject meanings of objects that the parameter cannot have.

    Args:
        names: All known names.
        argument: The action's argument.
        option: The option bound to the argument.
        type_: Type of the argument.
        place: Location of the option in the binding.

    Raises:
        BindingRefusedError: At the first such meaning.
    """
    names.parameter(option.parameter, (*place, "parameter"))
    possible = [one.name for one in names.own.problem.objects(type_)]
    names.once(option.objects, (*place, "objects"))
    for name in option.objects:
        what = f"an object that ?{argument} may be"
        names.known(name, possible, what, (*place, "objects", name))
    parameter = names.people.rulebook.parameters[option.parameter]
    if not isinstance(parameter, NominalParameter):
        for name, meaning in option.objects.items():
            _in_range(meaning, parameter, (*place, "objects", name))
        return
    for name, meaning in option.full(names.own, possible).objects.items():
        if isinstance(meaning, str) and meaning not in parameter.terms:
            remedy = closest(meaning, parameter.terms)
            raise refused(
                place,
                f"a category of {option.parameter} for the object {names.own.as_written(name)}",
                meaning,
                f"{remedy} Say under `objects` what it stands for; `null` is nothing to like or dislike.",
            )


def refuse_options(binding: Binding, beyond: str) -> None:
    """Reject all options: engines for numeric and durative domains do not add up action costs.

    Args:
        binding: Any binding.
        beyond: The feature that goes beyond classical planning, in words.

    Raises:
        BindingRefusedError: At the first option, which would silently have no weight.
    """
    for name in _with_options(binding):
        raise refused(
            ("actions", name, "options"),
            "options only in a classical domain",
            f"options beside {beyond}",
            "Remove one of the two; `parameters` and `fluents` work in every domain.",
        )


def _with_options(binding: Binding) -> Iterator[str]:
    return (name for name, action in binding.actions.items() if action.options)


def _in_range(meaning: OptionValue, parameter: NumericParameter, place: Location) -> None:
    """Reject numbers outside the parameter's range."""
    low = min(parameter.rules.low, parameter.ask.low)
    high = max(parameter.rules.high, parameter.ask.high)
    ends = meaning if isinstance(meaning, tuple) else (meaning,)
    for end in ends:
        if isinstance(end, int | float) and not low <= end <= high:
            raise BindingRefusedError(
                place,
                expected=f"numbers from {low:g} to {high:g} {parameter.unit}, which {parameter.name} can be",
                got=f"{end:g}",
                remedy=f"Measure in {parameter.unit}, and keep to what the parameter can be.",
            )
