"""Validation of times that a user asks about."""

from __future__ import annotations

from math import ceil, inf, isfinite

from comity_fis import InputError, Where


def check_time(until: float | None) -> None:
    """Refuse an invalid time; None is the end.

    Raises:
        InputError: if it is negative, infinite or not a number.
    """
    if until is not None and not 0.0 <= until < inf:
        raise InputError(
            expected="a time from 0 s on",
            got=f"{until:g}",
            remedy="Write for example --at 7.3; without --at it is the end.",
            where=Where("--at"),
        )


def check_times(between: tuple[float, float] | None, end_s: float) -> None:
    """Refuse an invalid span.

    Args:
        between: First and last time [s]; None for all times.
        end_s: End of the run [s], for the remedy.

    Raises:
        InputError: if a time is invalid, or they are in the wrong order.
    """
    if between is not None and not 0.0 <= between[0] <= between[1] < inf:
        raise InputError(
            expected="two times from 0 s on, the earlier one first",
            got=f"{between[0]:g} {between[1]:g}",
            remedy=_two_times(*between, end_s),
            where=Where("--between"),
        )


def _two_times(first: float, last: float, end_s: float) -> str:
    """Remedy for two times that are invalid, or in the wrong order."""
    if last == inf and 0.0 <= first < inf:
        return f"Write --between {first:g} {max(first, ceil(end_s)):g}: the run ended at {end_s:.2f} s."
    if not (isfinite(first) and isfinite(last)) or max(first, last) < 0.0:
        return "Write for example --between 5 10."
    return f"Write --between {max(0.0, min(first, last)):g} {max(first, last):g}."


def time_of(word: str) -> float | None:
    """The time [s] that a word denotes; None if it is no number.

    Raises:
        InputError: if it is a number, but an invalid time.
    """
    try:
        t = float(word)
    except ValueError:
        return None
    if not 0.0 <= t < inf:
        raise InputError(
            expected="a time from 0 s on, or a node",
            got=word,
            remedy="Write for example --why 7.3.",
            where=Where("--why"),
        )
    return t
