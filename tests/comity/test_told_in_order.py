"""A run tells people in the order in which the robot came to them, whatever their order in the file."""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

PLACES = {
    "anna": "{at_m: [2.0, 4.0], facing_deg: -90}",
    "bob": "{at_m: [7.0, 4.5], facing_deg: 180, profile: german_man}",
    "cleo": "{at_m: [8.0, 1.0], facing_deg: 90}",
}


def hall(people: list[str], goals: list[str], more: str = "") -> str:
    return "".join(
        (
            "schema_version: 1\nname: hall\nplace: {width_m: 10, height_m: 6}\n",
            "robot: {at_m: [1, 1]}\npeople:\n",
            *(f"  {name}: {PLACES[name]}\n" for name in people),
            "goals:\n",
            *(f"  - greet: {name}\n" for name in goals),
            more,
        )
    )


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(people=st.permutations(sorted(PLACES)), goals=st.permutations(sorted(PLACES)))
def test_visits_are_told_in_the_order_of_their_times(people, goals, here, comity):
    (here / "hall.scenario.yaml").write_text(hall(people, goals))
    visits = comity("run", "hall.scenario.yaml", "--json").json["visits"]
    times = [visit["greeted_s"] for visit in visits]
    assert times == sorted(times)


def test_people_whom_the_robot_never_reached_come_last(here, comity):
    (here / "hall.scenario.yaml").write_text(
        hall(["cleo", "bob", "anna"], ["cleo", "bob", "anna"], "limits: {time_s: 10}\n")
    )
    visits = comity("run", "hall.scenario.yaml", "--json").json["visits"]
    assert [visit["person"] for visit in visits] == ["anna", "bob", "cleo"], "as planned"
    assert [visit["docked_at_s"] is None for visit in visits] == [False, True, True]


def test_the_summary_names_when_the_robot_docked_and_when_the_greeting_was_over(here, comity):
    (here / "hall.scenario.yaml").write_text(hall(sorted(PLACES), sorted(PLACES)))
    visits = comity("run", "hall.scenario.yaml", "--out", "run", "--json").json["visits"]
    told = [line.split() for line in comity("run", "hall.scenario.yaml").out.splitlines()]
    rows = [words for words in told if words[2:3] == ["greeted"]]
    expected = [
        [visit["person"], f"{visit['docked_at_s']:.1f},", f"{visit['greeted_s']:.1f}"] for visit in visits
    ]
    assert [[row[0], row[3], row[4]] for row in rows] == expected
