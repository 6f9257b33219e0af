"""The page docs/reference/evidence.md, made from the rulebook: `python tests/evidence_page.py` writes it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from comity_fis import NominalParameter, NumericParameter, Parameter, Rule, Rulebook, load_rulebook

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "evidence.md"

HEAD = """\
# The rulebook `evidence`

<!-- Made from the rulebook by tests/evidence_page.py; a test holds the two together. -->

{description}

Of the {findings} findings in its {rules} rules, {on} are on. A rule is on if its evidence is strong
or moderate, or if it is a norm: what ought to be, which no study decides. It is off if it is weak or
contested: then it is there to be read, `comity explain` names it, and it decides nothing. `finding` is
the key of a finding in the table that the rules were written from; one finding may need several rules.
Most sources were read as abstracts or as quoted elsewhere, and each says which.

A grade says how well a finding is supported, and not how large the effect is: every value is a
prior, with the spread that stands beside its parameter.

One measure for all. A finding is weak where it rests on a theory, on memory, on one project's choice, on
one or two dozen people, or on something else than what its rule says, such as postures for gestures, cities
for robots, or a comparison of two countries for all. It is contested where studies of the same thing found
the opposite.
"""

BEHAVIOURS = """\
## What reaches a behaviour

| parameter | what changes in the world |
|---|---|
| `conversational_distance` | where the robot stops, and where it falls back to |
| `approach_direction` | on which side it stops |
| `approach_speed` | how fast it glides onto its place |
| `greeting_modality`, `greeting_gesture` | what it does |
| `greeting_language`, `formality`, `verbal_directness`, `rhetorical_style` | which words the utterance has |
| `voice_volume` | stands in the record of the utterance, and in the picture |
| `speech_rate` | how long the utterance takes |
| `gesture_amplitude` | stands in the record of the gesture, and in the picture |
| `touch` | `none`, asked for, takes the handshake out whatever was consented to; else nothing by itself |
| `bow_extent`, `mutual_gaze`, `initiative`, `explanation_level` | nothing: no rule for them is on |

For `speech_rate`, `gesture_amplitude`, `verbal_directness`, `formality` and `rhetorical_style` no rule is on
either: what a person asks for decides, else the neutral value.
"""


def page(rulebook: Rulebook) -> str:
    """The whole page."""
    on = {rule.finding for rule in rulebook.rules if rule.enabled}
    head = HEAD.format(
        description=rulebook.description.strip(),
        findings=len({rule.finding for rule in rulebook.rules}),
        rules=len(rulebook.rules),
        on=len(on),
    )
    rules = (
        "## Rules",
        *(part for parameter in rulebook.parameters for part in _rules(rulebook, parameter)),
    )
    parts = (
        head,
        _on(rulebook),
        _parameters(rulebook.parameters.values()),
        BEHAVIOURS,
        *rules,
        _sources(rulebook),
    )
    return "\n".join(part.rstrip() + "\n" for part in parts)


def _on(rulebook: Rulebook) -> str:
    """What is on and why: each finding once, with how its sources measured it."""
    by_finding = {rule.finding: rule for rule in rulebook.rules if rule.enabled}
    rows = [
        (
            rule.finding,
            ", ".join(dict.fromkeys(is_.name for is_ in rule.consequents)),
            rule.evidence,
            ". ".join(f"{source.key}: {source.measured}" for source in rule.sources),
        )
        for rule in by_finding.values()
    ]
    return "## What is on, and why\n\n" + _table(
        ("finding", "parameter", "grade", "how it was measured"), rows
    )


def _parameters(parameters: Iterable[Parameter]) -> str:
    rows = [_parameter(parameter) for parameter in parameters]
    head = ("parameter", "unit", "rules give", "may be asked for", "safety", "terms", "neutral", "spread")
    return "## Parameters\n\n" + _table(head, rows) + f"\n\n{RANGES}"


RANGES = (
    "Why each number is as it is stands in the rulebook file, below `reasons`; nearly all are design choices."
)


def _parameter(parameter: Parameter) -> Sequence[str]:
    name = f"`{parameter.name}`"
    if isinstance(parameter, NominalParameter):
        return name, "", "", "", "", ", ".join(parameter.terms), parameter.neutral, ""
    shift = f"; moved by {', '.join(parameter.shift.terms)}" if parameter.shift else ""
    return (
        name,
        "" if parameter.unit == "1" else parameter.unit,
        str(parameter.rules),
        str(parameter.ask),
        _safe(parameter),
        ", ".join(parameter.terms) + shift,
        f"{parameter.neutral:g}",
        f"{parameter.spread:g}",
    )


def _safe(parameter: NumericParameter) -> str:
    low, high = parameter.safe.ends
    ends = [f"at least {low:g}"] if low > float("-inf") else []
    ends += [f"at most {high:g}"] if high < float("inf") else []
    return ", ".join(ends) or "-"


def _rules(rulebook: Rulebook, parameter: str) -> Iterator[str]:
    rules = [rule for rule in rulebook.rules if rule.consequents[0].name == parameter]
    if rules:
        yield f"### {parameter}\n\n" + _table(
            ("finding", "rule", "evidence", "", "sources", "against it, and what is ours"), map(_rule, rules)
        )


def _rule(rule: Rule) -> Sequence[str]:
    remarks = ". ".join(filter(None, (rule.counter_evidence, rule.note)))
    keys = ", ".join(f"[{source.key}](#{source.key})" for source in rule.sources)
    return rule.finding, f"`{rule.text}`", rule.evidence, "on" if rule.enabled else "off", keys, remarks


def _sources(rulebook: Rulebook) -> str:
    rows = [
        (
            f'<a id="{source.key}"></a>{source.key}',
            source.citation,
            source.found,
            source.measured,
            source.verified,
        )
        for source in rulebook.sources.values()
    ]
    return "## Sources\n\n" + _table(("key", "source", "found", "how measured", "what was read"), rows)


def _table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    lines = [head, tuple("---" for _ in head), *rows]
    return "\n".join(f"| {' | '.join(' '.join(cell.split()) for cell in line)} |" for line in lines)


if __name__ == "__main__":
    PAGE.write_text(page(load_rulebook("evidence")), encoding="utf-8")
