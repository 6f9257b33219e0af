"""Random sampling of individuals, with a seed.

Each individual has its own random stream, which follows from the seed, its group and its number there. A
larger group therefore keeps its previous individuals, and another group changes none of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from hashlib import sha256
from typing import TYPE_CHECKING, Any

import numpy as np

from comity.parameters.values import infer_for
from comity.people.profile import declared_by
from comity.scenario import ComfortSpec
from comity.study.individual import Individual, plain_fact
from comity.study.population_file import ChosenFact, DrawnComfort, DrawnGroup, PopulationFile, UniformFact
from comity_domain.problem.bound_parameters import DISTANCE
from comity_fis import InputError, load_rulebook
from comity_sim2d.scene.comfort import FARTHEST_M, NEAREST_M

if TYPE_CHECKING:
    from datetime import date

    from comity_fis.validation.yaml_file import YamlFile


def drawn_individuals(file: YamlFile, written: PopulationFile, day: date | None) -> Iterator[Individual]:
    """Draw the individuals of all groups, group by group.

    Args:
        file: The population's file, for messages.
        written: Its content.
        day: Date for dated facts.

    Raises:
        InputError: with the line, for facts that are invalid in a profile, or a rulebook without a distance.
    """
    for name, group in written.groups.items():
        width = len(str(group.individuals))
        with file.placing("groups", name):
            for number in range(1, group.individuals + 1):
                called = f"{name}_{number:0{max(width, 2)}d}"
                yield _drawn(file, written, name, group, called, number=number, day=day)


def _drawn(
    file: YamlFile,
    written: PopulationFile,
    name: str,
    group: DrawnGroup,
    called: str,
    *,
    number: int,
    day: date | None,
) -> Individual:
    rng = random_numbers(written.seed, name, number)
    facts = {key: plain_fact(key, _fact(fact, rng)) for key, fact in sorted(group.facts.items())}
    profile: dict[str, Any] = {"name": called, **facts}
    _require_profile(profile, called)
    if group.comfort is None:
        return Individual(called, name, profile, None)
    mean_m, sd_m = _distribution(file, name, group.comfort, profile, day)
    comfort = _comfort(group.comfort, mean_m + sd_m * float(rng.standard_normal()))
    return Individual(called, name, profile, comfort)


def _require_profile(profile: Mapping[str, Any], called: str) -> None:
    """Refuse facts that are invalid in a profile; errors name the group's line, not that of a text."""
    try:
        declared_by(profile, called=called)
    except InputError as error:
        raise InputError(expected=error.expected, got=error.got, remedy=error.remedy) from None


def random_numbers(seed: int, group: str, number: int) -> np.random.Generator:
    """A random generator unique to an individual of a population.

    Args:
        seed: Seed of the population.
        group: Group of the individual, or another name that distinguishes streams.
        number: Number of the individual in its group.
    """
    words = np.frombuffer(sha256(f"{seed}\n{group}\n{number}".encode()).digest(), dtype="<u4")
    return np.random.Generator(np.random.PCG64([int(word) for word in words]))


def _fact(fact: Any, rng: np.random.Generator) -> float | str:
    if isinstance(fact, UniformFact):
        return round(float(rng.uniform(fact.from_, fact.to)), 1)
    if isinstance(fact, ChosenFact):
        return fact.any_of[int(rng.integers(len(fact.any_of)))]
    assert isinstance(fact, float | int | str)
    return fact


def _distribution(
    file: YamlFile, group: str, comfort: DrawnComfort, profile: Mapping[str, Any], day: date | None
) -> tuple[float, float]:
    """Mean and standard deviation of the middle of the comfort interval [m]."""
    if comfort.rulebook is None:
        assert comfort.middle_m is not None
        assert comfort.sd_m is not None
        return comfort.middle_m, comfort.sd_m
    with file.placing("groups", group, "comfort", "rulebook"):
        book = load_rulebook(rulebook_beside(file, comfort.rulebook))
        values = infer_for(declared_by(profile, called=group), book, at=day)
        if DISTANCE not in values.parameters:
            raise InputError(
                expected=f"a rulebook with the parameter {DISTANCE}",
                got=book.name,
                remedy="Name another one.",
            )
        value = values[DISTANCE]
        return value.number, float(value.spread or 0.0)


def rulebook_beside(file: YamlFile, name: str) -> str:
    """A shipped rulebook's name unchanged; a path relative to the file's folder."""
    path = file.path.parent / name
    return str(path.absolute()) if path.is_file() else name


def _comfort(written: DrawnComfort, middle_m: float) -> ComfortSpec:
    """An interval of the given width around the drawn middle, shifted into the possible range."""
    half_m = written.half_width_m
    middle_m = min(max(middle_m, NEAREST_M[0] + half_m), min(NEAREST_M[1], FARTHEST_M - 2 * half_m) + half_m)
    near_m = round(middle_m - half_m, 3)
    return ComfortSpec(wants_m=(near_m, round(near_m + 2 * half_m, 3)), chance=written.chance)
