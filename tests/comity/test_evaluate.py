"""`comity evaluate`: a rulebook against measured tuples, and every bad table refused with its line."""

from __future__ import annotations

import csv
import random
from contextlib import suppress
from pathlib import Path

import jsonschema
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import comity
from comity.commands.evaluate import evaluate as command
from comity.tables.evaluation import Radii, evaluate
from comity.tables.measurements import SHIPPED, read_measurements
from comity_fis import InputError, load_rulebook, shipped_rulebooks
from comity_sim2d.scene.person import PERSON_RADIUS_M, Person
from comity_sim2d.scene.robot_body import ROBOT_RADIUS_M, RobotBody

HEAD = "study,culture,gender,parameter,value,unit,measured,partner,n,sd\n"
GOOD = (
    HEAD
    + "a,DEU,female,conversational_distance,85,cm,surface,robot,20,10\n"
    + "a,JPN,male,conversational_distance,0.9,m,,person,,\n"
)


@pytest.fixture
def ask(comity, here):
    """`comity evaluate` on a text, as JSON."""

    def answer(text, *words, rulebook="bruno2017"):
        (here / "t.csv").write_text(text, encoding="utf-8")
        said = comity("evaluate", rulebook, "t.csv", "--json", *words)
        assert said.code == 0, said.err
        return said.json

    return answer


def test_capitals_make_no_difference_to_what_was_measured_and_to_whom(ask):
    assert ask(GOOD.replace("surface,robot", "Surface,ROBOT")) == ask(GOOD)


@pytest.mark.parametrize("rulebook", shipped_rulebooks())
def test_every_shipped_rulebook_is_held_against_the_shipped_rows(comity, rulebook):
    schema = comity("schema", "evaluate").json
    jsonschema.Draft202012Validator.check_schema(schema)
    answer = comity("evaluate", rulebook, "--json").json
    jsonschema.validate(answer, schema)
    assert (answer["file"], answer["rows"]) == (SHIPPED, 7)
    assert comity("evaluate", rulebook).code == 0


def test_the_paper_agrees_with_eresha_in_direction_only(comity):
    """The order of Germans and Arabs is right, and the numbers are no nearer than a neutral value."""
    answer = comity("evaluate", "bruno2017-case1", "--json").json
    eresha = answer["numbers"]["conversational_distance"]["readings"]["surface"]["eresha2013"]
    assert eresha["order"] == {"agreeing": 1, "contradicting": 0, "equal": 0}
    assert eresha["mean_absolute_error"] > 0.05
    assert eresha["mean_absolute_error"] >= eresha["neutral"] - 0.01
    said = comity("evaluate", "bruno2017-case1").out
    assert "in direction only" in " ".join(said.split())


def test_the_two_readings_differ_by_the_radii(comity):
    """To a robot 0.25 + 0.20 m, between two people 0.20 + 0.20 m; the constant does not care."""
    numbers = comity("evaluate", "bruno2017", "--json").json["numbers"]["conversational_distance"]
    for row in numbers["rows"]:
        gap = 0.45 if row["partner"] == "robot" else 0.40
        assert row["errors"]["centre"] - row["errors"]["surface"] == pytest.approx(gap)
    for study, one in numbers["readings"]["surface"].items():
        assert one["constant"] == pytest.approx(numbers["readings"]["centre"][study]["constant"])


def test_the_radii_are_those_of_the_shipped_world():
    assert RobotBody.__dataclass_fields__["radius_m"].default == ROBOT_RADIUS_M
    assert Person.__dataclass_fields__["radius_m"].default == PERSON_RADIUS_M
    assert Radii() == Radii(*(command.__kwdefaults__[name] for name in ("robot_radius", "person_radius")))


def test_a_stated_convention_is_believed(ask):
    between = ask(GOOD.replace("surface", "centre").replace(",m,,", ",m,surface,"))
    numbers = between["numbers"]["conversational_distance"]
    assert list(numbers["readings"]) == ["as_stated"]
    first, second = numbers["rows"]
    assert first["errors"]["as_stated"] == pytest.approx(first["predicted"] + 0.45 - 0.85)
    assert second["errors"]["as_stated"] == pytest.approx(second["predicted"] - 0.9)


def test_predictions_of_the_rulebook_itself_are_without_error(ask):
    """Whatever the culture and gender: error 0, rank correlation 1, and every pair in order."""
    book = load_rulebook("bruno2017-case2")
    rows = []
    for culture, score in (("DEU", 67), ("JPN", 46), ("CHN", 20), ("IND", 48), ("USA", 91)):
        value = book.infer({"individualism": score, "gender": "male"})["conversational_distance"].number
        rows.append(f"a,{culture},male,conversational_distance,{value!r},m,surface,robot,,\n")
    answer = ask(HEAD + "".join(rows), rulebook="bruno2017-case2")
    (study,) = answer["numbers"]["conversational_distance"]["readings"]["as_stated"].values()
    assert study["mean_absolute_error"] == pytest.approx(0, abs=1e-12)
    assert study["rank_correlation"]["value"] == 1
    assert (study["order"]["contradicting"], study["order"]["equal"]) == (0, 0)
    assert study["line"] > 0


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.randoms(use_true_random=False))
def test_the_order_of_the_rows_does_not_matter(tmp_path: Path, source):
    book = load_rulebook("bruno2017")
    shipped = Path(comity.__file__).parent / "measured" / f"{SHIPPED}.csv"
    lines = [line for line in shipped.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    body = source.sample(lines[1:], len(lines) - 1)
    (tmp_path / "t.csv").write_text("\n".join([lines[0], *body]), encoding="utf-8")
    one = evaluate(book, read_measurements(str(tmp_path / "t.csv"), book))
    other = evaluate(book, read_measurements(SHIPPED, book))
    for parameter, numbers in one.numbers.items():
        for reading, studies in numbers.readings.items():
            assert dict(studies) == dict(other.numbers[parameter].readings[reading])


def test_separators_decimal_commas_and_a_byte_order_mark_are_understood(ask):
    plain = ask(GOOD)
    semicolons = "\ufeff" + GOOD.replace(",", ";").replace("0.9", "0,9")
    for text in (semicolons, GOOD.replace(",", "\t"), "# a remark\n\n" + GOOD, GOOD.replace("\n", "\r\n")):
        answer = ask(text)
        for numbers in (*answer["numbers"].values(), *plain["numbers"].values()):
            for row in numbers["rows"]:
                row.pop("line", None)
        assert answer == plain


def test_words_are_held_against_words(ask, comity):
    text = HEAD + "a,JPN,,greeting_gesture,bow,,,,,\na,DEU,,greeting_gesture,bow,,,,,\n"
    answer = ask(text)
    assert answer["numbers"] == {}
    assert answer["words"]["greeting_gesture"]["studies"]["a"] == {"rows": 2, "hits": 1, "constant_hits": 2}
    assert "1 of 2" in comity("evaluate", "bruno2017", "t.csv").out


def test_facts_that_a_rulebook_does_not_know_are_said(ask, comity):
    answer = ask(GOOD, rulebook="bruno2017-case1")
    assert answer["unused"] == ["gender"]
    assert "gender" in comity("evaluate", "bruno2017-case1", "t.csv").out.splitlines()[2]


def test_the_standard_error_is_said_where_it_is_known(ask):
    first, second = ask(GOOD)["numbers"]["conversational_distance"]["rows"]
    assert first["sd"] == pytest.approx(0.1)
    assert first["standard_error"] == pytest.approx(0.1 / 20**0.5)
    assert second["standard_error"] is None


def test_a_picture_is_drawn_the_same_every_time_and_replaces_nothing_else(comity, here):
    answer = comity("evaluate", "bruno2017", "--picture", "e.png", "--json").json
    assert answer["files"] == ["e.png"]
    first = (here / "e.png").read_bytes()
    comity("evaluate", "bruno2017", "--picture", "e.png")
    assert (here / "e.png").read_bytes() == first
    (here / "thesis.png").write_text("seven chapters")
    assert comity("evaluate", "bruno2017", "--picture", "thesis.png").code == 2
    assert (here / "thesis.png").read_text() == "seven chapters"


def test_a_study_may_be_called_anything(ask, here):
    r"""`$\frac` is no formula, `[red]` no colour."""
    for name in ("$\\frac{1$ 2$", "[red]x", "_hidden"):
        ask(GOOD.replace("\na,", f"\n{name},"), "--picture", "odd.png")
        ask(HEAD + f"{GOOD.splitlines()[1]}\n".replace("a,", f"{name},", 1) * 50, "--picture", "odd.png")


def test_thousands_of_rows_are_evaluated_and_drawn(ask, here):
    source = random.Random(0)
    rows = [
        f"s{i % 3},{culture},,conversational_distance,{source.uniform(50, 150):.1f},cm,,,,\n"
        for i, culture in enumerate(source.choices(["DEU", "JPN", "CHN"], k=2000))
    ]
    answer = ask(HEAD + "".join(rows), "--picture", "many.png")
    assert answer["rows"] == 2000
    assert (here / "many.png").exists()


def test_separators_at_the_end_of_a_row_are_no_cells(ask):
    """Spreadsheets write them."""
    assert ask(GOOD.replace("20,10\n", "20,10,,,\n")) == ask(GOOD)


def row(**changes):
    """The good row with some cells changed, below its headings."""
    cells = dict(zip(HEAD.strip().split(","), GOOD.splitlines()[1].split(","), strict=True)) | changes
    return HEAD + ",".join(cells.values()) + "\n"


BAD = {
    "a missing heading": (GOOD.replace(",unit", ",einheit"), ":1", ["none called 'unit'", "Add it"]),
    "a heading with a slip": (GOOD.replace(",gender", ",gendr"), ":1", ["'gendr'", "Did you mean 'gender'?"]),
    "a heading twice": (GOOD.replace(",gender", ",culture"), ":1", ["'culture' twice"]),
    "no headings at all": ("", None, ["line of headings"]),
    "no rows": (HEAD, None, ["at least one row"]),
    "a code of no country": (row(culture="JPM"), ":2", ["'JPM'", "ISO 3166"]),
    "an unknown gender": (row(gender="femal"), ":2", ["gender", "Did you mean 'female'?"]),
    "an unknown parameter": (row(parameter="distance"), ":2", ["a parameter of the rulebook bruno2017"]),
    "no parameter": (row(parameter=""), ":2", ["got nothing"]),
    "no unit": (row(unit=""), ":2", ["one of the units m, cm", "no unit"]),
    "a unit of something else": (row(unit="deg"), ":2", ["'deg'", "Write it in m."]),
    "text for a number": (row(value="far"), ":2", ["a finite number as conversational_distance", "'far'"]),
    "no value": (row(value=""), ":2", ["a finite number"]),
    "metres that are centimetres": (row(unit="m"), ":2", ["of at most 30 m", "85 m", "Check the unit"]),
    "a deviation beyond everything": (row(sd="1e308"), ":2", ["at most 30 m", "Check the unit"]),
    "infinity": (row(value="1e999"), ":2", ["a finite number"]),
    "not a number": (row(value="nan"), ":2", ["a finite number"]),
    "an unknown convention": (row(measured="skin"), ":2", ["surface or centre as measured", "'skin'"]),
    "an unknown partner": (row(partner="dog"), ":2", ["robot or person as partner"]),
    "half a person": (row(n="2.5"), ":2", ["a whole number of people"]),
    "nobody": (row(n="0"), ":2", ["a whole number of people"]),
    "a negative deviation": (row(sd="-1"), ":2", ["sd of 0 or more"]),
    "a category that is none": (
        row(parameter="greeting_gesture", value="bwo", unit="", measured=""),
        ":2",
        ["Did you mean 'bow'?"],
    ),
    "a convention for a speed": (
        row(parameter="approach_speed", value="0.5", unit="m/s", sd="0.1"),
        ":2",
        ["Leave `measured` empty"],
    ),
    "a distance below nothing": (
        row(value="-85"),
        ":2",
        ["conversational_distance of 0 m or more", "-0.85 m", "Check the sign"],
    ),
    "more cells than headings": (
        GOOD + GOOD.splitlines()[1] + ",surplus\n",
        ":4",
        ["at most 10 cells in a row", "got 11", "in quotes"],
    ),
    "a decimal comma between commas": (
        row(value="85,5"),
        ":2",
        ["at most 10 cells", "got 11", "in quotes"],
    ),
    "another separator": (GOOD.replace(",", "|"), ":1", ["'|' between them"]),
    "too many rows": (HEAD + f"{GOOD.splitlines()[1]}\n" * 5001, ":5002", ["at most 5000 rows", "Split"]),
    "an endless field": ("x" * 200_000 + ",y\n1,2\n", ":1", ["field larger"]),
    "a zip archive": ("PK\x03\x04\x00\x00", ":1", ["none called"]),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_tables_are_refused_with_file_line_and_remedy(comity, here, case):
    text, place, words = BAD[case]
    (here / "t.csv").write_text(text, encoding="utf-8")
    said = comity("evaluate", "bruno2017", "t.csv", "--picture", "e.png")
    assert (said.code, said.out) == (2, "")
    assert f"t.csv{place or ''}:" in said.err
    assert all(word in said.err for word in words), said.err
    assert not (here / "e.png").exists()


@pytest.mark.parametrize("name", ["none.csv", ".", "smal-studies", "\0", "x" * 5000])
def test_a_table_that_is_not_there_is_refused(comity, name):
    said = comity("evaluate", "bruno2017", name)
    assert (said.code, said.out) == (2, "")
    assert "CSV file" in said.err or "usable path" in said.err


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.one_of(st.binary(max_size=300), st.text(max_size=200).map(str.encode)))
def test_random_bytes_are_refused_or_read(tmp_path: Path, content):
    """Alone, and below good headings: an answer or an `InputError`, never anything else."""
    book = load_rulebook("bruno2017")
    for text in (content, HEAD.encode() + content):
        (tmp_path / "t.csv").write_bytes(text)
        with suppress(InputError):
            evaluate(book, read_measurements(str(tmp_path / "t.csv"), book))


def test_the_shipped_table_names_a_source_for_every_row():
    book = load_rulebook("bruno2017")
    rows = read_measurements(SHIPPED, book).rows
    assert all(one.source and one.note for one in rows)
    assert {one.facts.get("culture") for one in rows if one.study == "eresha2013"} == {
        "DEU",
        "Arab countries",
    }
    assert [one.value for one in rows[:2]] == pytest.approx([0.85, 0.65])
    text = (Path(comity.__file__).parent / "measured" / f"{SHIPPED}.csv").read_text()
    assert len(next(csv.reader(line for line in text.splitlines() if not line.startswith("#")))) == 12
