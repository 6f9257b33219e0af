"""Learning in a run with `--learn`: what it adds about the visited people."""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from datetime import date
from typing import TYPE_CHECKING

from comity.parameters.acquaintance import observation, situation_of
from comity.people.adulthood import is_under_age
from comity.people.consents import is_covered, require_consent
from comity.people.remembered import remember
from comity_fis import InputError, Where
from comity_fis.learning.signals import SAID

if TYPE_CHECKING:
    from comity.episode import Episode
    from comity.people.learnt_file import Observation
    from comity.preparation import PlannedEpisode


def refuse_nobody_kept(visited: Sequence[str], kept_as: Mapping[str, str | None]) -> None:
    """Reject learning if no visited person has a stored profile that consents to it.

    Args:
        visited: Names of the visited people of the scenario.
        kept_as: By person, the name of the stored profile; None if not stored.

    Raises:
        InputError: No visited person is stored, or none of the stored ones consents.
    """
    kept = [name for person in visited if (name := kept_as[person])]
    if kept and not any(is_covered(name, "learn") for name in kept):
        require_consent(kept[0], "learn")
    if not kept:
        raise InputError(
            expected="somebody who is kept on this machine to learn about",
            got="none among those who are visited",
            remedy=f"`comity profile set NAME ...` keeps a person; then name them: --as {visited[0]}=NAME.",
            where=Where("--learn"),
        )


def observed(episode: Episode, day: date | None) -> dict[str, Observation]:
    """The signals noticed of people with consent to learning, by stored name.

    Args:
        episode: The run.
        day: Day of the run; None: today.
    """
    prepared, found = episode.prepared, {}
    for visit in episode.visits:
        kept = prepared.kept_as[visit.person]
        person = prepared.file.scenario.people[visit.person]
        seen = observation(visit, prepared.values[visit.person], situation_of(person), day or date.today())
        if (
            kept
            and seen
            and is_covered(kept, "learn")
            and visit.person not in episode.uncertain
            and _is_adult(prepared, visit.person, in_earnest=episode.loop is not None)
        ):
            invented = person.comfort is not None  # the scenario reacted, not the stored person
            found[kept] = seen.model_copy(update={"simulated": invented})
    return found


def _is_adult(prepared: PlannedEpisode, person: str, *, in_earnest: bool) -> bool:
    """Whether learning is allowed: not about children; in real runs only about adults, known or stated."""
    is_child = is_under_age(prepared.profiles[person], prepared.day)
    return not is_child and (is_child is False or not in_earnest or prepared.file.scenario.adults_only)


def keep(seen: Mapping[str, Observation]) -> frozenset[str]:
    """Store observations, by stored name.

    Returns:
        The people whose observations were stored, without those deleted in the meantime.
    """
    return frozenset(name for name, one in seen.items() if remember(name, [one]))


def in_words(seen: Mapping[str, Observation], kept: Container[str]) -> Iterator[str]:
    """What is stored, one line per person."""
    for name, one in seen.items():
        if name in kept:
            yield f"Learnt   {name} {SAID[one.signal]} at {one.distance_m:.2f} m"
        else:
            yield f"Learnt   nothing about {name}, who is not kept any more"
    if not seen:
        yield (
            "Learnt   nothing: nobody who is kept and agreed to it was reached, or each asked for a distance "
            "of their own"
        )
