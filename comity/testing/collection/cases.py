"""The cases of a scenario file, with the expectations of each."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from comity.scenario import Scenario, ScenarioFile
from comity.specification.matrix import Markers
from comity.system.library import require_file
from comity.system.scenario_sets import names_by_path
from comity.testing.expectation import ProfileComparison, Written
from comity.testing.grammar.quoting import advised, require_quotes
from comity.testing.grammar.sentence import parsed
from comity.testing.kinds.hearing import Hearing
from comity.testing.trials.case import ACROSS, Across, Case, beside, from_here
from comity.testing.trials.profiles import Tried, different, profiles_of
from comity.testing.trials.world import in_world
from comity_domain import ENGINE
from comity_fis import InputError, Where, closest, load_rulebook, read_rulebook, unknown_word
from comity_fis.errors import ManyInputErrors
from comity_fis.validation.yaml_file import read_yaml

_AND = "Write `and`, or a comma: the sentence holds for each of them."


@dataclass(frozen=True, slots=True)
class Claim:
    """One case with its expectations."""

    case: Case | Across
    expectations: tuple[Written, ...]
    others: tuple[str, ...] = ()
    """Profiles named instead of the matrix's: a case's own, or all of a comparison."""

    @property
    def id(self) -> str:
        """The case's name."""
        return self.case.id

    @property
    def path(self) -> Path:
        """The scenario's file."""
        return self.case.file.file.path

    @property
    def markers(self) -> Markers:
        """Markers that the file gives its tests."""
        return self.case.file.scenario.markers

    @property
    def must_fail(self) -> bool:
        """Whether the test must fail; a comparison may pass nevertheless."""
        return self.markers.xfail is not None and not isinstance(self.case, Across)

    @property
    def line(self) -> int:
        """Line at which the expectations begin, counted from 1."""
        return self.case.file.where("expect").line or 1


def claims_in(path: Path, *, profiles: Sequence[str] = (), engine: str = ENGINE) -> tuple[Claim, ...]:
    """The tests of a file, in the order of its matrix; a comparison of profiles comes last.

    Args:
        path: The file.
        profiles: Profiles that replace the matrix's, if it has any: names, or paths from the current folder.
        engine: The planner, as for `comity.preparation.prepare`.

    Raises:
        InputError: with the line, for anything in the file that cannot be used.
    """
    file = _read(path)
    people = file.scenario.people
    _require(file.scenario.matrix.people, "a person from `people`", people, file.where("matrix", "people"))
    own = profiles_of(file)
    written = _expectations(file, {tried.called for tried in own})
    by_itself = tuple(one for one in written if not isinstance(one.meaning, ProfileComparison))
    compared = tuple(one for one in written if isinstance(one.meaning, ProfileComparison))
    cases = tuple(_cases(file, profiles_of(file, profiles) if profiles else own, engine))
    claims = [
        Claim(
            case,
            tuple(one for one in by_itself if one.concerns(case.profile_name)),
            (case.named,) if profiles and case.named else (),
        )
        for case in cases
    ]
    if compared:
        others = tuple(profiles) if file.scenario.matrix.profiles else ()
        claims += [Claim(Across(group), compared, others) for group in _groups(cases)]
    _refuse_twins(claims, file)
    return tuple(claims)


def _refuse_twins(claims: Sequence[Claim], file: ScenarioFile) -> None:
    """Refuse two tests with the same name, or two cases with the same golden episode."""
    seen: dict[str, Claim] = {}
    for claim in claims:
        for name in (claim.id, claim.case.slug):
            if name in seen:
                raise InputError(
                    expected="cases with names of their own",
                    got=f"{claim.id} beside {seen[name].id}",
                    remedy=_told_apart(claim, seen[name]),
                    where=Where("--profile") if claim.others else file.where("matrix"),
                )
        seen |= dict.fromkeys((claim.id, claim.case.slug), claim)


def _told_apart(claim: Claim, other: Claim) -> str:
    """Remedy for two tests that cannot be distinguished."""
    if isinstance(claim.case, Across) and isinstance(other.case, Case):
        return f"Call the profile otherwise: `{ACROSS}` is what the comparison of all profiles is called."
    if claim.id == other.id:
        return "Leave out what stands there twice, or rename one of the two files or worlds."
    return (
        f"The files of both would be called {claim.case.slug!r}, with a dash for signs that names of files "
        "may not have: rename one of the two so that its letters or digits differ."
    )


def shown(path: Path) -> str:
    """The shortest path from the current folder; a shipped scenario by its name."""
    return names_by_path().get(path) or str(from_here(path) or path)


def ships(path: Path) -> bool:
    """Whether a file is a scenario that ships with Comity."""
    return path in names_by_path()


def _read(path: Path) -> ScenarioFile:
    try:
        file = read_yaml(path, shown(path))
    except InputError as error:
        if error.expected != "YAML":
            raise
        raise advised(error, path.read_text(encoding="utf-8")) from None
    return ScenarioFile(file, file.check(Scenario))


def _expectations(file: ScenarioFile, profiles: Collection[str]) -> tuple[Written, ...]:
    """All sentences of a file; the errors of unusable ones are reported together."""
    read, wrong = [], []
    for i, item in enumerate(file.scenario.expect):
        try:
            read.append(_written(file, i, item, profiles))
        except InputError as error:
            wrong.append(error)
    if wrong:
        raise wrong[0] if len(wrong) == 1 else ManyInputErrors(wrong)
    return tuple(read)


def _written(file: ScenarioFile, i: int, item: str | Mapping[str, str], known: Collection[str]) -> Written:
    text, where = _sentence(file, i, item)

    def place(offset: int) -> Where:
        if ("expect", i) in file.file.spans:
            return file.file.where_in(("expect", i), text, offset)
        return where

    require_quotes(text, _with_groups(file), place)
    meaning, profiles = parsed(text, place)
    hearers = meaning.hearers if isinstance(meaning, Hearing) else ()
    _require(meaning.people, "a person from `people`", file.scenario.people, where)
    _require(hearers, "a person from `people`, or one of `groups`", _with_groups(file), where)
    _refuse_unknown_profiles(profiles, known, where)
    if isinstance(meaning, ProfileComparison):
        different(file, meaning.profiles, where)
    return Written(text, where, meaning, profiles)


def _with_groups(file: ScenarioFile) -> tuple[str, ...]:
    return (*file.scenario.people, *file.scenario.groups)


def _require(names: Sequence[str], expected: str, known: Collection[str], where: Where) -> None:
    """Refuse a name that the scenario does not have."""
    for name in names:
        if name not in known:
            raise unknown_word(expected, name, known, where=where)


def _sentence(file: ScenarioFile, i: int, item: str | Mapping[str, str]) -> tuple[str, Where]:
    """The text of a sentence; YAML reads a sentence with a colon as a mapping."""
    where = file.where("expect", i)
    if isinstance(item, str):
        return item, where
    if len(item) != 1:
        raise InputError(
            expected="one sentence for each dash",
            got=f"{len(item)} lines with colons",
            remedy="Begin each with a dash.",
            where=where,
        )
    ((start, end),) = item.items()
    return f"{start}: {end}", where


def _cases(file: ScenarioFile, profiles: Sequence[Tried], engine: str) -> Iterator[Case]:
    matrix = file.scenario.matrix
    worlds: dict[str | None, ScenarioFile] = {None: file}
    if matrix.worlds:
        worlds = {name: in_world(file, name) for name in matrix.worlds}
    for world, there in worlds.items():
        for tried in profiles:
            for rulebook in _rulebooks(file):
                for seed in matrix.seeds:
                    yield Case(
                        file=there,
                        people=matrix.people or (file.scenario.goals[0].person,),
                        profile=tried.load,
                        profile_name=tried.called,
                        named=tried.named,
                        seed=seed,
                        rulebook=rulebook,
                        world=world,
                        engine=engine,
                    )


def _rulebooks(file: ScenarioFile) -> Sequence[str | None]:
    """Readable names and paths of rulebooks; None for the scenario's own."""
    written = file.scenario.matrix.rulebooks
    found = [beside(file, name) for name in written]
    for i, name in enumerate(found):
        where = file.where("matrix", "rulebooks", i)
        if name != written[i]:
            require_file("rulebook", Path(name), written[i], where)
        try:
            load_rulebook(read_rulebook(name))
        except InputError as error:
            raise _named(error, where) from None
    return found or (None,)


def _named(error: InputError, where: Where) -> InputError:
    """An error in a file, with the scenario's line that names the file."""
    if error.where is None:
        return error.at(where)
    remedy = f"{error.remedy} The matrix names this file in {where}.".strip()
    there = replace(error.where, file=str(from_here(Path(error.where.file)) or error.where.file))
    return InputError(expected=error.expected, got=error.got, remedy=remedy, where=there)


def _groups(cases: Sequence[Case]) -> Iterator[tuple[Case, ...]]:
    """Groups of cases that differ only in the profile."""
    groups: dict[tuple[object, ...], list[Case]] = {}
    for case in cases:
        groups.setdefault((case.world, case.rulebook, case.seed), []).append(case)
    yield from map(tuple, groups.values())


def _refuse_unknown_profiles(names: Sequence[str], known: Collection[str], where: Where) -> None:
    """Refuse an expectation for a profile that the matrix does not have."""
    for name in names:
        if name not in known:
            raise InputError(
                expected="a profile of the scenario's matrix",
                got=repr(name),
                remedy=_AND if name.lower() == "or" else closest(name, known),
                where=where,
            )
