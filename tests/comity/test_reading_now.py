"""`comity trace --why T` has the reading of that time beside the one at which things changed."""

from __future__ import annotations

import csv

import pytest


@pytest.fixture
def run(here, comity):
    assert comity("run", "two-visits", "--out", "run", "--no-pictures").code == 0
    with (here / "run" / "readings.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.parametrize("t", [0.0, 1.23, 4.0, 9.99])
def test_the_reading_is_the_last_one_of_that_person_by_then(run, comity, t):
    (answer, *_) = comity("trace", "run", "--why", str(t), "--json").json["why"]
    person = answer["event"]["node"].split("(")[1].rstrip(")").split(", ")[-1]
    last = [row for row in run if row["person"] == person and float(row["t"]) <= t + 1e-6][-1]
    assert answer["now"] == {key: value if key == "person" else float(value) for key, value in last.items()}


def test_a_damaged_file_of_readings_is_told_with_its_name(run, here, comity):
    path = here / "run" / "readings.csv"
    path.write_text(path.read_text(encoding="utf-8") + "host,nonsense\n", encoding="utf-8")
    said = comity("trace", "run", "--why", "9999")
    assert said.code == 2
    assert "readings.csv" in said.err
