"""What a run with `--learn` adds to what is known of the people whom it visited."""

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
    """Refuse to learn where no person who is visited has a stored profile that agrees to it.

    Args:
        visited: Names of the people of the scenario who are visited.
        kept_as: By person, the name under which the profile is stored; None where it is not.

    Raises:
        InputError: if all who are visited have profiles that describe nobody in particular, or none of those
            who are kept agrees to it.
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
    """What was noticed of those with whom anything is learnt, by the names under which they are kept.

    Args:
        episode: The run.
        day: When it was; None for today.
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
    """Whether anything may be learnt: about no child, and in earnest about nobody who may be one."""
    is_child = is_under_age(prepared.profiles[person], prepared.day)
    return not is_child and (is_child is False or not in_earnest or prepared.file.scenario.adults_only)


def keep(seen: Mapping[str, Observation]) -> frozenset[str]:
    """Remember what was observed, by the names under which people are kept.

    Returns:
        Those of whom it is remembered: not people who were deleted meanwhile.
    """
    return frozenset(name for name, one in seen.items() if remember(name, [one]))


def in_words(seen: Mapping[str, Observation], kept: Container[str]) -> Iterator[str]:
    """What is remembered, a line for each person."""
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
