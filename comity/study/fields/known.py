"""Reporting fields filled from a collection, its allocation and its answers."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection as SizedCollection
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from statistics import mean, stdev

from comity.study.allocation import Session
from comity.study.clips.making import CONFOUNDS
from comity.study.collecting.collected import ANSWERS, Collected, text_digest
from comity.study.collecting.collection_file import CONSENT, FACT, Collection
from comity.study.collecting.steps import steps_of
from comity.study.fields.reported_field import BLANKS, SECTIONS, ReportedField, blank
from comity.study.people_table import NUMBERS
from comity.study.questionnaires.answers_table import read_answers
from comity.study.questionnaires.questionnaire_file import QuestionnaireFile
from comity.study.questionnaires.scoring import scored
from comity_fis.validation.complaint import counted
from comity_fis.validation.csv_table import NUMBER, read_csv

STOP_SAYS = {
    "showed_nothing": "at the nearest distance that was still comfortable",
    "asked_farther": "at the first distance that was not comfortable any more",
}


@dataclass(frozen=True, slots=True)
class KnownStudy:
    """The files of a study with people."""

    collection: Collection
    sessions: Mapping[str, Session]
    """Sessions of the allocation, by participant."""
    folder: Path
    """Folder of the answers."""
    collected: Collected
    clips: Path | None
    """Folder written by `comity study clips`; None if no clips were shown."""

    @property
    def came(self) -> tuple[str, ...]:
        """Participants who consented and have not withdrawn."""
        return tuple(dict.fromkeys(row["participant"] for row in self.collected.to(CONSENT)))


def fields_of(study: KnownStudy) -> tuple[ReportedField, ...]:
    """All fields, section by section, those that are known first.

    Raises:
        InputError: for a table that cannot be used.
    """
    found = [*_study(study), *_participants(study), *_robot(study), *_design(study), *_procedure(study)]
    found += [*_measures(study), *_data(study), *BLANKS]
    return tuple(sorted(found, key=lambda one: SECTIONS.index(one.section)))


def _study(study: KnownStudy) -> Iterator[ReportedField]:
    written = study.collection.written
    yield ReportedField("Study", "Name", written.name)
    if written.about:
        yield ReportedField("Study", "About", written.about)
    rows = (*study.collected.answers, *study.collected.distances)
    if days := sorted({row["date"] for row in rows}):
        yield ReportedField("Study", "Dates", " to ".join(dict.fromkeys((days[0], days[-1]))))


def _participants(study: KnownStudy) -> Iterator[ReportedField]:
    written = study.collection.written
    digest = text_digest(written)
    answered = study.collected.answered
    done = [
        one
        for one in study.came
        if one in study.sessions
        and set(steps_of(study.collection, study.sessions[one], digest)) <= answered[one]
    ]
    yield ReportedField("Participants", "Allocated", _groups(study, study.sessions))
    yield ReportedField(
        "Participants", "Took part", f"{_groups(study, study.came)}; {len(done)} answered all"
    )
    facts = study.collected.to(FACT)
    for fact in written.facts:
        cells = [row["answer"] for row in facts if row["item"] == fact]
        yield ReportedField("Participants", fact.replace("_", " ").capitalize(), _spread(fact, cells))
    quoted = "\n".join(f"> {line}" for line in written.consent.strip().splitlines())
    yield ReportedField("Participants", "Consent", f"asked first; without it nothing is stored\n\n{quoted}")


def _groups(study: KnownStudy, participants: SizedCollection[str]) -> str:
    """Number of participants by group: `12 (x 6, y 6)`."""
    known = [study.sessions[one].group for one in participants if one in study.sessions]
    groups = Counter(group for group in known if group)
    told = ", ".join(f"{group} {count}" for group, count in sorted(groups.items()))
    return f"{len(participants)} ({told})" if told else str(len(participants))


def _spread(fact: str, cells: Sequence[str]) -> str:
    """Distribution of the answers to a fact; `undisclosed` counts open answers."""
    numbers = [float(cell) for cell in cells if fact in NUMBERS and NUMBER.fullmatch(cell)]
    if numbers:
        told = f"{len(numbers)} from {min(numbers):g} to {max(numbers):g}, mean {mean(numbers):.1f}"
        if len(numbers) > 1:
            told += f", SD {stdev(numbers):.1f}"
        undisclosed = len(cells) - len(numbers)
        return f"{told}, undisclosed {undisclosed}" if undisclosed else told
    counts = Counter(cell or "undisclosed" for cell in cells)
    return ", ".join(f"{word} {count}" for word, count in sorted(counts.items())) or "none asked yet"


def _robot(study: KnownStudy) -> Iterator[ReportedField]:
    shown = {"robot": "a robot in the room", "clip": "films of a robot", "paper": "pictures and words"}
    yield ReportedField("Robot", "Medium", shown[study.collection.written.medium])
    yield ReportedField("Robot", "Software", f"Comity {version('comity')}")


def _design(study: KnownStudy) -> Iterator[ReportedField]:
    sessions = list(study.sessions.values())
    conditions = sorted({one for session in sessions for one in session.conditions})
    shown = study.collection.written.conditions
    lines = [f"- {one}: {shown[one]}" if one in shown else f"- {one}" for one in conditions]
    yield ReportedField("Design", "Conditions", "\n".join(["each participant met all", "", *lines]))
    groups = sorted({one.group for one in sessions if one.group})
    if groups:
        size = Counter(one.block for one in sessions)[1]
        yield ReportedField("Design", "Groups", f"{', '.join(groups)}; drawn in blocks of {size}")
    orders = counted(len({one.conditions for one in sessions}), "order")
    yield ReportedField(
        "Design", "Order", f"{orders} of a balanced Latin square (Williams 1949), drawn by a seed"
    )
    if study.clips is None:
        asks = "what else differed with the condition; of films `--clips DIR` lists it"
        yield blank("Design", "Possible confounds", asks)
        return
    yield ReportedField("Design", "Possible confounds", "\n".join(["", *_confounds(study.clips / CONFOUNDS)]))


def _confounds(path: Path) -> Iterator[str]:
    with read_csv(path, ("quantity", "difference")) as table:
        places = {name: table.heading.index(name) for name in ("quantity", "unit", "difference", "person")}
        for row in table.rows:
            cells = {name: row.cell(place) for name, place in places.items()}
            of = f" ({cells['person']})" if cells["person"] else ""
            unit = f" {cells['unit']}" if cells["unit"] not in ("", "1") else ""
            by = f"by {cells['difference']}{unit}" if cells["difference"] else "in words"
            yield f"- {cells['quantity']}{of} differs {by}"


def _procedure(study: KnownStudy) -> Iterator[ReportedField]:
    written = study.collection.written
    experimenters = len({row["experimenter"] for row in study.collected.answers})
    yield ReportedField("Procedure", "Experimenters", str(experimenters))
    if written.stop_says is not None and written.trials:
        trials = counted(written.trials, "trial")
        told = f"{trials} under each condition; participants said stop {STOP_SAYS[written.stop_says]}"
        yield ReportedField("Procedure", "Stop-distance trials", told)


def _measures(study: KnownStudy) -> Iterator[ReportedField]:
    written = study.collection.written
    if written.trials:
        points = "the nearest points" if written.measured == "surface" else "the centres"
        read = Counter(row["read_by"] for row in study.collected.distances)
        by = ", ".join(f"{count} by the {name}" for name, count in sorted(read.items()))
        told = f"in metres between {points} of the two bodies" + (f"; read {by}" if by else "")
        yield ReportedField("Measures", "Stop distance", told)
    for name, one in study.collection.questionnaires.items():
        yield ReportedField("Measures", f"Questionnaire {name}", _instrument(one))
        if study.collected.to(name):
            reliable = _reliability(one, study.folder / ANSWERS)
            yield ReportedField("Measures", f"Reliability of {name}", reliable)


def _instrument(one: QuestionnaireFile) -> str:
    subscales = ", ".join(f"{name} ({len(items)})" for name, items in one.subscales.items())
    turned = [item for item, each in one.items.items() if each.reversed]
    told = f"{one.source}; {counted(len(one.items), 'item')} from {one.scale}: {subscales}"
    reversed_ = f"; reversed: {', '.join(turned)}" if turned else ""
    share = f"{one.answered_at_least:.0%}"
    return f"{told}{reversed_}; score: mean of the answered items, where {share} of them or more are answered"


def _reliability(one: QuestionnaireFile, path: Path) -> str:
    told = []
    for each in scored(one, read_answers(path, one)):
        found = each.reliability
        if found.alpha is not None:
            ends = "" if found.low is None else f" [{found.low:.2f}, {found.high:.2f}]"
            told.append(f"{each.name} {found.alpha:.2f}{ends} (n = {found.sheets} of {found.participants})")
    return f"Cronbach's alpha, 95 % interval over participants: {', '.join(told)}" if told else "no value yet"


def _data(study: KnownStudy) -> Iterator[ReportedField]:
    questionnaires = study.collection.questionnaires
    rows = [row for row in study.collected.answers if row["questionnaire"] in questionnaires]
    left_open = sum(not row["answer"] for row in rows)
    told = f"{counted(len(study.collected.distances), 'stop distance')}, {counted(len(rows), 'item')} asked"
    yield ReportedField("Data and analysis", "Collected", f"{told}, {left_open} of them left open")
