"""Shipped scenarios: tutorials by theme, and named sets for comparisons."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from comity_fis import Where, closest, unknown_word

THEMES = (
    "first visits",
    "distance and side",
    "greeting",
    "wishes and consent",
    "people who move",
    "things that change",
    "faults",
    "several visits",
    "groups and bystanders",
    "learning",
    "testing",
)
"""Themes in reading order; a theme's folder has its name, with dashes."""
SETS = ("comity-bench-1",)
"""Sets never change: a modified set gets a new number."""
SUFFIX = ".scenario.yaml"

_FOLDER = Path(__file__).parents[1] / "scenarios"
_RENAMED = {
    "asks-in-her-way": "asks-to-pass",
    "asks-it-nearer": "comity-bench-1/asks-it-closer",
    "aslant-through-the-hall": "comity-bench-1/diagonal-through-the-hall",
    "bath-is-shut": "comity-bench-1/closed-bathroom",
    "begins-beside": "comity-bench-1/starts-next-to-someone",
    "comes-at-it": "comity-bench-1/walks-at-the-robot",
    "comes-back-with-a-book": "comity-bench-1/returns-with-a-book",
    "crosses-the-way": "comity-bench-1/crosses-its-path",
    "emergency-pressed": "emergency-stop",
    "goes-back-before-her": "comity-bench-1/backs-out-of-the-passage",
    "in-the-only-gap": "comity-bench-1/blocks-the-only-gap",
    "long-way-round": "comity-bench-1/detour",
    "not-worth-the-way": "skipped-guest",
    "on-two-wheels": "comity-bench-1/two-wheels",
    "out-of-time": "comity-bench-1/time-limit",
    "own-words": "own-wishes",
    "poor-sight": "noisy-sensor",
    "round-odd-corners": "comity-bench-1/around-odd-corners",
    "round-the-table": "comity-bench-1/around-the-table",
    "sees-ahead": "comity-bench-1/limited-sensor",
    "sight-fails": "comity-bench-1/sensor-goes-blind",
    "somewhere-in-the-flat": "comity-bench-1/anywhere-in-the-flat",
    "spoken-to-slowly": "comity-bench-1/asks-for-slow-speech",
    "stands-in-its-way": "comity-bench-1/steps-in-the-way",
    "strolls-along": "comity-bench-1/keeps-strolling",
    "threatened": "comity-bench-1/threatening-person",
    "turns-round": "comity-bench-1/turns-around",
    "waits-for-a-sign": "comity-bench-1/waits-for-an-answer",
    "wanted-side-blocked": "comity-bench-1/preferred-side-blocked",
    "whoever-waits-longest": "comity-bench-1/priority-first",
    "worth-the-way": "comity-bench-1/worth-the-detour",
}
"""Present names by names used until November 2026; names kept by a set are not listed."""


@cache
def by_theme() -> Mapping[str, Mapping[str, Path]]:
    """Files of the tutorial scenarios, by theme and name."""
    return MappingProxyType({theme: _files(_FOLDER / theme.replace(" ", "-")) for theme in THEMES})


@cache
def taught_scenarios() -> Mapping[str, Path]:
    """Files of the tutorial scenarios by name, theme after theme."""
    return MappingProxyType({name: path for files in by_theme().values() for name, path in files.items()})


@cache
def set_named(name: str) -> Mapping[str, Path]:
    """Files of a set in `SETS`, by their names `SET/SCENARIO`."""
    return MappingProxyType({f"{name}/{each}": path for each, path in _files(_FOLDER / name).items()})


def set_asked(name: str) -> Mapping[str, Path]:
    """Files of a set named by a user.

    Raises:
        InputError: if there is no set of that name.
    """
    if name not in SETS:
        raise unknown_word("a shipped set of scenarios", name, SETS, where=Where("--set"))
    return set_named(name)


@cache
def every_shipped() -> Mapping[str, Path]:
    """All shipped files, by the names that users type."""
    sets = {name: path for each in SETS for name, path in set_named(each).items()}
    return MappingProxyType({**taught_scenarios(), **sets})


@cache
def names_by_path() -> Mapping[Path, str]:
    """The names that users type, by path."""
    return MappingProxyType({path: name for name, path in every_shipped().items()})


def instead(name: str) -> str | None:
    """The present name for a former name, or for a typo after a set's name; None for any other name."""
    if name in SETS:
        return f"It is a set: `comity scenarios --set {name}` lists what is in it; name one of these."
    for each in SETS:
        if f"{each}/{name}" in set_named(each):
            return f"It is in a set now: write '{each}/{name}'."
        if name.startswith(f"{each}/"):
            return f"{closest(name, set_named(each))} `comity scenarios --set {each}` lists them."
    return f"It is called {_RENAMED[name]!r} now." if name in _RENAMED else None


def _files(folder: Path) -> Mapping[str, Path]:
    return {path.name.removesuffix(SUFFIX): path for path in sorted(folder.glob(f"*{SUFFIX}"))}
