"""A scenario's walkers are met, or decline: as the answer, the trace, expectations and the page say it."""

from __future__ import annotations

import pytest

SCENARIO = """
schema_version: 1
name: hall
about: One who walks by, and one who waits.
place: {{width_m: 10.0, height_m: 6.0}}
robot: {{at_m: [5.0, 1.0]}}
people:
  ines: {{profile: german_woman, at_m: [8.6, 5.0], facing_deg: 215}}
  omar:
    profile: arab_man
    at_m: [1.0, 3.0]
    facing_deg: 0
    walks: {{route: [[9.0, 3.0], [1.0, 3.0]], loop: true, {walks}}}
goals:
{goals}
expect:
  - omar is {fares}
"""
BOTH = "  - greet: omar\n  - greet: ines"


@pytest.fixture
def hall(tmp_path):
    """Write the hall, and name its file."""

    def write(walks: str, fares: str, goals: str = BOTH) -> str:
        file = tmp_path / "hall.scenario.yaml"
        file.write_text(SCENARIO.format(walks=walks, fares=fares, goals=goals))
        return str(file)

    return write


def visits_of(answer: dict) -> dict[str, dict]:
    return {visit["person"]: visit for visit in answer["visits"]}


def test_a_person_who_walks_by_has_declined_and_the_run_is_a_success(comity, hall, tmp_path) -> None:
    done = comity("run", hall("speed_m_s: 0.8", "declined"), "--out", str(tmp_path / "run"), "--json")
    assert done.code == 0, done.err
    answer = done.json
    visits = visits_of(answer)
    assert answer["outcome"] == "success"
    assert visits["omar"]["outcome"] == "declined"
    assert visits["omar"]["reason"].startswith("declined: walked by the robot")
    assert visits["omar"]["greeting"] == []
    assert visits["ines"]["outcome"] == "greeted"
    why = comity("trace", str(tmp_path / "run"), "--why", "given_up?(omar)")
    assert "declined: walked by the robot" in why.out
    picture = (tmp_path / "run" / "replay.html").read_text(encoding="utf-8")
    assert "declined: walked by the robot" in picture


def test_where_the_only_person_declines_nothing_is_left_to_do(comity, hall, tmp_path) -> None:
    file = hall("speed_m_s: 0.8", "declined", "  - greet: omar")
    answer = comity("run", file, "--out", str(tmp_path / "run"), "--json").json
    assert (answer["outcome"], answer["revisions"]) == ("success", [])


@pytest.mark.parametrize(
    ("walks", "fares"),
    [
        ("speed_m_s: 0.8", "declined"),
        ("speed_m_s: 0.8, stops: true", "greeted"),
        ("speed_m_s: 0.3, accompanied: true", "greeted"),
        ("speed_m_s: 1.0, accompanied: true", "declined"),
    ],
)
def test_an_expectation_says_how_a_walker_fares(comity, hall, walks, fares) -> None:
    done = comity("test", hall(walks, fares))
    assert done.code == 0, done.out


def test_whoever_agreed_to_company_is_greeted_at_their_side(comity, hall, tmp_path) -> None:
    file = hall("speed_m_s: 0.3, accompanied: true", "greeted", "  - greet: omar")
    answer = comity("run", file, "--out", str(tmp_path / "run"), "--json").json
    visit = visits_of(answer)["omar"]
    assert visit["outcome"] == "greeted"
    assert abs(visit["bearing_actual_deg"]) > 60.0
    assert "walks" in visit["deviation_reason"]


def test_accompanied_is_a_truth_value(comity, hall) -> None:
    done = comity("run", hall("accompanied: perhaps", "greeted"))
    assert done.code == 2
    assert "accompanied" in done.err
