"""Loads a user's robot by name: `MODULE:CLASS`, or an entry point in the group `comity.robots`."""

from __future__ import annotations

import sys
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from inspect import Parameter, signature
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from comity.live.map_robot_check import problems_of
from comity_executor.robots.raised import raised
from comity_fis import InputError
from comity_fis.errors import closest

if TYPE_CHECKING:
    from types import ModuleType

    from comity_executor import MapRobot

GROUP = "comity.robots"
"""Entry point group in which installed packages offer robots."""


def load_robot(name: str) -> MapRobot:
    """Create a robot.

    Args:
        name: `my_robot:Base`, with an importable module; or the name of an entry point.

    Raises:
        InputError: There is no such robot, it cannot be created, or it lacks a call.
    """
    make = _imported(name) if ":" in name else _offered(name)
    needs = _arguments(make)
    if needs:
        raise InputError(
            expected=f"{name} to be made without arguments",
            got=f"one that needs {', '.join(needs)}",
            remedy="Write a function without arguments that makes it, and name that.",
        )
    try:
        robot = make()
    except Exception as error:
        raise InputError(
            expected=f"a robot made by {name}()",
            got=raised(error),
            remedy="Is the robot switched on, and its computer within reach?",
        ) from error
    require_map_robot(robot, name)
    return cast("MapRobot", robot)


def require_map_robot(robot: object, name: str) -> None:
    """Reject a robot that does not implement the protocol.

    Raises:
        InputError: Listing everything that is missing or malformed.
    """
    problems = problems_of(robot)
    if problems:
        raise InputError(
            expected=f"a robot with all calls of comity_executor.MapRobot in {name}",
            got="\n  ".join(("one that cannot be driven:", *problems)),
            remedy="docs/how-to/connect-a-robot.md says what each call is to do.",
        )


def _imported(name: str) -> Any:
    module, _, attribute = name.partition(":")
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.insert(0, here)  # as for `python -m`
    if not (module and attribute):
        lacks = "class" if module else "module"
        raise _unknown(name, f"{name!r}, without the name of the {lacks}")
    try:
        loaded = import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or not f"{module}.".startswith(f"{error.name}."):
            raise _broken(module, error) from error
        raise _unknown(name, f"{name!r}: {error}") from None
    except Exception as error:
        raise _broken(module, error) from error
    if not hasattr(loaded, attribute):
        raise _unknown(name, f"{name!r}: {module} has no {attribute!r}", _classes(loaded, attribute))
    return getattr(loaded, attribute)


def _unknown(name: str, got: str, remedy: str | None = None) -> InputError:
    module = name.partition(":")[0] or "my_robot"
    return InputError(
        expected="a robot as MODULE:CLASS, of a module that can be imported from this folder",
        got=got,
        remedy=remedy or f"Write `--robot {module}:Base` for the class `Base` in {module}.py.",
    )


def _classes(module: ModuleType, attribute: str) -> str | None:
    """The most similar names of the module's own classes and functions; None if it has none."""
    mine = module.__name__
    own = [name for name, one in vars(module).items() if getattr(one, "__module__", "") == mine]
    return closest(attribute, own) if own else None


def _broken(module: str, error: Exception) -> InputError:
    """The error for a module whose code raises, with the line."""
    if isinstance(error, SyntaxError) and error.filename:
        got = f"{type(error).__name__}: {error.msg} ({Path(error.filename).name}:{error.lineno})"
    else:
        got = raised(error)
    return InputError(
        expected=f"the module {module} of the robot to be imported",
        got=got,
        remedy="Correct that line, or install what it imports.",
    )


def _offered(name: str) -> Any:
    offers: dict[str, EntryPoint] = {each.name: each for each in entry_points(group=GROUP)}
    if name in offers:
        try:
            return offers[name].load()
        except Exception as error:
            raise _broken(offers[name].module, error) from error
    known = f"one of {', '.join(sorted(offers))}" if offers else "no installed package offers one"
    raise InputError(
        expected=f"a robot as MODULE:CLASS, or the name of one that a package offers ({known})",
        got=repr(name),
        remedy="Write `--robot my_robot:Base` for the class `Base` in my_robot.py.",
    )


def _arguments(make: Any) -> list[str]:
    """Required arguments of a robot's constructor."""
    if not callable(make):
        return ["to be a class or a function"]
    try:
        parameters = signature(make).parameters.values()
    except ValueError:
        return []
    plain = (Parameter.POSITIONAL_ONLY, Parameter.POSITIONAL_OR_KEYWORD, Parameter.KEYWORD_ONLY)
    return [each.name for each in parameters if each.default is Parameter.empty and each.kind in plain]
