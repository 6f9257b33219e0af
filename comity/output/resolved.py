"""The resolved scenario, with every profile and the rulebook written out: it can be rerun from this alone."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

from comity.output.run_folder import SCENARIO, TABLES
from comity.parameters.margin import MARGIN_FACTS, reads_margin_facts
from comity.parameters.speaking import wordings_files
from comity.parameters.used import used_of
from comity.people.profile import Declared
from comity.scenario import LimitsSpec, MapPlace, PersonSpec, RobotStart, Scenario
from comity_fis import NominalVariable
from comity_fis.validation.yaml_file import dump_yaml
from comity_sim2d.maps.file import FurniturePiece

if TYPE_CHECKING:
    from pydantic import BaseModel

    from comity.preparation import PlannedEpisode
    from comity_fis import Population, PopulationTable, Rulebook

FIRST = ("name", "profile")
"""Keys that people write first."""


def resolved_files(prepared: PlannedEpisode) -> dict[str, str]:
    """Files of the run folder by name: `scenario.yaml`, and the score tables that its rulebook names."""
    kept = kept_tables(prepared.rulebook).values()
    return {SCENARIO: resolved_yaml(prepared), **{name: table.text for name, table in kept}}


def resolved_yaml(prepared: PlannedEpisode) -> str:
    """Text of `scenario.yaml` in a run folder, with keys in the schema's order."""
    scenario = prepared.file.scenario
    content: dict[str, Any] = scenario.model_dump(
        mode="json", by_alias=True, exclude_none=True, exclude={"expect", "matrix", "markers"}
    )
    content["wordings"] = [deepcopy(one.data) for one in wordings_files(prepared.file)]
    if not content["wordings"]:
        del content["wordings"]
    if prepared.day is not None:
        content["at"] = prepared.day.isoformat()
    content["rulebook"] = _with_kept_tables(prepared.chosen.file.data, prepared.rulebook)
    also = MARGIN_FACTS if reads_margin_facts(scenario) else ()
    for name, profile in prepared.profiles.items():
        used = used_of(Declared(profile, None), prepared.rulebook, prepared.day, also=also).profile
        content["people"][name]["profile"] = used.model_dump(mode="json", exclude_defaults=True)
    for name, learnt in prepared.learnt.items():
        content["people"][name]["learnt"] = {
            parameter: {"offset": one.offset, "spread": one.spread, "text": one.text}
            for parameter, one in learnt.items()
        }
    content["limits"]["attend_s"] = prepared.attend_s
    content["limits"] = _ordered(content["limits"], LimitsSpec)
    content["robot"] = _ordered(content["robot"], RobotStart, FIRST)
    content["people"] = {
        name: _ordered(person, PersonSpec, FIRST) for name, person in content["people"].items()
    }
    place = content["place"]["map"] if isinstance(scenario.place, MapPlace) else content["place"]
    place["furniture"] = [_ordered(piece, FurniturePiece, FIRST) for piece in place["furniture"]]
    return dump_yaml(_ordered(content, Scenario))


def _with_kept_tables(read: Any, rulebook: Rulebook) -> Any:
    """The rulebook as read, with the names of its score tables replaced by those of the copies."""
    data = deepcopy(read)
    for (*way, key), (name, _) in kept_tables(rulebook).items():
        place = data["variables"]
        for step in way:
            place = place[step]
        place[key] = name
    return data


def kept_tables(rulebook: Rulebook) -> dict[tuple[str, ...], tuple[str, PopulationTable[Population]]]:
    """The CSV files that a rulebook names, by location of the name, each with its file name in the folder."""
    tables: dict[tuple[str, ...], PopulationTable[Population]] = {}
    for name, variable in rulebook.variables.items():
        if variable.derived_from and variable.derived_from.table:
            tables[name, "derived_from", "table"] = variable.derived_from.table
        if isinstance(variable, NominalVariable) and variable.table:
            tables[name, "categories_from"] = variable.table
    texts: dict[str, str] = {}
    kept: dict[tuple[str, ...], tuple[str, PopulationTable[Population]]] = {}
    for place, table in tables.items():
        if table.text:  # the same name twice means two files in two folders
            file = Path(table.name).with_suffix(".csv").name
            while texts.setdefault(file, table.text) != table.text:
                file = f"other-{file}"
            kept[place] = f"{TABLES}/{file}", table
    return kept


def _ordered(
    content: Mapping[str, Any], model: type[BaseModel], first: tuple[str, ...] = ()
) -> dict[str, Any]:
    """The content with keys in the model's order, after those in `first`."""
    return {key: content[key] for key in dict.fromkeys((*first, *model.model_fields)) if key in content}
