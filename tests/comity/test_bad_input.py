"""Bad input of every kind that a user would make ends with 2, a message that helps, and nothing written."""

from __future__ import annotations

import json
import re
import subprocess
import sys

import pytest
from typer.main import get_command

from comity.cli import app
from comity.commands.blank import MAY_BE_BLANK

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


INTERNALS = (
    "tuple",
    "dictionary",
    "str]",
    "'str'",
    "[key]",
    "after validation",
    "function-",
    "constrained",
    "input",
)
"""Words of the libraries behind: none of them belongs in a message."""


def edited(old: str, new: str) -> str:
    assert old in GOOD
    return GOOD.replace(old, new)


def ada(more: str) -> str:
    """The good scenario with something more said of Ada."""
    return edited("{at_m: [3.5", f"{{{more}, at_m: [3.5")


def place(more: str) -> str:
    """The good scenario with something more in the room."""
    return edited("height_m: 4}", f"height_m: 4, {more}}}")


def walls(second: str) -> str:
    """The good scenario with a wall and a second one, which stands in line 8."""
    wall = "\n    - [[2, 1], [2, 2]]"
    room = f"place:\n  width_m: 5\n  height_m: 4\n  walls_m:{wall}\n    - {second}"
    return edited("place: {width_m: 5, height_m: 4}", room)


BOMB = "a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n"

BAD_SCENARIOS = {
    "no such file": (None, None, ["lounge.scenario.yaml", "no such file", "Check the path"]),
    "broken YAML": (edited("{width_m: 5,", "{width_m: 5"), ":3", ["expected YAML"]),
    "not YAML at all": ("\x00\x01\x02", None, ["expected YAML"]),
    "an empty file": ("", ":1", ["a mapping", "nothing"]),
    "a number alone": ("5\n", ":1", ["a mapping of keys to values, got 5."]),
    "two documents": (GOOD + "---\nname: more\n", ":10", ["expected YAML, got another document"]),
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
    "out of range": (
        edited("width_m: 5", "width_m: -5"),
        ":3",
        ["width_m above 0, got -5", "Give a number of metres above 0."],
    ),
    "no speed": (
        edited("robot: {at_m", "robot: {max_speed_m_s: 0, at_m"),
        ":4",
        ["max_speed_m_s from 0.01 up, got 0", "Give a number of metres per second from 0.01 up."],
    ),
    "too hard a brake": (
        edited("robot: {at_m", "robot: {emergency_deceleration_m_s2: 500, at_m"),
        ":4",
        ["Give a number of m/s² up to 100."],
    ),
    "unknown profile": (
        edited("{at_m: [3.5", "{profile: germn_man, at_m: [3.5"),
        ":6",
        ["Did you mean 'german_man'?"],
    ),
    "missing profile": (edited("{at_m: [3.5", "{profile: no.yaml, at_m: [3.5"), ":6", ["no such file"]),
    "unknown rulebook": (edited("place:", "rulebook: bruno2016\nplace:"), ":3", ["bruno2017"]),
    "rulebook without the needed parameters": (
        edited("place:", "rulebook: bruno2017-case1\nplace:"),
        ":3",
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
    "a wall through a group": (
        place("walls_m: [[[2.5, 0], [2.5, 4]]]") + "groups: {pair: [ada, bob]}\n",
        ":10",
        ["pair:", "wall 1 between ada and bob", "leave them out of the group"],
    ),
    "person outside": (edited("[3.5, 2.5]", "[50, 2.5]"), ":6", ["ada"]),
    "two people in one place": (edited("[1.5, 3.0]", "[3.5, 2.5]"), ":7", ["ada", "bob"]),
    "robot named like a person": (
        edited("{at_m: [1, 1]}", "{name: ada, at_m: [1, 1]}"),
        ":6",
        ["a name of its own for the robot", "'ada' 2 times"],
    ),
    "robot named like a chair": (
        edited("height_m: 4}", "height_m: 4, furniture: [{name: robot, box_m: [0, 3, 1, 1]}]}"),
        ":4",
        ["robot", "a name of its own", "2 times"],
    ),
    "furniture outside": (
        place("furniture: [{name: chair, box_m: [30, 3, 1, 1]}]"),
        ":3",
        ["chair", "inside the room", "wholly outside"],
    ),
    "furniture that crosses itself": (
        edited("height_m: 4}", "height_m: 4, furniture: [{name: x, polygon_m: [[1,2],[2,3],[1,3],[2,2]]}]}"),
        ":3",
        ["x:", "does not cross itself"],
    ),
    "furniture on one line": (
        place("furniture: [{name: x, polygon_m: [[1,2],[2,2],[3,2]]}]"),
        ":3",
        ["x:", "no area"],
    ),
    "furniture of two shapes": (
        place("furniture: [{name: x, box_m: [1,1,1,1], polygon_m: [[1,2],[2,2],[3,3]]}]"),
        ":3",
        ["one of `box_m`, `polygon_m`, `circle_m`, got `box_m` and `polygon_m`", "Remove all but one"],
    ),
    "a flat box": (place("furniture: [{name: x, box_m: [1,1,1,0]}]"), ":3", ["box_m with a width", "[1.0"]),
    "half a wall": (
        walls("[[3,3]]"),
        ":8",
        ["2 items in item 2 of walls_m, got 1"],
    ),
    "a wall in three points": (
        place("walls_m: [[[3,3],[3,4],[2,2]]]"),
        ":3",
        ["2 items in item 1 of walls_m"],
    ),
    "a wall without length": (
        walls("[[3,3],[3,3]]"),
        ":8",
        ["wall:", "two different points", "(3.0, 3.0) twice"],
    ),
    "a room smaller than anything": (
        edited("{width_m: 5, height_m: 4}", "\n  width_m: 5\n  height_m: 0.001"),
        ":5",
        ["room: expected height_m in [0.01, 1000], got 0.001"],
    ),
    "passers-by who want to go into a corner": (
        edited("goals:", "passers_by:\n  count: 2\n  between: [[2.5, 1], [0.1, 0.1]]\ngoals:"),
        ":10",
        ["passers_by: expected points that can be walked to, got (0.1, 0.1), which is not inside the room"],
    ),
    "a wall outside": (
        walls("[[30,3],[30,4]]"),
        ":8",
        ["inside the room", "wholly outside"],
    ),
    "a number for a list": (edited("[3.5, 2.5]", "7"), ":6", ["at_m as a list, got 7"]),
    "three coordinates": (edited("[3.5, 2.5]", "[3.5, 2.5, 0]"), ":6", ["2 items in at_m, got 3"]),
    "a coordinate far away": (edited("[3.5, 2.5]", "[3.5, 1e9]"), ":6", ["item 2 of at_m up to 1000"]),
    "a truth for a number": (edited("width_m: 5", "width_m: true"), ":3", ["width_m as a number, got true"]),
    "a text for a number": (edited("width_m: 5", "width_m: '5'"), ":3", ["got '5'", "without quotes"]),
    "nothing for a number": (edited("width_m: 5", "width_m:"), ":3", ["expected YAML"]),
    "a text for an age": (
        ada("profile: {name: a, age: '71'}"),
        ":6",
        ["age as a number, got '71'"],
    ),
    "a truth for an age": (ada("profile: {name: a, age: true}"), ":6", ["age as a number, got true"]),
    "a truth for a wish": (
        ada("profile: {name: a, settings: {conversational_distance: true}}"),
        ":6",
        ["conversational_distance as text or a number, got true"],
    ),
    "a slip in an inline profile": (
        ada("profile: {name: a, cultur: DEU}"),
        ":6",
        ["a known key, got 'cultur'", "Did you mean 'culture'?"],
    ),
    "doors without a map": (
        edited("width_m: 5", "doors: {study: open}, width_m: 5"),
        ":3",
        ["a key that goes with the others here, got 'doors'", "It goes with 'map'; leave it out."],
    ),
    "an inline profile without a name": (ada("profile: {age: 7}"), ":6", ["the key 'name'"]),
    "a number for a profile": (
        ada("profile: 3"),
        ":6",
        ["profile as text or a mapping such as `name: ...`, got 3"],
    ),
    "no name for a profile": (ada("profile: ''"), ":6", ["profile with at least 1 character, got ''"]),
    "a slip in a goal": (
        edited("greet: ada", "hug: ada"),
        ":9",
        ["a known key, got 'hug'", "Known are: after, by_s, from, greet, "],
    ),
    "a goal that is a word": (
        edited("greet: ada", "ada"),
        ":9",
        ["a goal such as `greet: ada`, got 'ada'"],
    ),
    "a goal twice": (GOOD + "  - greet: bob\n  - greet: ada\n", ":11", ["each person once", "'ada' again"]),
    "a situation of no number": (
        ada("situation: {age: .nan}"),
        ":6",
        ["age as a finite number, got nan"],
    ),
    "a wish of no number": (
        ada("profile: {name: a, settings: {conversational_distance: .nan}}"),
        ":6",
        ["conversational_distance as a finite number, got nan"],
    ),
    "a posture twice": (
        ada("posture: seated, situation: {posture: standing}"),
        ":6",
        ["no key of its own in `situation`", "Write `posture: ...`"],
    ),
    "an angle far too large": (
        edited("ada: {at_m: [3.5, 2.5], facing_deg: 200}", "ada:\n    at_m: [3.5, 2.5]\n    facing_deg: 1e9"),
        ":8",
        ["facing_deg up to 360", "number of degrees"],
    ),
    "an unknown posture": (ada("posture: standin"), ":6", ["Did you mean 'standing'?"]),
    "a name on two lines": (edited("name: lounge", 'name: "a\\nb"'), ":2", ["a name on one line"]),
    "a person without a name": (edited("  bob:", "  '':"), ":7", ["the name ''", "at least 1 character"]),
    "people in a list": (
        GOOD[: GOOD.index("people:")] + "people: [ada]\ngoals: [{greet: ada}]\n",
        ":5",
        ["people as a mapping"],
    ),
    "a number for a name": (edited("name: lounge", "name: 7"), ":2", ["name as text, got 7"]),
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
    if line is None:
        assert not re.search(r"yaml:[0-9]", said.err)
    else:
        assert f"lounge.scenario.yaml{line}:" in said.err
    for word in (*words, "expected", "got"):
        assert word in said.err
    assert not [word for word in ("Traceback", *INTERNALS) if word in said.err]
    assert sorted(here.rglob("*")) == before, "something was written"


def test_the_good_scenario_is_good(comity, here):
    (here / "lounge.scenario.yaml").write_text(GOOD)
    assert comity("plan", "lounge.scenario.yaml").code == 0


def taking_words():
    """What everything on the command line is that takes a word, with a blank one."""

    def within(command, words):
        for name, inner in getattr(command, "commands", {}).items():
            yield from within(inner, [*words, name])
        arguments = [param for param in command.params if param.param_type_name == "argument"]
        if arguments:
            yield [*words, *[""] * len(arguments)]
        for param in command.params:
            if param.metavar and param not in arguments and param.name not in MAY_BE_BLANK:
                yield [*words, param.opts[0], *[" "] * param.nargs]
                yield [*words, f"{param.opts[0]}=", *[""] * (param.nargs - 1)]

    return within(get_command(app), [])


@pytest.mark.parametrize("words", list(taking_words()), ids=" ".join)
def test_no_command_takes_a_blank_word(comity, here, words):
    """Not for a path, which would be this folder, and not for a name either."""
    said = comity(*words)
    assert (said.code, said.out) == (2, "")
    assert re.search(r"expected .*, got ' ?'\. Name one", said.err)
    assert not list(here.iterdir())


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["infer", "--set", "individualism=nan"], "individualism"),
        (["infer", "--set", "individualism=380"], "0..100"),
        (["infer", "--set", "individualism=many"], "a number"),
        (["infer", "--set", "gendre=female"], "Did you mean 'gender'?"),
        (["infer", "--set", "approach_speed=0.2"], "`settings: {approach_speed: 0.2}`"),
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
        (["run", "--out", ""], "--out: expected a folder, got ''"),
        (["run", "/dev/null"], "no regular file"),
        (["run", "no/such/file"], "no such file"),
        (["infer", "/dev/null"], "no regular file"),
        (["infer", "--rulebook", "/dev/null"], "no regular file"),
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
        ("neutral: 0.825", "neutral: 99", "0.45..1.2, got 99"),
        ("neutral: 0.825", "neutral: '0.8'", "neutral as a number, got '0.8'"),
        ("[0.65, 0.75, 0.95, 1.05]", "[0.65, 0.75, 0.95]", "4 items in trapezoid, got 3"),
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
    assert not [word for word in ("Traceback", *INTERNALS) if word in said.err]
    near = [f"mine.yaml:{line + offset}" for offset in (0, 1)]
    assert any(place in said.err for place in near), said.err


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("schema_version: 1\nname: x\ngendre: female\n", ":3"),
        ("schema_version: 1\nname: x\nage: 200\n", ":3"),
        ("schema_version: 1\nname: x\nage: .nan\n", ":3"),
        ("schema_version: 1\nname: x\nculture: EGI\n", "x.yaml:3"),
        ("schema_version: 1\nname: x\nsettings:\n  conversational_distance: 9\n", "x.yaml:4"),
        ("schema_version: 1\nname: x\nsettings: {conversational_distans: 1}\n", "x.yaml:3"),
        ("name: x\nmobility: frame\nother: {mobility: wheelchair}\n", "expected mobility once"),
        (
            "schema_version: 1\nname: x\nage: 71\nother:\n  age: 20\n",
            "x.yaml:5: expected a fact that has no key",
        ),
        (
            "name: x\nsettings:\n  greeting_modality: verbal\n  greeting_gesture: bow\n",
            "x.yaml:4: expected a gesture only in greetings that are not words alone, "
            "got greeting_gesture: bow with greeting_modality: verbal",
        ),
    ],
)
def test_a_bad_profile_is_refused_wherever_it_is_used(comity, here, text, expected):
    (here / "x.yaml").write_text(text)
    for words in (["infer", "x.yaml"], ["run", "--as", "johanna=x.yaml"]):
        said = comity(*words)
        assert said.code == 2
        assert said.out == ""
        assert expected in said.err
        assert not [word for word in ("Traceback", *INTERNALS) if word in said.err]
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


@pytest.mark.parametrize(
    "words", ["test ..", "test --shipped -k johanna --jobs 2", "run", "plan nowhere.scenario.yaml"]
)
def test_a_current_folder_that_was_removed_is_told(words, here):
    gone = here / "gone"
    gone.mkdir()
    (here / "room.scenario.yaml").write_text(GOOD)
    line = f"rmdir {gone}; exec {sys.executable} -m comity {words}"
    done = subprocess.run(["sh", "-c", line], cwd=gone, capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert done.stderr.startswith("comity: ")
    assert "Traceback" not in done.stderr


def test_where_the_current_folder_was_removed_tests_have_their_object_all_the_same(here):
    gone = here / "gone"
    gone.mkdir()
    (here / "room.scenario.yaml").write_text(GOOD)
    line = f"rmdir {gone}; exec {sys.executable} -m comity test .. --json"
    done = subprocess.run(["sh", "-c", line], cwd=gone, capture_output=True, text=True, check=False)
    assert (done.returncode, json.loads(done.stdout)["not_run"]) == (2, None)
    assert done.stderr == "comity: expected a current folder, got one that was removed. Change to another.\n"
