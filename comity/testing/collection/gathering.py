"""Which tests are meant: paths, folders, node ids and words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from types import MappingProxyType

from comity.system.library import shipped
from comity.system.scenario_sets import instead as called_now
from comity.testing.collection.cases import Claim, claims_in
from comity.testing.collection.choosing import choice
from comity.testing.collection.folders import Below, below
from comity.testing.golden.place import abandoned, left_over
from comity.testing.naming import GOLDEN, SUFFIX
from comity.testing.trials.case import Case, whole
from comity.testing.trials.profiles import instead
from comity_fis import InputError, Where, closest

NONE: Mapping[str, Path] = MappingProxyType({})


@dataclass(frozen=True, slots=True)
class Gathered:
    """The tests that were found, and the files that cannot be used."""

    claims: tuple[Claim, ...]
    refused: Mapping[Path, InputError]
    left_over: tuple[Path, ...] = ()
    """Golden episodes of whole files with which none of their cases is compared."""
    abandoned: tuple[Path, ...] = ()
    """Folders of golden episodes, below the folders that were named, whose scenario is not there."""


@dataclass(frozen=True, slots=True)
class _Looked:
    """What somebody named, or what lies below it."""

    tests: tuple[tuple[Path, str | None], ...]
    """Files, each with the id of one of its tests; None for all."""
    golden: tuple[Path, ...] = ()
    """Folders that are called as those of golden episodes."""
    barred: tuple[Path, ...] = ()
    """Folders that may not be looked into."""


def gathered(
    words: Sequence[str],
    *,
    ship: Mapping[str, Path] = NONE,
    profiles: Sequence[str] = (),
    fast: bool = False,
) -> Gathered:
    """The tests of files, of folders, or of the current one; a file may be followed by `::` and a test's id.

    Args:
        words: What the user named.
        ship: Take these of the shipped scenarios instead.
        profiles: Instead of every matrix's profiles: names, or paths from the current folder.
        fast: Leave out what is marked as slow.

    Raises:
        InputError: if there is no such thing or no such profile, or nothing is left.
        FileNotFoundError: where the current folder was removed, and nothing else is named.
    """
    if ship and words:
        raise InputError(
            expected="paths, or `--shipped` and `--set`",
            got=f"both, with {words[0]}",
            remedy="Leave one of them out: the options take what ships and nothing else.",
            where=Where("comity test"),
        )
    instead(profiles)  # what is wrong with them is said once, and not for every file
    looked = _Looked(tuple((path, None) for path in ship.values())) if ship else _look(words)
    files: dict[Path, tuple[Path, dict[str | None, None]]] = {}
    for path, wanted in looked.tests:  # whatever is named twice counts once
        files.setdefault(whole(path), (path, {}))[1][wanted] = None
    found: list[Claim] = []
    whole_files: list[Claim] = []
    refused = {folder: _barred(folder) for folder in looked.barred}
    for path, tests in files.values():
        try:
            claims = claims_in(path, profiles=profiles)
        except InputError as error:
            refused[path] = error
        else:
            found += claims if None in tests else [_named(each, claims) for each in tests if each]
            whole_files += claims if None in tests and not profiles else ()
    chosen = tuple(claim for claim in found if not (fast and claim.markers.slow))
    if found and not (chosen or refused):
        raise InputError(
            expected="tests that are not marked as slow",
            got=f"{len(found)} which are",
            remedy="Leave `--fast` out, or name others.",
            where=Where("--fast"),
        )
    cases = (claim.case for claim in whole_files if isinstance(claim.case, Case))
    return Gathered(chosen, refused, tuple(left_over(cases)), tuple(abandoned(looked.golden)))


def _look(words: Sequence[str]) -> _Looked:
    if not words:
        Path.cwd()  # where it was removed, that is said, and not that it is empty
    looked = [_look_at(word) for word in words or ["."]]
    golden = dict.fromkeys(folder for each in looked for folder in each.golden)
    barred = dict.fromkeys(folder for each in looked for folder in each.barred)
    return _Looked(tuple(test for each in looked for test in each.tests), tuple(golden), tuple(barred))


def _look_at(word: str) -> _Looked:
    name, wanted = _parted(word)
    path = Path(name)
    if path.is_dir() and not wanted:
        found = _below(path)
        return _Looked(tuple((file, None) for file in found.files), found.folders, found.barred)
    if path.is_file() and name.endswith(SUFFIX):
        return _Looked(((path, wanted),))
    if name in shipped("scenario"):
        return _Looked(((shipped("scenario")[name], wanted),))
    raise _no_tests(word, path)


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
        where=Where("comity test"),
    )


def _barred(folder: Path) -> InputError:
    return InputError(
        expected="a folder that may be looked into",
        got="no permission",
        remedy="Let yourself read it, move it away, or name others.",
        where=Where(str(folder)),
    )


def _near(path: Path) -> str:
    """What is called nearly so where the path goes wrong, or among what ships; else where to look."""
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
    """The folders and the scenarios in a folder that we may look into."""
    try:
        return sorted(each for each in folder.iterdir() if each.name.endswith(SUFFIX) or each.is_dir())
    except OSError:
        return []


def _parted(word: str) -> tuple[str, str | None]:
    """A file and the id of its test: folders and ids may have `::` in their names, too."""
    parts = word.split("::")
    for n in range(len(parts), 0, -1):
        name = "::".join(parts[:n])
        if Path(name).is_file() or (n == len(parts) and Path(name).is_dir()):
            return name, "::".join(parts[n:]) or None
    return parts[0], "::".join(parts[1:]) or None


def _below(folder: Path) -> Below:
    found = below(folder, file_suffix=SUFFIX, folder_suffix=GOLDEN)
    if not found.files and not found.barred:
        left = [str(golden) for golden in abandoned(found.folders)]
        raise InputError(
            expected=f"files *{SUFFIX}",
            got=f"none, and golden episodes in {', '.join(left)}" if left else "none",
            remedy="Name a folder that has some, or try `comity test --shipped`.",
            where=Where(str(folder)),
        )
    return found


def _named(wanted: str, claims: Sequence[Claim]) -> Claim:
    by_id = {claim.id: claim for claim in claims}
    if wanted not in by_id:
        raise InputError(
            expected="a test of the file",
            got=repr(wanted),
            remedy=closest(wanted, by_id),
            where=Where(str(claims[0].path)),
        )
    return by_id[wanted]


def matching(every: Gathered, words: str | None) -> tuple[Claim, ...]:
    """The tests that `-k` chooses, by their ids, their files' names and their markers.

    Raises:
        InputError: if the words are no expression, or choose none of the tests that there are.
    """
    if not words:
        return every.claims
    chosen, claims = choice(words), every.claims
    left = tuple(claim for claim in claims if chosen(_names(claim)))
    if not left and (claims or not every.refused):
        raise InputError(
            expected="words of some test's id",
            got=repr(words),
            remedy=f"The first id is {claims[0].id!r}." if claims else "There are no tests.",
            where=Where("-k"),
        )
    return left


def _names(claim: Claim) -> Sequence[str]:
    markers = [name for name in ("slow", "xfail") if getattr(claim.markers, name)]
    return (claim.id.lower(), claim.path.name.lower(), *markers)
