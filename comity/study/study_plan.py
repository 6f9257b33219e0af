"""All episodes of a study, checked before any of them runs."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity.output.digest import digest_of
from comity.parameters.cast import rulebook_of
from comity.parameters.values import infer_for
from comity.people.profile import declared_by
from comity.preparation import resolved
from comity.scenario import ScenarioFile, load_scenario
from comity.study.base import EpisodeBase, base_of
from comity.study.design import StudyCondition, conditions_of, refuse_repeated
from comity.study.drawing import rulebook_beside
from comity.study.individual import Individual
from comity.study.population import StudyPopulation, load_population
from comity.study.roles import roles_of
from comity.study.study_file import StudyFile
from comity.study.unscored import unscored_notes
from comity_fis import InputError, Rulebook, load_rulebook, unknown_word
from comity_fis.validation.name_or_path import looks_like_a_file
from comity_fis.validation.yaml_file import YamlFile, read_yaml

if TYPE_CHECKING:
    from datetime import date

MOST_EPISODES = 10_000_000


@dataclass(frozen=True, slots=True)
class StudyCell:
    """One episode of a study: a scenario, a condition, an individual and a seed."""

    scenario: str
    """Name of the scenario in the study."""
    condition: StudyCondition
    base: EpisodeBase
    person: str | None
    """Person replaced by the individual; None without individuals."""
    individual: Individual | None
    seed: int

    def key(self, code: str, fingerprint: str) -> str:
        """Digest of everything the episode depends on.

        Args:
            code: The digest of the installed code.
            fingerprint: Fingerprint of everything else that affects the bytes of a trace.
        """
        one = self.individual
        who = None if one is None else {**one.as_plain(), "name": "", "group": ""}
        if who is not None:
            who["profile"] = {key: fact for key, fact in who["profile"].items() if key != "name"}
        return digest_of([self.base.digest, self.person, who, self.seed, code, fingerprint])


@dataclass(frozen=True, slots=True)
class StudyPlan:
    """A study with everything resolved."""

    file: YamlFile
    written: StudyFile
    conditions: tuple[StudyCondition, ...]
    population: StudyPopulation | None
    bases: Mapping[str, tuple[EpisodeBase, ...]]
    """By scenario, one base per condition."""
    persons: Mapping[str, str]
    """By scenario, the person replaced by individuals."""
    notes: tuple[str, ...] = ()
    """Warnings about possible mistakes, such as a culture without a score."""

    @property
    def individuals(self) -> tuple[Individual | None, ...]:
        """The individuals; a single None in a study without any."""
        return self.population.individuals if self.population else (None,)

    @property
    def episodes(self) -> int:
        """Number of episodes."""
        parts = (self.bases, self.conditions, self.individuals, self.written.every_seed)
        count = 1
        for part in parts:
            count *= len(part)
        return count

    def cells(self) -> Iterator[StudyCell]:
        """All episodes; seeds vary fastest, then individuals, conditions and scenarios."""
        for scenario, bases in self.bases.items():
            person = self.persons[scenario] if self.population else None
            for condition, base in zip(self.conditions, bases, strict=True):
                for individual in self.individuals:
                    for seed in self.written.every_seed:
                        yield StudyCell(scenario, condition, base, person, individual, seed)


def load_study(path: Path) -> StudyPlan:
    """Load a study from a file; everything is checked that needs no episode.

    Raises:
        InputError: with file and line, for anything that cannot be used.
    """
    return study_of(read_yaml(path))


def study_of(file: YamlFile) -> StudyPlan:
    """The plan of a parsed study file.

    Raises:
        InputError: with file and line, for anything that cannot be used.
    """
    written = file.check(StudyFile)
    conditions = conditions_of(file, written)
    refuse_repeated(file, ("scenarios",), written.scenarios, "scenario")
    if not isinstance(written.seeds, int):
        refuse_repeated(file, ("seeds",), written.seeds, "seed")
    scenarios = {name: _scenario(file, i, name) for i, name in enumerate(written.scenarios)}
    roles = {name: roles_of(file, written, name, one) for name, one in scenarios.items()}
    population = _population(file, written)
    persons = {name: _person(file, written, one) for name, one in roles.items()} if population else {}
    _refuse_profiles_of_individuals(file, written, conditions, has_individuals=population is not None)
    bases: dict[str, tuple[EpisodeBase, ...]] = {}
    books: dict[str, Rulebook] = {}
    people: list[tuple[str, Mapping[str, Any], date | None]] = []
    for name, scenario in scenarios.items():
        made = []
        for condition in conditions:
            base, changed = _based(file, written, scenario, condition, roles[name])
            books.setdefault(base.rulebook, load_rulebook(rulebook_of(changed)))
            made.append(base)
            people += _others(base, changed, persons.get(name))
        bases[name] = tuple(made)
    plan = StudyPlan(file, written, conditions, population, bases, persons)
    if plan.episodes > MOST_EPISODES:
        raise InputError(
            expected=f"at most {MOST_EPISODES} episodes",
            got=str(plan.episodes),
            remedy="Use fewer seeds, individuals or conditions.",
            where=file.where(("seeds",)),
        )
    if population is not None:
        _refuse_compared(file, written, population, books.values())
        _check_individuals(population, books.values(), written.at)
        people += [(one.group or one.name, one.profile, written.at) for one in population.individuals]
    return replace(plan, notes=unscored_notes(people, books.values()))


def _others(
    base: EpisodeBase, scenario: ScenarioFile, individual: str | None
) -> Iterator[tuple[str, Mapping[str, Any], date | None]]:
    """The people of a scenario who are not replaced by an individual: name, profile, and date."""
    for name, person in base.scenario["people"].items():
        if name != individual:
            yield name, person["profile"], scenario.scenario.at


def _scenario(file: YamlFile, i: int, name: str) -> ScenarioFile:
    path = file.path.parent / name
    with file.placing("scenarios", i):
        return load_scenario(str(path) if looks_like_a_file(name, path) else name)


def _population(file: YamlFile, written: StudyFile) -> StudyPopulation | None:
    if written.population is None:
        return None
    path = file.path.parent / written.population
    if not path.is_file():
        raise InputError(
            expected="a population file",
            got=f"no such file: {written.population}",
            remedy="Check the path: it starts from the study's folder.",
            where=file.where(("population",)),
        )
    return load_population(path, str(path), written.at)


def _person(file: YamlFile, written: StudyFile, roles: Mapping[str, str]) -> str:
    role = written.individuals_are
    if role not in roles:
        raise unknown_word("a role", role, roles, where=file.where(("individuals_are",)))
    return roles[role]


def _refuse_profiles_of_individuals(
    file: YamlFile, written: StudyFile, conditions: Sequence[StudyCondition], *, has_individuals: bool
) -> None:
    """Refuse factors for an individual's profile or comfort, which individuals bring along."""
    taken = {f"people.{written.individuals_are}.{key}" for key in ("profile", "comfort")}
    for condition in conditions if has_individuals else ():
        for path in condition.values:
            if path in taken:
                raise InputError(
                    expected="individuals or this factor",
                    got=f"{path} beside a population that takes that role",
                    remedy="Remove the factor, or let the individuals take another role.",
                    where=file.where(condition.places[path]),
                )


def _based(
    file: YamlFile,
    written: StudyFile,
    scenario: ScenarioFile,
    condition: StudyCondition,
    roles: Mapping[str, str],
) -> tuple[EpisodeBase, ScenarioFile]:
    """A scenario under a condition, checked; an invalid value is reported with its line."""

    def made(one: StudyCondition) -> tuple[EpisodeBase, ScenarioFile]:
        base, changed = base_of(scenario, one, roles, folder=file.path.parent, at=written.at)
        resolved(changed)
        return base, changed

    try:
        return made(condition)
    except InputError as error:
        for path, value in condition.values.items():
            try:
                made(replace(condition, values={path: value}))
            except InputError as alone:
                raise _placed(alone, file, condition.places[path], path) from None
        places = condition.places.values()
        raise _placed(error, file, next(iter(places), ("scenarios",)), None) from None


def _placed(error: InputError, file: YamlFile, place: tuple[str | int, ...], path: str | None) -> InputError:
    expected = error.expected if path is None else f"for {path} {error.expected}"
    return InputError(expected=expected, got=error.got, remedy=error.remedy, where=file.where(place))


def _refuse_compared(
    file: YamlFile, written: StudyFile, population: StudyPopulation, books: Collection[Rulebook]
) -> None:
    """Refuse comfort drawn from a rulebook that the study compares: it would be judged by itself."""
    if written.assume == "rulebook":
        return
    names = {book.name for book in books}
    for group, named in population.rulebooks.items():
        if load_rulebook(rulebook_beside(population.file, named)).name in names:
            raise InputError(
                expected="comfort that does not follow from a rulebook of the study",
                got=f"comfort drawn from {named}, which would be judged by what it says itself",
                remedy="State numbers with their source, or write `assume: rulebook` into the study.",
                where=population.file.where(("groups", group, "comfort", "rulebook")),
            )


def _check_individuals(population: StudyPopulation, books: Collection[Rulebook], at: date | None) -> None:
    """Refuse facts and wishes that a rulebook of the study cannot use, and facts that need a date."""
    for one in population.individuals:
        declared = declared_by(one.profile, called=one.name)
        where = population.where(one)
        if at is None and declared.profile.depends_on_date:
            raise InputError(
                expected="a day on which dated facts are taken",
                got="none",
                remedy="Write `at: 2026-01-31`, or another day, into the study.",
                where=where,
            )
        for book in books:
            try:
                infer_for(declared, book, at=at)
            except InputError as error:
                raise InputError(
                    expected=error.expected, got=error.got, remedy=error.remedy, where=where
                ) from None
