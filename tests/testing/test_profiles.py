"""A profile's test has one id wherever one stands, and a path starts where it is written."""

from __future__ import annotations

from pathlib import Path

import pytest

from comity.people.store import Store
from comity.system.library import shipped
from comity.testing.collection.cases import claims_in
from comity.testing.verdict import judged
from comity_fis import InputError

AMAL = "schema_version: 1\nname: amal\nculture: DEU\ngender: male\n"
FILES = "matrix: {profiles: [german_man, my/one.profile.yaml]}\n"
TWO = "matrix: {profiles: [german_man, arab_woman]}\n"


@pytest.fixture
def room(write, tmp_path) -> Path:
    """A scenario whose matrix names a file."""
    (tmp_path / "my").mkdir()
    (tmp_path / "my" / "one.profile.yaml").write_text(AMAL)
    return write("'duration at most 60 s, for amal'", more=FILES)


def test_a_file_is_called_by_its_name_from_wherever_one_looks(room, tmp_path, monkeypatch):
    """From beside it, from above, from elsewhere, and with the whole path, as pytest has it."""
    seen = []
    for here, path in (
        (tmp_path, Path(room.name)),
        (tmp_path.parent, room.relative_to(tmp_path.parent)),
        (tmp_path / "my", Path("..", room.name)),
        (tmp_path, room),
    ):
        monkeypatch.chdir(here)
        seen.append([claim.id for claim in claims_in(path)])
    assert seen == [["two-in-a-room[german_man-seed0]", "two-in-a-room[amal-seed0]"]] * 4


@pytest.mark.parametrize("instead", [(), ("arab_woman", "german_man")])
def test_a_comparison_calls_a_profile_as_the_tests_do(instead, room, write, tmp_path):
    """A file's by the name that it gives, also where others are tried instead of the matrix's."""
    (tmp_path / "my" / "two.profile.yaml").write_text(AMAL)
    sentences = ("amal and arab_woman", "amal and german_man", "amal and my/two.profile.yaml")
    path = write(*(f"'differs between {pair}: conversational_distance'" for pair in sentences), more=FILES)
    verdict = judged(claims_in(path, profiles=instead)[-1])
    assert [failure.finding.got for failure in verdict.failures] == [
        f"1.091 m for amal, 1.091 m for {other}: 0 cm apart"
        for other in ("german_man", "my/two.profile.yaml")
    ]


@pytest.mark.parametrize("profile", ["my/one.profile.yaml", "{name: amal, culture: DEU, gender: male}"])
def test_a_comparison_calls_who_is_as_written_as_the_test_does(profile, room, write):
    path = write(
        "'differs between amal and arab_woman: conversational_distance'",
        room=lambda text: text.replace("profile: arab_woman", f"profile: {profile}"),
    )
    claims = claims_in(path)
    assert [claim.id for claim in claims] == ["two-in-a-room[amal-seed0]", "two-in-a-room[across-seed0]"]
    assert judged(claims[-1]).passed


@pytest.mark.parametrize(
    ("sentence", "remedy"),
    [
        ("differs between german_man and amel: conversational_distance", "Did you mean 'amal'?"),
        ("differs between amal and arab_womn: conversational_distance", "Did you mean 'arab_woman'?"),
        ("duration at most 60 s, for amel", "Did you mean 'amal'?"),
    ],
)
def test_an_unknown_profile_is_refused_with_the_closest(sentence, remedy, room, write):
    with pytest.raises(InputError) as refused:
        claims_in(write(f"'{sentence}'", more=FILES))
    assert refused.value.remedy == remedy
    assert refused.value.where
    assert refused.value.where.line == 13


@pytest.mark.parametrize("other", ["other.profile.yaml", "my/one.profile.yaml"])
def test_two_profiles_of_one_name_are_refused_from_wherever_one_looks(
    other, write, room, tmp_path, monkeypatch
):
    (tmp_path / "other.profile.yaml").write_text(AMAL)
    path = write(more=f"matrix:\n  profiles:\n    - my/one.profile.yaml\n    - {other}\n")
    for here in (tmp_path, tmp_path / "my"):
        monkeypatch.chdir(here)
        with pytest.raises(InputError) as refused:
            claims_in(path.relative_to(here) if path.is_relative_to(here) else Path("..", path.name))
        assert refused.value.where
        assert refused.value.where.line == 15
        assert refused.value.got == f"'amal' of {other} beside that of my/one.profile.yaml"


def test_a_file_called_like_somebody_who_ships_is_refused(write, tmp_path):
    (tmp_path / "one.profile.yaml").write_text(AMAL.replace("amal", "german_man"))
    with pytest.raises(InputError) as refused:
        claims_in(write(more="matrix: {profiles: [german_man, one.profile.yaml]}\n"))
    assert refused.value.got == "'german_man' of one.profile.yaml beside that of german_man"


def test_a_path_on_the_command_line_starts_from_the_current_folder(write, tmp_path, monkeypatch):
    """Also for a scenario that is elsewhere, beside which there is another file of that name."""
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / "one.profile.yaml").write_text(AMAL)
    (tmp_path / "one.profile.yaml").write_text(AMAL.replace("amal", "noor"))
    write(more="matrix: {profiles: [german_man]}\n")
    monkeypatch.chdir(tmp_path / "here")
    (claim,) = claims_in(Path("../room.scenario.yaml"), profiles=["one.profile.yaml"])
    assert claim.id == "two-in-a-room[amal-seed0]"


@pytest.mark.parametrize(
    ("profiles", "said"),
    [
        (["no.profile.yaml"], "no such file: no.profile.yaml"),
        (["a.profile.yaml", "b.profile.yaml"], "'amal' of b.profile.yaml beside that of a.profile.yaml"),
    ],
)
def test_what_is_wrong_with_a_profile_of_the_command_line_is_said_once(
    profiles, said, write, tmp_path, comity
):
    for name in ("a", "b"):
        (tmp_path / f"{name}.profile.yaml").write_text(AMAL)
        write(more="matrix: {profiles: [german_man]}\n", name=f"{name}.scenario.yaml")
    done = comity("test", *(word for name in profiles for word in ("--profile", name)))
    assert done.code == 2
    assert done.err.count("\n") == 1
    assert done.err.startswith("comity: --profile: ")
    assert f"got {said}" in done.err


@pytest.fixture
def kept(tmp_path, monkeypatch) -> Path:
    """The file of somebody who is kept under another name than the one in it."""
    monkeypatch.setenv("COMITY_HOME", str(tmp_path / "home"))
    return Store().change_profile(
        "noor", lambda _: {"schema_version": 1, "name": "Noor K.", "culture": "DEU"}
    )


@pytest.fixture
def ways(kept, tmp_path) -> dict[str, str]:
    """The same person by name, by the path of the same file and by a link to it; who it is, by how."""
    (tmp_path / "link.profile.yaml").symlink_to(kept)
    (tmp_path / "other.profile.yaml").symlink_to(shipped("profile")["german_man"])
    return {
        "noor": "noor",
        "home/people/noor/profile.yaml": "noor",
        "./link.profile.yaml": "noor",
        "german_man": "german_man",
        "other.profile.yaml": "german_man",
    }


def test_somebody_has_one_name_whichever_way_their_profile_is_named(ways, write):
    """In the matrix, and as whoever the scenario visits has it."""
    for way, name in ways.items():
        as_written = write(room=lambda text, way=way: text.replace("profile: arab_woman", f"profile: {way}"))
        assert [claim.case.parts[0] for claim in claims_in(as_written)] == [name]
        in_matrix = write(more=f"matrix: {{profiles: [{way}]}}\n")
        assert [claim.case.parts[0] for claim in claims_in(in_matrix)] == [name]


def test_whoever_is_named_in_many_ways_is_tried_once(ways, write, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = write(more="matrix: {profiles: [arab_woman]}\n")
    claims = claims_in(path, profiles=list(ways))
    assert [claim.case.parts[0] for claim in claims] == ["noor", "german_man"]


def test_nobody_is_compared_with_themselves_by_another_name(ways, write):
    for one, other in (("noor", "./link.profile.yaml"), ("other.profile.yaml", "german_man")):
        with pytest.raises(InputError) as refused:
            claims_in(write(f"'differs between {one} and {other}: conversational_distance'", more=TWO))
        assert refused.value.got == f"{other!r}, which is {one!r} by another name"


def test_a_path_in_a_circle_is_refused_in_words(write, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "circle.profile.yaml").symlink_to("circle.profile.yaml")
    path = write(more="matrix: {profiles: [arab_woman]}\n")
    with pytest.raises(InputError):
        claims_in(path, profiles=["circle.profile.yaml"])
