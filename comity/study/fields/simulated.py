"""Reporting fields of a simulation study, from its file, its population and its table."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from statistics import mean
from typing import TYPE_CHECKING, Any

from comity.scenario import RobotStart
from comity.study.columns import column_of
from comity.study.fields.reported_field import BLANKS, SECTIONS, ReportedField, Section, inapplicable
from comity.study.fields.simulated_results import outcomes_told, results_told
from comity.study.folder import ACCOUNT, WRITTEN
from comity.study.report.episodes import StudyVisits
from comity.study.report.replaying import plan_of
from comity.study.statement import STATEMENT
from comity.study.table import plain_value
from comity.system.own_files import read_regular
from comity_fis import InputError, Where
from comity_fis.validation.complaint import counted

if TYPE_CHECKING:
    from pathlib import Path

    from comity.study.population import StudyPopulation
    from comity.study.results import Study
    from comity.study.study_plan import StudyPlan

TOLD = ("episodes", "different", "failed", "version", "code", "fingerprint")
"""Entries used of a study's account."""
NO_PEOPLE = "no people took part"
OF_PEOPLE: Mapping[str, str] = {
    "Ethics": NO_PEOPLE,
    "Recruitment": NO_PEOPLE,
    "Inclusion and exclusion": NO_PEOPLE,
    "Compensation": NO_PEOPLE,
    "Withdrawals": NO_PEOPLE,
    "Experience with robots": NO_PEOPLE,
    "Blinding": "all numbers are computed",
    "Manipulation check": NO_PEOPLE,
    "Instructions": NO_PEOPLE,
    "Familiarisation": NO_PEOPLE,
    "Wording": "no questionnaires were asked",
}
"""Fields about participants, with the reason why they do not apply."""
OF_A_TABLE = ("Ethics", "Recruitment", "Inclusion and exclusion", "Compensation", "Withdrawals")
"""Those of these fields that apply if individuals come from a table: it may contain real people."""


@dataclass(frozen=True, slots=True)
class SimulatedStudy:
    """The files of a simulation study."""

    plan: StudyPlan
    visits: StudyVisits
    account: Mapping[str, Any]
    """Content of its `study.json`."""

    @classmethod
    def read(cls, study: Study, file: Path) -> SimulatedStudy:
        """Read a study's folder, with the file that it was run from.

        Raises:
            InputError: if the file is missing or was changed, or the folder lacks its account or rows.
        """
        plan = plan_of(study, file)
        try:
            was_run = read_regular(study.path / WRITTEN).decode()
            account = json.loads(read_regular(study.path / ACCOUNT))
            told = {name: account[name] for name in TOLD}
        except (OSError, ValueError, TypeError, KeyError):
            raise InputError(
                expected="the account of a study beside its table",
                got="none that can be read",
                remedy="`comity study run` writes it again; episodes that are there are not run again.",
                where=Where(str(study.path / ACCOUNT)),
            ) from None
        if was_run != plan.file.text:
            raise InputError(
                expected=f"the study's file as it was run, as in {study.path / WRITTEN}",
                got="one that was changed since",
                remedy="Run it again, or name the older file: --study FILE.",
                where=Where(str(file)),
            )
        return cls(plan, StudyVisits.of(study), told)


def simulated_fields(study: SimulatedStudy) -> tuple[ReportedField, ...]:
    """All fields, section by section: known ones, inapplicable ones, and the lab's."""
    found = [*_study(study), *_participants(study), *_robot(study), *_design(study), *_procedure(study)]
    found += [*_measures(study), *_data(study), *_inapplicable(study.plan.population)]
    known = {(one.section, one.name) for one in found}
    found += [one for one in BLANKS if (one.section, one.name) not in known]
    return tuple(sorted(found, key=lambda one: SECTIONS.index(one.section)))


def _inapplicable(population: StudyPopulation | None) -> Iterator[ReportedField]:
    is_table = population is not None and not population.is_drawn
    for one in BLANKS:
        if one.name in OF_PEOPLE and not (is_table and one.name in OF_A_TABLE):
            yield inapplicable(one.section, one.name, OF_PEOPLE[one.name])


def _study(study: SimulatedStudy) -> Iterator[ReportedField]:
    written = study.plan.written
    yield ReportedField("Study", "Name", written.name)
    if written.about:
        yield ReportedField("Study", "About", written.about)
    yield ReportedField("Study", "Kind", f"simulated visits. {STATEMENT}")
    yield ReportedField("Study", "Place", f"simulated: {', '.join(written.scenarios)}")


def _participants(study: SimulatedStudy) -> Iterator[ReportedField]:
    population = study.plan.population
    section: Section = "Participants"
    if population is None:
        yield ReportedField(section, "Individuals", "none but the people whom the scenarios have")
        return
    count = counted(len(population.individuals), "simulated individual")
    wishing = f"{population.wishing} of them state a wish"
    if population.is_drawn:
        lines = "\n".join(_groups(population))
        told = f"{count}, drawn with the seed {population.written.seed}; {wishing}\n\n{lines}"
    else:
        told = f"{count}, from the table {population.written.table}, which may hold real people; {wishing}"
    yield ReportedField(section, "Individuals", told)


def _groups(population: StudyPopulation) -> Iterator[str]:
    """One line per group: number of individuals, their facts, and the source of their comfort distances."""
    for name, group in population.written.groups.items():
        written = group.model_dump(mode="json", by_alias=True, exclude_unset=True)
        facts = ", ".join(f"{key} {plain_value(value)}" for key, value in written.get("facts", {}).items())
        comfort = ", ".join(f"{key} {value}" for key, value in (written.get("comfort") or {}).items())
        yield f"- {name}, {group.individuals}: {facts or 'no facts disclosed'}; comfort: {comfort or 'none'}"


def _robot(study: SimulatedStudy) -> Iterator[ReportedField]:
    account = study.account
    yield ReportedField("Robot", "Medium", "a simulation in two dimensions")
    software = f"Comity {account['version']}, code {account['code'][:12]}, on {account['fingerprint']}"
    yield ReportedField("Robot", "Software", software)
    bodies = "\n".join(_body(name, bases[0].scenario) for name, bases in study.plan.bases.items())
    yield ReportedField(
        "Robot", "Platform", f"simulated; what a factor changes stands under Design\n\n{bodies}"
    )
    yield ReportedField("Robot", "Autonomy", "autonomous: planned and executed by Comity, no one intervened")
    books = dict.fromkeys(base.rulebook_name for bases in study.plan.bases.values() for base in bases)
    told = f"decided by the rulebooks {', '.join(books)}; what it did stands row by row in the table"
    yield ReportedField("Robot", "Behaviour", told)


def _body(name: str, scenario: Mapping[str, Any]) -> str:
    one = RobotStart.model_validate(scenario["robot"])
    return f"- {name}: a disc of {one.radius_m:g} m radius, {one.drive}, at most {one.max_speed_m_s:g} m/s"


def _design(study: SimulatedStudy) -> Iterator[ReportedField]:
    plan, account = study.plan, study.account
    lines = []
    for one in plan.conditions:
        values = ", ".join(f"{column_of(path)} {plain_value(value)}" for path, value in one.values.items())
        lines.append(f"- {one.number}: {values or 'as the scenario has it'}")
    every = "each individual met all, in every scenario and with every seed"
    yield ReportedField("Design", "Conditions", "\n".join([every, "", *lines]))
    combined = (
        f"{plan.written.design}; {counted(account['episodes'], 'episode')}, {account['different']} different"
    )
    yield ReportedField("Design", "Combination", combined)
    seeds = plan.written.every_seed
    told = f"{counted(len(seeds), 'seed')} of noise, random places and people's moves"
    yield ReportedField("Design", "Seeds", f"{told}: {', '.join(map(str, seeds[:20]))}")
    yield inapplicable("Design", "Order", "each episode begins anew, and nothing carries over")
    within = "individual, room and seed are the same within a pair"
    told = f"{within}; what else a condition changes as a result stands among the results"
    yield ReportedField("Design", "Possible confounds", told)


def _procedure(study: SimulatedStudy) -> Iterator[ReportedField]:
    account, rows = study.account, study.visits.study.rows
    yield inapplicable("Procedure", "Experimenters", NO_PEOPLE)
    lengths = {row["key"]: float(row["episode_duration_s"]) for row in rows if row.get("episode_duration_s")}
    if lengths:
        each = lengths.values()
        told = f"{mean(each):.1f} s simulated on average, from {min(each):.1f} to {max(each):.1f} s"
        yield ReportedField("Procedure", "Duration", f"{told}, an episode")
    outcomes = Counter(row["outcome"] for row in study.visits.rows)
    told = ", ".join(f"{name} {count}" for name, count in sorted(outcomes.items()))
    lost = f"{counted(account['failed'], 'episode')} failed to run"
    yield ReportedField("Procedure", "Deviations", f"outcomes of the visits: {told}; {lost}")


def _measures(study: SimulatedStudy) -> Iterator[ReportedField]:
    yield ReportedField("Measures", "Outcomes", outcomes_told(study.visits))
    told = f"{len(study.visits.study.columns)} columns, each with unit and definition in dictionary.csv"
    yield ReportedField("Measures", "Other measures", told)


def _data(study: SimulatedStudy) -> Iterator[ReportedField]:
    section: Section = "Data and analysis"
    account, visits = study.account, study.visits
    of = f"{counted(len(visits.study.rows), 'row')} of {counted(account['episodes'], 'episode')}"
    progress = visits.study.progress
    state = "done" if progress is None else progress.state
    yield ReportedField(section, "Collected", f"{of}; the study is {state}")
    others = f"{counted(visits.left_out, 'row')} of people who are no individuals of the population"
    told = "empty cells say why in why_missing; visits that were declined have no served_share"
    yield ReportedField(section, "Exclusions", f"{others if visits.left_out else 'no rows'}; {told}")
    told = "means over individuals and rooms; 95 % intervals resample individuals, rooms and seeds, never"
    yield ReportedField(section, "Analysis", f"{told} episodes (pigeonhole bootstrap); no p-values")
    yield ReportedField(section, "Results", results_told(visits))
    yield ReportedField(section, "Limits", STATEMENT)
