"""Maps user-chosen names to PDDL names: `Front`, `robot`, `and`, `Zoë` and a second `front` must all work."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import NamedTuple

from comity_domain.problem.agenda import PLAIN

RESERVED = frozenset(
    (
        *(
            "robot",
            "place",
            "user",
            "location",
            "side",
            "modality",
            "gesture",
            "company",
            "turn",
            "task",
            "thing",
        ),
        *("at", "docked", "free", "holds", "greeted", "due", "done", "whole", "waits", "now", "begun"),
        *("reachable", "permitted", "route", "after", "way_to", "empty", "suits", "leaves_open"),
        *("only_greeted", "opens", "follows", "last", "of", "farewell", "dropped", "skipped"),
        *(
            "brings",
            "first_brought",
            "kept",
            "member",
            "overlooks",
            "welcome",
            "lasts",
            "then",
            "then_together",
        ),
        *("travel_cost", "fetch_cost", "greet_cost", "greet_together_cost", "leave_cost", "skip_cost"),
        *("distance_mm", "speed_mm_s", "direction_mdeg"),
        *("reach_user", "greet_person", "greet_company", "fetch", "return_to_user"),
        *("offer", "take_leave", "skip_visit", "visit"),
        *(word for kind in PLAIN for word in (kind.action.lower(), kind.fact, *kind.thousandths)),
        *("and", "or", "not", "imply", "exists", "forall", "when", "either", "object", "number"),
        *("define", "domain", "problem", "increase", "decrease", "assign", "minimize", "maximize"),
        *("start", "end", "over", "all"),
    )
)
"""Names that no object may have: those of `visit.pddl` (compared by a test) and PDDL keywords.

In unified-planning all names are unique, and PDDL ignores case.
"""


class PddlWord(NamedTuple):
    """A name and its kind: a person and a gesture may share a name."""

    kind: str
    name: str


@dataclass(frozen=True, slots=True)
class PddlNames:
    """A bijection between names and PDDL names."""

    ids: Mapping[PddlWord, str]
    words: Mapping[str, PddlWord]

    def id(self, kind: str, name: str) -> str:
        """The PDDL name of a name."""
        return self.ids[PddlWord(kind, name)]

    def name(self, word: str) -> str:
        """The name behind a PDDL name."""
        return self.words[word].name


def name_all(words: Iterable[PddlWord]) -> PddlNames:
    """Give each name a unique PDDL name; a plain lower-case name stays unchanged if possible."""
    words_by_id: dict[str, PddlWord] = {}
    for word in dict.fromkeys(words):
        words_by_id[_free_id(_plain(word), words_by_id)] = word
    return PddlNames({word: id_ for id_, word in words_by_id.items()}, words_by_id)


def _plain(word: PddlWord) -> str:
    """The name in characters that every PDDL tool accepts."""
    ascii_only = unicodedata.normalize("NFKD", word.name).encode("ascii", "ignore").decode()
    plain = re.sub(r"[^a-z0-9]+", "_", ascii_only.lower()).strip("_")
    return plain if plain[:1].isalpha() else f"{word.kind}_{plain}".rstrip("_")


def _free_id(wanted: str, taken: Mapping[str, PddlWord]) -> str:
    candidate, count = wanted, 0
    while candidate in RESERVED or candidate in taken:
        count += 1
        candidate = f"{wanted}_{count}"
    return candidate
