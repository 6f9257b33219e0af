"""MATLAB's `.fis` files as sections of keys and values, each with its line; what they mean is read elsewhere.

The format is line based: `[System]`, `Name='tipper'`, `Range=[0 30]`, rules as rows of indexes, comments
after `%` (GNU Octave: `#`) outside quotes.
"""

from __future__ import annotations

import re
from codecs import BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isnan
from pathlib import Path

from comity_fis.errors import InputError, Where, unknown_word
from comity_fis.validation.yaml_file import MAX_BYTES

MAX_RULES = 10_000
MAX_VARIABLES = 100

HEAD = re.compile(r"\[\s*(System|Input[1-9]\d{0,2}|Output[1-9]\d{0,2}|Rules)\s*\]")
ASSIGNMENT = re.compile(r"([A-Za-z]+\d{0,4})\s*=\s*(.*)")
TEXT = re.compile(r"'([^']*)'|\"([^\"]*)\"")
CODE = re.compile(r"""(?:[^'"%#]|'[^']*'|"[^"]*")*""")
"""A line up to its comment."""
NUMBER = re.compile(r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,4})?|[Ii]nf|NaN)")
WHOLE = re.compile(r"([-+]?\d{1,9})(?:\.0*)?")
"""Some programs write every number with decimals, `1.000`."""


@dataclass(frozen=True, slots=True)
class MatlabLine:
    """What stands on one line: the value of a key, or a rule."""

    text: str
    where: Where

    def wrong(self, expected: str, remedy: str) -> InputError:
        """A complaint about this line."""
        got = self.text if len(self.text) <= 60 else f"{self.text[:57]}..."
        return InputError(expected=expected, got=repr(got), remedy=remedy, where=self.where)

    def words(self) -> str:
        """The text between quotes."""
        match = TEXT.fullmatch(self.text)
        if match is None:
            raise self.wrong("a text in single quotes", "Write for example 'tipper'.")
        return match[1] if match[1] is not None else match[2]

    def count(self, most: int, least: int = 1) -> int:
        """A whole number from `least` to `most`."""
        number = whole(self.text)
        if number is None or not least <= number <= most:
            raise self.wrong(f"a whole number from {least} to {most}", "Split a larger system.")
        return number

    def number(self, text: str) -> float:
        """One number of the line, which may be infinite."""
        if not NUMBER.fullmatch(text) or isnan(float(text)):
            raise self.wrong(f"a number where {text[:20]!r} stands", "Write for example 0.5 or 1e-3.")
        return float(text)

    def numbers(self, text: str) -> tuple[float, ...]:
        """Numbers between square brackets."""
        text = text.strip()
        if not (text.startswith("[") and text.endswith("]")):
            raise self.wrong("numbers between square brackets", "Write for example [0 0.5 1].")
        return tuple(self.number(word) for word in text[1:-1].replace(",", " ").split())


def whole(text: str) -> int | None:
    """A whole number, with or without decimals that are 0; None for any other text."""
    match = WHOLE.fullmatch(text)
    return int(match[1]) if match else None


@dataclass(frozen=True, slots=True)
class Section:
    """What follows one `[...]` line."""

    name: str
    where: Where
    entries: dict[str, MatlabLine] = field(default_factory=dict)
    rows: list[MatlabLine] = field(default_factory=list)
    """The rules."""

    def entry(self, key: str) -> MatlabLine:
        """The value of a key.

        Raises:
            InputError: if it is missing.
        """
        if key not in self.entries:
            raise InputError(
                expected=f"a line {key}=... in [{self.name}]",
                got="nothing",
                remedy="Add it; the file may be cut off.",
                where=self.where,
            )
        return self.entries[key]

    def refuse_others(self, known: Sequence[str]) -> None:
        """Refuse a key that nobody reads: what it means would be lost."""
        for key, entry in self.entries.items():
            if key not in known:
                raise unknown_word(f"a known key in [{self.name}]", key, known, where=entry.where)


def sections_of(text: str, name: str) -> Mapping[str, Section]:
    """The sections of a file's text, by name and in its order.

    Args:
        text: All of it.
        name: How messages call the file.

    Raises:
        InputError: if a line has no form that a `.fis` file knows.
    """
    sections: dict[str, Section] = {}
    section: Section | None = None
    for number, raw in enumerate(text.splitlines(), 1):
        where = Where(name, number)
        match = CODE.match(raw)
        line = (match[0] if match else "").strip()
        if head := HEAD.fullmatch(line):
            section = Section(head[1], where)
            if sections.setdefault(section.name, section) is not section:
                raise MatlabLine(line, where).wrong("each section once", "Remove or renumber one of them.")
        elif line and section is None:
            raise MatlabLine(line, where).wrong("[System] first", "Is this a .fis file of MATLAB?")
        elif line and section is not None:
            _add(section, MatlabLine(line, where))
    if not sections:
        raise InputError(
            expected="a .fis file of MATLAB", got="no section", remedy="Check the path.", where=Where(name)
        )
    return sections


def _add(section: Section, line: MatlabLine) -> None:
    if section.name == "Rules":
        if len(section.rows) == MAX_RULES:
            raise line.wrong(f"at most {MAX_RULES} rules", "Split the system.")
        section.rows.append(line)
        return
    match = ASSIGNMENT.fullmatch(line.text)
    if match is None:
        raise line.wrong("a section or a line KEY=VALUE", "Comments start with %.")
    if match[1] in section.entries:
        raise line.wrong(f"{match[1]} once in [{section.name}]", "Remove one of the lines.")
    section.entries[match[1]] = MatlabLine(match[2].strip(), line.where)


def read_text(path: Path, name: str) -> str:
    """A file's text.

    Raises:
        InputError: if it cannot be read, is too large, or is no text.
    """

    def refuse(got: str, remedy: str) -> InputError:
        return InputError(expected="a .fis file of MATLAB", got=got, remedy=remedy, where=Where(name))

    try:
        if not path.is_file():
            raise refuse(
                "something else" if path.exists() else "no such file", "Check the path and its spelling."
            )
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
        if len(content) > MAX_BYTES:
            raise refuse(f"more than {MAX_BYTES} bytes", "Split the system.")
        text = _decoded(content)
        if "\0" in text:
            raise refuse("bytes that are no text", "Save the file as UTF-8 text.")
        return text
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise refuse(reason, "Check the path and its permissions.") from None


def _decoded(content: bytes) -> str:
    """UTF-8, UTF-16 where a mark says so, else what MATLAB on Windows writes: every byte a Latin letter."""
    if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        return content.decode("utf-16", errors="replace")
    for encoding in ("utf-8-sig", "cp1252"):
        try:
            return content.decode(encoding)
        except UnicodeDecodeError:
            continue
    return content.decode("latin-1")
