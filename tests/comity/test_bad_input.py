"""Bad input of every kind that a user would make ends with 2, a message that helps, and nothing written."""

from __future__ import annotations

import pytest

GOOD = """\
schema_version: 1
name: lounge
place: {width_m: 5, height_m: 4}
robot: {at_m: [1, 1]}
people:
  ada: {at_m: [3.5, 2.5], facing_deg: 200}
  bob: {at_m: [1.5, 3.0], facing_deg: -90}
goals:
  - greet: ada
"""


def edited(old: str, new: str) -> str:
    assert old in GOOD
    return GOOD.replace(old, new)


BOMB = "a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n"

BAD_SCENARIOS = {
    "no such file": (None, "", ["lounge.scenario.yaml", "no such file", "Check the path"]),
    "broken YAML": (edited("{width_m: 5,", "{width_m: 5"), ":3", ["expected YAML"]),
    "not YAML at all": ("\x00\x01\x02", "", ["expected YAML"]),
    "an empty file": ("", ":1", ["a mapping", "nothing"]),
    "a list": ("- 1\n", ":1", ["a mapping", "list"]),
    "unknown key": (edited("place:", "plaice:"), ":3", ["'plaice'", "Did you mean 'place'?"]),
    "unknown key inside": (
        edited("facing_deg: 200", "facing: 200"),
        ":6",
        ["'facing'", "Did you mean 'facing_deg'?"],
    ),
    "missing key": (edited("robot: {at_m: [1, 1]}\n", ""), ":1", ["'robot'", "Add"]),
    "a word for a number": (edited("width_m: 5", "width_m: wide"), ":3", ["width_m", "'wide'"]),
    "not a number": (edited("width_m: 5", "width_m: .nan"), ":3", ["width_m", "nan"]),
    "infinity": (edited("[3.5, 2.5]", "[.inf, 2.5]"), ":6", ["at_m", "inf"]),
    "out of range": (edited("width_m: 5", "width_m: -5"), ":3", ["width_m", "greater than 0"]),
    "unknown profile": (
        edited("{at_m: [3.5", "{profile: germn_man, at_m: [3.5"),
        ":6",
        ["Did you mean 'german_man'?"],
    ),
    "missing profile": (edited("{at_m: [3.5", "{profile: no.yaml, at_m: [3.5"), ":6", ["no such file"]),
    "unknown rulebook": (edited("place:", "rulebook: bruno2016\nplace:"), ":3", ["bruno2017"]),
    "rulebook without the needed parameters": (
        edited("place:", "rulebook: bruno2017-case1\nplace:"),
        "",
        ["approach_direction"],
    ),
    "unknown goal": (edited("greet: ada", "greet: eda"), ":9", ["'eda'", "Did you mean 'ada'?"]),
    "no goals": (edited("goals:\n  - greet: ada", "goals: []"), ":8", ["at least 1 item"]),
    "no people": (GOOD[: GOOD.index("people:")] + "people: {}\ngoals: [{greet: ada}]\n", ":5", ["people"]),
    "robot outside": (edited("[1, 1]", "[9, 9]"), ":4", ["robot"]),
    "person in a wall": (
        edited("height_m: 4}", "height_m: 4, walls_m: [[[3.5, 0], [3.5, 4]]]}"),
        ":6",
        ["ada"],
    ),
    "person outside": (edited("[3.5, 2.5]", "[50, 2.5]"), ":6", ["ada"]),
    "two people in one place": (edited("[1.5, 3.0]", "[3.5, 2.5]"), ":", ["ada", "bob"]),
    "robot named like a person": (edited("{at_m: [1, 1]}", "{name: ada, at_m: [1, 1]}"), ":6", ["twice"]),
    "furniture that crosses itself": (
        edited("height_m: 4}", "height_m: 4, furniture: [{name: x, polygon_m: [[1,2],[2,3],[1,3],[2,2]]}]}"),
        ":3",
        ["x:"],
    ),
    "furniture of no shape": (
        edited("height_m: 4}", "height_m: 4, furniture: [{name: x}]}"),
        ":3",
        ["box_m"],
    ),
    "unknown situation": (edited("facing_deg: 200", "situation: {mood: good}"), ":6", ["'mood'"]),
    "unknown category": (
        edited("facing_deg: 200", "situation: {gender: femal}"),
        ":6",
        ["Did you mean 'female'?"],
    ),
    "an inline profile's wish": (
        edited("{at_m: [3.5", "{profile: {name: a, settings: {approach_speed: 7}}, at_m: [3.5"),
        ":6",
        ["approach_speed", "7"],
    ),
    "wrong version": (edited("schema_version: 1", "schema_version: 2"), ":1", ["schema_version"]),
    "a key twice": (edited("name: lounge", "name: lounge\nname: hall"), ":3", ["'name' again"]),
    "an alias bomb": (BOMB, ":2", ["alias"]),
    "deep nesting": ("a: " + "[" * 3000 + "]" * 3000, ":1", ["levels"]),
    "a tag": (edited("name: lounge", "name: !!python/name:os.system x"), ":2", ["tag"]),
}


@pytest.mark.parametrize("kind", BAD_SCENARIOS)
@pytest.mark.parametrize("command", ["run", "plan"])
def test_a_bad_scenario_is_refused_with_place_and_remedy(comity, here, command, kind):
    text, line, words = BAD_SCENARIOS[kind]
    if text is not None:
        (here / "lounge.scenario.yaml").write_text(text)
    before = sorted(here.rglob("*"))
    said = comity(command, "lounge.scenario.yaml")
    assert said.code == 2, said
    assert said.out == ""
    assert "lounge.scenario.yaml" + line in said.err or not line
    for word in (*words, "expected", "got"):
        assert word in said.err
    assert "Traceback" not in said.err
    assert sorted(here.rglob("*")) == before, "something was written"


def test_the_good_scenario_is_good(comity, here):
    (here / "lounge.scenario.yaml").write_text(GOOD)
    assert comity("plan", "lounge.scenario.yaml").code == 0


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["infer", "--set", "individualism=nan"], "individualism"),
        (["infer", "--set", "individualism=380"], "0..100"),
        (["infer", "--set", "individualism=many"], "a number"),
        (["infer", "--set", "gendre=female"], "Did you mean 'gender'?"),
        (["infer", "--set", "gender=femal"], "Did you mean 'female'?"),
        (["infer", "--set", "gender"], "NAME=VALUE"),
        (["infer", "--set", "gender=female", "--set", "gender=male"], "twice"),
        (["infer", "germn_man"], "Did you mean 'german_man'?"),
        (["infer", "--rulebook", "bruno"], "bruno2017"),
        (["explain", "distance"], "conversational_distance"),
        (["explain", "approach_sped"], "Did you mean 'approach_speed'?"),
        (["run", "johana"], "Did you mean 'johanna'?"),
        (["run", "--as", "johanna=germn_man"], "Did you mean 'german_man'?"),
        (["run", "--as", "johana=german_man"], "Did you mean 'johanna'?"),
        (["run", "--as", "johanna"], "NAME=VALUE"),
        (["trace", "nowhere"], "no such folder"),
        (["trace", "."], "run.json"),
    ],
)
def test_a_bad_word_on_the_command_line_is_refused_with_a_remedy(comity, here, words, expected):
    said = comity(*words)
    assert (said.code, said.out) == (2, "")
    assert expected in said.err
    assert "Traceback" not in said.err
    assert not list(here.iterdir())


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("is medium", "is medum", "Did you mean 'medium'?"),
        ("and gender is male", "and gendre is male", "Did you mean 'gender'?"),
        ("if individualism is LC1 and", "if individualism is LC1 und", "expected"),
        ("evidence: contested", "evidence: certain", "certain"),
        ("[0.65, 0.75, 0.95, 1.05]", "[0.95, 0.75, 0.65, 1.05]", "0.95"),
        ("neutral: 0.825", "neutral: .nan", "neutral"),
        ("rules:\n  - rule", "ruels:\n  - rule", "Did you mean 'rules'?"),
    ],
)
def test_a_bad_rulebook_is_refused_with_line_and_remedy(comity, here, old, new, expected):
    from comity_fis import read_rulebook

    text = read_rulebook("bruno2017-case2").text
    assert old in text
    (here / "mine.yaml").write_text(text.replace(old, new, 1))
    line = text[: text.index(old)].count("\n") + 1
    said = comity("infer", "--rulebook", "mine.yaml", "--set", "individualism=38")
    assert said.code == 2
    assert "mine.yaml:" in said.err
    assert expected in said.err
    near = [f"mine.yaml:{line + offset}" for offset in (0, 1)]
    assert any(place in said.err for place in near), said.err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("schema_version: 1\nname: x\ngendre: female\n", ":3"),
        ("schema_version: 1\nname: x\nage: 200\n", ":3"),
        ("schema_version: 1\nname: x\nage: .nan\n", ":3"),
        ("schema_version: 1\nname: x\nculture: Atlantis\n", "x.yaml:3"),
        ("schema_version: 1\nname: x\nculture: EGY\n", "x.yaml:3"),
        ("schema_version: 1\nname: x\nsettings:\n  conversational_distance: 9\n", "x.yaml:4"),
        ("schema_version: 1\nname: x\nsettings: {conversational_distans: 1}\n", "x.yaml:3"),
        ("schema_version: 1\nname: x\nsettings: {greeting_gesture: handshake}\n", "x.yaml:3"),
        ("schema_version: 1\nname: x\nother: {hometown: Rome}\n", "x.yaml:3"),
    ],
)
def test_a_bad_profile_is_refused_wherever_it_is_used(comity, here, text, expected):
    (here / "x.yaml").write_text(text)
    for words in (["infer", "x.yaml"], ["run", "--as", "johanna=x.yaml"]):
        said = comity(*words)
        assert said.code == 2
        assert said.out == ""
        assert expected in said.err
        assert "Traceback" not in said.err
    assert [path.name for path in here.iterdir()] == ["x.yaml"]


def test_a_folder_that_is_not_ours_is_left_alone(comity, here):
    mine = here / "thesis"
    mine.mkdir()
    (mine / "run.json").write_text('{"chapters": 7}')
    said = comity("run", "--out", "thesis")
    assert said.code == 2
    assert [path.read_text() for path in mine.iterdir()] == ['{"chapters": 7}']


def test_a_run_folder_of_ours_is_renewed(comity, here):
    comity("run", "--out", "run", "--json")
    said = comity("run", "two-visits", "--out", "run", "--json")
    assert said.code == 0
    assert said.json["scenario"] == "two-visits"


def test_a_damaged_trace_is_named_with_its_line(comity, here):
    comity("run", "--out", "run", "--json")
    trace = here / "run" / "trace.jsonl"
    lines = trace.read_text().splitlines()
    lines[5] = lines[5][:20]
    trace.write_text("\n".join(lines))
    said = comity("trace", "run")
    assert said.code == 2
    assert "trace.jsonl:6" in said.err
