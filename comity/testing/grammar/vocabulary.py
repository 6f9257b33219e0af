"""The vocabulary of expectations."""

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
    "_BETWEEN": "between",
    "_BY": "by",
    "_CONTAINS": "contains",
    "_DECIDED": "decided",
    "_DIFFERS": "differs",
    "_EXACTLY": "exactly",
    "_FOR": "for",
    "_FROM": "from",
    "_GREETING": "greeting",
    "_HEARS": "hears",
    "_IN_THIS_ORDER": "in this order",
    "_IS": "is",
    "_LASTS": "lasts",
    "_MORE": "more",
    "_OF": "of",
    "_OR": "or",
    "_SAME_FOR_ALL": "same for all",
    "_TIMES": "times",
    "_TO": "to",
    "_VISITING": "visiting",
    "_VISITS": "visits",
    "_WITH": "with",
    "_WITHIN": "within",
    "_WOULD_COST": "would cost",
    "_AND": "and",
    "BACK": "back",
    "EXCLUDED": "excluded",
    "FAILS": "fails",
    "FINDS_NO_OTHER_PLAN": "finds no other plan",
    "FRONT": "front",
    "HALTED": "halted",
    "LEFT": "left",
    "NEVER": "never",
    "NO": "no",
    "ONCE": "once",
    "PER_PERSON": "per person",
    "REPLANS": "replans",
    "RIGHT": "right",
    "SUCCEEDS": "succeeds",
    "TWICE": "twice",
    "UPDATES_PARAMETERS": "updates parameters",
}
"""Patterns by terminal of the grammar; those with an underscore are dropped from the parse tree."""

MEANING: Mapping[str, str] = {
    "NAME": "a name",
    "NUMBER": "a number",
    "UNIT": "a unit such as cm, s, deg or m/s",
    "$END": "the end",
}
"""Names of the other terminals in messages."""

UNITS = frozenset(chain(*QUANTITIES, (each.unit for each in (*EPISODE.values(), *VISIT.values())))) - {"1"}
"""Units that are converted, and units of metrics."""

_END = r"(?![\w?(\/-])"
"""End of a word: `visits` does not match the start of `visits_made`."""


ARTICLE = rf"(the|an|a){_END}"
"""Articles, which are ignored, in any case."""
QUOTED = r"\"(?!\s*\")[^\"\n]+\"|'(?!\s*')[^'\n]+'"
"""A quoted name."""


def _units() -> str:
    """A regular expression of all units, longer ones first: `m` begins `m/s`."""
    longest = sorted(UNITS, key=lambda unit: (-len(unit), unit))
    return "|".join(re.escape(unit).replace("/", r"\/") for unit in longest)


_OTHERS = rf"""
    NAME: /{QUOTED}|(\.{{0,2}}\/)*[^\W\d][\w.\/-]*\??(\([^)\n]*\))?/
    NUMBER: /[-+]?(\d+(\.\d*)?|\.\d+)(e[-+]?\d+)?/i
    UNIT.2: /({_units()}){_END}/
    _ARTICLE.3: /{ARTICLE}/i
    _POINT: /[,:;]/
    %ignore /\s+/
    %ignore _ARTICLE
    %ignore _POINT
"""

_SHARED = """
    amount: NUMBER [UNIT]
    ?bounds: _AT_LEAST amount -> lower
           | _AT_MOST amount -> upper
           | _BETWEEN amount _AND amount -> between
           | amount [_WITHIN amount] -> around
    ?price: _AT_LEAST amount _MORE -> lower
          | _AT_MOST amount _MORE -> upper
          | _BETWEEN amount _AND amount _MORE -> between
          | amount _MORE [_WITHIN amount] -> around
    names: NAME (_AND? NAME)*
    times: _AT_LEAST _count -> at_least
         | _AT_MOST _count -> at_most
         | _EXACTLY _count -> exactly
    _count: ONCE | TWICE | NUMBER _TIMES
"""


def grammar(rules: Mapping[str, str]) -> str:
    """The whole grammar in lark's form.

    Args:
        rules: Grammar rule of each kind of expectation, by the kind's name.
    """
    keywords = "".join(f"{name}.2: /{_pattern(words)}/i\n" for name, words in KEYWORDS.items())
    kinds = "".join(f"{name}: {rule}\n" for name, rule in rules.items())
    return f"sentence: ({' | '.join(rules)}) [_FOR names]\n{kinds}{_SHARED}{keywords}{_OTHERS}"


def _pattern(words: str) -> str:
    return r"\s+".join(words.split()) + _END
