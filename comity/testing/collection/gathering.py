"""Selection of what `comity test` runs: folders, files and single tests, also shipped ones by name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from itertools import islice
from pathlib import Path
from types import MappingProxyType

from comity.system.library import shipped
from comity.system.scenario_sets import instead as called_now
from comity.testing.collection.cases import claims_in
from comity.testing.naming import SUFFIX
from comity.testing.trials.case import whole
from comity_fis import InputError, Where, unknown_word

NONE: Mapping[str, Path] = MappingProxyType({})


def gathered(
    words: Sequence[str], *, ship: Mapping[str, Path] = NONE, profiles: Sequence[str] = ()
) -> tuple[str, ...]:
    """The arguments for pytest: unique absolute paths; a file may be followed by `::` and a test id.

    Args:
        words: Names given by the user; if empty, the current folder.
        ship: If given, these shipped scenarios are used instead.
        profiles: Profiles that replace every matrix's: names, or paths from the current folder.

    Raises:
        InputError: if there is no such file, folder or test.
        FileNotFoundError: if the current folder was removed, and nothing else is named.
    """
    if ship and words:
        raise InputError(
            expected="paths, or `--shipped` and `--set`",
            got=f"both, with {words[0]}",
            remedy="Leave one of them out: the options take what ships and nothing else.",
        )
    if ship:
        return tuple(map(str, ship.values()))
    return tuple(dict.fromkeys(_argument(word, profiles) for word in words or [str(Path.cwd())]))


def files_in(arguments: Sequence[str], most: int) -> list[Path]:
    """The scenario files named by or below the arguments, up to a maximum.

    Args:
        arguments: Paths as returned by `gathered`.
        most: Maximum number of files to find.
    """
    return list(islice(_files_in(arguments), most))


def _files_in(arguments: Sequence[str]) -> Iterator[Path]:
    for path in map(Path, arguments):
        if path.is_dir():
            yield from path.rglob(f"*{SUFFIX}")
        else:
            yield path


def _argument(word: str, profiles: Sequence[str]) -> str:
    name, _, wanted = word.partition("::")
    path = Path(name)
    if not wanted and path.is_dir():
        return str(whole(path))
    if path.is_file() and name.endswith(SUFFIX):
        found = path
    elif name in shipped("scenario"):
        found = shipped("scenario")[name]
    else:
        raise _no_tests(word, path)
    if not wanted:
        return str(whole(found))
    _require_test(wanted, found, profiles)
    return f"{whole(found)}::{wanted}"


def _require_test(wanted: str, path: Path, profiles: Sequence[str]) -> None:
    known = [claim.id for claim in claims_in(path, profiles=profiles)]
    if wanted not in known:
        raise unknown_word("a test of the file", wanted, known, where=Where(str(path)))


def _no_tests(word: str, path: Path) -> InputError:
    if path.is_file():
        got, remedy = "another file", f"Let its name end in `{SUFFIX}`, or name another."
    elif path.is_dir():
        got, remedy = "a folder", "Name the file of the test, too."
    else:
        got, remedy = "no such file or folder", called_now(path.as_posix()) or _near(path)
    return InputError(
        expected=f"a folder, a file *{SUFFIX} or a shipped scenario",
        got=f"{got}: {word}",
        remedy=remedy,
    )


def _near(path: Path) -> str:
    """A hint for a wrong path: the closest existing or shipped name, else where to look."""
    ways = [path, *path.parents]
    wrong = next((way for way in ways if way.parent.is_dir()), path)
    known = {entry.name: str(entry) for entry in _entries(wrong.parent) if wrong is path or entry.is_dir()}
    if len(path.parts) == 1:
        known |= {name: name for name in shipped("scenario")}
    near = get_close_matches(wrong.name, known, n=1)
    if near:
        return f"Did you mean {known[near[0]]!r}?"
    return "Check the path." if len(path.parts) > 1 or path.suffix else "`comity scenarios` lists what ships."


def _entries(folder: Path) -> list[Path]:
    """The accessible folders and scenarios in a folder."""
    try:
        return sorted(each for each in folder.iterdir() if each.name.endswith(SUFFIX) or each.is_dir())
    except OSError:
        return []
