"""The scenario as it was run, every profile and the rulebook written out: it runs again from this alone."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from comity.scenario import Limits, MapPlace, Person, RobotStart, Scenario
from comity_fis.validation.yaml_file import dump_yaml
from comity_sim2d.maps.file import FurniturePiece

if TYPE_CHECKING:
    from pydantic import BaseModel

    from comity.preparation import Prepared

FIRST = ("name", "profile")
"""People write who or what somebody or something is, and then where."""


def resolved_yaml(prepared: Prepared) -> str:
    """The text of `scenario.yaml` in a run folder: keys in the order of the schema, as people write them."""
    scenario = prepared.file.scenario
    content: dict[str, Any] = scenario.model_dump(
        mode="json", by_alias=True, exclude_none=True, exclude={"expect", "matrix", "markers"}
    )
    if prepared.day is not None:
        content["at"] = prepared.day.isoformat()
    content["rulebook"] = prepared.rulebook_file.data
    for name, profile in prepared.profiles.items():
        content["people"][name]["profile"] = profile.model_dump(mode="json", exclude_defaults=True)
    for name, learnt in prepared.learnt.items():
        content["people"][name]["learnt"] = {
            parameter: {"offset": one.offset, "spread": one.spread, "text": one.text}
            for parameter, one in learnt.items()
        }
    content["limits"]["attend_s"] = prepared.attend_s
    content["limits"] = _ordered(content["limits"], Limits)
    content["robot"] = _ordered(content["robot"], RobotStart, FIRST)
    content["people"] = {name: _ordered(person, Person, FIRST) for name, person in content["people"].items()}
    place = content["place"]["map"] if isinstance(scenario.place, MapPlace) else content["place"]
    place["furniture"] = [_ordered(piece, FurniturePiece, FIRST) for piece in place["furniture"]]
    return dump_yaml(_ordered(content, Scenario))


def _ordered(
    content: Mapping[str, Any], model: type[BaseModel], first: tuple[str, ...] = ()
) -> dict[str, Any]:
    """The same with the keys of a model in its order, but for those that come first."""
    return {key: content[key] for key in dict.fromkeys((*first, *model.model_fields)) if key in content}
