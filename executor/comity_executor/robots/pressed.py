"""Whether a robot says that its stop is not pressed."""

from __future__ import annotations


def is_false(said: object) -> bool:
    """Whether an answer is the word False, numpy's included, which is no instance of bool."""
    if type(said).__module__ == "numpy":
        return type(said).__name__ in ("bool", "bool_") and not said
    return said is False
