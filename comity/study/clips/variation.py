"""The same visit under several values of one parameter, as a study with one factor."""

from __future__ import annotations

from hashlib import sha256
from json import dumps
from pathlib import Path
from typing import Any

from comity.scenario import load_scenario
from comity.study.study_plan import StudyPlan, study_of
from comity_fis import InputError, Where
from comity_fis.validation.yaml_file import dump_yaml, parse_yaml

OPTION = "--vary"


def varied(scenario: str, words: str, seed: int) -> StudyPlan:
    """The study of a scenario with one factor, one condition for each value.

    Args:
        scenario: A shipped name or a file.
        words: `KEY=V1,V2`; the key as a factor of a study, the values as in YAML.
        seed: Seed of every episode.

    Raises:
        InputError: for an unknown key or a value that the scenario cannot have.
    """
    key, _, text = words.partition("=")
    values = parse_yaml(f"[{text}]", Path(), OPTION).data
    if not key.strip() or len({dumps(value) for value in values}) < max(len(values), 2):
        raise InputError(
            expected="a key and two values or more, each once",
            got=repr(words),
            remedy="Write for example rulebook=bruno2017,evidence.",
            where=Where(OPTION),
        )
    load_scenario(scenario)
    content: dict[str, Any] = {
        "schema_version": 1,
        "name": "clips",
        "scenarios": [scenario],
        "factors": {key.strip(): values},
        "seeds": [seed],
    }
    return study_of(parse_yaml(dump_yaml(content), Path(), OPTION))


def opaque_name(scenario: str, key: str, value: object, seed: int) -> str:
    """A clip's name, which reveals neither its value nor the order; deterministic."""
    return f"clip-{sha256(dumps([scenario, key, value, seed]).encode()).hexdigest()[:8]}"
