"""Golden episodes: kept with `--update`, and a later difference is told in words."""

from __future__ import annotations

import json

import pytest

from comity.testing.cases import claims_in
from comity.testing.golden import place_of
from comity.testing.verdict import judged
from comity_fis import InputError


@pytest.fixture
def kept(write):
    """A scenario with its golden episode."""
    path = write()
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    return path, place_of(claim.case)


def test_the_same_episode_is_the_golden_one(kept):
    path, golden = kept
    assert golden.name == "two-in-a-room-arab_woman-seed0.json"
    (claim,) = claims_in(path)
    assert judged(claim).passed


def test_a_difference_is_a_readable_one(kept):
    """The parameters that changed, then where the two part and which cause differs: no two hashes."""
    path, _ = kept
    path.write_text(path.read_text().replace("host: {profile: arab_woman", "host: {profile: german_man"))
    golden = path.with_name("room.golden")
    (golden / "two-in-a-room-arab_woman-seed0.json").rename(golden / "two-in-a-room-german_man-seed0.json")
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    assert failure.where.file.endswith("two-in-a-room-german_man-seed0.json")
    assert failure.finding.got == "conversational_distance of host: 0.64 -> 1.091"
    told = "\n".join(failure.finding.because)
    assert "greeting_modality of host: both -> verbal" in told
    assert "plan: Reach_user(robot, host, front); Greet_person(robot, host, both, nod)" in told
    assert "they do different things from t=" in told
    assert (
        "parameter conversational_distance 0.6402 m (culture) -> conversational_distance 1.0910 m (culture)"
        in told
    )


def test_on_another_machine_the_digest_does_not_count(kept):
    path, golden = kept
    record = json.loads(golden.read_text())
    record["trace_sha256"] = "0" * 64
    golden.write_text(json.dumps(record))
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    assert "digits or words" in failure.finding.got
    golden.write_text(json.dumps({**record, "fingerprint": "another machine"}))
    assert judged(claim).passed


def test_a_damaged_one_is_refused(kept):
    path, golden = kept
    golden.write_text("{")
    (claim,) = claims_in(path)
    with pytest.raises(InputError) as refused:
        judged(claim)
    assert "--update" in refused.value.remedy
