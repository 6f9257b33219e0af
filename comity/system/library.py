"""Shipped files, found by name; any other name is a path."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Literal

from comity.system.scenario_sets import every_shipped, instead
from comity_fis import InputError, Where, closest
from comity_fis.validation.name_or_path import looks_like_a_file
from comity_fis.validation.no_file import no_file

Kind = Literal["profile", "scenario"]

_PROFILES = Path(__file__).parents[1] / "profiles"
_SUFFIX = ".profile.yaml"


@cache
def shipped(kind: Kind) -> Mapping[str, Path]:
    """Shipped files of one kind by the names that users type: profiles, or scenarios of all sets."""
    if kind == "scenario":
        return every_shipped()
    files = sorted(_PROFILES.glob(f"*{_SUFFIX}"))
    return MappingProxyType({file.name.removesuffix(_SUFFIX): file for file in files})


def find(
    kind: Kind,
    name: str,
    *,
    beside: Path | None = None,
    where: Where | None = None,
    more: Iterable[str] = (),
) -> tuple[Path, str]:
    """The file for a shipped name or a path, and its name in messages.

    Args:
        kind: Kind of file.
        name: A shipped name, or a path (it has a suffix or a separator, or exists).
        beside: Base folder of relative paths; None for the current one.
        where: Position of the name, for the message.
        more: Further known names, for suggestions.

    Raises:
        InputError: if it is neither a shipped name nor a path.
    """
    known = shipped(kind)
    if name in known:
        return known[name], name
    path = Path(name) if beside is None else beside / name
    if kind == "scenario" and (now := instead(name)) and not path.exists():
        raise InputError(expected="a shipped scenario or a file", got=repr(name), remedy=now, where=where)
    if looks_like_a_file(name, path):
        require_file(kind, path, name, where)
        return path, str(path)
    raise InputError(
        expected=f"a shipped {'or stored ' if kind == 'profile' else ''}{kind} or a file",
        got=repr(name),
        remedy=f"{closest(name, [*known, *more])} `comity {kind}s` lists them.",
        where=where,
    )


def require_file(kind: str, path: Path, name: str, where: Where | None) -> None:
    """Refuse a user's path that is no file, before anything reads it.

    Args:
        kind: Kind of file.
        path: The resolved path.
        name: The name as written.
        where: Position of the name, for the message.

    Raises:
        InputError: if there is no file, or the system denies access.
    """
    try:
        if path.is_file():
            return
        got = no_file(path)
    except (OSError, ValueError) as error:
        got = (error.strerror if isinstance(error, OSError) else None) or str(error)
    raise InputError(expected=f"a {kind} file", got=f"{got}: {name}", remedy="Check the path.", where=where)
