"""One case of a scenario's matrix."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from comity.parameters.cast import cast_of, rulebook_of
from comity_domain import ENGINE
from comity_fis.validation.name_or_path import looks_like_a_file

if TYPE_CHECKING:
    from comity.parameters.cast import Cast
    from comity.scenario import ScenarioFile
    from comity_fis.validation.yaml_file import YamlFile

ACROSS = "across"
"""The case that compares the profiles of a scenario."""


DAY = date(2026, 1, 1)
"""On which facts are taken where a scenario names no day: a test says tomorrow what it says today."""


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A scenario in one world, for one profile, with one rulebook and one seed; the same only as itself."""

    file: ScenarioFile
    """The scenario, as it is in this world."""
    people: tuple[str, ...]
    """Who has the profile."""
    profile: str | None
    """A shipped or stored name, or a file; None where everybody is as written."""
    profile_name: str
    """As it is called in the case's name."""
    seed: int
    named: str | None = None
    """As the matrix or `--profile` has it; None as the profile."""
    rulebook: str | None = None
    world: str | None = None
    engine: str = ENGINE
    """Who plans: `comity`, or an engine by the name that unified-planning has for it."""

    @property
    def day(self) -> date:
        """On which facts are taken."""
        return self.file.scenario.at or DAY

    @property
    def cast(self) -> Cast:
        """Its people, with their profiles on its day."""
        return cast_of(self.file, profiles=self.profiles, rulebook=self.rulebook, at=self.day)

    @property
    def rulebook_file(self) -> YamlFile:
        """The rulebook that it reads."""
        return rulebook_of(self.file, self.rulebook, self.profiles)

    @property
    def parts(self) -> tuple[str, ...]:
        """What distinguishes it from other cases of the scenario."""
        rulebook = None if self.rulebook is None else Path(self.rulebook).stem
        return tuple(filter(None, (self.profile_name, rulebook, self.world, f"seed{self.seed}")))

    @property
    def id(self) -> str:
        """`greet-in-lounge[german_woman-seed0]`."""
        return f"{self.file.scenario.name}[{'-'.join(self.parts)}]"

    @property
    def slug(self) -> str:
        """Its parts as the name of a file or folder, of which no two in a scenario have the same."""
        return _slug(self.parts)

    @property
    def path(self) -> Path:
        """The scenario's file."""
        return self.file.file.path

    @property
    def profiles(self) -> Mapping[str, str]:
        """Other profiles than the scenario's, by person."""
        return {} if self.profile is None else dict.fromkeys(self.people, self.profile)

    def properties(self) -> Iterator[tuple[str, str | float]]:
        """For JUnit reports."""
        yield from (("scenario", self.file.scenario.name), ("profile", self.profile_name))
        yield from self.circumstances()

    def circumstances(self) -> Iterator[tuple[str, str | float]]:
        """For JUnit reports: what profiles of one scenario share; a world has a name only in a matrix."""
        rulebook = self.rulebook or self.file.scenario.rulebook
        if rulebook is None:
            rulebook = str(self.rulebook_file.data["name"])
        yield "seed", self.seed
        yield "rulebook", Path(rulebook).stem if isinstance(rulebook, str) else "of the scenario"
        if self.world is not None:
            yield "world", self.world


@dataclass(frozen=True, slots=True, eq=False)
class Across:
    """All profiles of a scenario against each other, in one world, with one rulebook and one seed."""

    cases: tuple[Case, ...]

    @property
    def file(self) -> ScenarioFile:
        """The scenario."""
        return self.cases[0].file

    @property
    def engine(self) -> str:
        """Who plans."""
        return self.cases[0].engine

    @property
    def id(self) -> str:
        """`greet-in-lounge[across-seed0]`."""
        return f"{self.file.scenario.name}[{'-'.join(self.parts)}]"

    @property
    def parts(self) -> tuple[str, ...]:
        """What distinguishes it from other tests of the scenario."""
        return (ACROSS, *self.cases[0].parts[1:])

    @property
    def slug(self) -> str:
        """The same as the name of a file."""
        return _slug(self.parts)

    def properties(self) -> Iterator[tuple[str, str | float]]:
        """For JUnit reports."""
        yield "scenario", self.file.scenario.name
        yield "profiles", ", ".join(case.profile_name for case in self.cases)
        yield from self.cases[0].circumstances()


def _slug(parts: Iterable[str]) -> str:
    return re.sub(r"[^\w.-]+", "-", "-".join(parts)).strip("-.")


def whole(path: Path) -> Path:
    """A path from the root on, without `..`, and with its links: `resolve` follows them."""
    return Path(os.path.abspath(path))  # noqa: PTH100  (`absolute` keeps `..`)


def from_here(path: Path) -> Path | None:
    """A path as seen from the current folder; None where it is elsewhere."""
    return whole(path).relative_to(Path.cwd()) if whole(path).is_relative_to(Path.cwd()) else None


def beside(file: ScenarioFile, name: str) -> str:
    """A shipped or stored name as it is; a file's path starts from the scenario's folder."""
    path = file.folder / name
    return str(path) if looks_like_a_file(name, path) else name
