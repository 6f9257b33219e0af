"""One session: asks unanswered questions and stores each answer before the next question."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from datetime import date
from pathlib import Path
from typing import Any, Literal

from comity.adaptation.observers_words import distance as distance_in_words
from comity.people.profile import declared_by
from comity.study.allocation import Session
from comity.study.collecting.asking import OPEN, AnswersEndedError, Asker, agreed
from comity.study.collecting.collected import (
    ANSWER_COLUMNS,
    ANSWERS,
    DISTANCES,
    Collected,
    distance_columns,
    text_digest,
)
from comity.study.collecting.collection_file import CONSENT, DISTANCE, FACT, Collection
from comity.study.collecting.growing_table import GrowingTable, opened_table, without_participant
from comity.study.collecting.steps import Step, steps_of
from comity.study.individual import plain_fact
from comity.study.people_table import NUMBERS
from comity.study.questionnaires.questionnaire_file import QuestionnaireFile
from comity.system.locks import locked
from comity.system.own_files import make_folder
from comity_domain.problem.bound_parameters import DISTANCE as PARAMETER
from comity_fis import InputError, Where
from comity_fis.errors import WrongValueError
from comity_fis.validation.csv_table import NUMBER

Status = Literal["done", "stopped", "refused"]


@dataclass(frozen=True, slots=True)
class Collector:
    """A running session.

    Args:
        collection: The collection that defines the questions.
        session: The participant, with their order of conditions.
        folder: Folder of the answers.
        by: The experimenter.
        day: Date of the session.
        asker: Source of answers and target of questions.
        robot_m: Stops a robot and returns its distance between the centres [m]; None if distances are typed.
    """

    collection: Collection
    session: Session
    folder: Path
    by: str
    day: date
    asker: Asker
    robot_m: Callable[[], float] | None = None

    def left(self) -> tuple[Step, ...]:
        """Unanswered questions, in order."""
        done = self._collected().answered[self.session.participant]
        steps = steps_of(self.collection, self.session, text_digest(self.collection.written))
        return tuple(step for step in steps if step not in done)

    def carry_out(self) -> tuple[Status, int]:
        """Ask the remaining questions; returns how it ended, and the number of new answers.

        Nothing is stored without consent. If the input ends, or after Ctrl-C or SIGKILL, the answers are
        kept, and the same command continues.

        Raises:
            InputError: if the folder holds the answers of another collection, or is being written to.
        """
        left = self.left()
        count = 0
        try:
            if left and left[0].of == CONSENT:
                if not self._consents():
                    return "refused", 0
                self.asker.say(f"{OPEN} leaves a question open.")
            with ExitStack() as held:
                tables = held.enter_context(self._tables())
                for step in left:
                    count += self._take(step, tables)
        except AnswersEndedError:
            return "stopped", count
        return ("stopped" if self.left() else "done"), count

    def withdraw(self) -> int:
        """Delete all answers of the participant, and return their number.

        Raises:
            InputError: as for `carry_out`.
        """
        if not self.folder.is_dir():
            return 0
        with _alone(self.folder):
            files = ((ANSWERS, ANSWER_COLUMNS), (DISTANCES, distance_columns(self.collection.written)))
            return sum(
                without_participant(self.folder / name, columns, self.session.participant)
                for name, columns in files
            )

    def _collected(self) -> Collected:
        return Collected.read(self.folder, self.collection.written)

    def _facts(self) -> dict[str, str]:
        mine = (row for row in self._collected().to(FACT) if row["participant"] == self.session.participant)
        return {row["item"]: row["answer"] for row in mine}

    def _consents(self) -> bool:
        self.asker.say(self.collection.written.consent.rstrip())
        return self.asker.ask(f"Does {self.session.participant} agree? (yes, no)", agreed)

    @contextmanager
    def _tables(self) -> Iterator[tuple[GrowingTable, GrowingTable]]:
        make_folder(self.folder, private=True)
        with (
            _alone(self.folder),
            opened_table(self.folder / ANSWERS, ANSWER_COLUMNS) as answers,
            opened_table(self.folder / DISTANCES, distance_columns(self.collection.written)) as distances,
        ):
            yield answers, distances

    def _take(self, step: Step, tables: tuple[GrowingTable, GrowingTable]) -> int:
        """Ask one question and store its answer; 0 if it is left open, to be asked again next time."""
        answers, distances = tables
        if step.of == DISTANCE:
            row = self._stop_distance(step)
            if row is None:
                return 0
            distances.add(row)
            return 1
        answers.add(
            {
                "participant": self.session.participant,
                "condition": step.condition,
                "questionnaire": step.of,
                "item": step.item,
                "answer": self._answer(step),
                "date": self.day,
                "experimenter": self.by,
            }
        )
        return 1

    def _answer(self, step: Step) -> str:
        if step.of == CONSENT:
            return "yes"
        if step.of == FACT:
            return self.asker.ask(step.item.replace("_", " "), lambda words: self._fact(step.item, words))
        questionnaire = self.collection.questionnaires[step.of]
        text = questionnaire.items[step.item].text or step.item
        question = f"{step.condition}, {text} ({questionnaire.scale_of(step.item)})"
        return self.asker.ask(question, lambda words: _item_answer(questionnaire, step.item, words))

    def _fact(self, fact: str, words: str) -> str:
        if words == OPEN:
            return ""
        value: Any = float(words) if fact in NUMBERS and NUMBER.fullmatch(words) else words
        declared_by({fact: plain_fact(fact, value)}, called=self.session.participant)
        return words

    def _stop_distance(self, step: Step) -> Mapping[str, object] | None:
        order = self.session.conditions.index(step.condition) + 1
        if step.item == "1":
            shown = self.collection.written.conditions.get(step.condition, "")
            self.asker.say(f"\n{order}. {step.condition}{': ' if shown else ''}{shown}")
        by_robot = "Enter as the participant says stop, or the distance" if self.robot_m else "stop distance"
        found = self.asker.ask(f"{step.condition}, trial {step.item}, {by_robot}", self._distance)
        if found is None:
            return None
        value_m, read_by = found
        written = self.collection.written
        gap_m = written.radii_m if written.measured == "centre" else 0.0
        return {
            "study": written.name,
            "participant": self.session.participant,
            "name": self.session.participant,
            "group": self.session.group,
            "condition": step.condition,
            "order": order,
            "trial": step.item,
            "medium": written.medium,
            **self._facts(),
            "parameter": PARAMETER,
            "value": f"{value_m:g}",
            "unit": "m",
            "measured": written.measured,
            "partner": "robot",
            "signal": written.stop_says,
            "distance_m": f"{max(value_m - gap_m, 0.0):.6g}",
            "date": self.day,
            "read_by": read_by,
        }

    def _distance(self, words: str) -> tuple[float, str] | None:
        """A distance [m] in the collection's convention, and who read it; None if left open."""
        if words == OPEN:
            return None
        if words or self.robot_m is None:
            return round(distance_in_words(words), 4), "experimenter"
        gap_m = self.collection.written.radii_m if self.collection.written.measured == "surface" else 0.0
        return round(max(self.robot_m() - gap_m, 0.0), 4), "robot"


def _item_answer(questionnaire: QuestionnaireFile, item: str, words: str) -> str:
    if words == OPEN:
        return ""
    scale = questionnaire.scale_of(item)
    if NUMBER.fullmatch(words) and scale.holds(float(words)):
        return f"{float(words):g}"
    raise WrongValueError(
        expected=f"a whole number from {scale}",
        got=repr(words),
        remedy=f"Type it again, or {OPEN} where it is not answered.",
    )


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    from filelock import Timeout

    with ExitStack() as held:
        try:
            held.enter_context(locked(folder, waits=False))
        except Timeout:
            raise InputError(
                expected="a folder that no other session writes to",
                got="one that is written to now",
                remedy="Wait, or name another with --out.",
                where=Where(str(folder)),
            ) from None
        yield
