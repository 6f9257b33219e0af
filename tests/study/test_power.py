"""How many people a difference takes: known numbers, and what must hold of all of them."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from scipy import stats

from comity.study.power import PowerQuestion, people_needed, power_of
from comity_fis.errors import WrongValueError

DIFFERENCES, SPREADS = st.floats(3, 60), st.floats(10, 80)


def needed(**question) -> int:
    return people_needed(PowerQuestion(**question)).per_group


def test_20_cm_at_a_spread_of_35_cm_take_50_people_a_group():
    assert needed(difference_cm=20, sd_cm=35) == 50


@pytest.mark.parametrize(("effect", "people"), [(0.2, 394), (0.5, 64), (0.8, 26)])
def test_two_groups_need_what_cohen_tabulates(effect, people):
    """Cohen 1988, table 2.4.1: two-sided 0.05, power 0.80; he rounds to the next person."""
    assert abs(needed(difference_cm=100 * effect, sd_cm=100) - people) <= 1


@given(DIFFERENCES, SPREADS)
def test_one_person_fewer_does_not_do(difference_cm, sd_cm):
    question = PowerQuestion(difference_cm=difference_cm, sd_cm=sd_cm)
    found = people_needed(question)
    assert found.power_reached == power_of(question, found.per_group) >= 0.80
    assert power_of(question, found.per_group - 1) < 0.80


@given(DIFFERENCES, SPREADS, st.floats(-1, 0.95), st.floats(0.01, 0.04))
def test_the_more_two_values_of_a_person_correlate_the_fewer_people(difference_cm, sd_cm, correlation, more):
    question = {"difference_cm": difference_cm, "sd_cm": sd_cm}
    assert needed(**question, correlation=correlation + more) <= needed(**question, correlation=correlation)


@given(DIFFERENCES, SPREADS, st.integers(1, 30), st.floats(0, 1))
def test_people_in_clusters_count_for_less_and_never_for_more(difference_cm, sd_cm, cluster, icc):
    question = {"difference_cm": difference_cm, "sd_cm": sd_cm}
    found, alone = people_needed(PowerQuestion(**question, cluster=cluster, icc=icc)), needed(**question)
    assume(cluster > 1)
    assert found.per_group >= alone
    assert found.per_group == found.clusters_per_group * cluster
    assert found.power_reached >= 0.80 - 1e-9


@given(DIFFERENCES, SPREADS, st.integers(2, 200))
def test_the_power_is_that_of_the_noncentral_t(difference_cm, sd_cm, people):
    freedom, shift = 2 * people - 2, difference_cm / sd_cm * (people / 2) ** 0.5
    limit = stats.t.ppf(0.975, freedom)
    expected = stats.nct.sf(limit, freedom, shift) + stats.nct.cdf(-limit, freedom, shift)
    assume(np.isfinite(expected))
    found = power_of(PowerQuestion(difference_cm=difference_cm, sd_cm=sd_cm), people)
    assert found == pytest.approx(expected, abs=1e-5)


def test_the_power_is_that_of_simulated_tests():
    rng = np.random.default_rng(0)
    one, other = rng.normal(0, 35, (4000, 50)), rng.normal(20, 35, (4000, 50))
    share = (stats.ttest_ind(one, other, axis=1).pvalue < 0.05).mean()
    assert share == pytest.approx(power_of(PowerQuestion(difference_cm=20, sd_cm=35), 50), abs=0.02)
    common = rng.normal(0, 35 * 0.6**0.5, (4000, 20))
    pairs = [common + rng.normal(mean, 35 * 0.4**0.5, (4000, 20)) for mean in (0, 20)]
    share = (stats.ttest_rel(*pairs, axis=1).pvalue < 0.05).mean()
    paired = PowerQuestion(difference_cm=20, sd_cm=35, correlation=0.6)
    assert share == pytest.approx(power_of(paired, 20), abs=0.02)


@pytest.mark.parametrize(
    "wrong",
    [{"difference_cm": 0}, {"sd_cm": -1}, {"correlation": 1}, {"icc": 2}, {"alpha": 0.6}, {"power": 0.01}],
)
def test_a_question_that_means_nothing_is_refused(wrong):
    with pytest.raises(WrongValueError):
        PowerQuestion(**{"difference_cm": 20, "sd_cm": 35, **wrong})


TABLE = "person,group,distance_m\na,x,0.6\nb,x,0.8\nc,y,1.6\nd,y,1.8\n"


def test_the_spread_is_measured_within_groups(comity, here):
    (here / "people.csv").write_text(TABLE)
    words = ["study", "power", "--difference-cm", 20, "--from", "people.csv", "--column", "distance_m"]
    answer = comity(*words, "--by", "group", "--json").json
    assert answer["sd_cm"] == pytest.approx(100 * 0.02**0.5)
    assert answer["measured"] == 4
    assert comity(*words, "--json").json["sd_cm"] > 50


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["--sd-cm", 35, "--from", "people.csv", "--column", "distance_m"],
        ["--from", "people.csv"],
        ["--from", "people.csv", "--column", "distance"],
        ["--from", "people.csv", "--column", "group"],
        ["--from", "nobody.csv", "--column", "distance_m"],
        ["--sd-cm", 0],
        ["--sd-cm", 1e9, "--difference-cm", 0.001],
    ],
)
def test_the_command_refuses_what_it_cannot_use(comity, here, words):
    (here / "people.csv").write_text(TABLE)
    said = comity("study", "power", "--difference-cm", 20, *words)
    assert said.code == 2
    assert "expected" in said.err


def test_the_command_says_the_numbers(comity):
    said = comity("study", "power", "--difference-cm", 20, "--sd-cm", 35)
    assert said.out.startswith("50 people a group, 100 in all")
    words = ["--sd-cm", 35, "--paired", 0.5, "--cluster", 8, "--icc", 0.05]
    assert "clusters of 8" in comity("study", "power", "--difference-cm", 20, *words).out
