"""Source positions (file and line) of the rules that a failure refers to."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from comity.testing.trials.case import Across, from_here
from comity_fis.loading import is_fis

if TYPE_CHECKING:
    from comity.testing.trials.case import Case
    from comity_fis.validation.yaml_file import YamlFile

_NUMBERED = re.compile(r"\brule (\d+)\b|\brules (\d+(?:, \d+)*)")
_QUOTED = re.compile(r"^rule {6}(.*?)(?: \(\d\.\d\d\))?$")
"""A rule in a causal chain, with its firing strength."""
_EDITED, _NOW = "edited ", " -> "


def cited(case: Case | Across, reasons: Iterable[str]) -> str:
    """Rules named in these lines with their positions, in the rulebook's order; empty without any.

    Args:
        case: The case that reads the rulebook.
        reasons: The lines of a failure.
    """
    one = case.cases[0] if isinstance(case, Across) else case
    file = one.rulebook_file
    if is_fis(file.path):  # converted to YAML, so its lines differ
        return ""
    rules = [str(rule["rule"]) for rule in file.data.get("rules") or ()]
    numbers = sorted({number for line in reasons for number in _numbers(line, rules)})
    return ", ".join(f"rule {number} in {_place(file, number)}" for number in numbers if number <= len(rules))


def _numbers(line: str, rules: list[str]) -> Iterator[int]:
    if line.startswith(_EDITED):  # the old text has the number of another rulebook
        line = line.rpartition(_NOW)[2]
    found = (one or several for one, several in _NUMBERED.findall(line))
    yield from (int(number) for numbers in found for number in numbers.split(", "))
    quoted = _QUOTED.match(line)
    if quoted and quoted[1] in rules:
        yield rules.index(quoted[1]) + 1


def _place(file: YamlFile, number: int) -> str:
    where = file.where(("rules", number - 1, "rule"))
    return str(replace(where, file=str(from_here(Path(where.file)) or where.file)))
