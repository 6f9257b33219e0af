"""`comity paper`: the paper's six numbers beside ours."""

from __future__ import annotations

import pytest

from comity_fis import load_rulebook

PAPER_CM = [
    (1, 38, None, 69.9),
    (1, 67, None, 100.7),
    (2, 38, "female", 63.63),
    (2, 67, "female", 84.7),
    (2, 38, "male", 87.51),
    (2, 67, "male", 109.34),
]
WORST_CM = {"matlab": 0.2, "exact": 0.4, "skfuzzy": 0.4}


@pytest.fixture
def answer(comity):
    return comity("paper", "--json").json


def test_the_six_numbers_are_the_papers(answer):
    found = [(n["case"], n["individualism"], n["gender"], n["paper_cm"]) for n in answer["numbers"]]
    assert found == PAPER_CM


@pytest.mark.parametrize("mode", WORST_CM)
def test_each_mode_gives_what_infer_gives_with_its_difference(answer, mode):
    for number in answer["numbers"]:
        told = {"individualism": number["individualism"]}
        told |= {"gender": number["gender"]} if number["gender"] else {}
        rulebook = load_rulebook(f"bruno2017-case{number['case']}")
        cm = 100 * rulebook.infer(told, mode)["conversational_distance"].number
        ours = number["modes"][mode]
        assert ours["distance_cm"] == pytest.approx(cm, abs=1e-9)
        assert ours["difference_cm"] == pytest.approx(cm - number["paper_cm"], abs=1e-9)
        assert abs(ours["difference_cm"]) <= WORST_CM[mode]


def test_the_largest_difference_is_that_of_some_number(answer):
    for mode, largest in answer["largest_difference_cm"].items():
        assert largest == max(abs(n["modes"][mode]["difference_cm"]) for n in answer["numbers"])


def test_the_second_cases_close_and_far_do_not_give_the_first_cases_numbers(answer):
    other = answer["case_1_with_the_shapes_of_case_2"]
    found = [number["modes"]["matlab"]["distance_cm"] for number in other]
    assert found == [pytest.approx(65.95, abs=0.005), pytest.approx(108.83, abs=0.005)]
    assert all(abs(mode["difference_cm"]) > 3 for number in other for mode in number["modes"].values())


def test_the_text_has_the_numbers_of_the_json(comity, answer):
    text = comity("paper").out
    for number in (*answer["numbers"], *answer["case_1_with_the_shapes_of_case_2"]):
        assert f"{number['paper_cm']:.2f}" in text
        for mode in number["modes"].values():
            assert f"{mode['distance_cm']:.2f} ({mode['difference_cm']:+.2f})" in text
