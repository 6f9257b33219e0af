"""`comity metrics`: the figures of runs, for readers and for statistics programs."""

from __future__ import annotations

import csv

import pytest

from comity.live_episode import execute
from comity.preparation import prepare
from comity.scenario import load_scenario
from comity_sim2d import EPISODE, VISIT, speeds_m_s


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The folder of a run of two visits."""
    from comity.recording import record

    out = tmp_path_factory.mktemp("metrics") / "visits"
    return record(prepare(load_scenario("two-visits")), out=out, views=())


def test_the_figures_of_a_visit_are_those_of_the_visit(run):
    """Where the account and the figures speak of the same thing, they agree."""
    for visit in run.answer.visits:
        error = visit.distance_reached_m - visit.distance_wanted_m
        assert run.answer.figures[visit.person]["stop_distance_error_m"] == pytest.approx(error, abs=0.002)
    assert run.answer.metrics["min_clearance_m"] == pytest.approx(
        min(visit.distance_reached_m for visit in run.answer.visits), abs=0.01
    )
    assert 0.5 < run.answer.metrics["success_weighted_by_path_length"] <= 1.0


def test_the_time_that_a_run_took_is_one_of_its_metrics(run):
    assert run.answer.metrics["duration_s"] == run.answer.simulated_s > 10.0


def test_to_stand_beside_somebody_is_no_stall_though_the_robot_docks_anew_later(tmp_path):
    """It stands for a while from its first docking on; then the guest moves on, and it follows."""
    file = tmp_path / "moves.scenario.yaml"
    file.write_text(
        "schema_version: 1\nname: moves\nplace: {width_m: 8, height_m: 5}\nrobot: {at_m: [1, 1]}\n"
        "people: {guest: {at_m: [3.5, 2.0], facing_deg: 200}}\ngoals: [{greet: guest}]\n"
        "changes: [{at_s: 5.8, person: guest, moves_to_m: [5.5, 3.0], facing_deg: 200}]\n"
    )
    ran = execute(prepare(load_scenario(str(file))))
    docked = [event.t for event in ran.events if event.node == "docked?(guest)" and event.status == "success"]
    assert docked[0] < 5.8 < ran.visits[0].docked_s
    stood = ran.frames.time_s[1:][speeds_m_s(ran.frames) < 0.02]
    assert (stood > docked[0]).sum() * 0.05 > 0.5
    assert ran.metrics.stalled_s == pytest.approx((stood <= docked[0]).sum() * 0.05, abs=0.11)


@pytest.mark.parametrize(
    ("at_s", "on_the_way"), [(1, True), (15, False)], ids=["on the way there", "after the robot has docked"]
)
def test_the_stop_is_measured_against_what_was_wanted_when_the_robot_docked(tmp_path, at_s, on_the_way):
    """The guest asks for more room: before the stop it is what was wanted there, and afterwards it is not."""
    file = tmp_path / "asks.scenario.yaml"
    file.write_text(
        "schema_version: 1\nname: asks\nplace: {width_m: 9, height_m: 5}\nrobot: {at_m: [1, 2.5]}\n"
        "people: {guest: {at_m: [5, 2.5], facing_deg: 180}}\n"
        "goals: [{greet: guest}, {wait_s: 20, with: guest}]\n"
        f"changes: [{{at_s: {at_s}, person: guest, says: {{conversational_distance: 1.6}}}}]\n"
    )
    prepared = prepare(load_scenario(str(file)))
    first_m = prepared.values["guest"]["conversational_distance"].number
    ran = execute(prepared)
    stop, visit = ran.metrics.stopping["guest"], ran.visits[0]
    assert visit.docked_at.distance_m == pytest.approx(1.6, abs=0.01)
    assert stop.stop_distance_error_m == pytest.approx(0.0, abs=0.01)
    assert ran.metrics.min_clearance_m == pytest.approx(1.6 if on_the_way else first_m, abs=0.01)
    assert stop.overshoot_m == pytest.approx(0.0, abs=0.01)


def test_every_figure_is_shown_with_what_it_means(run, comity):
    done = comity("metrics", run.folder.path)
    for name in run.answer.metrics:
        assert name in done.out
    assert EPISODE["path_length_m"].means in done.out
    assert EPISODE["path_length_m"].source in done.out
    assert "host" in done.out


def test_a_table_of_two_runs_has_one_figure_a_line(run, comity, tmp_path):
    out = tmp_path / "figures.csv"
    comity("metrics", run.folder.path, run.folder.path, "--out", out)
    rows = list(csv.DictReader(out.open()))
    account = run.answer
    each = len(account.metrics) + sum(map(len, account.figures.values()))
    assert len(rows) == 2 * each
    assert {row["metric"] for row in rows} <= {*EPISODE, *VISIT}
    stop = next(row for row in rows if row["metric"] == "stop_distance_error_m" and row["person"] == "guest")
    assert float(stop["value"]) == account.figures["guest"]["stop_distance_error_m"]
    assert stop["profile"] == account.profiles["guest"]


def test_the_answer_has_figures_and_their_definitions(run, comity):
    answer = comity("metrics", run.folder.path, "--json").json
    assert {figure["metric"] for figure in answer["figures"]} <= answer["definitions"].keys()


def test_means_by_profile_are_those_of_the_people_of_a_profile(run, comity):
    answer = comity("metrics", run.folder.path, run.folder.path, "--json").json
    for metric, mean in answer["by_profile"][run.answer.profiles["guest"]].items():
        people = [
            name for name in run.answer.figures if run.answer.profiles[name] == run.answer.profiles["guest"]
        ]
        values = [run.answer.figures[name][metric] for name in people if metric in run.answer.figures[name]]
        assert mean == pytest.approx(sum(values) / len(values))
    assert "Means over the people of each profile in 2 runs" in comity("metrics", *[run.folder.path] * 2).out


def test_a_table_of_somebody_else_is_not_overwritten(run, comity, tmp_path):
    mine = tmp_path / "mine.csv"
    mine.write_text("a,b\n1,2\n")
    done = comity("metrics", run.folder.path, "--out", mine)
    assert done.code == 2
    assert "nothing is overwritten" in done.err
    assert mine.read_text() == "a,b\n1,2\n"


def test_a_folder_without_a_run_is_refused(comity, tmp_path):
    done = comity("metrics", tmp_path)
    assert done.code == 2
    assert "the folder of a run" in done.err
