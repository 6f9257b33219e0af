"""Facts about people that are shared only on request."""

from enum import StrEnum


class Extra(StrEnum):
    """A single optional fact."""

    CULTURE = "culture"
    GENDER = "gender"
