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
    """Empty for what is asked once."""
    of: str
    """A questionnaire's name, or `consent`, `facts`, `stop distance`."""
    item: str
    """Of the questionnaire; a fact; the number of the trial; of the consent its text's digest."""


def steps_of(collection: Collection, session: Session, text_digest: str) -> Iterator[Step]:
    """Consent, facts, then under each condition the stop distances and the questionnaires.

    Args:
        collection: What is asked.
        session: Whose conditions stand in their order.
        text_digest: Of the consent's text.
    """
    yield Step("", CONSENT, text_digest)
    yield from (Step("", FACT, fact) for fact in collection.written.facts)
    for condition in session.conditions:
        trials = range(1, collection.written.trials + 1)
        yield from (Step(condition, DISTANCE, str(trial)) for trial in trials)
        for name, questionnaire in collection.questionnaires.items():
            yield from (Step(condition, name, item) for item in questionnaire.items)
