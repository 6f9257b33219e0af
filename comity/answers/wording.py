"""What an answer says of a wording: its facts, as its file has them."""

from __future__ import annotations

from datetime import date

from pydantic import Field

from comity.answers.base import Answer


class WordingAnswer(Answer):
    """One wording of the robot."""

    use: str = Field(
        description="What it is said for: greet, honour, hand_over, take_leave, ask_to_pass, ..."
    )
    language: str = Field(description="By its BCP 47 tag.")
    script: str = Field(description="By its ISO 15924 code.")
    register_: str = Field(alias="register", description="plain, informal, neutral or formal.")
    occasion: str | None = Field(description="`first_meeting` where it is said then alone; null: always.")
    text: str = Field(description="In its script, with {name} where the person is named.")
    latin: str | None = Field(description="The same in Latin letters; null where `text` is.")
    reviewed_by: str | None = Field(description="Who speaks the language and has read it; null: nobody.")
    reviewed_on: date | None = Field(description="The day of the review; null where there was none.")
