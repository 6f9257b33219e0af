"""Common phrasings that the grammar lacks, and their equivalents in it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import chain

from comity.testing.trials.nodes import FORMER_NODES
from comity_domain.problem.bound_parameters import ABOUT_VISITS
from comity_executor.memory.visit_context import SAY_ACT
from comity_sim2d.metrics import EPISODE, VISIT, by_short_name
from comity_sim2d.robot.acts import VERBS

_Put = str | Callable[[re.Match[str]], str]

_NUMBER = r"(\d+(?:\.\d+)?)"
_SPACED: Mapping[str, str] = {
    name.replace("_", " "): name
    for name in (*ABOUT_VISITS, *by_short_name(EPISODE), *by_short_name(VISIT))
    if "_" in name
}
"""Names of metrics and parameters, with spaces."""
_ACTS: Mapping[str, str] = {verb: act for act, verb in VERBS.items()}
_VERBS: Mapping[str, str] = {
    **{verb.replace(" ", "_"): act for act, verb in VERBS.items()},
    **dict.fromkeys(("speaks", "utters"), SAY_ACT),
}
"""Name of the node by the robot's action."""
_NAME = r"(\"[^\"]+\"|'[^']+'|\S+?)"
_AMOUNT = r"([\d.]+ ?[a-z/]*)"
_FORMER: Mapping[str, _Put] = {
    rf"^distance within {_AMOUNT}( of the (culture-derived|wanted)( one)?)?": r"docking_error at most \1",
    rf"^distance to {_NAME} within {_AMOUNT}( of the (culture-derived|wanted)( one)?)?": (
        r"docking_error of \1 at most \2"
    ),
    rf"^no intrusion( into an? bystander's distance)? for longer than {_AMOUNT}": (
        r"longest_intrusion at most \2"
    ),
    rf"^no intrusion into {_NAME}'s distance for longer than {_AMOUNT}": (
        r"longest_intrusion of \1 at most \2"
    ),
    rf"^finishes (?:within|in|after|by|before) {_NUMBER} ?(?:s|secs?|seconds?)\b": r"duration at most \1 s",
    rf"^visits {_NAME} before {_NAME}(,? for .*)?$": r"visits in this order: \1, \2\3",
    rf"^never ({'|'.join(_VERBS)}) twice": lambda found: (
        f"{_VERBS[found[1].lower()]} succeeds at most once per person"
    ),
    r"\bplans anew\b": "replans",
    r"\bbinds anew\b": "updates parameters",
    r"\bis ruled out\b": "is excluded",
    r"\bis made of\b": "is decided because",
    rf"\bis (never )?halted by {_NAME}(?= |$)": r"is \1halted because '\2'",
}
"""Present form of sentences by their form in earlier versions."""
_RENAMED: Mapping[str, str] = {
    "reached": "docking_time",
    "speed_at_wanted_plus_0_3_m": "speed_at_target_plus_0_3_m",
    "speed_at_wanted_plus_0_3_m_m_s": "speed_at_target_plus_0_3_m_m_s",
}
"""Present names of metrics by their names in earlier versions."""
_RULES: Mapping[str, _Put] = {
    r"\s*[.!]+$": "",
    r"\bis within\b": "within",
    r"\s*(<=?|≤)\s*": " at most ",
    r"\s*(>=?|≥)\s*": " at least ",
    r"(?<!at least )(?<!at most )(?<!exactly )\b(once|twice|\d+ times)$": r"exactly \1",
    r"\b(less than|smaller than|no more than|not more than|under|below)\b": "at most",
    r"\b(greater than|more than|no less than|not less than|over|above)\b": "at least",
    rf"{_NUMBER} ?(min|minutes?)\b": lambda found: f"{60 * float(found[1]):g} s",
    rf"{_NUMBER} ?(%|percent\b)": lambda found: f"{float(found[1]) / 100:g}",
    rf"\bis (?:about|around|roughly) {_NUMBER} ?([\w/]+)": r"is \1 \2 within 1 \2",
    **_FORMER,
    r"^(no (collisions?|contacts?|touch(es)?)|(collisions?|contacts?) at most 0)$": "touches at most 0",
    r"^touches (nobody|no-?one|no one|nothing)$": "touches at most 0",
    r"^(\S+) is visited before (\S+)$": r"visits in this order: \1, \2",
    r"^(\S+) is visited after (\S+)$": r"visits in this order: \2, \1",
    r"^visits (\S+) after (\S+)$": r"visits in this order: \2, \1",
    r"^visits ([^\s,]+),? (?:and )?then (\S+)$": r"visits in this order: \1, \2",
    r"^(\S+) is approached from ": r"approach to \1 from ",
    r"^greets (\S+) with ": r"greeting of \1 contains ",
    rf"^never ({'|'.join(_ACTS)})$": lambda found: f"{_ACTS[found[1].lower()]} succeeds at most 0 times",
    r"^never (?!replan|update)([\w?]+)$": r"\1 never succeeds",
    rf"\b({'|'.join(sorted(_SPACED, key=len, reverse=True))})\b": lambda found: _SPACED[found[1].lower()],
}
"""Replacement by pattern, case-insensitive."""


def renamed(metric: str, text: str) -> str | None:
    """The sentence with the metric's present name; None if the metric was never renamed."""
    now = _RENAMED.get(metric)
    return re.sub(rf"\b{metric}\b", now, text, count=1) if now else None


def rewordings(sentence: str) -> Iterator[str]:
    """Rephrased sentences that may parse: with one replacement, or with all possible ones.

    Args:
        sentence: The sentence as written.
    """
    text = sentence
    for former, now in FORMER_NODES.items():
        text = re.sub(rf"\b{former}\b", now, text)
    single = [re.sub(found, put, text, flags=re.IGNORECASE) for found, put in _RULES.items()]
    every = text
    for found, put in _RULES.items():
        every = re.sub(found, put, every, flags=re.IGNORECASE)
    yield from dict.fromkeys(other for other in chain([text], single, [every]) if other != sentence)
