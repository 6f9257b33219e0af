"""When the robot may pass a person nearer than 0.30 m: every condition is necessary, and unknown is no."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from comity_fis.proxemics import PERSON_MARGIN_M
from comity_sim2d import RobotBody, Room, Scene, SceneError, Sensor, World
from comity_sim2d.robot.reduced_margin import (
    CONDITIONS,
    PassageFacts,
    check_margin,
    least_margin_m,
    reasons_against,
)
from comity_sim2d.scene.margin_facts import MarginFacts

ADULT = MarginFacts(age_years=18.0, walks_unaided=True, hears_well=True, sees_well=True)
GRANTED = PassageFacts(
    asked_m=0.25,
    least_m=0.24,
    declared=ADULT,
    is_known=True,
    radius_m=0.35,
    posture="standing",
    walks=False,
    bearing_deg=30.0,
    said_yes=True,
    said_otherwise=False,
    has_waited=True,
    has_other_route=False,
)
BREAKS: list[dict[str, Any]] = [
    {"asked_m": 0.30},
    {"least_m": 0.26},
    {"asked_m": float("nan")},
    {"declared": replace(ADULT, age_years=None)},
    {"declared": replace(ADULT, age_years=17.9)},
    {"declared": replace(ADULT, walks_unaided=False)},
    {"declared": replace(ADULT, walks_unaided=False, uses_wheelchair=True)},
    {"declared": replace(ADULT, hears_well=False)},
    {"declared": replace(ADULT, sees_well=False)},
    {"is_known": False},
    {"radius_m": 0.36},
    {"posture": "seated"},
    {"posture": ""},
    {"walks": True},
    {"bearing_deg": 91.0},
    {"bearing_deg": -180.0},
    {"bearing_deg": None},
    {"said_yes": False, "has_stepped_aside": True, "bearing_deg": 61.0},
    {"said_yes": False, "has_stepped_aside": False},
    {"said_otherwise": True},
    {"said_yes": False, "has_stepped_aside": True, "said_otherwise": True},
    {"has_waited": False},
    {"has_other_route": True},
]


def test_leave_is_given_where_every_condition_holds() -> None:
    assert not reasons_against(GRANTED)


@pytest.mark.parametrize("change", BREAKS, ids=str)
def test_each_condition_is_necessary(change: dict[str, Any]) -> None:
    assert reasons_against(replace(GRANTED, **change))


def test_each_row_of_the_table_refuses_something_that_no_other_row_refuses() -> None:
    alone = {reasons_against(replace(GRANTED, **change)) for change in BREAKS}
    assert {(reason,) for reason, _ in CONDITIONS} <= alone


def test_what_is_not_known_refuses() -> None:
    """All rows but two of numbers, two of a bearing, which has its own where unknown, and a declared aid."""
    refused = set(reasons_against(PassageFacts(asked_m=0.25, least_m=0.0)))
    of_bearing = set(reasons_against(replace(GRANTED, bearing_deg=180.0, said_yes=False)))
    of_bearing -= set(reasons_against(replace(GRANTED, said_yes=False)))
    numbers = {CONDITIONS[0][0], CONDITIONS[1][0]}
    of_aid = set(reasons_against(replace(GRANTED, declared=replace(ADULT, uses_wheelchair=True))))
    assert refused == {reason for reason, _ in CONDITIONS} - numbers - of_bearing - of_aid
    assert len(of_bearing) == 2


def test_no_cultural_fact_is_an_input() -> None:
    known = {field.name for field in (*fields(PassageFacts), *fields(MarginFacts))}
    assert not known & {"culture", "gender", "nationality", "profile", "values", "personal_distance_m"}


def test_a_person_who_stepped_aside_and_faces_the_robot_need_not_speak() -> None:
    assert not reasons_against(replace(GRANTED, said_yes=False, has_stepped_aside=True))


def test_the_least_margin_of_the_default_robot_is_body_latency_and_braking() -> None:
    latency_s, braking_m_s2 = 0.1, 0.3
    assert least_margin_m(RobotBody(0.0, 0.0)) == pytest.approx(
        0.15 + 0.2 * latency_s + 0.04 / (2 * braking_m_s2)
    )


@given(
    st.floats(0.0, 0.2),
    st.floats(0.0, 0.03),
    st.floats(0.05, 10.0),
    st.floats(0.1, 100.0),
    st.floats(0.0, 0.5),
)
def test_a_worse_robot_never_keeps_less(
    delay_s: float, sigma_m: float, acceleration: float, jerk: float, worse: float
) -> None:
    def least(sensor: Sensor, acceleration: float) -> float:
        body = RobotBody(0.0, 0.0, max_acceleration_m_s2=acceleration, max_jerk_m_s3=jerk, sensor=sensor)
        return least_margin_m(body)

    one = least(Sensor(sigma_m=sigma_m, delay_s=delay_s), acceleration)
    assert one > 0.15
    assert least(Sensor(sigma_m=sigma_m, delay_s=delay_s + worse), acceleration) >= one
    assert least(Sensor(sigma_m=sigma_m + worse, delay_s=delay_s), acceleration) >= one


@given(st.floats(0.0, PERSON_MARGIN_M))
def test_a_margin_that_the_robot_cannot_keep_is_refused_with_both_numbers(margin_m: float) -> None:
    body = RobotBody(1.0, 1.0, margin_m=margin_m)
    least_m = least_margin_m(body)
    if margin_m >= least_m:
        check_margin(body)
        return
    with pytest.raises(SceneError, match=f"at least {least_m:.3f} m") as refused:
        World(Scene(Room.rectangle(3.0, 3.0), body, ()))
    assert refused.value.field == "margin_m"


@pytest.mark.parametrize("margin_m", [-0.1, 0.31, float("nan")])
def test_no_margin_is_above_the_full_one_or_below_0(margin_m: float) -> None:
    with pytest.raises(SceneError):
        RobotBody(1.0, 1.0, margin_m=margin_m)
