"""The same scenario, seed, code and platform give the same bytes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from datetime import date
from pathlib import Path

import pytest
import yaml

from comity.output.resolved import resolved_yaml
from comity.preparation import prepare
from comity.scenario import LimitsSpec, PersonSpec, Scenario, load_scenario


def run_apart(hash_seed: str, folder: Path, *words: str) -> dict[str, object]:
    """Run in a process of its own, with a hash seed of its own."""
    done = subprocess.run(
        [sys.executable, "-m", "comity", "run", *words, "--json"],
        cwd=folder,
        env={**os.environ, "PYTHONHASHSEED": hash_seed},
        capture_output=True,
        text=True,
        check=True,
    )
    return json.loads(done.stdout)


def test_processes_with_other_hash_seeds_agree_to_the_byte(here):
    first = run_apart("1", here, "two-visits", "--out", "first")
    second = run_apart("2", here, "two-visits", "--out", "second")
    assert first["trace_sha256"] == second["trace_sha256"]
    for name in set(first["files"]) - {"run.json", "replay.html"}:  # these two name the folder
        assert (here / "first" / name).read_bytes() == (here / "second" / name).read_bytes(), name


def test_another_profile_is_another_episode(comity):
    digests = {
        profile: comity("run", "--as", f"johanna={profile}", "--json").json["trace_sha256"]
        for profile in ("arab_woman", "german_woman", "arab_man", "german_man")
    }
    assert len(set(digests.values())) == 4


def test_a_run_folder_runs_again_from_its_own_scenario(comity, here):
    """Profiles and rulebook are written out, so the resolved scenario needs nothing else."""
    first = comity("run", "two-visits", "--as", "guest=japanese_woman", "--out", "first", "--json").json
    again = comity("run", "first/scenario.yaml", "--out", "second", "--json").json
    assert again["trace_sha256"] == first["trace_sha256"]
    assert again["rulebook"] == first["rulebook"]


def test_the_trace_holds_no_path_date_or_version(comity, here):
    comity("run", "--out", "run")
    trace = (here / "run" / "trace.jsonl").read_text()
    for stranger in (str(here), "202", "0.1.0", ".yaml"):
        assert stranger not in trace, stranger


def test_the_seed_matters_where_the_sensors_are_noisy(comity, here):
    from comity.system.library import shipped

    text = shipped("scenario")["johanna"].read_text()
    noisy = text.replace("  facing_deg: 90\n", "  facing_deg: 90\n  sensor: {noise_m: 0.03, delay_s: 0.1}\n")
    assert noisy != text
    (here / "noisy.scenario.yaml").write_text(noisy)
    answers = [comity("run", "noisy.scenario.yaml", "--seed", seed, "--json").json for seed in (0, 0, 1)]
    digests = [answer["trace_sha256"] for answer in answers]
    assert digests[0] == digests[1] != digests[2]
    assert [answer["outcome"] for answer in answers] == ["success"] * 3


@pytest.mark.parametrize("name", ["comity-bench-1/apartment-study", "learnt-distance", "passers-by"])
def test_the_scenario_of_a_run_is_in_the_order_in_which_people_write(name):
    """First who or what it is; then as the schema lists it, also what only the run knows."""
    written = yaml.safe_load(resolved_yaml(prepare(load_scenario(name), at=date(2026, 1, 1))))
    limits, place = written["limits"], written["place"]
    assert "at" in written
    assert "attend_s" in limits
    assert list(written) == [key for key in Scenario.model_fields if key in written]
    assert list(limits) == [key for key in LimitsSpec.model_fields if key in limits]
    for person in written["people"].values():
        where = [key for key in PersonSpec.model_fields if key in person and key != "profile"]
        assert list(person) == ["profile", *where]
    for piece in (place.get("map") or place)["furniture"]:
        assert next(iter(piece)) == "name"
