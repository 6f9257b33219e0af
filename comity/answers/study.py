"""What `comity study` answers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from comity_fis.record import Record

StudyState = Literal["running", "interrupted", "incomplete", "done"]
"""Of a study's folder: `interrupted` where it was stopped or killed, `incomplete` where episodes are new."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyPlanAnswer(Record):
    """`comity study plan --json`."""

    study: str
    statement: str
    """What its differences between people are, and what they are not."""
    episodes: int
    scenarios: int
    conditions: int
    individuals: int
    """0 where the study has no population."""
    seeds: int
    groups: Mapping[str, int]
    """Individuals by group."""
    wishing: int
    """Individuals who state a wish, which goes before culture."""
    notes: tuple[str, ...]
    """What may not have been meant, such as a culture without a score."""
    cpu_s_per_episode: float
    """Mean of the episodes that were tried."""
    done: int | None
    """Episodes that the folder of `--out` holds, of this code and platform; null without `--out`."""
    state: StudyState | None
    """Of that folder."""
    estimated_s: float
    """Of the episodes that are not done, on as many processes as `jobs`."""
    jobs: int
    estimated_bytes: int
    """Of the journal and the CSV file."""
    without_effect: tuple[str, ...]
    """Scenarios and conditions, of those that were tried, in which a second seed changed no number."""
    tried: int
    """Scenarios under a condition of which episodes were tried."""
    first: tuple[Mapping[str, Any], ...]
    """The first episodes: what each is made of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyRunAnswer(Record):
    """`comity study run --json`, and `study.json` in the folder of a study."""

    study: str
    statement: str
    """What its differences between people are, and what they are not."""
    status: Literal["begun", "done", "stopped"]
    """`done` where the table has every episode of the study. `begun` is written at the start and stays where
    the command was killed: `progress` of `comity.study.Study` says which."""
    episodes: int
    different: int
    """Different episodes among them: those that depend on the same things are carried out once."""
    done: int
    """Episodes of the study that the journal held as this was written."""
    run_now: int
    """Different episodes that this command carried out."""
    damaged_lines: int
    """Of the journal, which were skipped; their episodes ran again."""
    damaged_at: tuple[str, ...]
    """Where these are: `six/journal.jsonl:12`."""
    other: int
    """Episodes in the journal that the study as it is now does not have: they are not in the table."""
    failed: int
    """Episodes that raised, or that no worker survived."""
    rows: int
    """Of the table; 0 before it is written."""
    lost_workers: int
    """Workers that ended during this command before their episode did."""
    version: str
    code: str
    """Digest of the installed code."""
    fingerprint: str
    folder: str
    file: str
    """The study's file, from which `study show` plays rows again."""
    files: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class StudyPowerAnswer(Record):
    """`comity study power --json`."""

    difference_cm: float
    sd_cm: float
    """Between people."""
    measured: int | None
    """People that the spread was measured with; null: stated."""
    correlation: float | None
    """Of one person's two values, where each meets both conditions; null for two groups."""
    cluster: int
    """People in each cluster; 1 without clusters."""
    icc: float
    alpha: float
    """Of a two-sided test."""
    power: float
    """As asked for."""
    per_group: int
    """People in each of two groups; all people where each meets both."""
    people: int
    """In all."""
    clusters_per_group: int | None
    design_effect: float
    power_reached: float
    """With that many people."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionAnswer(Record):
    """One participant's session."""

    participant: str
    group: str
    block: int
    conditions: tuple[str, ...]
    """In the order in which the participant meets them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class StudySessionsAnswer(Record):
    """`comity study sessions --json`."""

    study: str
    seed: int
    groups: Mapping[str, int]
    """Participants by group; empty for one group."""
    orders: int
    """Different orders of the balanced Latin square."""
    sessions: tuple[SessionAnswer, ...]
    files: tuple[str, ...]
