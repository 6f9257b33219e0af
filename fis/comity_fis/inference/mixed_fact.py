"""A fact that differs between the cultures of one person."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from comity_fis.inference.possibility import Known


@dataclass(frozen=True, slots=True)
class MixedFact:
    """What is known of one variable, culture by culture; no inference takes it as an input."""

    parts: tuple[tuple[str, float, Known | None], ...]
    """Culture, its share in (0, 1], and the value there; None where it is not disclosed."""

    def as_json(self) -> object:
        """The parts as a list."""
        return {
            "mixed": [
                {
                    "part": name,
                    "share": share,
                    "value": value
                    if value is None or isinstance(value, float | int | str)
                    else value.as_json(),
                }
                for name, share, value in self.parts
            ]
        }

    def __str__(self) -> str:
        return " and ".join(
            f"{'not disclosed' if value is None else _shown(value)} ({name}, {share:.0%})"
            for name, share, value in self.parts
        )


def _shown(value: Known) -> str:
    return f"{value:g}" if isinstance(value, float | int) else str(value)
