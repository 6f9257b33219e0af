"""`comity metrics`: the figures of runs, for readers and for statistics programs."""

from __future__ import annotations

import csv

import pytest

from comity_sim2d import EPISODE, VISIT


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """The folder of a run of two visits."""
    from comity.preparation import prepare
    from comity.recording import record
    from comity.scenario import load_scenario

    out = tmp_path_factory.mktemp("metrics") / "visits"
    return record(prepare(load_scenario("two-visits")), out=out, pictures=False)


def test_the_figures_of_a_visit_are_those_of_the_visit(run):
    """Where the account and the figures speak of the same thing, they agree."""
    for visit in run.answer.visits:
        error = visit.distance_reached_m - visit.distance_wanted_m
        assert run.answer.figures[visit.person]["stop_distance_error_m"] == pytest.approx(error, abs=0.002)
    assert run.answer.metrics["min_clearance_m"] == pytest.approx(
        min(visit.distance_reached_m for visit in run.answer.visits), abs=0.01
    )
    assert 0.5 < run.answer.metrics["success_weighted_by_path_length"] <= 1.0


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
    each = 1 + len(account.metrics) + sum(map(len, account.figures.values()))
    assert len(rows) == 2 * each
    assert {row["metric"] for row in rows} <= {*EPISODE, *VISIT}
    stop = next(row for row in rows if row["metric"] == "stop_distance_error_m" and row["person"] == "guest")
    assert float(stop["value"]) == account.figures["guest"]["stop_distance_error_m"]
    assert stop["profile"] == account.profiles["guest"]


def test_the_answer_has_figures_and_their_definitions(run, comity):
    answer = comity("metrics", run.folder.path, "--json").json
    assert {figure["metric"] for figure in answer["figures"]} <= answer["definitions"].keys()


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
