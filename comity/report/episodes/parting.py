"""Divergence of two runs, and faults that occurred in only one of them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING

from comity.output.run_folder import SCENARIO
from comity.report.episodes.why import differences
from comity.scenario import load_scenario
from comity.specification.fault import in_words
from comity_executor import Cause

if TYPE_CHECKING:
    from comity.report.episodes.trace import StoredTrace
    from comity_executor import Divergence


def parting(one: StoredTrace, other: StoredTrace) -> tuple[Divergence, ...]:
    """The first divergences of two runs: in parameter values, then in actions and their times.

    A fault may delay a run without being the cause of any node's state, so faults of one run up to then are
    reported.
    """
    return tuple(_with_faults(found, one, other) for found in differences(one.history, other.history))


def _with_faults(found: Divergence, one: StoredTrace, other: StoredTrace) -> Divergence:
    mine, theirs = (dict.fromkeys(_faults_until(found.t, recorded)) for recorded in (one, other))
    told = {cause.text for pair in found.causes for cause in pair if cause}
    pairs = zip_longest(
        [Cause("fault", text, None) for text in mine if text not in theirs and text not in told],
        [Cause("fault", text, None) for text in theirs if text not in mine and text not in told],
    )
    return replace(found, causes=(*found.causes, *pairs))


def _faults_until(t: float, recorded: StoredTrace) -> Iterator[str]:
    scenario = Path(recorded.episode) / SCENARIO
    if scenario.is_file():
        faults = load_scenario(str(scenario)).scenario.faults
        yield from (in_words(fault) for fault in faults if fault.at_s <= t)
