"""`--fairness`: a difference that no parameter explains is flagged, and one that a parameter explains is not.

The unfairness is planted in the robot: for one of two people who declared the same it drives at half speed.
"""

from __future__ import annotations

from dataclasses import replace

import pytest

from comity.testing import trial
from comity.testing.cases import claims_in
from comity.testing.fairness import ASPECTS, unexplained
from comity.testing.result import Result, result_of

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


def slow_for(name: str, monkeypatch) -> None:
    honest = trial.prepared_case

    def prepared(case):
        found = honest(case)
        if case.profile_name != name:
            return found
        robot = replace(found.scene.robot, max_speed_m_s=found.scene.robot.max_speed_m_s / 2)
        return replace(found, scene=replace(found.scene, robot=robot))

    monkeypatch.setattr(trial, "prepared_case", prepared)


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
