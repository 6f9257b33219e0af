"""A Dask cluster by its address: the same table, also where a worker is killed and the cluster is lost."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from contextlib import contextmanager
from pathlib import Path

import pytest
from study.writing import population, study

BIN = Path(sys.executable).parent
pytest.importorskip("distributed", reason="Dask is not installed (`comity[study]`)")


@contextmanager
def cluster(here: Path):
    """A scheduler with two workers on this machine: its address and the three processes."""
    file = here / "scheduler.json"
    words = ["--no-dashboard", "--scheduler-file", str(file)]
    processes = [begun("scheduler", "--host", "127.0.0.1", "--port", "0", *words)]
    try:
        while not file.exists():
            assert processes[0].poll() is None
            time.sleep(0.1)
        words += ["--nthreads", "1", "--no-nanny", "--host", "127.0.0.1"]
        processes += [begun("worker", *words) for _ in range(2)]
        yield json.loads(file.read_text())["address"], processes
    finally:
        for process in processes:
            process.kill()
            process.wait()


def begun(*words: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-m", "dask", *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    )


def running(address: str, out: str) -> subprocess.Popen[bytes]:
    """The command, once its journal has an episode."""
    command = [BIN / "comity", "study", "run", "s.yaml", "--out", out, "--scheduler", address, "--json"]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    journal = Path(out) / "journal.jsonl"
    while process.poll() is None and not (journal.exists() and journal.stat().st_size):
        time.sleep(0.05)
    return process


@pytest.fixture
def noisy(here, comity):
    """24 episodes, and their table by one process here."""
    population(here / "people.yaml")
    factors = {"robot.sensor.noise_m": [0.02], "rulebook": ["bruno2017", "evidence"]}
    study(here / "s.yaml", population="people.yaml", factors=factors, seeds=3)
    assert comity("study", "run", "s.yaml", "--out", "here", "--jobs", "1").code == 0
    return (here / "here/results.csv").read_bytes()


@pytest.mark.integration
def test_a_cluster_that_loses_a_worker_writes_the_same_table_and_one_that_is_lost_can_be_resumed(
    here, comity, noisy
):
    with cluster(here) as (address, (scheduler, worker, _)):
        process = running(address, "there")
        worker.kill()
        _, err = process.communicate()
        assert process.returncode == 0, err
        assert (here / "there/results.csv").read_bytes() == noisy
        process = running(address, "lost")
        scheduler.kill()
        _, err = process.communicate()
        assert process.returncode == 1
        assert b"to go on" in err
        assert b"Traceback" not in err
    answer = comity("study", "run", "s.yaml", "--out", "lost", "--json").json
    assert 0 < answer["run_now"] < 24
    assert (here / "lost/results.csv").read_bytes() == noisy


@pytest.mark.integration
def test_an_address_where_no_cluster_answers_is_refused(here, comity, noisy, monkeypatch):
    monkeypatch.setattr("comity.study.cluster_workers.PATIENCE_S", 2.0)
    said = comity("study", "run", "s.yaml", "--out", "nowhere", "--scheduler", "tcp://127.0.0.1:9")
    assert said.code == 2
    assert "tcp://127.0.0.1:9" in said.err
