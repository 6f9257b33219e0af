"""`--fairness`: a difference that no parameter explains is flagged, and one that a parameter explains is not.

The unfairness is planted in the robot: for one of two people who declared the same it drives at half speed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import pytest

from comity.system.library import shipped
from comity.testing.collection.cases import claims_in
from comity.testing.measuring.measured import TESTED
from comity.testing.reporting.account import answer, summary
from comity.testing.reporting.answers import TestsAnswer, UnexplainedAnswer
from comity.testing.reporting.fairness import ASPECTS, differences, spread
from comity.testing.reporting.summary import others, served, shared
from comity.testing.runner.result import Result, result_of
from comity.testing.trials import attempt

SAME = "schema_version: 1\nname: {name}\nculture: DEU\ngender: male\n"
TWINS = "matrix: {people: [guest], profiles: [one.profile.yaml, other.profile.yaml]}\n"


@pytest.fixture
def twins(write, tmp_path):
    """A scenario for two people who declared the same under two names."""
    for name in ("one", "other"):
        (tmp_path / f"{name}.profile.yaml").write_text(SAME.format(name=name))
    return write(more=TWINS)


def results(path) -> list[Result]:
    return [result_of(claim) for claim in claims_in(path)]


def unexplained(found: Sequence[Result]) -> tuple[UnexplainedAnswer, ...]:
    return tuple(one for one in differences(found) if not one.settings)


def slow_for(name: str, monkeypatch) -> None:
    honest = attempt.prepared_case

    def prepared(case):
        found = honest(case)
        if case.profile_name != name:
            return found
        robot = replace(found.scene.robot, max_speed_m_s=found.scene.robot.max_speed_m_s / 2)
        return replace(found, scene=replace(found.scene, robot=robot))

    monkeypatch.setattr(attempt, "prepared_case", prepared)


def test_twins_are_served_alike(twins):
    found = results(twins)
    assert [result.status for result in found] == ["passed", "passed"]
    assert unexplained(found) == ()


def test_a_robot_that_is_slower_for_one_of_two_twins_is_flagged(twins, monkeypatch):
    slow_for("other", monkeypatch)
    flagged = unexplained(results(twins))
    way = next(one for one in flagged if one.what == "time on the way")
    assert way.profiles == ("one", "other")
    assert way.values[1] > way.values[0] + 1.0
    assert "it may hang on conversational_distance, approach_direction, which do not differ" in way.text


def test_a_difference_that_a_parameter_explains_is_not_flagged(write):
    """The one is greeted with words and a nod, which takes longer than words alone; the rules say so."""
    found = results(write(more="matrix: {people: [guest], profiles: [german_man, arab_woman]}\n"))
    one, other = (result.measured for result in found)
    assert one
    assert other
    assert {aspect.what for aspect in ASPECTS if abs(aspect.value(one) - aspect.value(other)) > aspect.small}
    assert unexplained(found) == ()


def test_whether_somebody_is_served_hangs_on_no_parameter(write):
    """Planted in what was measured: even where every parameter differs, that is flagged."""
    one, other = results(write(more="matrix: {people: [guest], profiles: [german_man, arab_woman]}\n"))
    assert other.measured
    left_out = replace(other, measured=replace(other.measured, served=1))
    (flagged,) = unexplained([one, left_out])
    assert (flagged.what, flagged.values) == ("people served", (2.0, 1.0))
    assert "nobody's culture may decide that" in flagged.text


def planted(results, **changed):
    """The second of two results, with other measurements."""
    one, other = results
    assert other.measured
    return [one, replace(other, measured=replace(other.measured, **changed))]


def test_who_is_met_farther_off_than_they_would_have_it_is_flagged(write):
    """Planted, with all parameters different: how near somebody is met to what they want hangs on none."""
    found = results(write(more="matrix: {people: [guest], profiles: [german_man, arab_woman]}\n"))
    (flagged,) = unexplained(planted(found, distances_m={"guest": (0.64, 1.35)}))
    assert flagged.what == "distance off the wanted one"
    assert flagged.values[1] == pytest.approx(0.71)


def test_what_somebody_asked_for_is_told_as_that_and_is_no_fault(write, tmp_path):
    """Three metres cannot be had there: no culture decided it."""
    (tmp_path / "one.profile.yaml").write_text(SAME.format(name="one"))
    far = SAME.format(name="far") + "settings: {conversational_distance: 3.0}\n"
    (tmp_path / "far.profile.yaml").write_text(far)
    path = write(
        more="matrix: {people: [guest], profiles: [one.profile.yaml, far.profile.yaml]}\n",
        room=lambda room: (
            room.replace("guest: {profile: german_man, at_m: [6.8, 1.2]", "guest: {at_m: [1.7, 3.0]")
            .replace("width_m: 8.0", "width_m: 3.4")
            .replace("  sam: {profile: german_man, at_m: [4.6, 2.2], facing_deg: 0}\n", "")
        ),
    )
    found = results(path)
    told = [one for one in differences(found) if one.what in ("distance off the wanted one", "people served")]
    assert told
    assert all(one.settings == ("conversational_distance",) for one in told)
    assert "one of them asked for another conversational_distance" in told[0].text
    assert unexplained(found) == ()


@pytest.fixture
def wishes(write, tmp_path):
    """The results of two people who declared the same, of whom the second asks for something."""

    def asked(settings: str) -> list[Result]:
        (tmp_path / "one.profile.yaml").write_text(SAME.format(name="one"))
        (tmp_path / "asks.profile.yaml").write_text(SAME.format(name="asks") + f"settings: {{{settings}}}\n")
        return results(
            write(more="matrix: {people: [guest], profiles: [one.profile.yaml, asks.profile.yaml]}\n")
        )

    return asked


SLOWER, FARTHER, BOWS = "approach_speed: 0.25", "conversational_distance: 1.4", "greeting_gesture: bow"
OFF, SERVED = {"distances_m": {"guest": (0.64, 1.35)}}, {"served": 1}


@pytest.mark.parametrize(
    ("settings", "changed", "excused"),
    [
        (SLOWER, OFF, False),
        (BOWS, OFF, False),
        (FARTHER, OFF, True),
        (SLOWER, SERVED, False),
        (FARTHER, SERVED, True),
        (BOWS, SERVED, True),
    ],
)
def test_a_setting_is_behind_only_what_its_parameter_bears_on(settings, changed, excused, wishes):
    """Planted: an asked-for speed moves no place where the robot stops, and a bow neither."""
    found = planted(wishes(settings), **changed)
    what = "distance off the wanted one" if changed is OFF else "people served"
    (told,) = (one for one in differences(found) if one.what == what)
    assert told.settings == ((settings.split(":")[0],) if excused else ())
    assert (told in unexplained(found)) != excused
    assert ("nobody's culture may decide that" in told.text) != excused


def test_an_asked_for_speed_is_behind_the_time_of_coming_near(wishes):
    """Planted: a little slower, and much longer."""
    found = wishes(SLOWER)
    values = {**found[1].measured.values, "approach_speed": found[0].measured.values["approach_speed"] * 0.98}
    told = differences(planted(found, values=values, coming_near_s=90.0))
    assert [one.settings for one in told if one.what == "time of coming near"] == [("approach_speed",)]


def test_who_asks_for_a_speed_is_met_as_near_to_what_they_want_as_others(tmp_path):
    """A counter is where the robot would stop: it is 12 cm too near, and her speed has no part in it."""
    her = tmp_path / "her.profile.yaml"
    her.write_text(
        "schema_version: 1\nname: her\nculture: {DEU: 2, ESP: 1}\ngender: female\nbirth_date: 1948-05-03\n"
        f"settings: {{{SLOWER}}}\n"
    )
    claims = claims_in(shipped("scenario")["blocked-front"], profiles=["german_man", str(her)])
    (flagged,) = unexplained([result_of(claim) for claim in claims])
    assert flagged.what == "distance off the wanted one"
    assert abs(flagged.values[0] - flagged.values[1]) == pytest.approx(0.12, abs=0.01)


@pytest.mark.parametrize(("apart", "flagged"), [(1.01, True), (2.0, False)])
def test_a_parameter_explains_what_is_in_proportion_to_it(apart, flagged, twins):
    found = results(twins)
    assert found[1].measured
    values = dict(found[1].measured.values)
    values["conversational_distance"] = float(values["conversational_distance"]) * apart
    told = unexplained(planted(found, values=values, way_s=3.0 * found[1].measured.way_s))
    assert bool(told) == flagged
    assert all("hardly differ" in one.text for one in told)


def test_off_the_wanted_distance_is_off_the_one_that_they_want_by_then(write):
    """Whoever asks for another distance on the way is met at that one."""
    changes = "changes: [{at_s: 2, person: guest, says: {conversational_distance: 1.6}}]\n"
    (result,) = results(write(more=changes))
    assert result.measured
    wanted, reached = result.measured.distances_m["guest"]
    assert wanted == pytest.approx(1.6)
    assert reached == pytest.approx(1.6, abs=0.03)


@pytest.fixture
def told(capsys):
    """What `--fairness` prints of results, and its answer."""

    def printed(found: Sequence[Result]) -> tuple[str, TestsAnswer]:
        account = answer(found, 1.0, fairness=True)
        summary(found, account)
        return " ".join(capsys.readouterr().out.split()), account

    return printed


EVERY = "Every difference depends on a parameter"
TWO = "matrix: {people: [guest], profiles: [german_man, arab_woman], seeds: [0, 1]}\n"


def test_nobody_has_most_of_what_is_the_same_to_all_digits_that_are_told(write, told):
    text, _ = told(results(write(more=TWO)))
    assert "time of the greeting s" in text
    assert " 0.00 most " not in text


def test_one_profile_cannot_be_compared(write, told):
    text, account = told(
        results(write(more="matrix: {people: [guest], profiles: [german_man], seeds: [0, 1]}\n"))
    )
    assert "Nothing is compared: one profile, german_man, cannot be" in text
    assert EVERY not in text
    assert "on average" not in text
    assert account.not_compared == 2


def test_two_profiles_that_share_no_case_cannot_be_compared(write, told):
    one, _, _, other = results(write(more=TWO))
    text, account = told([one, other])
    assert "Nothing is compared: what was measured cannot be" in text
    assert account.not_compared == 2


def test_what_is_left_out_of_a_comparison_is_counted(write, told):
    """One test without a plan takes its fellow with it; a comparison of profiles is neither."""
    found = results(write("'same for all: safety'", more=TWO))
    without = replace(found[3], measured=None, status="failed")
    text, account = told([*found[:3], without, *found[4:]])
    assert "Left out: 1 test in whose case no other profile was measured." in text
    assert "Left out: 1 test that was refused or without a plan." in text
    assert EVERY in text
    assert account.not_compared == 2


def test_where_all_is_compared_nothing_is_left_out(write, told):
    text, account = told(results(write("'same for all: safety'", more=TWO)))
    assert "Left out" not in text
    assert EVERY in text
    assert account.not_compared == 0


def test_who_serves_nobody_takes_no_time_that_counts(write):
    """Planted: the one who is not served ends at once, which is no faster service."""
    found = results(write(more="matrix: {people: [guest], profiles: [german_man, arab_woman]}\n"))
    nothing = dict.fromkeys(set(TESTED) - {"served", "distance_error_m"}, 0.0)
    given_up = planted(found, served=0, **nothing)
    lines = {line.profile: line for line in served(given_up)}
    assert (lines["arab_woman"].served, lines["arab_woman"].time_s, lines["arab_woman"].detour_m) == (
        0.0,
        None,
        None,
    )
    assert lines["german_man"].time_s == pytest.approx(found[0].measured.time_s)
    assert {flagged.what for flagged in unexplained(given_up)} == {"people served"}
    assert set(spread(given_up)) == {"people served", "distance off the wanted one m"}


@pytest.mark.parametrize(("off_m", "small"), [(0.09, True), (0.0, False)])
def test_what_is_left_out_for_being_small_is_said_with_the_threshold(off_m, small, twins, told):
    text, account = told(planted(results(twins), distances_m={"guest": (1.09, 1.09 - off_m)}))
    assert account.unexplained == ()
    assert ("Too small to be told: distance off the wanted one up to 0.10 m. Every other" in text) == small
    assert (EVERY in text) != small


@pytest.fixture
def tried(write):
    """The results of a file for each line of profiles, in rooms that are the same."""

    def each(*profiles: str) -> list[Result]:
        return [
            result
            for n, names in enumerate(profiles)
            for result in results(
                write(more=f"matrix: {{people: [guest], profiles: [{names}]}}\n", name=f"{n}.scenario.yaml")
            )
        ]

    return each


def failing(found: Sequence[Result], name: str) -> list[Result]:
    """All tests of a profile, failed."""
    return [replace(one, status="failed") if one.profile == name else one for one in found]


def test_tests_and_failures_are_all_of_a_profile_and_means_over_what_all_share(tried, told):
    pair = "arab_woman, german_man"
    found = failing(tried(f"{pair}, unknown", pair, pair), "german_man")
    for i in (3, 5):  # planted: what the means leave out
        found[i] = replace(found[i], measured=replace(found[i].measured, time_s=500.0))
    text, account = told(found)
    lines = {line.profile: line for line in account.profiles}
    assert {name: (line.tests, line.failed) for name, line in lines.items()} == {
        "arab_woman": (3, 0),
        "german_man": (3, 3),
        "unknown": (1, 0),
    }
    assert lines["arab_woman"].time_s == pytest.approx(found[0].measured.time_s)
    assert (account.shared_cases, account.other_cases, account.other_profiles) == (1, 2, ())
    assert "Means over the 1 case that all of these have in common; 2 others are left out." in text
    assert "Not in the table" not in text


def test_a_test_without_a_plan_is_one_of_its_profile(tried):
    """Planted; as it was not measured, its case is none that both share."""
    pair = "arab_woman, german_man"
    found = tried(pair, pair)
    found[3] = replace(found[3], measured=None, status="failed")
    assert found[3].profile == "german_man"
    assert [(line.tests, line.failed) for line in served(found)] == [(2, 0), (2, 1)]
    assert (shared(found).cases, shared(found).left_out) == (1, 1)


def test_as_many_profiles_are_not_the_same_profiles(tried, told):
    """Two pairs that share no case: neither the table nor the means of `--fairness` mix them."""
    found = failing(tried("arab_woman, german_man", "own_wish, unknown", "own_wish, unknown"), "german_man")
    text, account = told(found)
    assert [(line.profile, line.tests) for line in account.profiles] == [("own_wish", 2), ("unknown", 2)]
    assert [(line.profile, line.tests, line.failed) for line in account.other_profiles] == [
        ("arab_woman", 1, 0),
        ("german_man", 1, 1),
    ]
    assert "Not in the table: arab_woman, german_man (2 tests, 1 failed)." in text
    assert "Not compared: 4 pairs of profiles that share no case, such as arab_woman and own_wish." in text
    assert {name for most, least, _ in spread(found).values() for name in (most, least)} <= {
        "own_wish",
        "unknown",
    }


def test_two_profiles_of_two_files_are_not_ranked(tried, told):
    text, account = told(tried("arab_woman", "german_man"))
    assert "How each profile was served" not in text
    assert "Nothing is compared: what was measured cannot be" in text
    assert (account.shared_cases, account.other_cases) == (1, 1)
    assert [line.profile for line in (*account.profiles, *others(tried("arab_woman", "german_man")))] == [
        "arab_woman",
        "german_man",
    ]


def test_where_all_profiles_share_all_cases_the_table_needs_no_word(tried, told):
    text, account = told(tried("arab_woman, german_man"))
    assert "Means over" not in text
    assert (account.shared_cases, account.other_cases, account.other_profiles) == (1, 0, ())


def test_a_case_in_which_nobody_is_served_is_in_neither_mean(tried):
    """Planted: whoever drives about in vain has no detour to anybody."""
    pair = "arab_woman, german_man"
    found = tried(pair, pair)
    for i, detour_m in ((2, 0.0), (3, 9.0)):
        found[i] = replace(found[i], measured=replace(found[i].measured, served=0, detour_m=detour_m))
    means = {line.profile: line.detour_m for line in served(found)}
    _, _, apart = spread(found)["detour m"]
    assert apart == pytest.approx(abs(means["arab_woman"] - means["german_man"]))
    assert apart < 1.0
