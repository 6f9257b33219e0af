"""The six numbers that the paper prints, and what must hold around them."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis import Rulebook

# Bruno et al. 2017: individualism, gender, conversational distance in cm.
PRINTED = [
    (38, None, 69.9),
    (67, None, 100.7),
    (38, "female", 63.63),
    (67, "female", 84.7),
    (38, "male", 87.51),
    (67, "male", 109.34),
]

individualism = st.floats(0, 100)


def distance_cm(
    rulebook: Rulebook, individualism: float | None, gender: str | None, mode: str = "exact"
) -> float:
    inputs = {"individualism": individualism}
    if "gender" in rulebook.variables:
        inputs["gender"] = gender
    return 100 * rulebook.infer(inputs, mode=mode)["conversational_distance"].number


@pytest.mark.parametrize(("score", "gender", "printed"), PRINTED)
def test_the_papers_numbers_come_out(case1, case2, score, gender, printed):
    rulebook = case2 if gender else case1
    matlab, exact, skfuzzy = (
        distance_cm(rulebook, score, gender, mode) for mode in ("matlab", "exact", "skfuzzy")
    )
    assert matlab == pytest.approx(printed, abs=0.2)
    assert exact == pytest.approx(printed, abs=0.4)
    assert skfuzzy == pytest.approx(exact, abs=0.05)


@pytest.mark.parametrize(("score", "gender", "printed"), PRINTED)
def test_bruno2017_gives_the_second_cases_distance(case2, bruno2017, score, gender, printed):
    assert distance_cm(bruno2017, score, gender) == distance_cm(case2, score, gender)


@pytest.mark.parametrize(
    ("score", "gender", "measured"),
    # docs of the reconstruction: 101 points with plain sums, and the integral
    [
        (38, None, (70.08, 70.20)),
        (67, None, (100.66, 100.47)),
        (38, "female", (63.79, 64.02)),
        (67, "female", (84.68, 84.69)),
        (38, "male", (87.60, 87.53)),
        (67, "male", (109.29, 109.10)),
    ],
)
def test_the_modes_differ_as_their_rules_do(case1, case2, score, gender, measured):
    rulebook = case2 if gender else case1
    assert distance_cm(rulebook, score, gender, "matlab") == pytest.approx(measured[0], abs=0.006)
    assert distance_cm(rulebook, score, gender, "exact") == pytest.approx(measured[1], abs=0.006)


@given(individualism, st.sampled_from(["female", "male", None]))
def test_the_reference_engine_agrees_with_the_exact_one(case2, score, gender):
    assert distance_cm(case2, score, gender, "skfuzzy") == pytest.approx(
        distance_cm(case2, score, gender), abs=0.05
    )


@given(individualism, st.sampled_from(["exact", "matlab"]))
def test_without_a_gender_the_answer_lies_between_the_womans_and_the_mans(case2, score, mode):
    woman, nobody, man = (distance_cm(case2, score, gender, mode) for gender in ("female", None, "male"))
    assert woman - 1e-9 <= nobody <= man + 1e-9


@given(st.sampled_from(["female", "male"]))
def test_without_a_score_the_answer_lies_between_the_extremes(case2, gender):
    answers = [distance_cm(case2, score, gender) for score in range(101)]
    assert min(answers) <= distance_cm(case2, None, gender) <= max(answers)


@given(st.floats(15, 80), st.floats(15, 80))
def test_a_higher_score_never_means_less_distance(case1, case2, one, other):
    """The fitted terms fall off at both ends of the scale, so that it holds for 15 to 80 only."""
    low, high = sorted((one, other))
    assert distance_cm(case1, low, None) <= distance_cm(case1, high, None) + 1e-9
    for gender in ("female", "male"):
        assert distance_cm(case2, low, gender) <= distance_cm(case2, high, gender) + 1e-9


@given(st.floats(16, 80), st.floats(16, 80))
def test_nor_does_it_where_no_gender_is_disclosed(case2, one, other):
    low, high = sorted((one, other))
    assert distance_cm(case2, low, None) <= distance_cm(case2, high, None) + 1e-9
