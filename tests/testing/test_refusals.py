"""What cannot be an expectation is refused with its line and the closest known words."""

from __future__ import annotations

import json
import re
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from rooms import ROOM

import comity_fis
from comity.testing.amounts.amount import Amount, Bounds
from comity.testing.collection.cases import claims_in
from comity.testing.grammar.sentence import parsed
from comity.testing.grammar.vocabulary import KEYWORDS, UNITS
from comity.testing.kinds import KINDS
from comity.testing.kinds.metric import MetricBounds
from comity.testing.verdict import judged
from comity_fis import InputError, Where
from comity_fis.variables.unit import QUANTITIES
from comity_sim2d.metrics import EPISODE, VISIT

WRONG = {
    "aproach from the front": "Did you mean 'approach'?",
    "path_length is 5 m withn 5 cm": "Did you mean 'within'?",
    "docking_error of hots at most 5 cm": "Did you mean 'host'?",
    "docking_error at most 5 kg": f"Units are {', '.join(sorted(UNITS)[:-1])} and s.",
    "docking_error at most 0.05 metres": "Did you mean 'm'?",
    "docking_error at most 5 CM": "Did you mean 'cm'?",
    "docking_error at most 5cms": "Did you mean 'cm'?",
    "duration at most 60 seconds, for arab_woman": "Did you mean 's'?",
    "duration at most 60 sec": "Did you mean 's'?",
    "longest_intrusion at most 1 S": "Did you mean 's'?",
    "chosen_bearing of host is 10° within 1 deg": "Did you mean 'deg'?",
    "chosen_bearing of host between 1 and 10 degrees": "Did you mean 'deg'?",
    "approach_speed of host at most 1 Km/H": "Did you mean 'km/h'?",
    "approach_speed of host at most 1 metre per second": "Did you mean 'm/s'?",
    "approach_speed of host at most 1 km per hour": "Did you mean 'km/h'?",
    "approach_speed of host at most 1 metre per minute": "Units are ",
    "approach_speed of host at most 2 mph": "Units are ",
    "duration at most 1 min": "Write `duration at most 60 s`.",
    "duration at most 60000 ms": "Units are ",
    "path_length at most 12 m m": "Write it like `min_clearance at least 45 cm`.",
    "path_length at most 12 fro arab_woman": "Did you mean 'for'?",
    "duration at most 5,5 s": "Write it like `min_clearance at least 45 cm`.",
    "docking_error at most 5": "Write the unit of the number beside it.",
    "docking_error at most 5 s": "Write it in m.",
    "approach from the frnt": "Did you mean 'front'?",
    "greeting contains a nood": "Did you mean 'nod'?",
    "visits in this oder: host, guest": "Did you mean 'in this order'?",
    "nod succeeds at most once per persn": "Did you mean 'per person'?",
    "same for al: safety": "Did you mean 'same for all'?",
    "never replan": "Did you mean 'replans'?",
    "outcome is sucess": "Did you mean 'success'?",
    "plan is prooven": "Did you mean 'proven'?",
    "walked of hots at most 1 m": "Did you mean 'host'?",
    'docked? fails becuse "distance"': "Did you mean 'because'?",
    "visiting host with a nod is exluded": "Did you mean 'excluded'?",
    "say is halted at lest once": "Did you mean 'at least'?",
    "docking_error at most 5 cm, for arab_womn": "Did you mean 'arab_woman'?",
    "docking_error at most 5 cm, for arab_woman or german_man": "Write `and`, or a comma",
    f"docked? succeeds at least {'9' * 400} times": "Write `3 times`.",
    "docked? succeeds at least 1.5 times": "Write `3 times`.",
    "docked? succeeds at least -3 times": "Write `3 times`.",
    f"duration at most {'9' * 400} s": "Write a smaller one.",
    "duration at most -5 s": "Leave the minus out",
    "docking_error at most -5 cm": "Leave the minus out",
    "longest_intrusion of sam at most -1 s": "Leave the minus out",
    "say lasts 1 s within -1 s": "Leave the minus out",
    "path_length is 3 m within -1 m": "Leave the minus out",
    "visiting guest from the left would cost at most -3 cm more": "Leave the minus out",
    "visiting guest with a wave would cost 40 cm more within -1 cm": "Leave the minus out",
    "path_length between 12 and 3 m": "Write `between 3 m and 12 m`.",
    "path_length between 1 m and 12 cm": "Write `between 12 cm and 1 m`.",
    "differs between a and b, conversational_distance by at most 10 cm": "Write it like `differs between",
    "greeting contains no nod and a nod": "Leave `nod` out, or what rules it out.",
    "greeting contains touch and no touch": "Leave `touch` out",
    "greeting of host contains a handshake and no touch": "Leave `handshake` out",
    "greeting contains words and a bow and no gesture": "Leave `bow` out",
    "greeting contains speech and no words": "Leave `speech` out",
    "visits in this order: guest, host, guest": "Name them once.",
    "say is never halted at most once": "Leave one of them out.",
    "replans at most once per person": "Leave `per person` out.",
    "greeting_gesture of host is decided": "Write it like `conversational_distance of anna is decided by",
    "differs between german_man and german_man: conversational_distance": "Name another one.",
    "touches at most -1": "Leave the minus out",
    "touches is -1": "Leave the minus out",
    "path_length_m between -3 and -1 m": "Leave the minus out",
    "overshoot of host at most -1 cm": "Leave the minus out",
    "walked at most -1 cm": "Leave the minus out",
    "plan_gap at most -0.1": "Leave the minus out",
    "bearing_error of host between -3 and -1 deg": "Leave the minus out",
    "chosen_bearing of guest is 361 deg within 5 deg": "Write a smaller number, or another sentence.",
    "chosen_bearing of guest at least 4 rad": "Write a smaller number, or another sentence.",
    "chosen_bearing of guest at most -181 deg": "Leave the minus out",
    "chosen_bearing of guest at most 5 m": "Write it in deg.",
    "duration at most 60 m": "Write it in s.",
    "greeting contains a hug": "Known are: bow, ",
    "bearing_error_deg of host at least 181 deg": "Write a smaller number, or another sentence.",
    "compliance_share of host at least 1.1": "Write a smaller number, or another sentence.",
    "success_weighted_by_path_length is 3": "Write a smaller number, or another sentence.",
    "plan_gap at least 2": "Write a smaller number, or another sentence.",
    f"docking_error of guest at most {'9' * 26} m": "Write a smaller one.",
    f"path_length is 3 m within {'9' * 10} mm": "Write a smaller one.",
    "no touch": "Write `greeting contains no touch`.",
    "no touch and a nod, for arab_woman": "Write `greeting contains no touch and a nod, for arab_woman`.",
    "never": "Known are: approach, differs, ",
    "outcome": "Write it like `outcome is success`.",
    'visiting guest with a nod is excluded because ""': "Write it like `visiting johanna",
    'visiting guest from the left is excluded because ""': "Write it like `visiting johanna",
    "conversational_distance of guest between 1 and 4 kg": "Units are ",
    "foo bar baz": "For example",
    "": "For example",
}


@pytest.mark.parametrize("sentence", WRONG)
def test_a_wrong_word_is_refused_with_the_closest_one(sentence, write):
    with pytest.raises(InputError) as refused:
        claims_in(write(f"'{sentence}'"))
    assert WRONG[sentence] in refused.value.remedy
    assert refused.value.where
    assert refused.value.where.line == 13


@given(
    st.lists(st.sampled_from([*WRONG, *(kind.EXAMPLE for kind in KINDS.values())]), min_size=2, max_size=8)
)
def test_all_wrong_sentences_of_a_file_are_told_together_each_with_its_line(sentences):
    """In their order, each as it is told where it stands alone."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "hall.scenario.yaml"

        def told(*written: str) -> list[str]:
            lines = "".join(f"- {json.dumps(sentence)}\n" for sentence in written)
            path.write_text(f"{ROOM}expect:\n{lines}")
            try:
                claims_in(path)
            except InputError as error:
                return re.sub(r"^\S*?:(\d+)(:\d+)?: ", r"\1 ", str(error), flags=re.MULTILINE).splitlines()
            return []

        first = len(ROOM.splitlines()) + 2
        alone = [(i, line.split(" ", 1)[1]) for i, one in enumerate(sentences) for line in told(one)]
        assert told(*sentences) == [f"{first + i} {line}" for i, line in alone]


def test_a_wrong_word_is_named_with_its_column(write):
    with pytest.raises(InputError) as refused:
        claims_in(write("path_length is 15 m withn 5 cm"))
    assert refused.value.where
    assert (refused.value.where.line, refused.value.where.column) == (13, 25)


@pytest.mark.parametrize(
    "sentence",
    [
        'visits in this order: "host", guest',
        '"host" hears "tea"',
        '"visits in this order: "host", guest"',
        "'visits in this order: \"O'Neil\", guest'",
        "visits in this order: 'host', guest",
    ],
)
@pytest.mark.parametrize("indent", [0, 2, 4])
def test_quotes_that_yaml_takes_for_its_own_are_told_with_the_line_that_works(sentence, indent, write):
    def room(text: str) -> str:
        first = f"{' ' * indent}- docking_error of host\n{' ' * indent}    at most 5 cm\n"
        return f"{text}expect:\n{first}# here\n{' ' * indent}- {sentence}\n"

    with pytest.raises(InputError, match="Put quotes around the whole sentence") as refused:
        claims_in(write(room=room))
    assert refused.value.where
    assert refused.value.where.line == 16
    (advice,) = re.findall(r"`- (.*)`", refused.value.remedy)
    meant = yaml.safe_load(advice)
    assert meant.replace('"', "").replace("'", "") == sentence.replace('"', "").replace("'", "")
    parsed(meant, lambda _: Where("x"))


@pytest.mark.parametrize(
    ("sentence", "said"),
    [
        ("path_length at least 0 m", "path_length is never less than 0"),
        ("space_compliance_share at most 3", "is never less than 0 and never more than 1"),
        ("compliance_share between 0 and 1", "got at least 0 and at most 1"),
        ("duration at least -1 s", "duration is never less than 0"),
        ("docked? succeeds at least 0 times", "at least 0, which every run keeps"),
    ],
)
def test_a_bound_that_no_run_can_break_is_refused(sentence, said):
    with pytest.raises(InputError) as refused:
        parsed(sentence, lambda _: Where("x"))
    assert said in str(refused.value)


@pytest.mark.parametrize(
    "sentence",
    [
        "path_length between 0 and 3 m",
        "plan_gap at most 0",
        "min_clearance at least 0 m",
        "path_length of guest at least 0 m",
    ],
)
def test_a_bound_that_a_run_may_break_is_taken(sentence):
    parsed(sentence, lambda _: Where("x"))


def test_numbers_may_be_written_with_a_power_of_ten():
    assert parsed("duration at most 1.5e2 s", lambda _: Where("x")) == parsed(
        "duration at most 150 s", lambda _: Where("x")
    )


@pytest.mark.parametrize("sentence", ["guest hears ''", 'guest hears ""', '"" hears tea'])
def test_quotes_with_nothing_in_them_are_told_as_that(sentence):
    with pytest.raises(InputError, match=r"expected a name|an expectation") as refused:
        parsed(sentence, lambda _: Where("x"))
    assert refused.value.got == "quotes with nothing in them"


@pytest.mark.parametrize("sign", ["'", '"'])
def test_quotes_around_a_whole_sentence_besides_those_of_yaml_are_named(sign):
    with pytest.raises(InputError, match="Leave these quotes out: `duration at most 60 s`"):
        parsed(f"{sign}duration at most 60 s{sign}", lambda _: Where("x"))
    with pytest.raises(InputError, match="got the end"):
        parsed(f"{sign}not a sentence{sign}", lambda _: Where("x"))


def test_quotes_that_are_wrong_elsewhere_are_told_as_yaml_tells_them(write):
    with pytest.raises(InputError, match="Check the indentation, colons and quotes"):
        claims_in(write(room=lambda text: text.replace("- greet: host", '- greet: "host", guest')))


@pytest.mark.parametrize(
    ("lines", "remedy"),
    [
        ("matrix: {profiles: [arab_womn]}\n", "Did you mean 'arab_woman'?"),
        ("matrix: {profile: paper}\n", "Did you mean 'profiles'?"),
        ("matrix: {people: [hots]}\n", "Did you mean 'host'?"),
        ("matrix: {seeds: [-1]}\n", "Give a number"),
        ("matrix: {worlds: {high: {place: {hight_m: 3}}}}\n", "Did you mean 'height_m'?"),
        ("markers: {slo: true}\n", "Did you mean 'slow'?"),
        ("markers: {slow: yes please}\n", "Write `true` or `false` (without quotes)."),
        ("markers: {slow: 1}\n", "Write `true` or `false` (without quotes)."),
        ("markers: {slow: 2}\n", "Write `true` or `false` (without quotes)."),
        ("markers: {slow: [true]}\n", "Write `true` or `false` (without quotes)."),
        ("matrix: {profiles: []}\n", "Write at least 1 item."),
        ("matrix: {seeds: []}\n", "Write at least 1 item."),
        ("matrix: {people: []}\n", "Write at least 1 item."),
        ("matrix: {rulebooks: []}\n", "Write at least 1 item."),
        ("matrix: {worlds: {}}\n", "Write at least 1 item."),
        ("matrix: {profiles: papr}\n", "Did you mean 'paper'?"),
        ("matrix: {profiles: {a: b}}\n", "Write"),
        ("matrix: {profiles: german_man}\n", "A list has brackets: `[german_man]`."),
        ("matrix: {profiles: 5}\n", "A list has brackets: `[a, b]`."),
    ],
)
def test_a_wrong_matrix_or_marker_is_refused(lines, remedy, write):
    with pytest.raises(InputError) as refused:
        claims_in(write(more=lines))
    assert remedy in refused.value.remedy
    assert refused.value.where
    assert refused.value.where.line == 12


@pytest.mark.parametrize(
    ("matrix", "remedy"),
    [
        ("profiles: [arab_woman, arab_woman]", "Leave one of them out"),
        ("seeds: [0, 0]", "Leave out what stands there twice"),
        ("rulebooks: [a/rules.yaml, b/rules.yaml]", "rename one of the two files"),
        ("worlds: {a b: {}, a-b: {}}", "files of both would be called 'arab_woman-a-b-seed0'"),
        ('worlds: {a b: {}, "a::b": {}}', "files of both would be called 'arab_woman-a-b-seed0'"),
        (
            "profiles: [a/across.profile.yaml], people: [host]",
            "Call the profile otherwise: `across`",
        ),
    ],
)
def test_two_cases_of_one_name_are_refused(matrix, remedy, write, tmp_path):
    """One golden episode and one picture would be of both, and nobody could name the second."""
    rules = (Path(comity_fis.__path__[0]) / "rulebooks" / "bruno2017.yaml").read_text()
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "rules.yaml").write_text(rules)
    (tmp_path / "a" / "across.profile.yaml").write_text("schema_version: 1\nname: across\n")
    with pytest.raises(InputError) as refused:
        claims_in(write("'same for all: safety'", more=f"matrix: {{{matrix}}}\n"))
    assert "names of their own" in refused.value.expected
    assert remedy in refused.value.remedy
    assert refused.value.where
    assert refused.value.where.line == 14


WORLDS = """\
matrix:
  worlds:
    quiet: {}
    other:
      robot: {at_m: [1.0, 1.0]}
"""


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("expect: [duration at most 1 s]", "`expect`, which is of the whole file"),
        ("matrix: {seeds: [1]}", "`matrix`, which is of the whole file"),
        ("markers: {slow: true}", "`markers`, which is of the whole file"),
        ("name: another", "`name`, which is of the whole file"),
        ("people: {host: {facing_deg: north}}", "facing_deg as a number"),
        ("people: {host: {posture: lying}}", "posture to be"),
    ],
)
def test_what_a_world_cannot_change_is_refused_with_its_line(line, said, write):
    with pytest.raises(InputError) as refused:
        claims_in(write(more=WORLDS.replace("robot: {at_m: [1.0, 1.0]}", line)))
    assert said in str(refused.value)
    assert refused.value.where
    assert refused.value.where.line == 16


def test_a_bad_position_in_a_world_is_told_with_the_line_of_the_world(write):
    """The others stay where the scenario has them."""
    at = "robot: {at_m: [90.0, 1.0]}"
    _, claim = claims_in(write(more=WORLDS.replace("robot: {at_m: [1.0, 1.0]}", at)))
    with pytest.raises(InputError) as refused:
        judged(claim)
    assert refused.value.where
    assert refused.value.where.line == 16
    assert claim.case.file.where("people", "guest").line == 7


def test_a_rulebook_of_the_matrix_is_refused_with_its_line(write):
    with pytest.raises(InputError) as refused:
        claims_in(write(more="matrix:\n  rulebooks:\n    - bruno2017\n    - bruno2107\n"))
    assert "Did you mean 'bruno2017'?" in refused.value.remedy
    assert refused.value.where
    assert refused.value.where.line == 15


@pytest.mark.parametrize(
    ("more", "line", "got"),
    [
        ("rulebook: gone.yaml\n", 14, "no such file: gone.yaml"),
        ("rulebook: gone.fis\n", 14, "no such file: gone.fis"),
        ("matrix:\n  rulebooks:\n    - bruno2017\n    - gone.yaml\n", 17, "no such file: gone.yaml"),
        ("matrix: {rulebooks: [gone.fis]}\n", 14, "no such file: gone.fis"),
        ("matrix: {rulebooks: [.]}\n", 14, "a folder: ."),
        ("place: {map: gone.map.yaml}\n", 13, "no such file: gone.map.yaml"),
    ],
)
def test_a_file_that_is_gone_is_told_with_the_line_that_names_it(more, line, got, write):
    room = ROOM.partition("place:")[2].partition("\n")[0] if more.startswith("place:") else "none"
    path = write("duration at most 60 s", more=more, room=lambda text: text.replace(f"place:{room}\n", ""))
    with pytest.raises(InputError) as refused:
        judged(claims_in(path)[0])
    assert refused.value.got == got
    assert refused.value.where
    assert (refused.value.where.file, refused.value.where.line) == (str(path), line)


@pytest.mark.parametrize("unit", [unit for quantity in QUANTITIES for unit in quantity])
def test_a_sentence_takes_every_unit_that_is_converted(unit):
    """Messages recommend them: `expected one of the units m, cm, mm, in, ft`."""
    meaning, profiles = parsed(f"width is 25 {unit} within 30 {unit}, for german_man", lambda _: Where("x"))
    assert isinstance(meaning, MetricBounds)
    assert meaning.bounds == Bounds(Amount(-5.0, unit), Amount(55.0, unit))
    assert profiles == ("german_man",)


@pytest.mark.parametrize("figure", {**EPISODE, **VISIT})
def test_a_sentence_takes_the_unit_of_every_metric(figure):
    unit = {**EPISODE, **VISIT}[figure].unit.removeprefix("1")
    meaning, _ = parsed(f"{figure} at most 0.5 {unit}", lambda _: Where("x"))
    assert isinstance(meaning, MetricBounds)
    assert meaning.bounds == Bounds(None, Amount(0.5, unit or None))


@pytest.mark.parametrize(
    "sentence",
    [
        "touches at most 0",
        "touches between -1 and 0",
        "min_clearance at least -1 m",
        "min_clearance at most -1 cm",
        "stop_distance_error of host at most -1 cm",
        "chosen_bearing of host at most -1 deg",
        "chosen_bearing of host is 180 deg within 5 deg",
        "chosen_bearing of host is -3 rad within 0.2 rad",
        "chosen_distance of host at least 1 m",
        "compliance_share of host at least 1",
        "plan_gap at least 1",
    ],
)
def test_a_figure_that_may_be_less_than_nothing_or_is_bounded_above_it_is_taken(sentence, write):
    assert claims_in(write(f"'{sentence}'"))


def test_an_end_at_once_can_be_fulfilled_where_nobody_can_be_reached(judge):
    walled = "height_m: 6.0, walls_m: [[[2.0, 0.0], [2.0, 6.0]]]}"
    sentences = ("duration at most 1 s", "outcome is failed")
    (verdict,) = judge(*sentences, room=lambda text: text.replace("height_m: 6.0}", walled))
    assert verdict.passed


TURNING = [*range(0x202A, 0x202F), *range(0x2066, 0x206A), 0x200E, 0x200F, 0x1B]


@pytest.mark.parametrize("sign", [chr(code) for code in TURNING], ids=ascii)
@pytest.mark.parametrize(
    "more",
    [
        'matrix: {{worlds: {{"a{}b": {{}}}}}}\n',
        'markers: {{xfail: "a{}b"}}\n',
        "matrix: {{profiles: [turned.profile.yaml]}}\n",
        "expect: [\"host hears 'a{}b'\"]\n",
        "expect: [\"{}host hears 'a'\"]\n",
    ],
)
def test_signs_that_steer_a_terminal_or_turn_text_round_are_refused(sign, more, write, tmp_path):
    escaped = f"\\u{ord(sign):04x}"
    profile = f'schema_version: 1\nname: "a{escaped}b"\n'
    (tmp_path / "turned.profile.yaml").write_text(profile)
    with pytest.raises(InputError, match="control characters") as refused:
        claims_in(write(more=more.format(escaped)))
    assert sign not in str(refused.value)
    assert refused.value.where
    assert refused.value.where.line


@pytest.mark.parametrize("kind", KINDS)
def test_the_example_of_every_kind_is_one(kind):
    meaning, profiles = parsed(KINDS[kind].EXAMPLE, lambda _: Where("example"))
    assert type(meaning) is KINDS[kind]
    assert profiles == ()


@given(
    st.lists(st.sampled_from([*KEYWORDS.values(), "host", "5", "cm", "docked?", "'s", ":", "("]), max_size=12)
)
def test_any_row_of_words_is_read_or_refused_in_words(words):
    refused = None
    try:
        parsed(" ".join(words), lambda n: Where("x", 1, n + 1))
    except InputError as error:
        refused = error
    assert refused is None or (refused.where and refused.remedy)


@pytest.mark.parametrize("name", ["a", "A", "the"])
@pytest.mark.parametrize("sentence", ["visits in this order: host, {}", "docking_error of {} at most 5 cm"])
def test_a_name_that_is_an_article_too_stands_in_quotes(write, name, sentence):
    """It would be left out, and the sentence be about nobody, or somebody else."""
    path = write(sentence.format(name), room=lambda room: room.replace("guest", name))
    with pytest.raises(InputError, match=f"""quotes around the name '{name}', which is an article, too"""):
        claims_in(path)
    quoted = sentence.format(f'"{name}"')
    (claim,) = claims_in(write(f"'{quoted}'", room=lambda room: room.replace("guest", name)))
    assert name in claim.expectations[0].meaning.people


FORMER = {
    "distance within 1 cm": "docking_error at most 1 cm",
    "distance to host within 5 cm of the culture-derived one": "docking_error of host at most 5 cm",
    "distance within 5 cm of the wanted one, for arab_woman": "docking_error at most 5 cm, for arab_woman",
    "no intrusion for longer than 1 s": "longest_intrusion at most 1 s",
    "no intrusion into a bystander's distance for longer than 0.5 s": "longest_intrusion at most 0.5 s",
    "no intrusion into guest's distance for longer than 1 s": "longest_intrusion of guest at most 1 s",
    "finishes within 60 s": "duration at most 60 s",
    "reached of host at most 12 s": "docking_time of host at most 12 s",
    "visits host before guest": "visits in this order: host, guest",
    "never waves twice": "wave succeeds at most once per person",
    "never speaks twice, for arab_woman": "say succeeds at most once per person, for arab_woman",
    "never plans anew": "never replans",
    "plans anew because 'guest moved' exactly once": "replans because 'guest moved' exactly once",
    "binds anew at most twice": "updates parameters at most twice",
    "say is halted by docked? at least once": "say is halted because 'docked?' at least once",
    "say is never halted by docked?": "say is never halted because 'docked?'",
    "visiting host with a nod is ruled out because 'noise'": (
        "visiting host with a nod is excluded because 'noise'"
    ),
    "greeting_gesture of host is made of 'nod'": "greeting_gesture of host is decided because 'nod'",
}
"""Sentences of earlier versions, and what they are now."""
SAID_OTHERWISE = FORMER | {
    "path_length less than 12 m": "path_length at most 12 m",
    "path length at most 12 m": "path_length at most 12 m",
    "conversational distance of host over 60 cm": "conversational_distance of host at least 60 cm",
    "duration under 2 minutes": "duration at most 120 s",
    "finishes within 1 min": "duration at most 60 s",
    "space_compliance_share at least 95 %": "space_compliance_share at least 0.95",
    "conversational_distance of host is about 85 cm": "conversational_distance of host is 85 cm within 1 cm",
    "host is visited before guest": "visits in this order: host, guest",
    "no collisions": "touches at most 0",
    "never waves": "wave succeeds at most 0 times",
    "never shakes hands": "handshake succeeds at most 0 times",
    "docked? succeeds twice": "docked? succeeds exactly twice",
    "say is halted by docked? 3 times": "say is halted because 'docked?' exactly 3 times",
    "min_clearance > 60 cm": "min_clearance at least 60 cm",
    "path_length<=12 m": "path_length at most 12 m",
    "guest is visited after host": "visits in this order: host, guest",
    "visits host, then guest": "visits in this order: host, guest",
    "host is approached from the front": "approach to host from the front",
    "greets host with a nod": "greeting of host contains a nod",
    "touches nobody": "touches at most 0",
    "duration at most 60 s.": "duration at most 60 s",
    "finishes in 60 s": "duration at most 60 s",
    "finishes in 90 seconds": "duration at most 90 s",
    "visits host after guest": "visits in this order: guest, host",
    "never say": "say never succeeds",
}


@pytest.mark.parametrize("sentence", SAID_OTHERWISE)
def test_what_people_say_otherwise_is_put_as_it_is_understood(write, sentence):
    """The remedy is a sentence that is taken as it stands."""
    with pytest.raises(InputError) as refusal:
        claims_in(write(json.dumps(sentence)))
    assert refusal.value.remedy == f"Write `{SAID_OTHERWISE[sentence]}`."
    assert claims_in(write(json.dumps(SAID_OTHERWISE[sentence])))


def test_a_name_of_several_words_needs_quotes(write):
    def room(text: str) -> str:
        return text.replace("host", "Anna Maria")

    with pytest.raises(InputError) as refused:
        claims_in(write("docking_error of Anna Maria at most 5 cm", room=room))
    assert refused.value.remedy == 'Write `"Anna Maria"`.'
    assert refused.value.where.column == 22
    assert claims_in(write('docking_error of "Anna Maria" at most 5 cm', room=room))
    assert claims_in(write("guest hears 'Anna Maria'", room=room))


def test_an_article_is_left_out_where_nobody_is_called_so(write):
    (claim,) = claims_in(write("greeting of the guest contains a nod"))
    assert claim.expectations
