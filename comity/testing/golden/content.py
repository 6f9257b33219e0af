"""All inputs of a case, by content: cached results depend on them, and golden episodes name them.

A file that a scenario names by path counts with its content, not its name.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from comity.scenario import MapPlace
from comity.simulation.changes import changes_of_values
from comity.simulation.place import written_map
from comity.testing.golden.leaves import SourceFile, source_of

if TYPE_CHECKING:
    from comity.testing.trials.case import Case

_PROSE = ("name", "description", "reason", "reasons", "note")
"""Prose keys of a rulebook, which affect no computation."""
_ABOUT = ("about",)
"""Prose keys of other files."""
_HEADS = ("schema_version", "name")
"""Keys by which a file identifies itself."""
_ABOUT_TESTS = ("expect", "matrix", "markers")
"""Keys of a scenario that concern its tests only and do not affect an episode."""


def content_of(case: Case) -> Iterator[tuple[str, Any]]:
    """The inputs of a case, by name.

    Of the rules, only the inferred values count, initially and after later statements of people.

    Raises:
        InputError: if anything that the case names cannot be used.
    """
    cast, data, rulebook = case.cast, case.file.file.data, case.rulebook_file.data
    map_name = _map_name(case)
    yield "scenario", _without(data, (*_ABOUT_TESTS, "rulebook"))
    map_data = written_map(case.file, map_name)[0].data if map_name else None
    yield f"map {map_name or ''}".strip(), map_data
    yield "rulebook", _without(rulebook, ("rules",))
    yield "profiles", {name: each.profile.model_dump(mode="json") for name, each in cast.declared.items()}
    yield "values", {person: inference.as_json() for person, inference in cast.values().items()}
    yield "later values", [change.values.as_json() for change in changes_of_values(cast).values()]
    yield "learnt", {name: repr(about) for name, about in cast.learnt.items()}


def sources_of(case: Case) -> Iterator[tuple[str, SourceFile]]:
    """The files that a case reads, flattened, by their names in golden episodes; without rules and prose.

    A profile inside the scenario is part of it; one that the case replaces is left out. Stored personal data
    is excluded because golden episodes are shared.

    Raises:
        InputError: if anything that the case names cannot be used.
    """
    file, rulebook, map_name = case.file.file, case.rulebook_file, _map_name(case)
    yield "scenario", source_of(file, _without(_as_played(case), _HEADS), _ABOUT)
    if map_name:
        found = written_map(case.file, map_name)[0]
        yield f"map {map_name}", source_of(found, _without(found.data, _HEADS), _ABOUT)
    figures = _without(rulebook.data, (*_HEADS, "rules", "sources"))
    yield "rulebook", source_of(rulebook, figures, _PROSE)
    for name, each in case.cast.declared.items():
        if each.file and not (each.kept_as or is_written_out(case, name)):
            yield profile_of(name), source_of(each.file, _without(each.file.data, _HEADS), _ABOUT)


def kept_of(case: Case) -> Iterator[tuple[str, str]]:
    """Stored profiles that a case reads, by name in golden episodes, with the keys that refer to them."""
    for name, each in case.cast.declared.items():
        if each.kept_as:
            at = ("matrix", "profiles") if name in case.profiles else ("people", name, "profile")
            named = f"{each.kept_as} of the store, whom {' '.join(at)} names in {case.file.where(*at)}"
            yield profile_of(name), named
            yield learnt_with(name), named


def learnt_with(person: str) -> str:
    """Name in golden episodes of what was learnt from meetings with a person."""
    return f"what was learnt with {person}"


def profile_of(person: str) -> str:
    """Name of a person's profile in golden episodes."""
    return f"profile of {person}"


def is_written_out(case: Case, person: str) -> bool:
    """Whether a person's profile is written in the scenario itself."""
    return person not in case.profiles and not isinstance(case.file.scenario.people[person].profile, str)


def rules_of(case: Case) -> tuple[str, ...]:
    """The rules in their order."""
    return tuple(map(_rule, case.rulebook_file.data.get("rules") or ()))


def _as_played(case: Case) -> dict[str, Any]:
    """The scenario without keys about tests and without replaced profiles."""
    data = _without(case.file.file.data, (*_ABOUT_TESTS, "rulebook"))
    people = {
        name: _without(person, ("profile",)) if name in case.profiles else person
        for name, person in data["people"].items()
    }
    return {**data, "people": people}


def _without(data: Mapping[str, Any], keys: Sequence[str]) -> dict[str, Any]:
    return {key: part for key, part in data.items() if key not in keys}


def _rule(written: Mapping[str, Any]) -> str:
    """A rule's text, and any other keys of it that affect the result."""
    more = [f"{key}: {written[key]}" for key in ("weight", "enabled") if key in written]
    return f"{written['rule']} ({', '.join(more)})" if more else str(written["rule"])


def _map_name(case: Case) -> str | None:
    """Name of the map; None if the place is described in the scenario."""
    place = case.file.scenario.place
    return place.map if isinstance(place, MapPlace) and isinstance(place.map, str) else None
