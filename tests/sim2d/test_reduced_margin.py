"""When the robot may pass a person nearer than 0.30 m: every condition is necessary, and unknown is no."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_sim2d.navigation.reduced_margin import (
    CONDITIONS,
    FASTEST_M_S,
    PassageFacts,
    PersonMargin,
    least_margin_m,
    margin_for,
)
from comity_sim2d.scene.obstacles import PERSON_MARGIN_M
from comity_sim2d.scene_error import SceneError

GRANTED = PassageFacts(
    asked_m=0.25,
    latency_s=0.05,
    braking_m_s2=0.5,
    tracking_sd_m=0.01,
    is_allowed=True,
    speed_m_s=0.2,
    age_years=18.0,
    is_known=True,
    posture="standing",
    walks=False,
    has_mobility_aid=False,
    has_reduced_hearing=False,
    has_reduced_sight=False,
    bearing_deg=30.0,
    said_yes=True,
    has_waited=True,
    has_other_route=False,
)
BREAKS: dict[str, list[dict[str, Any]]] = {
    "margin": [{"asked_m": 0.30}],
    "errors": [{"latency_s": None}, {"braking_m_s2": None}, {"tracking_sd_m": None}],
    "operator": [{"is_allowed": False}],
    "speed": [{"speed_m_s": 0.21}, {"speed_m_s": float("nan")}],
    "age": [{"age_years": None}, {"age_years": 17.9}, {"age_years": float("nan")}],
    "tracker": [{"is_known": False}],
    "posture": [{"posture": "seated"}, {"posture": ""}],
    "walks": [{"walks": True}],
    "mobility": [{"has_mobility_aid": True}],
    "hearing": [{"has_reduced_hearing": True}],
    "sight": [{"has_reduced_sight": True}],
    "behind": [{"bearing_deg": 91.0}, {"bearing_deg": -180.0}, {"bearing_deg": None}],
    "faces": [{"said_yes": False, "has_stepped_aside": True, "bearing_deg": 61.0}],
    "silence": [{"said_yes": False, "has_stepped_aside": False}],
    "waited": [{"has_waited": False}],
    "route": [{"has_other_route": True}],
    "errors too large": [{"tracking_sd_m": 0.05}, {"latency_s": 0.5}, {"asked_m": 0.15}],
}

any_facts = st.builds(
    PassageFacts,
    asked_m=st.floats(0.0, 0.5),
    latency_s=st.none() | st.floats(0.0, 0.5),
    braking_m_s2=st.none() | st.floats(0.05, 5.0),
    tracking_sd_m=st.none() | st.floats(0.0, 0.1),
    is_allowed=st.booleans(),
    speed_m_s=st.floats(0.0, 0.5),
    age_years=st.none() | st.floats(0.0, 110.0),
    is_known=st.booleans(),
    posture=st.sampled_from(["standing", "seated"]),
    walks=st.booleans(),
    has_mobility_aid=st.booleans(),
    has_reduced_hearing=st.booleans(),
    has_reduced_sight=st.booleans(),
    bearing_deg=st.none() | st.floats(-180.0, 180.0),
    has_stepped_aside=st.booleans(),
    said_yes=st.booleans(),
    has_waited=st.booleans(),
    has_other_route=st.booleans(),
)


def test_the_margin_is_granted_where_every_condition_holds() -> None:
    assert margin_for(GRANTED) == PersonMargin(0.25, ())


@pytest.mark.parametrize("change", [change for changes in BREAKS.values() for change in changes], ids=str)
def test_each_condition_is_necessary(change: dict[str, Any]) -> None:
    got = margin_for(replace(GRANTED, **change))
    assert got.clearance_m == PERSON_MARGIN_M
    assert got.reasons


def test_each_row_of_the_table_refuses_something_that_no_other_row_refuses() -> None:
    alone = {
        margin_for(replace(GRANTED, **change)).reasons for changes in BREAKS.values() for change in changes
    }
    assert {(reason,) for reason, _ in CONDITIONS} <= alone


@given(any_facts)
def test_the_clearance_is_the_full_margin_or_the_one_that_is_set_and_can_be_kept(now: PassageFacts) -> None:
    got = margin_for(now)
    if got.reasons:
        assert got.clearance_m == PERSON_MARGIN_M
        return
    assert now.latency_s is not None
    assert now.braking_m_s2 is not None
    assert now.tracking_sd_m is not None
    assert least_margin_m(now.latency_s, now.braking_m_s2, now.tracking_sd_m, now.speed_m_s) >= 0.15
    assert 0.15 <= got.clearance_m == now.asked_m < PERSON_MARGIN_M
    assert now.speed_m_s <= FASTEST_M_S


def test_what_is_not_known_refuses() -> None:
    assert margin_for(PassageFacts(asked_m=0.2)).clearance_m == PERSON_MARGIN_M


def test_no_cultural_fact_is_an_input() -> None:
    known = {field.name for field in fields(PassageFacts)}
    assert not known & {"culture", "gender", "nationality", "profile", "values", "personal_distance_m"}


def test_a_person_who_stepped_aside_and_faces_the_robot_need_not_speak() -> None:
    assert not margin_for(replace(GRANTED, said_yes=False, has_stepped_aside=True)).reasons


def test_the_least_margin_adds_latency_braking_and_two_standard_deviations() -> None:
    assert least_margin_m(0.1, 0.5, 0.02) == pytest.approx(0.15 + 0.02 + 0.04 + 0.04)


@pytest.mark.parametrize(
    "errors", [(-0.1, 0.5, 0.0), (0.0, 0.0, 0.0), (0.0, 0.5, -0.1), (float("nan"), 1.0, 0.0)]
)
def test_errors_out_of_range_are_refused(errors: tuple[float, float, float]) -> None:
    with pytest.raises(SceneError):
        least_margin_m(*errors)
