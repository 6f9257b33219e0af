"""`comity figures`: every figure of the paper that the fuzzy layer can make."""

from __future__ import annotations

import struct

import pytest

from comity.report.values.figures import FIGURES
from comity.report.values.mapping_picture import NON_DECREASING
from comity.report.values.paper import distance_cm
from comity_fis import load_rulebook


@pytest.fixture(scope="module")
def pictures():
    return {name: figure.draw() for name, figure in FIGURES.items()}


def test_the_set_is_complete(pictures):
    assert list(pictures) == [
        "variable-gender",
        "variable-education",
        "variable-age",
        "individualism-scores",
        "individualism-clusters",
        "individualism-terms",
        "output-case1",
        "output-case2",
        "mapping-case1",
        "mapping-case2",
    ]


@pytest.mark.parametrize("name", FIGURES)
def test_a_picture_is_wide_says_whose_it_is_and_has_no_date(pictures, name):
    png = pictures[name]
    width, height = struct.unpack(">II", png[16:24])
    assert width == 1200
    assert 300 < height < 1600
    assert b"Software\x00Comity" in png[:1024]
    assert b"20" not in png[:1024].split(b"IDAT")[0][60:]
    assert len(set(png)) > 100  # not blank


def test_the_same_figure_has_the_same_bytes_whatever_the_users_settings(pictures):
    import matplotlib

    with matplotlib.rc_context({"lines.linewidth": 9, "axes.facecolor": "black", "font.size": 30}):
        for name in ("variable-age", "mapping-case1"):
            assert FIGURES[name].draw() == pictures[name]


def test_they_are_written_renewed_and_listed(comity, here):
    said = comity("figures", "--out", "figures")
    assert said.code == 0
    assert sorted(path.stem for path in (here / "figures").iterdir()) == sorted(FIGURES)
    assert all(name in said.out for name in FIGURES)
    again = comity("figures", "--out", "figures", "--json")
    assert [figure["file"] for figure in again.json["figures"]] == [f"figures/{name}.png" for name in FIGURES]


@pytest.mark.parametrize(("form", "start"), [("svg", b"<?xml"), ("pdf", b"%PDF")])
def test_a_folder_has_them_in_the_form_that_is_asked_for(comity, here, form, start):
    assert comity("figures", "--out", "paper", "--format", form).code == 0
    assert comity("figures", "bruno2017", "--out", "rules", "--format", form).code == 0
    files = [*(here / "paper").iterdir(), *(here / "rules").iterdir()]
    assert {file.suffix for file in files} == {f".{form}"}
    assert all(file.read_bytes().startswith(start) for file in files)
    assert comity("figures", "--out", "paper", "--format", form).code == 0, "its own pictures are renewed"


def test_a_file_that_ends_otherwise_than_asked_for_is_refused(comity, here):
    said = comity("figures", "bruno2017", "--out", "a.png", "--format", "svg")
    assert (said.code, list(here.iterdir())) == (2, [])
    assert "a.svg" in said.err


def test_a_picture_of_somebody_else_is_left_alone(comity, here):
    theirs = here / "mapping-case2.png"
    theirs.write_bytes(b"\x89PNG by somebody else")
    said = comity("figures", "--out", ".")
    assert said.code == 2
    assert "mapping-case2.png" in said.err
    assert [path.read_bytes() for path in here.iterdir()] == [b"\x89PNG by somebody else"]


def test_a_file_is_no_folder(comity, here):
    (here / "out").write_text("")
    assert comity("figures", "--out", "out").code == 2


@pytest.mark.parametrize(("case", "gender"), [(1, None), (2, "female"), (2, "male")])
def test_the_shaded_ends_are_where_a_larger_score_may_mean_less(case, gender):
    rulebook = load_rulebook(f"bruno2017-case{case}")
    low, high = NON_DECREASING
    inside = [distance_cm(rulebook, x, gender) for x in range(low, high + 1)]
    assert inside == sorted(inside)


def test_with_gender_not_disclosed_the_distance_falls_by_a_hundredth_of_a_millimetre_at_the_low_end():
    rulebook = load_rulebook("bruno2017-case2")
    cm = {score: distance_cm(rulebook, score, None) for score in (15, 15.82, 16, 20, 40, 60, 80)}
    assert 100 * (cm[15] - cm[15.82]) == pytest.approx(0.08, abs=0.01)
    later = [cm[score] for score in (15.82, 16, 20, 40, 60, 80)]
    assert later == sorted(later)
