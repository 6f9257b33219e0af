from __future__ import annotations

import json

import pytest

from tests.oracle.__main__ import KEPT
from tests.oracle.comparing import Comparison

LINE = json.loads(KEPT.read_text("utf-8").splitlines()[1])


@pytest.mark.parametrize(
    ("changed", "kind"),
    [
        ({}, "equal"),
        ({"trace": "0123456789abcdef"}, "equal but for the digest"),
        ({"cost": 1}, "other plan"),
        ({"cost": 1, "outcome": "failed"}, "other plan"),
        ({"outcome": "failed"}, "other outcome"),
        ({"contacts": {"person_contacts": 1.0}}, "other outcome"),
    ],
)
def test_a_change_is_named_by_the_first_stage_that_it_touches(changed: dict[str, object], kind: str) -> None:
    assert Comparison(LINE, LINE | changed, same_fingerprint=True).kind == kind


def test_digests_of_another_platform_are_not_compared() -> None:
    assert Comparison(LINE, LINE | {"trace": ""}, same_fingerprint=False).kind == "equal"


def test_what_changed_is_shown_and_what_did_not_is_not() -> None:
    text = Comparison(LINE, LINE | {"outcome": "failed"}, same_fingerprint=True).text
    assert text.splitlines()[1:] == ["    outcome: success -> failed"]
