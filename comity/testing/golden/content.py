"""All that a case reads, by its content: what is known of a case hangs on it, and golden episodes name it.

Whatever a scenario names by path counts with what stands there, not with its name.
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
"""Of a rulebook: what nothing is computed with."""
_ABOUT = ("about",)
"""The same of the other files."""
_HEADS = ("schema_version", "name")
"""How a file calls itself."""
_ABOUT_TESTS = ("expect", "matrix", "markers")
"""What of a scenario nobody in it notices."""


def content_of(case: Case) -> Iterator[tuple[str, Any]]:
    """What a case reads, by what it is called.

    Of the rules only the values that follow from them, at the start and from what people say later.

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
    """The files that a case reads, flat, by what golden episodes call them; without rules and without prose.

    A profile that stands in the scenario is none apart, and one that the case replaces is left out there.
    What the store holds of a person stays there: golden episodes are shared.

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
    """What a case reads from the store, by what golden episodes call it: who is kept, and what names them."""
    for name, each in case.cast.declared.items():
        if each.kept_as:
            at = ("matrix", "profiles") if name in case.profiles else ("people", name, "profile")
            named = f"{each.kept_as} of the store, whom {' '.join(at)} names in {case.file.where(*at)}"
            yield profile_of(name), named
            yield learnt_with(name), named


def learnt_with(person: str) -> str:
    """What golden episodes call what meetings with a person taught."""
    return f"what was learnt with {person}"


def profile_of(person: str) -> str:
    """What golden episodes call a person's profile."""
    return f"profile of {person}"


def is_written_out(case: Case, person: str) -> bool:
    """Whether a person's profile is a part of the scenario."""
    return person not in case.profiles and not isinstance(case.file.scenario.people[person].profile, str)


def rules_of(case: Case) -> tuple[str, ...]:
    """The rules in their order."""
    return tuple(map(_rule, case.rulebook_file.data.get("rules") or ()))


def _as_played(case: Case) -> dict[str, Any]:
    """The scenario without what is about tests, and without profiles that the case replaces."""
    data = _without(case.file.file.data, (*_ABOUT_TESTS, "rulebook"))
    people = {
        name: _without(person, ("profile",)) if name in case.profiles else person
        for name, person in data["people"].items()
    }
    return {**data, "people": people}


def _without(data: Mapping[str, Any], keys: Sequence[str]) -> dict[str, Any]:
    return {key: part for key, part in data.items() if key not in keys}


def _rule(written: Mapping[str, Any]) -> str:
    """Its text, and what else of it decides something, where that is written."""
    more = [f"{key}: {written[key]}" for key in ("weight", "enabled") if key in written]
    return f"{written['rule']} ({', '.join(more)})" if more else str(written["rule"])


def _map_name(case: Case) -> str | None:
    """None for a place that is written out in the scenario."""
    place = case.file.scenario.place
    return place.map if isinstance(place, MapPlace) and isinstance(place.map, str) else None
