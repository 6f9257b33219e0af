"""Words in which people write what expectations say otherwise: the sentence, put as it is understood."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import chain

from comity.testing.metrics.quantity import by_bare_name
from comity_domain.problem.request import PARAMETERS
from comity_sim2d.metrics import EPISODE, VISIT
from comity_sim2d.robot.acts import VERBS

_Put = str | Callable[[re.Match[str]], str]

_NUMBER = r"(\d+(?:\.\d+)?)"
_SPACED: Mapping[str, str] = {
    name.replace("_", " "): name
    for name in (*PARAMETERS, *by_bare_name(EPISODE), *by_bare_name(VISIT))
    if "_" in name
}
"""Names of figures and parameters, with spaces in them."""
_ACTS: Mapping[str, str] = {verb: act for act, verb in VERBS.items()}
_RULES: Mapping[str, _Put] = {
    r"\s*[.!]+$": "",
    r"\bis (at (?:most|least)|within|between)\b": r"\1",
    r"\s*(<=?|≤)\s*": " at most ",
    r"\s*(>=?|≥)\s*": " at least ",
    r"(?<!at least )(?<!at most )(?<!exactly )\b(once|twice|\d+ times)$": r"exactly \1",
    r"\b(less than|smaller than|no more than|not more than|under|below)\b": "at most",
    r"\b(greater than|more than|no less than|not less than|over|above)\b": "at least",
    rf"{_NUMBER} ?(min|minutes?)\b": lambda found: f"{60 * float(found[1]):g} s",
    rf"{_NUMBER} ?(%|percent\b)": lambda found: f"{float(found[1]) / 100:g}",
    rf"\bis (?:about|around|roughly) {_NUMBER} ?([\w/]+)": r"is \1 \2 within 1 \2",
    rf"^finishes (?:in|after|by|before) {_NUMBER} ?(?:s|secs?|seconds?)\b": r"finishes within \1 s",
    r"^(no (collisions?|contacts?|touch(es)?)|(collisions?|contacts?) at most 0)$": "touches at most 0",
    r"^touches (nobody|no-?one|no one|nothing)$": "touches at most 0",
    r"^(\S+) is visited before (\S+)$": r"visits \1 before \2",
    r"^(\S+) is visited after (\S+)$": r"visits \2 before \1",
    r"^visits (\S+) after (\S+)$": r"visits \2 before \1",
    r"^visits ([^\s,]+),? (?:and )?then (\S+)$": r"visits \1 before \2",
    r"^(\S+) is approached from ": r"approach to \1 from ",
    r"^greets (\S+) with ": r"greeting of \1 contains ",
    rf"^never ({'|'.join(_ACTS)})$": lambda found: f"{_ACTS[found[1].lower()]} succeeds at most 0 times",
    r"^never ([\w?]+)$": r"\1 never succeeds",
    rf"\b({'|'.join(sorted(_SPACED, key=len, reverse=True))})\b": lambda found: _SPACED[found[1].lower()],
}
"""By what is looked for, in whatever case, what is put in its place."""


def rewordings(text: str) -> Iterator[str]:
    """The sentence otherwise, which may be understood then: one thing put otherwise, or all that can be.

    Args:
        text: The sentence.
    """
    single = [re.sub(found, put, text, flags=re.IGNORECASE) for found, put in _RULES.items()]
    every = text
    for found, put in _RULES.items():
        every = re.sub(found, put, every, flags=re.IGNORECASE)
    yield from dict.fromkeys(other for other in chain(single, [every]) if other != text)
