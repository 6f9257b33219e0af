"""Check, before the first tick, that a robot's method takes the arguments that the tree gives."""

from __future__ import annotations

from collections.abc import Callable
from inspect import Parameter, signature

from comity_fis.errors import WrongValueError

_BY_NAME = (Parameter.KEYWORD_ONLY, Parameter.POSITIONAL_OR_KEYWORD)


def require_arguments(call: Callable[..., object], *names: str) -> None:
    """Refuse a method that cannot be given these arguments by name.

    Raises:
        WrongValueError: It names the method and what it lacks.
    """
    try:
        takes = signature(call).parameters.values()
    except (TypeError, ValueError):  # compiled code tells no signature
        return
    if any(parameter.kind is Parameter.VAR_KEYWORD for parameter in takes):
        return
    known = {parameter.name for parameter in takes if parameter.kind in _BY_NAME}
    lacks = [name for name in names if name not in known]
    if lacks:
        method = getattr(call, "__qualname__", repr(call))
        raise WrongValueError(
            expected=f"a method {method} with the arguments {', '.join(names)}",
            got=f"one without {', '.join(lacks)}",
            remedy=f"Add {', '.join(lacks)} to its definition; `comity_executor.Robot` says what it means.",
        )
