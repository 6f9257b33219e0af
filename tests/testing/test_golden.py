"""Golden episodes: kept with `--update`, and a later difference is told in words."""

from __future__ import annotations

import json
from datetime import date
from pathlib import Path

import pytest
from rooms import ROOM

import comity_fis
from comity.people.consents import give
from comity.people.learnt_file import Stated
from comity.people.remembered import remember_answer
from comity.people.store import Store
from comity.system.library import shipped
from comity.testing.collection.cases import claims_in
from comity.testing.golden.file import Golden
from comity.testing.golden.place import place_of
from comity.testing.runner.result import result_of
from comity.testing.verdict import judged
from comity_fis import InputError

HALL = "schema_version: 1\nname: hall\nrooms:\n  hall: {box_m: [0, 0, 8, 6]}\n"


@pytest.fixture
def kept(write):
    """A scenario with its golden episode."""
    path = write()
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    return path, place_of(claim.case)


def test_the_same_episode_is_the_golden_one(kept):
    path, golden = kept
    assert golden.name == "arab_woman-seed0.json"
    (claim,) = claims_in(path)
    assert judged(claim).passed


def test_a_difference_is_a_readable_one(kept):
    """The parameters that changed, then where the two part and which cause differs: no two hashes."""
    path, _ = kept
    path.write_text(path.read_text().replace("host: {profile: arab_woman", "host: {profile: german_man"))
    golden = path.with_name("room.golden")
    (golden / "arab_woman-seed0.json").rename(golden / "german_man-seed0.json")
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    assert failure.where.file.endswith("german_man-seed0.json")
    assert failure.finding.got == "conversational_distance of host: 0.64 -> 1.091"
    told = "\n".join(failure.finding.also)
    assert "greeting_modality of host: both -> verbal" in told
    assert "plan: Reach_user(robot, host, front); Greet_person(robot, host, both, nod)" in told
    assert "they do different things from t=" in told
    assert (
        "parameter conversational_distance 0.6402 m (culture) -> conversational_distance 1.0910 m (culture)"
        in told
    )


def test_readings_that_differ_where_their_words_do_not_are_told_with_their_values(kept):
    path, golden = kept
    events = json.loads(golden.read_text())["events"]
    reading = next(
        cause
        for event in events
        for cause in event["because"]
        if cause["kind"] == "reading" and isinstance(cause["value"], float)
    )
    was = reading["value"]
    reading["value"] = was + 0.001
    _rewritten(golden, events=events)
    told = "\n".join(_found(path))
    assert f"reading   {reading['text']}: {reading['value']} -> {was}" in told


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


EDITED_BY_HAND = {
    "parameters": lambda kept: kept["host"].update(conversational_distance=0.7),
    "visits": lambda kept: kept.update(guest="unreached"),
    "plan": lambda kept: kept[0].update(cost_m=1.0),
    "events": lambda kept: kept[3].update(t=99.0),
    "nodes": lambda kept: kept[2].update(name="Stopp"),
}


@pytest.mark.parametrize("part", EDITED_BY_HAND)
def test_what_somebody_edited_in_one_is_told_though_the_digest_is_right(part, kept):
    path, golden = kept
    record = json.loads(golden.read_text())
    EDITED_BY_HAND[part](record[part])
    golden.write_text(json.dumps(record))
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    assert "somebody edited the golden episode" in failure.finding.because[-1]


CLOSE = "gender is female then conversational_distance is close"
RULES = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text()


def _with_rules(room: str) -> str:
    return room.replace("place:", "rulebook: rules.yaml\nplace:")


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (CLOSE, CLOSE.replace("close", "medium"), "female then conversational_distance is medium"),
        (
            "far: {trapezoid: [0.95,",
            "far: {trapezoid: [0.9501,",
            "terms far trapezoid [0.95, 1.05, 1.2, 1.2]",
        ),
    ],
)
def test_an_edit_whose_traces_are_smaller_than_what_is_kept_is_named_with_what_moved(old, new, told, write):
    """Low individualism is hardly true of somebody British: its rule counts for less than a millimetre."""
    path = write(room=lambda room: _with_rules(room.replace("german_man", "british_elder")))
    path.with_name("rules.yaml").write_text(RULES)
    path.write_text(path.read_text().replace("arab_woman", "british_elder"))
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    path.with_name("rules.yaml").write_text(RULES.replace(old, new))
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    because = failure.finding.because
    assert any(line.startswith("moved     conversational_distance of host: 0.945") for line in because)
    assert [told in line for line in because if line.startswith("edited    ")] == [True]


def test_rules_that_move_nothing_here_make_no_difference(write):
    """They are kept to tell a cause, and are none by themselves, on another machine either."""
    path = write(room=_with_rules)
    path.with_name("rules.yaml").write_text(RULES)
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    british = "if culture is GBR then greeting_gesture is"
    other = RULES.replace(f"{british} wave", f"{british} bow")
    assert other != RULES
    path.with_name("rules.yaml").write_text(other)
    golden = place_of(claim.case)
    golden.write_text(json.dumps({**json.loads(golden.read_text()), "fingerprint": "another machine"}))
    (claim,) = claims_in(path)
    assert judged(claim).passed


PASSER_BY = """\
schema_version: 1
name: passer-by
culture: DEU
gender: male
"""
MORE_FRONT = ("front: {trapezoid: [0, 0, 15, 30]}", "front: {trapezoid: [0, 0, 17, 28]}")
NOD = (
    "individualism is LC2 then greeting_gesture is wave",
    "individualism is LC2 then greeting_gesture is nod",
)


@pytest.fixture
def watched(write):
    """A scenario with a golden episode, rules of its own, and two who are not visited."""
    people = PLAIN.replace("  host:", "  far: {profile: far.profile.yaml, at_m: [7.4, 5.4]}\n  host:")
    path = write(room=lambda _: _with_rules(people))
    path.with_name("rules.yaml").write_text(RULES)
    path.with_name("far.profile.yaml").write_text(PASSER_BY)
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    return path


PLAIN = ROOM.replace("arab_woman", "german_man").replace("  - greet: guest\n", "")


def _found(path: Path) -> tuple[str, ...]:
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    return failure.finding.got, *failure.finding.because


def _edit(path: Path, name: str, old: str, new: str) -> None:
    text = path.with_name(name).read_text()
    assert old in text
    path.with_name(name).write_text(text.replace(old, new))


OFF = (NOD[0], f"{NOD[0]}\n    weight: 0.25\n    enabled: false")


@pytest.mark.parametrize(
    ("name", "edit", "moved", "said"),
    [
        ("rules.yaml", NOD, "greeting_gesture", f"edited    rule 20: if {NOD[0]} -> rule 20: if {NOD[1]}"),
        (
            "rules.yaml",
            MORE_FRONT,
            "approach_direction",
            "front trapezoid [0, 0, 15, 30] -> [0, 0, 17, 28] (",
        ),
        ("rules.yaml", OFF, "greeting_gesture", "wave (weight: 0.25, enabled: False)"),
        (
            "far.profile.yaml",
            ("DEU", "JPN"),
            "conversational_distance",
            "edited    profile of far: culture DEU -> JPN (",
        ),
    ],
    ids=("a rule", "a figure", "a weight", "a profile of somebody not visited"),
)
def test_an_edit_that_moves_parameters_and_no_event_is_named_and_nobody_is_accused(
    name, edit, moved, said, watched
):
    _edit(watched, name, *edit)
    got, *because = _found(watched)
    assert got.startswith(f"{moved} of far: ")
    assert [line for line in because if line.startswith("edited    ") and said in line]
    assert "from t=" not in " ".join(because)
    assert "golden" not in " ".join(because)


def _rewritten(golden: Path, **parts: object) -> None:
    """A golden episode with other parts and the digest that fits them."""
    changed = Golden.model_validate_json(json.dumps({**json.loads(golden.read_text()), **parts}))
    golden.write_text(changed.model_copy(update={"sha256": changed.digest()}).model_dump_json())


def test_where_nothing_was_edited_at_all_comity_is_another(kept):
    """Its code is nothing that a golden episode keeps: but nobody edited this one."""
    path, golden = kept
    parameters = json.loads(golden.read_text())["parameters"]
    _rewritten(
        golden, parameters={**parameters, "sam": {**parameters["sam"], "conversational_distance": 0.7}}
    )
    got, *because = _found(path)
    assert got == "conversational_distance of sam: 0.7 -> 1.091"
    assert because == ["neither what the case reads nor the golden episode was edited: Comity is another"]


@pytest.mark.parametrize("scenario", ["empty-room", "johanna", "two-visits", "comity-bench-1/ward-round"])
def test_what_nobody_edited_has_the_digest_that_it_says(scenario, tmp_path):
    """Whatever is in it, through JSON and back."""
    path = tmp_path / "own.scenario.yaml"
    path.write_text(shipped("scenario")[scenario].read_text())
    claim = claims_in(path)[0]
    judged(claim, update=True)
    golden = Golden.model_validate_json(place_of(claim.case).read_bytes())
    assert golden.sha256 == golden.digest()


def test_what_was_learnt_with_somebody_since_is_named(write, tmp_path, monkeypatch):
    """The store is no file of the scenario's, and no profile."""
    monkeypatch.setenv("COMITY_HOME", str(tmp_path / "home"))
    path = write(
        room=lambda room: (
            room.replace("sam: {profile: german_man", "sam: {profile: sam") + "rulebook: bruno2017\n"
        )
    )
    give("sam", ["remember", "learn"], by="a_test")
    Store().change_profile(
        "sam", lambda _: {"schema_version": 1, "name": "sam", "culture": "DEU", "gender": "male"}
    )
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    said = Stated(day=date(2025, 12, 1), situation={"posture": "standing"}, model_m=1.091, likes_m=0.6)
    assert remember_answer("sam", said)
    got, *because = _found(path)
    assert got.startswith("conversational_distance of sam: 1.091 -> ")
    assert any(line.startswith("edited    what was learnt with sam: sam of the store, ") for line in because)


SPOILT = {
    "nothing": b"",
    "cut": b"{",
    "no text": b"\xff\xfe",
    "null": b"null",
    "a number": b"5",
    "a word": b'"x"',
    "too deep": b"[" * 200_000,
}


@pytest.mark.parametrize("content", SPOILT.values(), ids=SPOILT)
def test_a_damaged_one_is_refused(content, kept):
    path, golden = kept
    golden.write_bytes(content)
    (claim,) = claims_in(path)
    refused = result_of(claim)
    assert refused.status == "refused"
    assert refused.text.startswith(f"{golden}: expected a golden episode")
    assert "--update" in refused.text


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("format", "comity-golden-4"),
        ("parameters", 5),
        ("plan", [5]),
        ("nodes", []),
        ("events", [{"t": "soon"}]),
        ("visits", None),
        ("further", 1),
    ],
)
def test_one_with_a_wrong_part_is_refused_with_its_name(key, value, kept):
    path, golden = kept
    golden.write_text(json.dumps({**json.loads(golden.read_text()), key: value}))
    (claim,) = claims_in(path)
    with pytest.raises(InputError) as refused:
        judged(claim)
    assert key in refused.value.got or "of node" in refused.value.got


def test_a_folder_in_its_place_is_refused(kept):
    path, golden = kept
    golden.unlink()
    golden.mkdir()
    (claim,) = claims_in(path)
    assert result_of(claim).status == "refused"
    assert result_of(claim, update=True).status == "refused"
    assert list(golden.parent.iterdir()) == [golden]


def test_a_pipe_in_its_place_is_refused_and_not_waited_for(kept, piped):
    path, golden = kept
    piped(golden)
    (claim,) = claims_in(path)
    with pytest.raises(InputError, match="got no regular file") as refused:
        judged(claim)
    assert refused.value.where.file == str(golden)


def test_a_device_in_its_place_is_refused_and_not_read(kept):
    path, golden = kept
    golden.unlink()
    golden.symlink_to("/dev/null")
    (claim,) = claims_in(path)
    refused = result_of(claim)
    assert refused.text.startswith(f"{golden}: expected a golden episode, got no regular file")


def test_where_none_can_be_written_it_is_said(write):
    path = write()
    path.with_name("room.golden").write_text("a file")
    (claim,) = claims_in(path)
    refused = result_of(claim, update=True)
    assert refused.status == "refused"
    assert "room.golden: expected a place to write to" in refused.text


def test_none_is_written_among_what_is_installed():
    claim = claims_in(shipped("scenario")["empty-room"])[0]
    refused = result_of(claim, update=True)
    assert refused.status == "refused"
    assert "Copy the scenario" in refused.text
    assert not place_of(claim.case).parent.exists()


def test_an_edited_map_is_named_with_what_it_costs(write, tmp_path):
    """Not only when the two part: the cost of the way, what was driven, and which file is another."""
    (tmp_path / "hall.map.yaml").write_text(HALL)
    path = write(room=lambda room: room.replace("width_m: 8.0, height_m: 6.0", "map: hall.map.yaml"))
    (claim,) = claims_in(path)
    assert judged(claim, update=True).passed
    (tmp_path / "hall.map.yaml").write_text(
        HALL + "furniture:\n  - {name: desk, box_m: [1.6, 2.0, 1.4, 0.6]}\n"
    )
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    assert failure.finding.got.startswith("cost of Reach_user(robot, host, front): ")
    (edited,) = failure.finding.because
    assert edited.startswith("edited    map hall.map.yaml: furniture desk box_m - -> [1.6, 2.0, 1.4, 0.6] (")
    assert edited.endswith("hall.map.yaml:6)")
    told = "\n".join(failure.finding.also)
    assert "way that was driven: " in told
    assert "they do different things from t=" in told


def test_an_outcome_is_told_as_people_read_it(kept):
    path, golden = kept
    record = json.loads(golden.read_text())
    _rewritten(golden, outcome="failed", visits={**record["visits"], "guest": "not_greeted"})
    got, *_ = _found(path)
    assert got == "outcome: failed -> success"
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    assert list(failure.finding.also) == ["visit of guest: not greeted -> greeted"]


def test_a_way_that_is_no_longer_ruled_out_is_told_though_nothing_else_differs(kept):
    """What the robot does is the same; what it could do is not."""
    path, golden = kept
    record = json.loads(golden.read_text())
    for step, choice in (("Reach_user(robot, guest)", "left"), ("Greet_person(robot, host)", "both, wave")):
        record["ruled_out"][step][choice] = "no free place there"
    record["ruled_out"]["Reach_user(robot, sam)"] = {"front": "of a step that is no more"}
    _rewritten(golden, ruled_out=record["ruled_out"])
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    told = {failure.finding.got, *failure.finding.also}
    assert told == {
        "left of Reach_user(robot, guest): no longer excluded (no free place there)",
        "both, wave of Greet_person(robot, host): no longer excluded (no free place there)",
    }


def test_choices_that_the_same_befell_are_told_together(kept):
    """Noise rules out all that is said: its level is not told a dozen times."""
    path, _ = kept
    path.write_text(path.read_text().replace("facing_deg: 180}", "facing_deg: 180, noise_db: 90}"))
    (claim,) = claims_in(path)
    (failure,) = judged(claim).failures
    told = [line for line in failure.finding.also if "drowns a voice" in line and " of Greet_person" in line]
    assert len(told) <= 2
    assert any("more of Greet_person(robot, guest): now excluded (" in line for line in told)
