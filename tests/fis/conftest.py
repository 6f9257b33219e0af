"""What the tests share: the shipped rulebooks, and a small one to vary."""

from collections.abc import Callable
from pathlib import Path

import pytest

from comity_fis import Rulebook, load_rulebook

SMALL = """\
schema_version: 1
name: small
description: two variables, three parameters
sources:
  book: {citation: "A book", verified: read}
variables:
  warmth:
    kind: culture
    level: interval
    range: [0, 10]
    terms:
      cold: {trapezoid: [0, 0, 2, 6]}
      warm: {trapezoid: [2, 6, 10, 10]}
    shapes: design
    reason: made up
  mood:
    kind: situation
    level: nominal
    categories: [calm, lively]
    reason: made up
  touch_consent:
    kind: situation
    level: nominal
    categories: [given, withheld]
    reason: made up
parameters:
  distance:
    kind: behaviour
    level: ratio
    unit: m
    rules: [0, 4]
    ask: [0, 8]
    safe: {at_most: 6}
    terms:
      near: {trapezoid: [0, 0, 1, 2]}
      middle: {trapezoid: [1, 2, 2, 3]}
      away: {trapezoid: [2, 3, 4, 4]}
    shapes: design
    neutral: 3.5
    spread: 0.5
    reasons: {ranges: made up, terms: made up, neutral: made up, spread: made up}
  gesture:
    kind: action
    level: nominal
    categories: [wave, nod, hug]
    requires: {hug: touch_consent is given}
    neutral: nod
    reasons: {categories: made up, neutral: made up}
  volume:
    kind: behaviour
    level: ratio
    unit: "1"
    rules: [0, 1]
    ask: [0, 1]
    terms:
      soft: {trapezoid: [0, 0, 0.2, 0.8]}
      loud: {trapezoid: [0.2, 0.8, 1, 1]}
    shapes: design
    neutral: 0.5
    spread: 0.1
    reasons: {ranges: made up, terms: made up, neutral: made up, spread: made up}
rules:
  - {rule: if warmth is warm then distance is near, sources: [book], evidence: weak}
  - {rule: if warmth is cold then distance is away, sources: [book], evidence: weak}
  - {rule: if mood is lively then distance is middle, sources: [book], evidence: weak}
  - {rule: if warmth is warm then gesture is hug, sources: [book], evidence: weak}
  - {rule: if mood is lively then gesture is wave, sources: [book], evidence: weak}
  - {rule: if distance is away then volume is loud, sources: [book], evidence: weak}
  - {rule: if distance is near or distance is middle then volume is soft, sources: [book], evidence: weak}
"""

Write = Callable[..., Path]


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write the small rulebook with some of its text replaced, and give its path."""

    def written(*changes: tuple[str, str]) -> Path:
        text = SMALL
        for old, new in changes:
            assert old in text, f"nothing to replace: {old}"
            text = text.replace(old, new, 1)
        path = tmp_path / "small.yaml"
        path.write_text(text, encoding="utf-8")
        return path

    return written


@pytest.fixture(scope="session")
def small_text() -> str:
    return SMALL


@pytest.fixture(scope="session")
def small(tmp_path_factory: pytest.TempPathFactory) -> Rulebook:
    path = tmp_path_factory.mktemp("rulebook") / "small.yaml"
    path.write_text(SMALL, encoding="utf-8")
    return load_rulebook(path)


@pytest.fixture(scope="session")
def case1() -> Rulebook:
    return load_rulebook("bruno2017-case1")


@pytest.fixture(scope="session")
def case2() -> Rulebook:
    return load_rulebook("bruno2017-case2")


@pytest.fixture(scope="session")
def bruno2017() -> Rulebook:
    return load_rulebook("bruno2017")


WIDER = (
    (
        "if mood is lively then distance is middle",
        "if mood is lively or warmth is not cold then distance is middle",
    ),
    (
        "if warmth is warm then distance is near",
        "if warmth is warm and not (mood is calm and warmth is cold) then distance is near"
        " and gesture is nod",
    ),
    (
        "if distance is near or distance is middle then volume is soft",
        "if distance is not away or mood is calm then volume is soft",
    ),
    ("if warmth is cold then distance is away", "if warmth is cold and mood is calm then distance is away"),
    (
        "rules:\n  - {",
        "rules:\n  - {rule: if warmth is cold then distance is away, sources: [book], evidence: weak}\n  - {",
    ),
)


@pytest.fixture(scope="session")
def wide(tmp_path_factory: pytest.TempPathFactory) -> Rulebook:
    """The small rulebook with `or`, `not`, brackets, several consequents, and two rules for one term."""
    text = SMALL
    for old, new in WIDER:
        assert old in text, f"nothing to replace: {old}"
        text = text.replace(old, new, 1)
    path = tmp_path_factory.mktemp("rulebook") / "wide.yaml"
    path.write_text(text, encoding="utf-8")
    return load_rulebook(path)
