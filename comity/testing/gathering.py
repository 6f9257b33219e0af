"""Which tests are meant: paths, folders, node ids and words."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from fnmatch import fnmatch
from pathlib import Path

from comity.library import shipped
from comity.testing.cases import SUFFIX, Claim, claims_in
from comity_fis import InputError, Where, closest

PASSED_OVER = (".*", "build", "dist", "node_modules", "venv", "__pycache__", "*.egg", "site-packages")
"""Folders that pytest does not look into either."""


def gathered(
    words: Sequence[str], *, ship: bool = False, profiles: Sequence[str] = (), fast: bool = False
) -> tuple[Claim, ...]:
    """The tests of files, of folders, or of the current one; a file may be followed by `::` and a test's id.

    Args:
        words: What the user named.
        ship: Take the shipped scenarios instead.
        profiles: Instead of every matrix's profiles.
        fast: Leave out what is marked as slow.

    Raises:
        InputError: if there is no such thing, or a file cannot be used.
    """
    if ship and words:
        raise InputError(
            expected="paths, or `--shipped`",
            got=f"`--shipped` beside {words[0]}",
            remedy="Leave one of them out: it takes all that ships and nothing else.",
            where=Where("--shipped"),
        )
    places = [(str(path), None) for path in shipped("scenario").values()] if ship else _places(words)
    found: list[Claim] = []
    for path, wanted in places:
        claims = claims_in(Path(path), profiles=profiles)
        found += [_named(wanted, claims)] if wanted else claims
    return tuple(claim for claim in found if not (fast and claim.markers.slow))


def _places(words: Sequence[str]) -> Iterator[tuple[str, str | None]]:
    for word in words or ["."]:
        name, _, wanted = word.partition("::")
        path = Path(name)
        if path.is_dir():
            yield from ((str(file), None) for file in _below(path, bool(words)))
        elif path.is_file() and name.endswith(SUFFIX):
            yield name, wanted or None
        elif name in shipped("scenario"):
            yield str(shipped("scenario")[name]), wanted or None
        else:
            got = "another file" if path.is_file() else "no such file or folder"
            raise InputError(
                expected=f"a folder, a file *{SUFFIX} or a shipped scenario",
                got=f"{got}: {name}",
                remedy=closest(name, shipped("scenario")),
                where=Where("comity test"),
            )


def _below(folder: Path, named: bool) -> list[Path]:
    found: list[Path] = []
    for root, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not any(fnmatch(name, over) for over in PASSED_OVER)]
        found += [Path(root) / name for name in files if name.endswith(SUFFIX)]
    if not found:
        raise InputError(
            expected=f"files *{SUFFIX}",
            got="none",
            remedy="Name a folder that has some, or try `comity test --shipped`.",
            where=Where(str(folder)),
        )
    return sorted(found)


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


def matching(claims: Sequence[Claim], words: str | None) -> tuple[Claim, ...]:
    """The tests whose id holds what `-k` says: words with `and`, `or` and `not`.

    Raises:
        InputError: if none is left.
    """
    if not words:
        return tuple(claims)
    left = tuple(claim for claim in claims if _says(words, claim.id.lower()))
    if not left:
        raise InputError(
            expected="words of some test's id",
            got=repr(words),
            remedy=f"The first id is {claims[0].id!r}." if claims else "There are no tests.",
            where=Where("-k"),
        )
    return left


def _says(words: str, id_: str) -> bool:
    """`or` binds loosest, then `and`, then `not`; no brackets."""
    return any(
        all(
            (part.removeprefix("not ").strip().lower() in id_) != part.startswith("not ")
            for part in map(str.strip, either.split(" and "))
        )
        for either in words.split(" or ")
    )
