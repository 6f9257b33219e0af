"""The questions of a session in their order."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from comity.study.allocation import Session
from comity.study.collecting.collection_file import CONSENT, DISTANCE, FACT, Collection


@dataclass(frozen=True, slots=True)
class Step:
    """One question; no two of a session are the same."""

    condition: str
    """Condition; empty for a question asked once."""
    of: str
    """Name of a questionnaire, or `consent`, `facts`, `stop distance`."""
    item: str
    """Item of the questionnaire, fact, trial number, or digest of the consent text."""


def steps_of(collection: Collection, session: Session, text_digest: str) -> Iterator[Step]:
    """Consent, facts, then under each condition the stop distances and the questionnaires.

    Args:
        collection: The collection that defines the questions.
        session: The session, with the order of its conditions.
        text_digest: Digest of the consent text.
    """
    yield Step("", CONSENT, text_digest)
    yield from (Step("", FACT, fact) for fact in collection.written.facts)
    for condition in session.conditions:
        trials = range(1, collection.written.trials + 1)
        yield from (Step(condition, DISTANCE, str(trial)) for trial in trials)
        for name, questionnaire in collection.questionnaires.items():
            yield from (Step(condition, name, item) for item in questionnaire.items)
