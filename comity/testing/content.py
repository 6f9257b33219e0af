"""All that a case reads, by its content: what is known of a case hangs on it, and golden episodes name it.

Whatever a scenario names by path counts with what stands there, not with its name.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from comity.cast import cast_of, rulebook_of
from comity.changes import changes_of_values
from comity.place import written_map
from comity.scenario import MapPlace

if TYPE_CHECKING:
    from comity.testing.case import Case

_PROSE = ("name", "description", "sources", "reason", "reasons", "note")
"""Of a rulebook: what nothing is computed with."""
_ABOUT_TESTS = ("expect", "matrix", "markers")
"""What of a scenario nobody in it notices."""


def content_of(case: Case) -> Iterator[tuple[str, Any]]:
    """What a case reads, by what it is called.

    Of the rules only the values that follow from them, at the start and from what people say later.

    Raises:
        InputError: if anything that the case names cannot be used.
    """
    cast = cast_of(case.file, profiles=case.profiles, rulebook=case.rulebook, at=case.day)
    data, rulebook = case.file.file.data, rulebook_of(case.file, case.rulebook).data
    map_name = _map_name(case)
    yield "scenario", {key: part for key, part in data.items() if key not in (*_ABOUT_TESTS, "rulebook")}
    map_data = written_map(case.file, map_name)[0].data if map_name else None
    yield f"map {map_name or ''}".strip(), map_data
    yield "rulebook", {key: part for key, part in rulebook.items() if key != "rules"}
    yield "profiles", {name: each.profile.model_dump(mode="json") for name, each in cast.declared.items()}
    yield "values", {person: inference.as_json() for person, inference in cast.values().items()}
    yield "later values", [change.values.as_json() for change in changes_of_values(cast).values()]
    yield "learnt", {name: repr(about) for name, about in cast.learnt.items()}


def rules_of(case: Case) -> tuple[tuple[str, ...], dict[str, Any]]:
    """The rules in their order, and the rulebook's other figures by their place: `variables age range`."""
    data = rulebook_of(case.file, case.rulebook).data
    rules = tuple(map(_rule, data.get("rules") or ()))
    return rules, dict(_leaves({key: part for key, part in data.items() if key != "rules"}))


def _rule(written: Mapping[str, Any]) -> str:
    """Its text, and what else of it decides something, where that is written."""
    more = [f"{key}: {written[key]}" for key in ("weight", "enabled") if key in written]
    return f"{written['rule']} ({', '.join(more)})" if more else str(written["rule"])


def _leaves(part: Any, place: tuple[str, ...] = ()) -> Iterator[tuple[str, Any]]:
    if not isinstance(part, dict):
        yield " ".join(place), json.loads(json.dumps(part, default=str))
        return
    for key, inner in part.items():
        if key not in _PROSE:
            yield from _leaves(inner, (*place, str(key)))


def digest_of(content: Any) -> str:
    """Of plain values, the order of keys left aside."""
    return hashlib.sha256(json.dumps(content, sort_keys=True, default=str).encode()).hexdigest()


def _map_name(case: Case) -> str | None:
    """None for a place that is written out in the scenario."""
    place = case.file.scenario.place
    return place.map if isinstance(place, MapPlace) and isinstance(place.map, str) else None
