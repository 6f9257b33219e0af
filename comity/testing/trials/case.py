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
"""Name of the case that compares the profiles of a scenario."""


DAY = date(2026, 1, 1)
"""Default date for dated facts, if a scenario names none: tests must not depend on the current date."""


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A scenario in one world, with one profile, rulebook and seed; compared by identity."""

    file: ScenarioFile
    """The scenario in this world."""
    people: tuple[str, ...]
    """People who have the profile."""
    profile: str | None
    """A shipped or stored name, or a file; None if the scenario's profiles are unchanged."""
    profile_name: str
    """Name of the profile in the case's name."""
    seed: int
    named: str | None = None
    """The profile as written in the matrix or `--profile`; None if the same as `profile`."""
    rulebook: str | None = None
    world: str | None = None
    engine: str = ENGINE
    """The planner: `comity`, or an engine by its name in unified-planning."""

    @property
    def day(self) -> date:
        """Date on which dated facts are evaluated."""
        return self.file.scenario.at or DAY

    @property
    def cast(self) -> Cast:
        """Its people, with their profiles on that date."""
        return cast_of(self.file, profiles=self.profiles, rulebook=self.rulebook, at=self.day)

    @property
    def rulebook_file(self) -> YamlFile:
        """The rulebook that the case reads."""
        return rulebook_of(self.file, self.rulebook, self.profiles)

    @property
    def parts(self) -> tuple[str, ...]:
        """What distinguishes it from other cases of the scenario."""
        rulebook = None if self.rulebook is None else Path(self.rulebook).stem
        return tuple(filter(None, (self.profile_name, rulebook, self.world, f"seed{self.seed}")))

    @property
    def id(self) -> str:
        """Test id such as `greet-in-lounge[german_woman-seed0]`."""
        return f"{self.file.scenario.name}[{'-'.join(self.parts)}]"

    @property
    def slug(self) -> str:
        """Its parts as a file or folder name, unique in the scenario."""
        return _slug(self.parts)

    @property
    def path(self) -> Path:
        """The scenario's file."""
        return self.file.file.path

    @property
    def profiles(self) -> Mapping[str, str]:
        """Profiles that replace the scenario's, by person."""
        return {} if self.profile is None else dict.fromkeys(self.people, self.profile)

    def properties(self) -> Iterator[tuple[str, str | float]]:
        """Properties for JUnit reports."""
        yield from (("scenario", self.file.scenario.name), ("profile", self.profile_name))
        yield from self.circumstances()

    def circumstances(self) -> Iterator[tuple[str, str | float]]:
        """Properties for JUnit reports that the profiles of a scenario share; only a matrix names worlds."""
        rulebook = self.rulebook or self.file.scenario.rulebook
        if rulebook is None:
            rulebook = str(self.rulebook_file.data["name"])
        yield "seed", self.seed
        yield "rulebook", Path(rulebook).stem if isinstance(rulebook, str) else "of the scenario"
        if self.world is not None:
            yield "world", self.world


@dataclass(frozen=True, slots=True, eq=False)
class Across:
    """A comparison of all profiles of a scenario, in one world, with one rulebook and one seed."""

    cases: tuple[Case, ...]

    @property
    def file(self) -> ScenarioFile:
        """The scenario."""
        return self.cases[0].file

    @property
    def engine(self) -> str:
        """The planner."""
        return self.cases[0].engine

    @property
    def id(self) -> str:
        """Test id such as `greet-in-lounge[across-seed0]`."""
        return f"{self.file.scenario.name}[{'-'.join(self.parts)}]"

    @property
    def parts(self) -> tuple[str, ...]:
        """What distinguishes it from other tests of the scenario."""
        return (ACROSS, *self.cases[0].parts[1:])

    @property
    def slug(self) -> str:
        """Its parts as a file name."""
        return _slug(self.parts)

    def properties(self) -> Iterator[tuple[str, str | float]]:
        """Properties for JUnit reports."""
        yield "scenario", self.file.scenario.name
        yield "profiles", ", ".join(case.profile_name for case in self.cases)
        yield from self.cases[0].circumstances()


def _slug(parts: Iterable[str]) -> str:
    return re.sub(r"[^\w.-]+", "-", "-".join(parts)).strip("-.")


def whole(path: Path) -> Path:
    """An absolute path without `..` whose links are kept: `resolve` would follow them."""
    return Path(os.path.abspath(path))  # noqa: PTH100  (`absolute` keeps `..`)


def from_here(path: Path) -> Path | None:
    """A path relative to the current folder; None if it is elsewhere."""
    return whole(path).relative_to(Path.cwd()) if whole(path).is_relative_to(Path.cwd()) else None


def beside(file: ScenarioFile, name: str) -> str:
    """A shipped or stored name unchanged; a file's path relative to the scenario's folder."""
    path = file.folder / name
    return str(path) if looks_like_a_file(name, path) else name
