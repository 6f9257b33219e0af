"""Scores by subscale: reversed, missing and broken answers, and how reliable a subscale is."""

from __future__ import annotations

import csv
import io
from itertools import product

import numpy as np
import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity.study.questionnaires.answers_table import AnswerSheet, AnswersTable, read_answers
from comity.study.questionnaires.questionnaire_file import (
    QuestionnaireFile,
    load_questionnaire,
    shipped_questionnaires,
)
from comity.study.questionnaires.reliability import reliability_of
from comity.study.questionnaires.scoring import scored
from comity_fis import InputError

ITEMS = {"a": ["x"], "b": ["x", "y"], "c": ["x"], "d": ["y"]}
ANSWERS = st.lists(st.lists(st.none() | st.integers(1, 5), min_size=4, max_size=4), min_size=1, max_size=12)


def questionnaire(reversed_items="", **keys) -> QuestionnaireFile:
    items = {one: {"subscales": of, "reversed": one in reversed_items} for one, of in ITEMS.items()}
    content = {"schema_version": 1, "name": "q", "source": "design choice", "scale": {"from": 1, "to": 5}}
    return QuestionnaireFile.model_validate({**content, "items": items, **keys})


def table_of(rows) -> AnswersTable:
    return AnswersTable(
        "answers.csv",
        tuple(
            AnswerSheet(f"P{i}", "", {one: float(cell) for one, cell in zip(ITEMS, row, strict=True) if cell})
            for i, row in enumerate(rows)
        ),
        (),
    )


@given(ANSWERS, st.sets(st.sampled_from("abcd")))
def test_an_item_that_is_reversed_with_its_answers_changes_nothing(rows, turned):
    mirrored = [
        [6 - cell if cell and item in turned else cell for item, cell in zip(ITEMS, row, strict=True)]
        for row in rows
    ]
    assert scored(questionnaire(turned), table_of(mirrored)) == scored(questionnaire(), table_of(rows))


@given(ANSWERS, st.floats(0.01, 1))
def test_a_score_lies_among_the_answers_and_needs_the_stated_share(rows, share):
    for one in scored(questionnaire(answered_at_least=share), table_of(rows)):
        places = [list(ITEMS).index(item) for item in one.items]
        assert 1 <= one.needed <= len(one.items)
        assert one.needed - 1 < share * len(one.items) <= one.needed
        for row, score, answered in zip(rows, one.scores, one.answered, strict=True):
            given_answers = [row[place] for place in places if row[place]]
            assert answered == len(given_answers)
            assert (score is None) == (answered < one.needed)
            if score is not None:
                assert score == pytest.approx(sum(given_answers) / answered)


def test_an_item_counts_in_each_of_its_subscales():
    found = {one.name: one.scores for one in scored(questionnaire(), table_of([[1, 4, 1, 2]]))}
    assert found == {"x": (2.0,), "y": (3.0,)}


@given(st.integers(2, 6), st.integers(8, 20), st.integers(0, 99))
def test_alpha_is_that_of_the_covariances_and_rises_to_1_with_items_that_agree(items, people, seed):
    frame = pd.DataFrame(np.random.default_rng(seed).normal(size=(people, items)))
    expected = items / (items - 1) * (1 - frame.var().sum() / frame.sum(axis=1).var())
    found = reliability_of(frame.to_numpy(), np.arange(people))
    assert found.alpha == pytest.approx(expected)
    assert found.low <= found.high <= 1 + 1e-9
    same = np.repeat(frame[[0]].to_numpy(), items, axis=1)
    assert reliability_of(same, np.arange(people)).alpha == pytest.approx(1)


def test_alpha_of_a_known_covariance():
    """The example of Julia's StatsBase.cronbachalpha: 0.8136."""
    covariance = np.array([[10, 6, 6, 6], [6, 11, 6, 6], [6, 6, 12, 6], [6, 6, 6, 13]])
    drawn = np.random.default_rng(0).normal(size=(50, 4))
    white = (drawn - drawn.mean(axis=0)) @ np.linalg.inv(np.linalg.cholesky(np.cov(drawn.T))).T
    data = white @ np.linalg.cholesky(covariance).T
    assert reliability_of(data, np.arange(50)).alpha == pytest.approx(0.8136, abs=5e-5)


@given(st.integers(3, 12), st.integers(0, 9))
def test_a_person_whose_sheets_come_twice_is_one_person_still(people, seed):
    data = np.random.default_rng(seed).integers(1, 6, size=(people, 3)).astype(float)
    data[0], data[1] = (1, 1, 1), (5, 5, 4)
    once, twice = (reliability_of(np.tile(data, (n, 1)), np.tile(np.arange(people), n)) for n in (1, 2))
    assert once.participants == twice.participants == people
    assert (twice.low, twice.high) == (pytest.approx(once.low), pytest.approx(once.high))


def test_alpha_without_a_value_says_so():
    for data in ([[1.0], [2.0]], [[1.0, 2.0]], [[3.0, 3.0], [3.0, 3.0]], [[np.nan, 1.0], [2.0, np.nan]]):
        found = reliability_of(np.array(data), np.arange(len(data)))
        assert (found.alpha, found.low, found.high) == (None, None, None)


def test_the_interval_covers_the_true_alpha_about_as_often_as_it_says():
    """Four items of one factor: alpha is 4 r / (1 + 3 r) for the correlation r of two items."""
    random, true, covered = np.random.default_rng(3), 4 * 0.4 / (1 + 3 * 0.4), 0
    for _ in range(60):
        data = random.normal(size=(60, 1)) * 0.4**0.5 + random.normal(size=(60, 4)) * 0.6**0.5
        found = reliability_of(data, np.arange(60))
        covered += found.low <= true <= found.high
    assert covered / 60 >= 0.85


def long(rows: list[dict[str, object]]) -> str:
    text = io.StringIO()
    writer = csv.DictWriter(text, rows[0], lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def test_a_row_for_each_answer_and_a_row_for_each_sheet_say_the_same(tmp_path):
    sheets = list(product(["P01", "P02"], ["near", "far"]))
    cells = {
        (*sheet, item): 1 + (3 * i + j) % 5 for i, sheet in enumerate(sheets) for j, item in enumerate(ITEMS)
    }
    wide = [{"participant": p, "condition": c, **{i: cells[p, c, i] for i in ITEMS}} for p, c in sheets]
    tall = [
        {"participant": p, "condition": c, "questionnaire": "q", "item": i, "answer": cell}
        for (p, c, i), cell in cells.items()
    ]
    tall.append({**tall[0], "questionnaire": "another", "item": "z"})
    (tmp_path / "wide.csv").write_text(long(wide))
    (tmp_path / "long.csv").write_text(long(tall))
    both = [read_answers(tmp_path / f"{name}.csv", questionnaire()) for name in ("wide", "long")]
    assert both[0].sheets == both[1].sheets
    assert both[0].conditions == ("near", "far")


WIDE = "participant,condition,a,b,c,d\nP01,near,1,2,3,4\nP01,far,1,,NA,4\n"
LONG = "participant,item,answer\nP01,a,1\nP01,b,2\n"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (WIDE.replace("3,4", "3,6"), 2),
        (WIDE.replace("3,4", "3,2.5"), 2),
        (WIDE.replace("3,4", "3,often"), 2),
        (WIDE.replace("P01,far", "P01,near"), 3),
        (WIDE.replace("P01,far", ",far"), 3),
        (WIDE.replace(",d\n", ",dd\n"), 1),
        (WIDE.replace(",d\n", ",a\n"), 1),
        (WIDE.replace("participant", "person"), 1),
        (LONG.replace("b,2", "a,2"), 3),
        (LONG.replace("b,2", "e,2"), 3),
        (LONG.replace("b,2", "b,0"), 3),
        ("participant,item,answer\n", 1),
    ],
)
def test_a_broken_table_is_refused_by_its_line(tmp_path, text, line):
    path = tmp_path / "answers.csv"
    path.write_text(text)
    with pytest.raises(InputError) as error:
        read_answers(path, questionnaire())
    assert error.value.where is not None
    assert (error.value.where.file, error.value.where.line) == (str(path), line)


@pytest.mark.parametrize(
    ("name", "sizes", "ends"),
    [
        (
            "godspeed",
            {
                "anthropomorphism": 5,
                "animacy": 6,
                "likeability": 5,
                "perceived_intelligence": 5,
                "perceived_safety": 3,
            },
            (1, 5),
        ),
        ("rosas", {"warmth": 6, "competence": 6, "discomfort": 6}, (1, 9)),
    ],
)
def test_the_shipped_structures_have_the_published_sizes_and_no_text_of_an_item(name, sizes, ends):
    found = load_questionnaire(name)
    assert {subscale: len(items) for subscale, items in found.subscales.items()} == sizes
    assert len(found.items) == sum(sizes.values())
    assert (found.scale.from_, found.scale.to) == ends
    assert not any(one.text for one in found.items.values())
    assert set(shipped_questionnaires()) == {"godspeed", "rosas"}


QUESTIONNAIRE = """schema_version: 1
name: q
source: design choice
scale: {from: 1, to: 5}
items:
  a: {subscales: [x], text: Calm}
  b: {subscales: [x, y], reversed: true}
  c: {subscales: [x]}
  d: {subscales: [y]}
"""


def test_the_command_scores_and_writes_and_never_replaces_the_answers(comity, here):
    (here / "q.yaml").write_text(QUESTIONNAIRE)
    (here / "answers.csv").write_text(WIDE.replace("\n", "\n# a note\n", 1))
    words = ["study", "score", "q.yaml", "answers.csv"]
    answer = comity(*words, "--out", "scores.csv", "--json").json
    assert [one["scores"] for one in answer["sheets"]] == [[8 / 3, 4], [None, 4]]
    assert [one["answered"] for one in answer["sheets"]] == [[3, 2], [1, 1]]
    assert answer["missing"] == 2
    frame = pd.read_csv(here / "scores.csv")
    assert frame["y"].tolist() == [4, 4]
    assert frame["x"].isna().tolist() == [False, True]
    before = (here / "scores.csv").read_bytes()
    assert comity(*words, "--out", "scores.csv").code == 0
    assert (here / "scores.csv").read_bytes() == before
    assert comity(*words, "--out", "answers.csv").code == 2
    assert "a note" in (here / "answers.csv").read_text()


@pytest.mark.parametrize(
    ("before", "after", "line"),
    [
        ("{from: 1, to: 5}", "{from: 5, to: 1}", 4),
        ("subscales: [x]}", "subscales: []}", 8),
        ("subscales: [y]}", "subscales: [y], scale: {from: 1, to: 7}}", 1),
        ("  d:", "  answer:", 1),
        ("reversed: true", "revers: true", 7),
    ],
)
def test_a_broken_questionnaire_is_refused_by_its_line(comity, here, before, after, line):
    (here / "q.yaml").write_text(QUESTIONNAIRE.replace(before, after))
    (here / "answers.csv").write_text(WIDE)
    said = comity("study", "score", "q.yaml", "answers.csv")
    assert said.code == 2
    assert f"q.yaml:{line}:" in said.err


def test_a_questionnaire_is_printed_to_be_filled_in(comity, here):
    (here / "ours.yaml").write_text(comity("study", "questionnaire", "rosas").out)
    (here / "ours.csv").write_text(
        "participant," + ",".join(load_questionnaire("rosas").items) + "\nP01" + ",5" * 18 + "\n"
    )
    answer = comity("study", "score", "ours.yaml", "ours.csv", "--json").json
    assert answer["sheets"][0]["scores"] == [5, 5, 5]
    assert comity("study", "questionnaire", "godsped").code == 2
