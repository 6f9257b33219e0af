"""What `comity study` answers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from pydantic import Field

from comity.answers.base import Answer


class StudyPlanAnswer(Answer):
    """`comity study plan --json`."""

    study: str
    statement: str = Field(description="What its differences between people are, and what they are not.")
    episodes: int
    scenarios: int
    conditions: int
    individuals: int = Field(description="0 where the study has no population.")
    seeds: int
    groups: Mapping[str, int] = Field(description="Individuals by group.")
    wishing: int = Field(description="Individuals who state a wish, which goes before culture.")
    cpu_s_per_episode: float = Field(description="Mean of the episodes that were tried.")
    estimated_s: float = Field(description="On as many processes as `jobs`.")
    jobs: int
    estimated_bytes: int = Field(description="Of the journal and the CSV file.")
    without_effect: tuple[str, ...] = Field(
        description="Scenarios and conditions, of those that were tried, in which a second seed changed no "
        "number."
    )
    tried: int = Field(description="Scenarios under a condition of which episodes were tried.")
    first: tuple[Mapping[str, Any], ...] = Field(description="The first episodes: what each is made of.")


class StudyRunAnswer(Answer):
    """`comity study run --json`, and `study.json` in the folder of a study."""

    study: str
    statement: str = Field(description="What its differences between people are, and what they are not.")
    status: Literal["running", "done", "stopped"]
    episodes: int
    done: int = Field(description="Episodes of the study that the journal holds.")
    run_now: int = Field(description="Those of them that this command carried out.")
    failed: int = Field(description="Episodes that raised, or that no worker survived.")
    rows: int = Field(description="Of the table; 0 before it is written.")
    lost_workers: int = Field(description="Workers that ended during this command before their episode did.")
    version: str
    code: str = Field(description="Digest of the installed code.")
    fingerprint: str
    folder: str
    file: str = Field(description="The study's file, from which `study show` plays rows again.")
    files: tuple[str, ...]


class StudyPowerAnswer(Answer):
    """`comity study power --json`."""

    difference_cm: float
    sd_cm: float = Field(description="Between people.")
    measured: int | None = Field(description="People that the spread was measured with; null: stated.")
    correlation: float | None = Field(
        description="Of one person's two values, where each meets both conditions; null for two groups."
    )
    cluster: int = Field(description="People in each cluster; 1 without clusters.")
    icc: float
    alpha: float = Field(description="Of a two-sided test.")
    power: float = Field(description="As asked for.")
    per_group: int = Field(description="People in each of two groups; all people where each meets both.")
    people: int = Field(description="In all.")
    clusters_per_group: int | None
    design_effect: float
    power_reached: float = Field(description="With that many people.")


class SessionAnswer(Answer):
    """One participant's session."""

    participant: str
    group: str
    block: int
    conditions: tuple[str, ...] = Field(description="In the order in which the participant meets them.")


class StudySessionsAnswer(Answer):
    """`comity study sessions --json`."""

    study: str
    seed: int
    groups: Mapping[str, int] = Field(description="Participants by group; empty for one group.")
    orders: int = Field(description="Different orders of the balanced Latin square.")
    sessions: tuple[SessionAnswer, ...]
    files: tuple[str, ...]
