"""A value of a binding that cannot be used, and where it stands."""

from __future__ import annotations

from comity_fis.errors import WrongValueError

Location = tuple[str | int, ...]
"""The way to a value of a binding, as its file nests it."""


class BindingRefusedError(WrongValueError):
    """A binding that does not fit its domain.

    Args:
        location: The value's.
        expected: What would have been right.
        got: What came.
        remedy: What to do.
    """

    def __init__(self, location: Location, *, expected: str, got: object, remedy: str) -> None:
        self.location = location
        super().__init__(expected=expected, got=got, remedy=remedy)


def refused(place: Location, expected: str, got: str, remedy: str) -> BindingRefusedError:
    """The refusal of a word."""
    return BindingRefusedError(place, expected=expected, got=repr(got), remedy=remedy)
