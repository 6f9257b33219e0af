"""Splits a `.fis` file into sections of keys and values with line numbers; `reader` interprets them.

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
"""An integer; some programs write every number with decimals, `1.000`."""


@dataclass(frozen=True, slots=True)
class MatlabLine:
    """One line of a file: the value of a key, or a rule."""

    text: str
    where: Where

    def wrong(self, expected: str, remedy: str) -> InputError:
        """The error for this line."""
        got = self.text if len(self.text) <= 60 else f"{self.text[:57]}..."
        return InputError(expected=expected, got=repr(got), remedy=remedy, where=self.where)

    def words(self) -> str:
        """The text in quotes."""
        match = TEXT.fullmatch(self.text)
        if match is None:
            raise self.wrong("a text in single quotes", "Write for example 'tipper'.")
        return match[1] if match[1] is not None else match[2]

    def count(self, most: int, least: int = 1) -> int:
        """An integer from `least` to `most`."""
        number = whole(self.text)
        if number is None or not least <= number <= most:
            raise self.wrong(f"a whole number from {least} to {most}", "Split a larger system.")
        return number

    def number(self, text: str) -> float:
        """One number of the line; it may be infinite."""
        if not NUMBER.fullmatch(text) or isnan(float(text)):
            raise self.wrong(f"a number where {text[:20]!r} stands", "Write for example 0.5 or 1e-3.")
        return float(text)

    def numbers(self, text: str) -> tuple[float, ...]:
        """The numbers in square brackets."""
        text = text.strip()
        if not (text.startswith("[") and text.endswith("]")):
            raise self.wrong("numbers between square brackets", "Write for example [0 0.5 1].")
        return tuple(self.number(word) for word in text[1:-1].replace(",", " ").split())


def whole(text: str) -> int | None:
    """An integer, possibly with decimals that are 0; None for any other text."""
    match = WHOLE.fullmatch(text)
    return int(match[1]) if match else None


@dataclass(frozen=True, slots=True)
class Section:
    """The lines after a `[...]` line."""

    name: str
    where: Where
    entries: dict[str, MatlabLine] = field(default_factory=dict)
    rows: list[MatlabLine] = field(default_factory=list)
    """The rules."""

    def entry(self, key: str) -> MatlabLine:
        """The value of a key.

        Raises:
            InputError: The key is missing.
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
        """Reject an unknown key: ignoring it would lose information."""
        for key, entry in self.entries.items():
            if key not in known:
                raise unknown_word(f"a known key in [{self.name}]", key, known, where=entry.where)


def sections_of(text: str, name: str) -> Mapping[str, Section]:
    """The sections of a file's text, by name, in file order.

    Args:
        text: The whole text.
        name: Name of the file in messages.

    Raises:
        InputError: A line is not valid in a `.fis` file.
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
        InputError: The file cannot be read, is too large, or is not text.
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
    """Decode as UTF-8, as UTF-16 if there is a byte-order mark, or else as Latin-1 (MATLAB on Windows)."""
    if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        return content.decode("utf-16", errors="replace")
    for encoding in ("utf-8-sig", "cp1252"):
        try:
            return content.decode(encoding)
        except UnicodeDecodeError:
            continue
    return content.decode("latin-1")
