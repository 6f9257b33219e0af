"""The individuals of a study in their order, from a file."""

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
"""What a person may ask for [m]: a wish outside it would be refused."""


@dataclass(frozen=True, slots=True)
class StudyPopulation:
    """The individuals, and how they came to be."""

    file: YamlFile
    written: PopulationFile
    individuals: tuple[Individual, ...]

    @property
    def is_drawn(self) -> bool:
        """Whether they are invented; else they were taken from a table, and may be real people."""
        return self.written.table is None

    @property
    def wishing(self) -> int:
        """How many of them state a wish."""
        return sum("settings" in one.profile for one in self.individuals)

    def where(self, one: Individual) -> Where:
        """The place of an individual: its row in the table, or its group."""
        if one.line is None:
            return self.file.where(("groups", one.group))
        return Where(str(self.file.path.parent / str(self.written.table)), one.line)

    @property
    def rulebooks(self) -> dict[str, str]:
        """The rulebooks that comfort was drawn from, by group."""
        drawn = ((name, group.comfort) for name, group in self.written.groups.items())
        return {name: comfort.rulebook for name, comfort in drawn if comfort and comfort.rulebook}


def load_population(path: Path, called: str, day: date | None) -> StudyPopulation:
    """The population that a file describes.

    Args:
        path: Of the file.
        called: What messages call it.
        day: On which dated facts are taken; needed only where comfort follows from them.

    Raises:
        InputError: with file and line, for whatever cannot be used.
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
    """Let each individual with a comfort wish its middle, with a probability that is the share."""
    for number, one in enumerate(individuals, 1):
        rng = random_numbers(seed, f"wish of {one.name}", 0 if one.line is None else number)
        if one.comfort is None or float(rng.uniform()) >= share:
            yield one
        else:
            yield replace(one, profile={**one.profile, "settings": {DISTANCE: wished_m(one.comfort)}})


def wished_m(comfort: ComfortSpec) -> float:
    """The distance that an individual asks for [m]: the middle of the interval, if that may be asked for."""
    low_m, high_m = WISH_RANGE_M
    return round(min(max(sum(comfort.wants_m) / 2, low_m), high_m), 2)
