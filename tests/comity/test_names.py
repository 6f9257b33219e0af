"""A name never steers anything: what a person or a door is called changes words alone."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

import comity

WALKS_OFF = """
schema_version: 1
name: named
place: {{width_m: 9.0, height_m: 5.0}}
robot: {{at_m: [1.0, 2.5]}}
people:
  {name}: {{profile: german_woman, at_m: [5.0, 2.5], facing_deg: 180}}
goals:
  - greet: {name}
faults:
  - {{at_s: 1, fault: person walks off, person: {name}, by_m: 2.0}}
"""

TWO_ROOMS = """
schema_version: 1
name: two
about: Two rooms and a door.
rooms:
  one: {{box_m: [0, 0, 4, 5]}}
  two: {{box_m: [4, 0, 4, 5]}}
doors:
  {door}: {{at_m: [4, 2.5], width_m: 1.2}}
"""

DOOR_SHUTS = """
schema_version: 1
name: shut
place: {{map: two.map.yaml}}
robot: {{at_m: [1.0, 2.5]}}
people:
  {name}: {{profile: german_woman, at_m: [6.5, 2.5], facing_deg: 180}}
goals:
  - greet: {name}
faults:
  - {{at_s: 1, fault: person walks off, person: {name}, by_m: 0.5}}
  - {{at_s: 2, fault: door closes, door: {door}, for_s: 4}}
"""

_RESERVED = {"robot", "null", "true", "false", "yes", "no", "on", "off", "one", "two", "y", "n"}
"""Words of YAML, and names that the scenario gives already."""

# What the program itself calls its parts, nodes, columns and states, and what else might be taken for one.
# No longer than seven letters: a longer name takes longer to say.
NAMES = st.sampled_from(
    [
        "base",
        "voice",
        "sensors",
        "way",
        "path",
        "plan",
        "door",
        "wall",
        "none",
        "goal",
        "t",
        "Safe",
        "visited",
    ]
) | st.from_regex(r"[a-z][a-z_]{0,6}", fullmatch=True).filter(lambda name: name not in _RESERVED)


def frames(folder: Path, scenario: str, *, door: str = "") -> np.ndarray:
    (folder / "two.map.yaml").write_text(TWO_ROOMS.format(door=door), encoding="utf-8")
    path = folder / "named.scenario.yaml"
    path.write_text(scenario, encoding="utf-8")
    episode = comity.run(path)
    return np.stack([episode.frames.of(entity) for entity in episode.frames.entities])


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("named")


@pytest.fixture(scope="module")
def annas_visit(folder: Path) -> np.ndarray:
    return frames(folder, WALKS_OFF.format(name="anna"))


@pytest.fixture(scope="module")
def annas_door(folder: Path) -> np.ndarray:
    return frames(folder, DOOR_SHUTS.format(name="anna", door="sliding"), door="sliding")


@settings(max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(name=NAMES)
@example(name="base")
@example(name="sensors")
def test_a_person_may_be_called_anything(name: str, folder: Path, annas_visit: np.ndarray) -> None:
    np.testing.assert_array_equal(frames(folder, WALKS_OFF.format(name=name)), annas_visit)


@settings(max_examples=4, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(name=NAMES)
def test_a_door_may_be_called_like_a_person(name: str, folder: Path, annas_door: np.ndarray) -> None:
    np.testing.assert_array_equal(
        frames(folder, DOOR_SHUTS.format(name=name, door=name), door=name), annas_door
    )
