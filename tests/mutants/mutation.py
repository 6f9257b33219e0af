"""One small change of the software, as a researcher or an engineer makes it by mistake."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Mutation:
    """Some characters of a file, replaced."""

    package: str
    file: str
    """From the root of the checkout."""
    line: int
    family: str
    start: int
    end: int
    old: str
    new: str
    culprits: tuple[str, ...]
    """Words of which a failure text names at least one if it points to the change."""

    def applied(self, text: str) -> str:
        return text[: self.start] + self.new + text[self.end :]

    def apply(self, root: Path) -> None:
        path = root / self.file
        text = self.applied(path.read_text(encoding="utf-8"))
        path.unlink()  # it may be a link to the unchanged file
        path.write_text(text, encoding="utf-8")
        for compiled in path.parent.glob(f"__pycache__/{path.stem}.*.pyc"):
            compiled.unlink()

    @property
    def shown(self) -> str:
        """What was there and what is there now."""
        return f"{' '.join(self.old.split())[:60]} -> {' '.join(self.new.split())[:60]}"


_COMMON = frozenset(
    [
        "self",
        "return",
        "values",
        "value",
        "name",
        "names",
        "none",
        "true",
        "false",
        "with",
        "from",
        "import",
        "person",
        "people",
        "robot",
        "float",
        "tuple",
        "not",
        "and",
        "else",
        "for",
        "the",
        "list",
        "dict",
        "str",
        "int",
        "bool",
        "math",
        "self.x",
        "other",
    ]
)


def words_of(*texts: str) -> tuple[str, ...]:
    """The telling words of identifiers: `docking_band` gives docking and band, and their stems."""
    found: dict[str, None] = {}
    for text in texts:
        for word in re.findall(r"[A-Za-z]{4,}", text.replace("_", " ")):
            if word.lower() not in _COMMON:
                found[word.lower()[:6]] = None
    return tuple(found)
