"""Stored answers of sessions: tables, their columns, and the questions already answered."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from comity.study.collecting.collection_file import DISTANCE, CollectionFile
from comity.study.collecting.growing_table import rows_of
from comity.study.collecting.steps import Step

ANSWERS, DISTANCES = "answers.csv", "distances.csv"
ANSWER_COLUMNS = ("participant", "condition", "questionnaire", "item", "answer", "date", "experimenter")
BEFORE_FACTS = ("study", "participant", "name", "group", "condition", "order", "trial", "medium")
AFTER_FACTS = ("parameter", "value", "unit", "measured", "partner", "signal", "distance_m", "date", "read_by")


def distance_columns(written: CollectionFile) -> tuple[str, ...]:
    """Columns of the table of stop distances."""
    return (*BEFORE_FACTS, *written.facts, *AFTER_FACTS)


def text_digest(written: CollectionFile) -> str:
    """Digest of the consent text."""
    return sha256(written.consent.encode()).hexdigest()[:12]


@dataclass(frozen=True, slots=True)
class Collected:
    """The rows of both tables."""

    answers: tuple[Mapping[str, str], ...]
    distances: tuple[Mapping[str, str], ...]

    @classmethod
    def read(cls, folder: Path, written: CollectionFile) -> Collected:
        """Read a folder; empty if it does not exist.

        Raises:
            InputError: if the tables belong to another collection.
        """
        return cls(
            tuple(rows_of(folder / ANSWERS, ANSWER_COLUMNS)),
            tuple(rows_of(folder / DISTANCES, distance_columns(written))),
        )

    @property
    def answered(self) -> dict[str, set[Step]]:
        """Answered questions, by participant."""
        found: dict[str, set[Step]] = defaultdict(set)
        for row in self.answers:
            found[row["participant"]].add(Step(row["condition"], row["questionnaire"], row["item"]))
        for row in self.distances:
            found[row["participant"]].add(Step(row["condition"], DISTANCE, row["trial"]))
        return found

    def to(self, questionnaire: str) -> list[Mapping[str, str]]:
        """Answers to a questionnaire, or to `consent` or `facts`."""
        return [row for row in self.answers if row["questionnaire"] == questionnaire]
