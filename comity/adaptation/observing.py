"""What somebody saw and heard at real meetings: written down, weighed like what a robot notices, undone."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING

from comity.adaptation.editing import metres
from comity.parameters.acquaintance import learnt_about, model_m, usual_situation
from comity.parameters.own_words import in_the_rulebooks_case
from comity.parameters.values import infer_for
from comity.parameters.which_rulebook import EVIDENCE
from comity.people.adulthood import require_adult
from comity.people.consents import require_consent
from comity.people.dated import day_given, read_day
from comity.people.learnt_file import PARAMETER, Observation
from comity.people.profile import load_profile
from comity.people.remembered import undo as forget_last
from comity.people.remembered import write_down
from comity.people.store import Store
from comity_fis import InputError, NominalVariable, NumericParameter, Where, closest, load_rulebook
from comity_fis.errors import WrongValueError
from comity_fis.learning.signals import SIGNALS, Signal
from comity_fis.validation.csv_table import CsvTable, Row, read_csv

if TYPE_CHECKING:
    from comity.people.fact import Fact
    from comity_fis import ParameterValue, Rulebook

PAST: Mapping[str, Signal] = {
    "stepped_back": "step_back",
    "asked_farther": "ask_farther",
    "turned_away": "turn_away",
    "leaned_in": "lean_in",
    "asked_closer": "ask_closer",
    "showed_nothing": "nothing",
}
"""How an observer writes down what a person did; the words of `learnt.yaml` are understood, too."""
FARTHEST_M = 20.0
NEEDED = ("signal", "distance_m")
MOST_ROWS = 10_000
RULEBOOK = EVIDENCE
"""What runs with somebody who is kept go by."""


@dataclass(frozen=True, slots=True)
class Sight:
    """One thing that was seen or heard of a person."""

    name: str
    signal: Signal
    distance_m: float
    """Where the robot stood, between the nearest points of the bodies."""
    day: date | None = None
    """None for today."""
    situation: Mapping[str, Fact] | None = None
    """What held then, by variable; for what is left out, the person's usual situation."""
    where: Where | None = None
    """Of the row that says so."""


@dataclass(frozen=True, slots=True)
class StoredProfile:
    """Somebody who is kept on this machine, for programs: `comity.profile("amal")`.

    What is observed is kept for later meetings, in the store; it needs the person's consent to `learn`.
    """

    name: str
    rulebook: str = RULEBOOK

    def __post_init__(self) -> None:
        Store().require(self.name)

    def observe(
        self,
        signal: str,
        distance_m: float,
        *,
        at: date | str | None = None,
        situation: Mapping[str, Fact] | None = None,
    ) -> Observation:
        """Write down what a person did when the robot stood before them.

        Args:
            signal: `stepped_back`, `turned_away`, `leaned_in` or `showed_nothing` is seen, `asked_farther`
                and `asked_closer` are said.
            distance_m: Where the robot stood, between the nearest points of the bodies, 0 to 20.
            at: The day, as a date or YYYY-MM-DD; None for today.
            situation: What held then, as in `{"posture": "seated"}`; None for the person's usual one.

        Returns:
            What was written down, with what culture and situation alone gave then.

        Raises:
            InputError: if the person did not agree to it, asks for a distance of their own, is a child, or
                something given cannot be used; nothing is written.
        """
        sight = Sight(self.name, signal_in_words(signal), distance(distance_m), day_given(at), situation)
        (seen,) = observe([sight], load_rulebook(self.rulebook))
        return seen

    def undo(self) -> tuple[Observation, ...]:
        """Forget what was written down last; again for what was before. What runs saw stays."""
        return forget_last(self.name)


def signal_in_words(words: str, where: Where | None = None) -> Signal:
    """A signal as an observer writes it.

    Raises:
        InputError: if there is none of the kind.
    """
    if isinstance(words, str):
        plain = words.strip().casefold().replace(" ", "_")
        if plain in PAST:
            return PAST[plain]
        for signal in SIGNALS:
            if plain == signal:
                return signal
    raise InputError(
        expected=f"a signal: {', '.join(PAST)}",
        got=repr(words),
        remedy=closest(str(words), PAST),
        where=where or Where("signal"),
    )


def distance(given: object, where: Where | None = None) -> float:
    """A distance as an observer writes it: 0.8, `0.8 m` or `80 cm`.

    Raises:
        InputError: if it is none, or nowhere near a person.
    """
    found = metres(given.strip() if isinstance(given, str) else given)
    try:
        number = float("" if isinstance(found, bool) else found)
    except (TypeError, ValueError):
        number = -1.0
    if 0.0 <= number <= FARTHEST_M:
        return number
    raise InputError(
        expected=f"where the robot stood, between the bodies: 0 to {FARTHEST_M:g} m",
        got=repr(given),
        remedy="Write for example 0.8, or '80 cm'.",
        where=where or Where("distance"),
    )


def observe(sights: Iterable[Sight], rulebook: Rulebook) -> tuple[Observation, ...]:
    """Write down what was seen and heard of people, all or nothing; of each person it is undone at once.

    Args:
        sights: In any order.
        rulebook: It says what culture and situation alone gave.

    Raises:
        InputError: if somebody did not agree to it, asks for a distance of their own, is a child, or a
            situation cannot be used; nothing is written.
    """
    checked = [(sight.name, _observation(sight, rulebook)) for sight in sights]
    for name in dict.fromkeys(name for name, _ in checked):
        write_down(name, [seen for other, seen in checked if other == name])
    return tuple(seen for _, seen in checked)


def met_at(name: str, rulebook: Rulebook, situation: Mapping[str, Fact], day: date) -> ParameterValue:
    """How near the robot comes to a person in a situation, with what that is made of."""
    declared = load_profile(name)
    learnt = learnt_about(declared, rulebook, situation, day)
    told = {key: fact for key, fact in situation.items() if key in rulebook.variables}
    return infer_for(declared, rulebook, situation=told, at=day, learnt=learnt)[PARAMETER]


def read_sights(
    path: Path, rulebook: Rulebook, *, name: str | None = None, day: date | None = None
) -> tuple[Sight, ...]:
    """The rows of a CSV file: `signal`, `distance_m`, and `name`, `date` and situations where they are told.

    Args:
        path: Of the file.
        rulebook: Its variables that describe a situation may be headings.
        name: Of whom all rows tell, where there is no column of names.
        day: Of rows without a date; None for today.

    Raises:
        InputError: with the line of whatever cannot be used.
    """
    situations = [key for key, variable in rulebook.variables.items() if variable.kind == "situation"]
    known = [*NEEDED, "name", "date", *situations]
    with read_csv(path, known) as table:
        _check_heading(table, known, name)
        rows = tuple(_sights(table, rulebook, situations, name, day))
    if not rows:
        raise table.refusal("at least one row below the headings", "none", "Add what was seen and heard.")
    return rows


def _check_heading(table: CsvTable, known: Iterable[str], name: str | None) -> None:
    needed = NEEDED if name else ("name", *NEEDED)
    for heading in needed:
        if heading not in table.heading:
            remedy = "Add it" + ("." if heading != "name" else ", or name the person on the command line.")
            raise table.refusal(
                f"the headings {', '.join(needed)}", f"none called {heading!r}", remedy, table.line
            )
    for heading in table.heading:
        if heading not in known or table.heading.count(heading) > 1:
            got = f"{heading!r} twice" if heading in known else repr(heading)
            raise table.refusal(f"headings of {', '.join(known)}", got, "Rename or remove it.", table.line)


def _sights(
    table: CsvTable, rulebook: Rulebook, situations: Iterable[str], name: str | None, day: date | None
) -> Iterator[Sight]:
    place = {heading: index for index, heading in enumerate(table.heading)}
    for count, row in enumerate(table.rows):
        if count == MOST_ROWS:
            raise table.refusal(f"at most {MOST_ROWS} rows", "more", "Split the file.", row.line)
        where = Where(table.file, row.line)
        told = {key: row.cell(place[key]) for key in situations if key in place and row.cell(place[key])}
        yield Sight(
            name=_name(table, row, place, name),
            signal=signal_in_words(row.cell(place["signal"]), where),
            distance_m=table.number(row.cell(place["distance_m"]), row.line, "a distance in metres"),
            day=_day(row.cell(place["date"]), where) if "date" in place and row.cell(place["date"]) else day,
            situation=situation_of(told, rulebook, where),
            where=where,
        )


def _name(table: CsvTable, row: Row, place: Mapping[str, int], name: str | None) -> str:
    told = row.cell(place["name"]) if "name" in place else ""
    if told and name and told != name:
        remedy = "Leave the name on the command line out, or split the file."
        raise table.refusal(f"rows about {name}", repr(told), remedy, row.line)
    if not (told or name):
        raise table.refusal("who it was", "an empty cell", "Write the name.", row.line)
    return told or str(name)


def situation_of(
    words: Mapping[str, object], rulebook: Rulebook, where: Where | None = None
) -> dict[str, Fact]:
    """A situation in words, in the rulebook's own.

    Raises:
        InputError: for what is no situation, or no word or number for it.
    """
    told: dict[str, Fact] = {}
    if not isinstance(words, Mapping):
        raise InputError(
            expected="a situation as variables with their values",
            got=repr(words),
            remedy="Write for example {'posture': 'seated'}.",
            where=where or Where("situation"),
        )
    for name, fact in words.items():
        variable = rulebook.variables.get(name)
        if variable is None or variable.kind != "situation":
            known = [key for key, one in rulebook.variables.items() if one.kind == "situation"]
            raise InputError(
                expected="something that describes the situation",
                got=repr(name),
                remedy=closest(name, known),
                where=where or Where("situation"),
            )
        try:
            is_text = isinstance(fact, str) and not isinstance(variable, NominalVariable)
            value = float(str(fact)) if is_text else fact  # a cell or an option is text
            told[name] = variable.check(in_the_rulebooks_case(value, name, rulebook))
        except ValueError:
            raise InputError(
                expected=f"a number for {name}",
                got=repr(fact),
                remedy="Write for example 38.",
                where=where or Where("situation"),
            ) from None
        except InputError as error:
            raise error.at(where or Where("situation")) from None
    return told


def _observation(sight: Sight, rulebook: Rulebook) -> Observation:
    try:
        return _checked(sight, rulebook)
    except InputError as error:
        if sight.where is None:
            raise
        raise error.at(sight.where) from None


def _checked(sight: Sight, rulebook: Rulebook) -> Observation:
    Store().require(sight.name)
    require_consent(sight.name, "learn")
    declared, day = load_profile(sight.name), sight.day or date.today()
    _refuse_impossible(sight, day, rulebook)
    require_adult(declared.profile, day)
    situation = {**usual_situation(declared, day), **situation_of(sight.situation or {}, rulebook)}
    value = met_at(sight.name, rulebook, situation, day)
    if value.start.origin == "setting":
        raise InputError(
            expected="somebody who leaves the distance open",
            got=f"{sight.name}, who asks for {value.start.value:g} m",
            remedy="What a person asked for stands, and nothing is learnt about it; "
            f"`comity profile set {sight.name} distance=unknown` takes the wish back.",
        )
    return Observation(
        day=day,
        situation=situation,
        model_m=round(model_m(value), 4),
        distance_m=round(sight.distance_m, 4),
        signal=sight.signal,
    )


def _refuse_impossible(sight: Sight, day: date, rulebook: Rulebook) -> None:
    if day > date.today():
        raise InputError(
            expected="a meeting that has been",
            got=f"one on {day}, in the future",
            remedy="Check the date.",
        )
    distance(sight.distance_m, sight.where)
    if not isinstance(rulebook.parameters.get(PARAMETER), NumericParameter):
        raise InputError(
            expected=f"a rulebook with the numeric parameter {PARAMETER}",
            got=rulebook.name,
            remedy="Name another one.",
            where=Where("--rulebook"),
        )


def _day(words: str, where: Where | None = None) -> date:
    try:
        return read_day(words)
    except WrongValueError as error:
        raise error.at(where or Where("at")) from None
