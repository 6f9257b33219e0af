"""The error for a value of a binding that cannot be used, with its location."""

from __future__ import annotations

from comity_fis.errors import WrongValueError

Location = tuple[str | int, ...]
"""Path to a value of a binding: the keys and indices in its file."""


class BindingRefusedError(WrongValueError):
    """A binding that does not fit its domain.

    Args:
        location: Path to the value.
        expected: The expected value.
        got: The given value.
        remedy: What to change.
    """

    def __init__(self, location: Location, *, expected: str, got: object, remedy: str) -> None:
        self.location = location
        super().__init__(expected=expected, got=got, remedy=remedy)


def refused(place: Location, expected: str, got: str, remedy: str) -> BindingRefusedError:
    """The error for a rejected word."""
    return BindingRefusedError(place, expected=expected, got=repr(got), remedy=remedy)
