"""Changes of the rulebook that ships: a rule flipped, a term renamed or moved, another neutral value."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from tests.mutants.mutation import Mutation

FILE = "fis/comity_fis/rulebooks/bruno2017.yaml"
FLIPS = {
    "close": "far",
    "medium": "close",
    "far": "medium",
    "slow": "fast",
    "front": "side",
    "front_side": "front",
    "both": "verbal",
    "verbal": "gestural",
    "nod": "wave",
    "wave": "bow",
    "bow": "nod",
    "handshake": "wave",
    "palms_together": "nod",
}
SWAPS = {
    "LC1": "LC2",
    "LC2": "LC1",
    "female": "male",
    "male": "female",
    "seated": "standing",
    "standing": "seated",
}
RULE = re.compile(r"- rule: if (?P<condition>.*) then (?P<parameter>\w+) is (?P<term>\w+)")
TERM = re.compile(r"^      (?P<term>\w+): \{trapezoid: \[(?P<points>[^\]]+)\]\}", re.MULTILINE)
NEUTRAL = re.compile(r"^    neutral: (?P<value>\S+)", re.MULTILINE)
PARAMETER = re.compile(r"^  (?P<name>\w+):$", re.MULTILINE)


def mutations(root: Path) -> Iterator[Mutation]:
    """All of them."""
    text = (root / FILE).read_text(encoding="utf-8")
    for rule in RULE.finditer(text):
        parameter = rule["parameter"]
        if rule["term"] in FLIPS:
            yield _at(text, rule.span("term"), FLIPS[rule["term"]], "rule flipped", parameter)
        for word in re.finditer(r"\w+", rule["condition"]):
            if word[0] in SWAPS:
                start = rule.start("condition") + word.start()
                yield _at(text, (start, start + len(word[0])), SWAPS[word[0]], "condition flipped", parameter)
    for term in TERM.finditer(text):
        parameter = _around(text, term.start())
        if not re.search(rf"- rule: .*\b{parameter} is {term['term']}\b", text):
            continue  # no rule speaks of it: nothing could change
        yield _at(text, term.span("term"), f"{term['term']}_2", "term renamed", parameter, term["term"])
        moved = ", ".join(f"{float(point) * 1.1:.3f}" for point in term["points"].split(", "))
        yield _at(text, term.span("points"), moved, "term moved", parameter, term["term"])
    for neutral in NEUTRAL.finditer(text):
        value = neutral["value"]
        new = {"both": "verbal", "nod": "wave", "0": "60"}.get(value) or f"{float(value) * 1.3:.3f}"
        yield _at(text, neutral.span("value"), new, "neutral value", _around(text, neutral.start()))


def _around(text: str, start: int) -> str:
    return [found["name"] for found in PARAMETER.finditer(text, 0, start)][-1]


def _at(text: str, span: tuple[int, int], new: str, family: str, *culprits: str) -> Mutation:
    line = text.count("\n", 0, span[0]) + 1
    return Mutation("rulebook", FILE, line, family, *span, text[slice(*span)], new, culprits)
