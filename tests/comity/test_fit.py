"""`comity fit`: any column of numbers becomes a linguistic variable, or the answer says why not."""

from __future__ import annotations

import random
from contextlib import suppress
from importlib.resources import files

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from comity.tables.column import read_column
from comity_fis import InputError, load_rulebook, read_rulebook

SHIPPED = str(files("comity_fis").joinpath("data/individualism.csv"))
TWO_GROUPS = [3, 4, 5, 5, 6, 7, 8, 44, 45, 46, 46, 47, 48, 50]


def table(*cells, heading="score", separator=","):
    return f"name{separator}{heading}\n" + "".join(f"x{separator}{cell}\n" for cell in cells)


def test_the_shipped_scores_give_the_papers_partition(comity, here):
    said = comity("fit", SHIPPED, "--column", "individualism", "--json")
    assert said.code == 0
    answer = said.json
    assert (answer["values"], answer["empty"], answer["low"], answer["high"]) == (78, 0, 6, 91)
    assert {row["radius"] for row in answer["clusters"] if row["clusters"] == 2} == {
        r / 20 for r in range(7, 16)
    }
    assert [round(term["centre"], 3) for term in answer["terms"].values()] == [24.344, 68.616]
    assert [round(term["squared_error"], 5) for term in answer["terms"].values()] == [0.04136, 0.03098]
    assert not list(here.iterdir())


def test_what_is_written_stands_in_a_rulebook_and_gives_the_papers_distances(comity, here):
    said = comity(
        "fit", SHIPPED, "--column", "individualism", "--range", 0, 100, "--level", "ordinal",
        "--coercion", "The paper clusters them.", "--out", "idv.yaml",
    )  # fmt: skip
    assert said.code == 0
    fragment = "".join(f"  {line}\n" for line in (here / "idv.yaml").read_text().splitlines())
    text = read_rulebook("bruno2017-case2").text
    start, end = text.index("  individualism:\n"), text.index("  gender:\n")
    (here / "mine.yaml").write_text(text[:start] + fragment + text[end:])
    mine, shipped = load_rulebook(here / "mine.yaml"), load_rulebook("bruno2017-case2")
    for score in range(0, 101, 5):
        person = {"individualism": score, "gender": "female"}
        assert mine.infer(person)["conversational_distance"].number == pytest.approx(
            shipped.infer(person)["conversational_distance"].number, abs=1e-7
        )


def test_without_a_file_to_write_the_variable_is_printed(comity):
    said = comity("fit", SHIPPED, "--column", "individualism")
    assert "individualism:\n  kind: culture\n  level: interval\n  range: [6.0, 91.0]\n" in said.out
    assert "0.35..0.75" in said.out
    assert "0.04136" in said.out


def test_one_cluster_is_an_answer_with_the_radius_that_gives_more(comity, here):
    said = comity("fit", SHIPPED, "--column", "individualism", "--radius", 0.9, "--out", "x.yaml")
    assert said.code == 1
    assert "One cluster at radius 0.9" in said.out
    assert "A radius of 0.75 gives 2." in said.out
    assert not list(here.iterdir())
    answer = comity("fit", SHIPPED, "--column", "individualism", "--radius", 0.9, "--json")
    assert answer.code == 1
    assert (answer.json["terms"], answer.json["variable"], answer.json["radius_for_more"]) == ({}, None, 0.75)
    assert comity("fit", SHIPPED, "--column", "individualism", "--radius", 0.75, "--json").code == 0


def test_ordinal_data_need_a_declared_coercion(comity):
    said = comity("fit", SHIPPED, "--column", "individualism", "--level", "ordinal")
    assert said.code == 2
    assert "coercion to interval" in said.err


@pytest.mark.parametrize("radius", [0.5, 0.9])
def test_a_picture_is_drawn_whatever_the_data_give(comity, here, radius):
    words = [
        "fit",
        SHIPPED,
        "--column",
        "individualism",
        "--radius",
        radius,
        "--picture",
        "fit.png",
        "--json",
    ]
    assert comity(*words).json["files"] == ["fit.png"]
    first = (here / "fit.png").read_bytes()
    assert first.startswith(b"\x89PNG")
    comity(*words)
    assert (here / "fit.png").read_bytes() == first


def test_hundreds_of_values_are_drawn_and_fitted(comity, here):
    source = random.Random(0)
    values = [source.gauss(20, 4) for _ in range(200)] + [source.gauss(60, 6) for _ in range(200)]
    (here / "many.csv").write_text(table(*values))
    said = comity("fit", "many.csv", "--column", "score", "--picture", "many.png", "--json")
    assert [round(term["centre"]) for term in said.json["terms"].values()] == [20, 60]


@pytest.mark.parametrize(("option", "name"), [("--out", "thesis"), ("--picture", "thesis.png")])
def test_nothing_of_somebody_else_is_overwritten(comity, here, option, name):
    (here / name).write_text("seven chapters")
    said = comity("fit", SHIPPED, "--column", "individualism", option, name)
    assert said.code == 2
    assert "nothing is overwritten" in said.err
    assert [path.read_text() for path in here.iterdir()] == ["seven chapters"]


@pytest.mark.parametrize("place", [".", "no/where.yaml", "x" * 300])
def test_a_place_that_cannot_be_written_is_refused_before_anything_else(comity, here, place):
    said = comity("fit", "missing.csv", "--column", "x", "--out", place)
    assert (said.code, said.out) == (2, "")
    assert "a place to write to" in said.err
    assert not list(here.iterdir())


BAD = {
    "no such column": (table(*TWO_GROUPS), ["x.csv:1", "Did you mean 'score'?"], "scores"),
    "a word": (table(1, 2, "many", 4), ["x.csv:4", "'many'"], "score"),
    "not a number": (table(1, "nan", 3), ["x.csv:3", "'nan'", "leave it empty"], "score"),
    "infinite": (table(1, "1e999"), ["x.csv:3", "'1e999'"], "score"),
    "an underscore": (table("1_000"), ["x.csv:2"], "score"),
    "a comment before": ("# by us\n\n" + table(1, "?"), ["x.csv:5", "'?'"], "score"),
    "too few": (table(1, 2, 3), ["at least 4 different"], "score"),
    "all the same": (table(*[4] * 40), ["1 among 40"], "score"),
    "no rows": (table(), ["at least 4 different"], "score"),
    "nothing": ("", ["line of headings"], "score"),
    "only comments": ("# a\n# b\n", ["line of headings"], "score"),
    "a heading twice": ("score,score\n1,2\n", ["2 times"], "score"),
    "too many": (table(*range(5001)), ["at most 5000"], "score"),
    "many lines in one field": ('name,score\n"a\nb",1\nx,?\n', ["x.csv:4"], "score"),
    "a field without end": ('name,score\n"' + "x" * 200_000, ["x.csv:2"], "score"),
    "more cells than headings": (
        "name,score\nx,1\ny,2,5\n",
        ["x.csv:3", "at most 2 cells", "got 3"],
        "score",
    ),
    "another separator": ("name|score\nx|1\n", ["x.csv:1", "'|' between them"], "score"),
    "blanks between": ("name score\nx 1\n", ["x.csv:1", "commas, semicolons or tabs"], "score"),
    "a heading as long as a book": ("a;" * 200_000 + "\n", ["x.csv:1", "heading of one column"], "score"),
    "numbers without differences": (table(1e308, -1e308, 1, 2, 3), ["differences"], "score"),
    "a range that rounding makes": (table(*(1e16 + 2 * k for k in range(8))), ["differences"], "score"),
    "bytes": (b"\xff\xfe\x00s", ["UTF-8"], "score"),
    "a null byte": (b"score\n1\x002\n", ["x.csv:2"], "score"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_bad_file_is_refused_with_line_and_remedy(comity, here, kind):
    content, expected, column = BAD[kind]
    (here / "x.csv").write_bytes(content if isinstance(content, bytes) else content.encode())
    said = comity("fit", "x.csv", "--column", column)
    assert (said.code, said.out) == (2, ""), said
    for word in expected:
        assert word in said.err
    assert "Traceback" not in said.err


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["--level", "ratio", "--range", -5, 100], "the level is interval"),
        (["--range", 100, 0], "first end is below"),
        (["--range", "nan", 100], "first end is below"),
        (["--range", 0, "inf"], "a finite range"),
    ],
)
def test_a_range_that_cannot_be_is_refused_as_the_range(comity, options, expected):
    said = comity("fit", SHIPPED, "--column", "individualism", *options)
    assert (said.code, said.out) == (2, "")
    assert expected in said.err


def test_negative_data_are_not_of_ratio_level(comity, here):
    (here / "x.csv").write_text(table(-5, -4, -4, -3, 30, 31, 32))
    said = comity("fit", "x.csv", "--column", "score", "--level", "ratio", "--json")
    assert (said.code, said.out) == (2, "")
    assert "the level is interval" in said.err


def test_reading_stops_at_the_first_value_too_many(comity, here):
    (here / "x.csv").write_text(table(*range(5003)) + "x,many\n")
    said = comity("fit", "x.csv", "--column", "score")
    assert said.code == 2
    assert "x.csv:5002: expected at most 5000 numbers" in said.err


def test_missing_values_of_r_are_skipped_and_counted(comity, here):
    (here / "x.csv").write_text(table(*TWO_GROUPS, "NA", "", "NA"))
    assert comity("fit", "x.csv", "--column", "score", "--json").json["empty"] == 3


def test_seven_point_answers_give_terms_with_one_peak_and_the_reason_is_said(comity, here):
    answers = [1] * 14 + [2] * 16 + [3] * 7 + [5] * 9 + [6] * 8 + [7] * 6
    (here / "x.csv").write_text(table(*answers))
    words = ("fit", "x.csv", "--column", "score", "--out", "x.yaml")
    said = comity(*words)
    assert "LC1 is held: 6 different values" in said.out
    assert "held: {LC1: 6 different values" in (here / "x.yaml").read_text()
    term = comity(*words, "--json").json["terms"]["LC1"]
    assert (term["form"], term["largest_error"] < 0.05) == ("held", True)
    assert max(height for height, _, _ in term["two_term_gaussian"]) <= 1


def test_what_is_written_is_as_fine_as_the_data(comity, here):
    (here / "x.csv").write_text(table(*(1_700_000_000 + value / 100 for value in TWO_GROUPS)))
    said = comity("fit", "x.csv", "--column", "score", "--json")
    assert said.json["variable"]["range"] == [1_700_000_000.03, 1_700_000_000.5]
    assert said.json["variable"]["partition"]["centres"] == pytest.approx(
        [term["centre"] for term in said.json["terms"].values()], abs=1e-6, rel=0
    )
    tiny = table(*(value * 1e-7 for value in TWO_GROUPS))
    (here / "x.csv").write_text(tiny)
    assert "5.4276e-07" in comity("fit", "x.csv", "--column", "score").out


@pytest.mark.parametrize("file", ["missing.csv", ".", "/dev/zero"])
def test_no_file_is_refused(comity, file):
    said = comity("fit", file, "--column", "x")
    assert said.code == 2
    assert "a CSV file" in said.err


def test_a_huge_file_is_refused_unread(comity, here):
    with (here / "x.csv").open("wb") as file:
        file.truncate(30_000_000)
    assert "at most 20000000 bytes" in comity("fit", "x.csv", "--column", "x").err


@pytest.mark.parametrize(
    "text",
    [
        table(*TWO_GROUPS),
        table(*TWO_GROUPS, separator=";"),
        table(*(f"{v},0" for v in TWO_GROUPS), separator=";"),
        table(*TWO_GROUPS, separator="\t"),
        "\ufeff" + table(*TWO_GROUPS),
        "# where from: a, b; c\n" + table(*TWO_GROUPS).replace("\n", "\r\n"),
        table(*TWO_GROUPS, heading=' "score" '.strip()),
    ],
    ids=["comma", "semicolon", "decimal comma", "tab", "byte order mark", "comment and CRLF", "quoted"],
)
def test_the_usual_ways_to_write_a_table_are_understood(here, text):
    (here / "x.csv").write_bytes(text.encode())
    assert read_column(here / "x.csv", "score").values == tuple(TWO_GROUPS)


def test_empty_cells_are_skipped_and_counted(comity, here):
    (here / "x.csv").write_text(table(*TWO_GROUPS, "", "  ") + "short row\n")
    said = comity("fit", "x.csv", "--column", "score")
    assert said.code == 0
    assert "14 values from 3 to 50, 3 empty or NA cells skipped" in said.out


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=200) | st.text(alphabet='a,;"\n\r1.#\x00 ', max_size=60).map(str.encode))
def test_no_bytes_crash_the_reader(here, content):
    (here / "x.csv").write_bytes(content)
    with suppress(InputError):
        read_column(here / "x.csv", "a")
