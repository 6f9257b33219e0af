"""One tidy table: a row a visit, units in the names, a reason for every empty cell; others read it."""

from __future__ import annotations

import shutil
import subprocess
from math import isnan

import pytest
from study.writing import population, study

from comity.study import Study
from comity.study.columns import columns_of
from comity.study.episode_rows import comfort_gap_m
from comity_sim2d import EPISODE, VISIT

ENDS = {"rad/m": "_rad_m", "m/s": "_m_s", "m/s^2": "_m_s2", "m/s^3": "_m_s3"}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Four individuals under two rulebooks in two scenarios; of one of these two people are visited."""
    from comity.study.local_workers import local_carrier
    from comity.study.running import run_study
    from comity.study.study_plan import load_study

    place = tmp_path_factory.mktemp("study")
    population(place / "people.yaml", wishes={"share": 0.5}, seed=1)
    file = study(
        place / "two.yaml",
        scenarios=["johanna", "two-visits"],
        roles={"visited": {"johanna": "johanna", "two-visits": "guest"}},
        population="people.yaml",
        factors={"rulebook": ["bruno2017", "evidence"], "robot.sensor.noise_m": [0.01]},
    )
    run_study(load_study(file), place / "out", lambda: local_carrier(2), lambda *_: lambda _: None)
    return place / "out"


def test_a_row_is_a_visit(folder):
    rows = Study.load(folder).rows
    assert len(rows) == 4 * 2 * (1 + 2)
    assert (
        len({(row["scenario"], row["condition"], row["individual"], row["person"]) for row in rows}) == 24 - 6
    )
    assert [int(row["row"]) for row in rows] == list(range(1, 25))
    assert {row["individual"] for row in rows if row["person"] == "host"} == {""}


def test_every_column_has_a_definition_and_every_measure_its_unit_in_its_name(folder):
    found = Study.load(folder)
    assert list(found.columns) == list(found.rows[0])
    for name, column in found.columns.items():
        assert column["definition"]
        assert column["source"]
        if (unit := column["unit"]) not in ("", "1", "years"):
            assert name.endswith(ENDS.get(unit, f"_{unit}")), name


def test_every_metric_of_a_run_has_a_column():
    names = {*VISIT, *(f"episode_{name}" for name in EPISODE)}
    assert names <= columns_of([], names).keys()


def test_every_empty_cell_has_a_reason(folder):
    found = Study.load(folder)
    for row in found.rows:
        said = [
            name for part in row["why_missing"].split("; ") for name in part.partition(": ")[2].split(", ")
        ]
        silent = {"reason", "deviation_reason", "error", "why_missing"}
        assert {name for name, cell in row.items() if not cell} - silent == {*filter(None, said)}


def test_every_row_says_what_differences_between_people_are(folder):
    assert {row["note"] for row in Study.load(folder).rows} == {
        "Simulated people: differences between profiles are assumptions of the population and the rulebook, "
        "no findings about people."
    }


def test_facts_are_those_that_the_rulebook_used(folder):
    rows = Study.load(folder).rows
    swedes = [row for row in rows if row["group"] == "swedish_women"]
    assert {(row["rulebook_used"], row["fact_gender"]) for row in swedes} == {
        ("bruno2017", "female"),
        ("evidence", ""),
    }
    assert {row["fact_culture"] for row in swedes if row["rulebook_used"] == "bruno2017"} == {"SWE"}


def test_wishes_are_told_with_their_value(folder):
    rows = [row for row in Study.load(folder).rows if row["wish_conversational_distance"]]
    assert rows
    for row in rows:
        assert float(row["distance_target_m"]) == pytest.approx(
            float(row["wish_conversational_distance"]), abs=1e-6
        )


def test_the_gap_is_how_far_outside_the_comfort_the_robot_stopped(folder):
    assert comfort_gap_m(0.5, 0.7, 1.0) == pytest.approx(-0.2)
    assert comfort_gap_m(1.5, 0.7, 1.0) == pytest.approx(0.5)
    assert comfort_gap_m(0.8, 0.7, 1.0) == 0.0
    for row in Study.load(folder).rows:
        if row["comfort_gap_m"]:
            parts = (row[name] for name in ("distance_actual_m", "comfort_near_m", "comfort_far_m"))
            assert float(row["comfort_gap_m"]) == pytest.approx(comfort_gap_m(*map(float, parts)))


def test_pandas_has_numbers_as_numbers(folder):
    frame = Study.load(folder).to_frame()
    assert frame["distance_actual_m"].dtype == float
    assert isnan(frame["late_s"][0])
    by_rulebook = frame[frame["group"].notna()].groupby("rulebook")["distance_target_m"].mean()
    assert set(by_rulebook.index) == {"bruno2017", "evidence"}


def test_individuals_of_a_table_are_told_as_a_run_that_is_passed_on(here, comity):
    (here / "people.csv").write_text("individual,culture,gender,age\nAnna Berg,SWE,female,71\n", "utf-8")
    population(here / "people.yaml", groups={}, table="people.csv")
    factors = {"rulebook": ["bruno2017"]}
    for tell, told in ((None, ("", "")), (["culture", "gender"], ("SWE", "female"))):
        study(here / "s.yaml", population="people.yaml", factors=factors, tell=tell)
        out = f"out-{bool(tell)}"
        assert comity("study", "run", "s.yaml", "--out", out).code == 0
        (row,) = Study.load(out).rows
        assert row["individual"] == "individual_1"
        assert row["fact_age_band"] == "70 to 79"
        assert (row.get("fact_culture", ""), row.get("fact_gender", "")) == told
        for path in (here / out).iterdir():
            assert b"Berg" not in path.read_bytes()
            if not tell and path.suffix in (".csv", ".jsonl"):
                assert b"SWE" not in path.read_bytes()


@pytest.mark.skipif(shutil.which("Rscript") is None, reason="R is not installed (Debian: r-base-core)")
def test_r_reads_the_table(folder):
    script = f"""
        d <- read.csv("{folder / "results.csv"}")
        stopifnot(nrow(d) == 24, is.numeric(d$distance_actual_m), is.numeric(d$robot_sensor_noise_m))
        stopifnot(all(is.na(d$late_s)), is.character(d$rulebook), all(d$outcome == "greeted"))
        cat(sprintf("%.6f", mean(d$distance_target_m[d$rulebook == "evidence"])))
    """
    said = subprocess.run(["Rscript", "--vanilla", "-e", script], capture_output=True, text=True, check=False)
    assert said.returncode == 0, said.stderr
    rows = [row for row in Study.load(folder).rows if row["rulebook"] == "evidence"]
    assert float(said.stdout) == pytest.approx(
        sum(float(row["distance_target_m"]) for row in rows) / len(rows), abs=1e-6
    )


def test_duckdb_reads_the_parquet_file(folder):
    duckdb = pytest.importorskip("duckdb")
    pytest.importorskip("pyarrow")
    path = folder / "results.parquet"
    ((count, mean),) = duckdb.sql(f"SELECT count(*), avg(distance_actual_m) FROM '{path}'").fetchall()
    rows = Study.load(folder).rows
    assert count == len(rows) == 24
    assert mean == pytest.approx(sum(float(row["distance_actual_m"]) for row in rows) / len(rows))
    kinds = {name: kind for name, kind, *_ in duckdb.sql(f"DESCRIBE SELECT * FROM '{path}'").fetchall()}
    assert (kinds["seed"], kinds["late_s"], kinds["group"]) == ("BIGINT", "DOUBLE", "VARCHAR")
