"""The words that expectations are made of."""

from __future__ import annotations

import re
from collections.abc import Mapping
from itertools import chain

from comity_fis.variables.unit import QUANTITIES
from comity_sim2d.metrics import EPISODE, VISIT

KEYWORDS: Mapping[str, str] = {
    "_APPROACH": "approach",
    "_AT_LEAST": "at least",
    "_AT_MOST": "at most",
    "_BECAUSE": "because",
    "_BEFORE": "before",
    "_BETWEEN": "between",
    "_BINDS_ANEW": "binds anew",
    "_BY": "by",
    "_BYSTANDER": "bystander",
    "_CONTAINS": "contains",
    "_CULTURE_DERIVED": "culture-derived",
    "_DECIDED_BY": "decided by",
    "_DIFFERS": "differs",
    "_DISTANCE": "distance",
    "_EXACTLY": "exactly",
    "_FAILS": "fails",
    "_FINDS_NO_OTHER_PLAN": "finds no other plan",
    "_FINISHES": "finishes",
    "_FOR": "for",
    "_FROM": "from",
    "_GREETING": "greeting",
    "_HALTED": "halted",
    "_HEARS": "hears",
    "_INTO": "into",
    "_INTRUSION": "intrusion",
    "_IN_THIS_ORDER": "in this order",
    "_IS": "is",
    "_LASTS": "lasts",
    "_LONGER_THAN": "longer than",
    "_MADE_OF": "made of",
    "_MORE": "more",
    "_NEVER": "never",
    "_OF": "of",
    "_ONE": "one",
    "_OR": "or",
    "_PLANS_ANEW": "plans anew",
    "_RULED_OUT": "ruled out",
    "_SAME_FOR_ALL": "same for all",
    "_SUCCEEDS": "succeeds",
    "_TIMES": "times",
    "_TO": "to",
    "_VISITING": "visiting",
    "_VISITS": "visits",
    "_WANTED": "wanted",
    "_WITH": "with",
    "_WITHIN": "within",
    "_WOULD_COST": "would cost",
    "_AND": "and",
    "BACK": "back",
    "FRONT": "front",
    "LEFT": "left",
    "NO": "no",
    "ONCE": "once",
    "RIGHT": "right",
    "TWICE": "twice",
}
"""By terminal of the grammar; those with an underscore leave no trace in what was read."""

MEANING: Mapping[str, str] = {
    "NAME": "a name",
    "NUMBER": "a number",
    "UNIT": "a unit such as cm, s, deg or m/s",
    "_POSSESSED": "'s",
    "$END": "the end",
}
"""How messages call the other terminals."""

UNITS = frozenset(chain(*QUANTITIES, (each.unit for each in (*EPISODE.values(), *VISIT.values())))) - {"1"}
"""Those that are converted, and those that metrics are in."""

_END = r"(?![\w?(\/-])"
"""A longer word is another word: `visits` does not begin `visits_made`."""


ARTICLE = rf"(the|an|a){_END}"
"""What is left out of a sentence, in small letters and in capitals."""
QUOTED = r"\"(?!\s*\")[^\"\n]+\"|'(?!\s*')[^'\n]+'"
"""A name that is no plain word."""


def _units() -> str:
    """As a regular expression, the longer first: `m` begins `m/s`."""
    longest = sorted(UNITS, key=lambda unit: (-len(unit), unit))
    return "|".join(re.escape(unit).replace("/", r"\/") for unit in longest)


_OTHERS = rf"""
    NAME: /{QUOTED}|(\.{{0,2}}\/)*[^\W\d][\w.\/-]*\??(\([^)\n]*\))?/
    NUMBER: /[-+]?(\d+(\.\d*)?|\.\d+)(e[-+]?\d+)?/i
    UNIT.2: /({_units()}){_END}/
    _POSSESSED.3: /'s{_END}/
    _ARTICLE.3: /{ARTICLE}/i
    _POINT: /[,:;]/
    %ignore /\s+/
    %ignore _ARTICLE
    %ignore _POINT
"""

_SHARED = """
    amount: NUMBER [UNIT]
    names: NAME (_AND? NAME)*
    times: _AT_LEAST _count -> at_least
         | _AT_MOST _count -> at_most
         | _EXACTLY _count -> exactly
    _count: ONCE | TWICE | NUMBER _TIMES
"""


def grammar(rules: Mapping[str, str]) -> str:
    """The whole grammar in lark's form.

    Args:
        rules: What each kind of expectation looks like, by the kind's name.
    """
    keywords = "".join(f"{name}.2: /{_pattern(words)}/i\n" for name, words in KEYWORDS.items())
    kinds = "".join(f"{name}: {rule}\n" for name, rule in rules.items())
    return f"sentence: ({' | '.join(rules)}) [_FOR names]\n{kinds}{_SHARED}{keywords}{_OTHERS}"


def _pattern(words: str) -> str:
    return r"\s+".join(words.split()) + _END
