"""A person's preference for an option, and its cost."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from comity_domain.choices.cost import dislike
from comity_domain.custom.binding.binding import Option, OptionValue
from comity_domain.problem.setting import is_setting
from comity_fis.defuzzification.curve import Choice, Curve
from comity_fis.errors import WrongValueError
from comity_fis.inference.value import ParameterValue


@dataclass(frozen=True, slots=True)
class Preference:
    """One option as evaluated for one person."""

    value: OptionValue
    desirability: float
    """Desirability in [0, 1]."""
    permitted: bool
    """Whether the option is permitted: not without consent to a gesture, nor against an explicit request."""
    preference_cost: float
    """Preference cost, in units of the domain's own cost; 0 for the person's best option."""


def preferences(option: Option, value: ParameterValue, person: str) -> Mapping[str, Preference]:
    """The preferences of one person over the objects.

    The cost grows as the desirability falls below that of the best available option. A person's best option
    costs nothing, so preferences affect how people are served, never which people.

    Args:
        option: The option, with the meaning of every object that the argument may be.
        value: The person's inferred parameter.
        person: The person's name in messages.

    Raises:
        WrongValueError: An object stands for something that the parameter cannot be, or no object matches the
            person's explicit request.
    """
    judged = {name: _judged(name, meaning, value) for name, meaning in option.objects.items()}
    allowed = [desirability for desirability, permitted in judged.values() if permitted]
    if not allowed:
        raise WrongValueError(
            expected=f"an object that stands for {value.name} {value.value}, which {person} asked for",
            got=", ".join(judged) or "no objects",
            remedy="Add such an object to the problem, or say under `objects` which one stands for it.",
        )
    best = max(allowed)
    return {
        name: Preference(
            value=option.objects[name],
            desirability=desirability,
            permitted=permitted,
            preference_cost=_worth(desirability, best, option) if option.objects[name] is not None else 0.0,
        )
        for name, (desirability, permitted) in judged.items()
    }


def _worth(desirability: float, best: float, option: Option) -> float:
    return option.weight * max(0.0, dislike(desirability) - dislike(best))


def _judged(name: str, meaning: OptionValue, value: ParameterValue) -> tuple[float, bool]:
    """The desirability of an object, and whether it is permitted."""
    if meaning is None:
        return 1.0, True
    liked = value.desirability
    if isinstance(liked, Choice):
        return _category(name, meaning, value, liked)
    return _number(name, meaning, value, liked)


def _category(name: str, meaning: OptionValue, value: ParameterValue, liked: Choice) -> tuple[float, bool]:
    if not isinstance(meaning, str):
        raise _means_nothing(name, meaning, value, "Write one of its categories.")
    if is_setting(value):
        return float(meaning == value.value), meaning == value.value
    return liked(meaning), meaning in liked.memberships


def _number(name: str, meaning: OptionValue, value: ParameterValue, liked: Curve) -> tuple[float, bool]:
    if isinstance(meaning, str) or meaning is None:
        remedy = f"Write `{name}: 20` or a range such as `{name}: [0, 22.5]` under `objects`."
        raise _means_nothing(name, meaning, value, remedy)
    low, high = meaning if isinstance(meaning, tuple) else (meaning, meaning)
    if low > high:
        raise _means_nothing(name, meaning, value, "Write the smaller number first.")
    if is_setting(value):
        # A single number only needs to be near the requested value; a range has to contain it.
        holds = low <= value.number <= high if low < high else math.isclose(low, value.number)
        return float(holds), holds
    return (liked.height(low, high) if low < high else liked(low)), True


def _means_nothing(name: str, meaning: OptionValue, value: ParameterValue, remedy: str) -> WrongValueError:
    got = f"[{meaning[0]:g}, {meaning[1]:g}]" if isinstance(meaning, tuple) else repr(meaning)
    return WrongValueError(expected=f"what {name!r} stands for in {value.name}", got=got, remedy=remedy)
