"""The individuals of a study, read from a file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from comity.study.drawing import drawn_individuals, random_numbers
from comity.study.individual import Individual
from comity.study.people_table import individuals_of_table
from comity.study.population_file import PopulationFile, Wishes
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import Where
from comity_fis.validation.yaml_file import YamlFile, read_yaml

if TYPE_CHECKING:
    from datetime import date

    from comity.scenario import ComfortSpec

WISH_RANGE_M = (0.45, 3.0)
"""Range of distances that a person may ask for [m]; other wishes are refused."""


@dataclass(frozen=True, slots=True)
class StudyPopulation:
    """The individuals, and their origin."""

    file: YamlFile
    written: PopulationFile
    individuals: tuple[Individual, ...]

    @property
    def is_drawn(self) -> bool:
        """Whether they are invented; otherwise they come from a table, and may be real people."""
        return self.written.table is None

    @property
    def wishing(self) -> int:
        """Number of individuals with a wish."""
        return sum("settings" in one.profile for one in self.individuals)

    def where(self, one: Individual) -> Where:
        """Position of an individual's source: its row in the table, or its group."""
        if one.line is None:
            return self.file.where(("groups", one.group))
        return Where(str(self.file.path.parent / str(self.written.table)), one.line)

    @property
    def rulebooks(self) -> dict[str, str]:
        """By group, the rulebook that comfort distances were drawn from."""
        drawn = ((name, group.comfort) for name, group in self.written.groups.items())
        return {name: comfort.rulebook for name, comfort in drawn if comfort and comfort.rulebook}


def load_population(path: Path, called: str, day: date | None) -> StudyPopulation:
    """Load a population from a file.

    Args:
        path: Path of the file.
        called: Name of the file in messages.
        day: Date for dated facts; needed only if comfort distances depend on them.

    Raises:
        InputError: with file and line, for anything that cannot be used.
    """
    file = read_yaml(path, called)
    written = file.check(PopulationFile)
    if written.table is not None:
        individuals = individuals_of_table(file, written)
    else:
        individuals = drawn_individuals(file, written, day)
    if isinstance(written.wishes, Wishes):
        individuals = _with_wishes(individuals, written.seed, written.wishes.share)
    return StudyPopulation(file, written, tuple(individuals))


def _with_wishes(individuals: Iterator[Individual], seed: int, share: float) -> Iterator[Individual]:
    """Give each individual with a comfort interval a wish for its middle, with probability `share`."""
    for number, one in enumerate(individuals, 1):
        rng = random_numbers(seed, f"wish of {one.name}", 0 if one.line is None else number)
        if one.comfort is None or float(rng.uniform()) >= share:
            yield one
        else:
            yield replace(one, profile={**one.profile, "settings": {DISTANCE: wished_m(one.comfort)}})


def wished_m(comfort: ComfortSpec) -> float:
    """The distance that an individual asks for [m]: the middle of the interval, clipped to `WISH_RANGE_M`."""
    low_m, high_m = WISH_RANGE_M
    return round(min(max(sum(comfort.wants_m) / 2, low_m), high_m), 2)
