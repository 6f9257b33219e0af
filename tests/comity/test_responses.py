"""`comity figures RULEBOOK`: what the pictures show is what the rulebook answers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from comity.report.rulebooks.response import MOST_SURFACES, responses
from comity.report.rulebooks.response_picture import response_picture
from comity_fis import NominalParameter, load_rulebook, shipped_rulebooks

DATA = Path(__file__).parents[1] / "fis" / "data"
BOOKS = {name: load_rulebook(name) for name in shipped_rulebooks()}
BOOKS |= {name: load_rulebook(DATA / f"{name}.fis") for name in ("tipping", "curves")}
SHOWN = {
    (name, parameter): responses(book, parameter, {})
    for name, book in BOOKS.items()
    for parameter in book.parameters
}
DRAWN = [key for key, shown in SHOWN.items() if shown.curves]


def answer(book, parameter, facts):
    """One value, or the place of one category."""
    value = book.infer(facts)[parameter].value
    decided = book.parameters[parameter]
    return decided.terms.index(value) if isinstance(decided, NominalParameter) else value


@given(st.sampled_from(DRAWN), st.data())
def test_every_point_of_a_curve_is_what_the_rulebook_answers(key, data):
    book, parameter = BOOKS[key[0]], key[1]
    curve = data.draw(st.sampled_from(SHOWN[key].curves))
    place = data.draw(st.integers(0, len(curve.places) - 1))
    x = curve.places[place]
    told = {curve.variable.name: x if isinstance(x, str) else float(x)}
    assert curve.value[place] == pytest.approx(answer(book, parameter, told), abs=1e-6)
    for category, values in curve.lines.items():
        assert values[place] == pytest.approx(answer(book, parameter, {**told, curve.by: category}), abs=1e-6)


@given(st.sampled_from([key for key in DRAWN if SHOWN[key].surfaces]), st.data())
def test_every_point_of_a_surface_is_what_the_rulebook_answers(key, data):
    surface = data.draw(st.sampled_from(SHOWN[key].surfaces))
    i, j = (data.draw(st.integers(0, len(surface.xs) - 1)) for _ in "xy")
    told = {surface.across.name: float(surface.xs[i]), surface.up.name: float(surface.ys[j])}
    assert surface.values[j, i] == pytest.approx(answer(BOOKS[key[0]], key[1], told), abs=1e-6)


def test_the_lines_of_the_papers_second_case_are_the_edges_of_its_band():
    """Each gender for itself is as far as gender can move the distance."""
    (curve, _) = SHOWN["bruno2017-case2", "conversational_distance"].curves
    every = np.vstack([curve.value, curve.others])
    assert curve.by == "gender"
    assert curve.lines["female"] == pytest.approx(every.min(axis=0))
    assert curve.lines["male"] == pytest.approx(every.max(axis=0))


def test_a_held_fact_is_no_axis_and_holds_everywhere():
    book = BOOKS["bruno2017-case2"]
    shown = responses(book, "conversational_distance", {"gender": "male"})
    (curve,) = shown.curves
    assert shown.held == {"gender": "male"}
    assert (
        curve.value[0] == book.infer({"individualism": 0, "gender": "male"})["conversational_distance"].value
    )


def test_an_input_that_changes_nothing_has_no_panel_and_is_named():
    shown = responses(BOOKS["bruno2017"], "greeting_gesture", {"culture": "SWE"})
    assert "touch_consent" in shown.without_effect
    assert "touch_consent" not in [curve.variable.name for curve in shown.curves]


@pytest.mark.parametrize("count", [2, 3, 5])
def test_surfaces_are_at_most_four_and_the_rest_is_counted(small_of, count):
    shown = responses(small_of(count), "y", {})
    pairs = count * (count - 1) // 2
    assert len(shown.surfaces) == min(pairs, MOST_SURFACES)
    assert len(shown.surfaces) + shown.left_out == pairs


@pytest.fixture
def small_of(tmp_path):
    """A rulebook in which each of so many numbers raises the one parameter."""

    def made(count):
        terms = "{low: {trapezoid: [0, 0, 0, 1]}, high: {trapezoid: [0, 1, 1, 1]}}"
        shape = f"range: [0, 1], terms: {terms}, shapes: design, reason: made up"
        variables = "".join(f"  x{i}: {{kind: culture, level: ratio, {shape}}}\n" for i in range(count))
        rules = "".join(
            f"  - {{rule: if x{i} is {term} then y is {term}, sources: [book], evidence: weak}}\n"
            for i in range(count)
            for term in ("low", "high")
        )
        path = tmp_path / "many.yaml"
        path.write_text(
            f"""schema_version: 1
name: many
description: many numbers
sources: {{book: {{citation: A book, verified: read}}}}
variables:
{variables}parameters:
  y:
    kind: behaviour
    level: ratio
    unit: "1"
    rules: [0, 1]
    ask: [0, 1]
    terms: {terms}
    shapes: design
    neutral: 0.5
    spread: 0.1
    reasons: {{ranges: made up, terms: made up, neutral: made up, spread: made up}}
rules:
{rules}"""
        )
        return load_rulebook(path)

    return made


@settings(max_examples=8)
@given(st.sampled_from(DRAWN), st.sampled_from(["png", "svg"]))
def test_the_same_picture_has_the_same_bytes(key, form):
    once, again = (response_picture(SHOWN[key], key[0], form) for _ in range(2))
    assert once == again
    assert b"Comity" in once[:1024]


def test_a_picture_for_every_parameter_that_something_changes(comity, here):
    said = comity("figures", "evidence", "--out", "figures", "--json")
    files = sorted(path.stem for path in (here / "figures").iterdir())
    assert files == sorted(parameter for book, parameter in DRAWN if book == "evidence")
    assert sorted(files + said.json["without_inputs"]) == sorted(BOOKS["evidence"].parameters)


def test_one_parameter_goes_to_a_file_in_the_format_of_its_ending(comity, here):
    for name, start in (("a.svg", b"<?xml"), ("b.png", b"\x89PNG")):
        said = comity("figures", DATA / "tipping.fis", "--parameter", "tip", "--out", name)
        assert said.code == 0, said.err
        assert (here / name).read_bytes().startswith(start)
    assert comity("figures", DATA / "tipping.fis", "--parameter", "tip", "--out", "a.svg").code == 0


@pytest.mark.parametrize(
    ("asked", "named"),
    [
        (["bruno2017", "--out", "a.png"], "--parameter conversational_distance"),
        (["bruno2017", "--out", "a.eps"], ".svg"),
        (["bruno2017", "--parameter", "aproach_speed", "--out", "o"], "approach_speed"),
        (["bruno2017-case1", "--set", "individualism=4", "--out", "o"], "some input changes"),
        (["bruno2017", "--set", "age=30..40", "--out", "o"], "one value for age"),
        (["bruno2017", "--set", "age=300", "--out", "o"], "0..117"),
        (["--set", "age=30", "--out", "o"], "a rulebook for --set"),
        (["--parameter", "x", "--out", "o"], "a rulebook for --parameter"),
        (["--out", "a.png"], "a folder for the paper's figures"),
    ],
)
def test_what_cannot_be_drawn_is_refused_and_nothing_is_written(comity, here, asked, named):
    said = comity("figures", *asked)
    assert said.code == 2
    assert named in said.err
    assert not list(here.iterdir())
