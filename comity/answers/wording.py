"""What an answer says of a wording: its facts, as its file has them."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date

from comity_fis.record import Record


@dataclass(frozen=True, slots=True, kw_only=True)
class WordingAnswer(Record):
    """One wording of the robot."""

    use: str
    """What it is said for: greet, honour, hand_over, take_leave, ask_to_pass, ..."""
    language: str
    """By its BCP 47 tag."""
    script: str
    """By its ISO 15924 code."""
    register: str
    """plain, informal, neutral or formal."""
    occasion: str | None
    """`first_meeting` where it is said then alone; null: always."""
    text: str
    """In its script, with {name} where the person is named."""
    latin: str | None
    """The same in Latin letters; null where `text` is."""
    reviewed_by: str | None
    """Who speaks the language and has read it; null: nobody."""
    reviewed_on: date | None
    """The day of the review; null where there was none."""
