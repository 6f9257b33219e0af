"""What is passed on of people only where it is asked for."""

from enum import StrEnum


class Extra(StrEnum):
    """A fact of its own."""

    CULTURE = "culture"
    GENDER = "gender"
