"""How a person wants to be addressed."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from comity.people.fact import Word


class FormOfAddress(BaseModel):
    """What the person is called, in their own words; every part but the name may be left out."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: Word = Field(description="The name that they are called by: Anna, Okafor, Sato Yuki.")
    title: Word | None = Field(default=None, description="Before or after the name: Dr, Frau, san.")
    order: Literal["title name", "name title"] = Field(
        default="title name", description="Which of the two is said first."
    )
    pronunciation: Word | None = Field(
        default=None, description="How the name is spoken: in IPA, or in letters of any other kind."
    )

    def __str__(self) -> str:
        parts = {"title": self.title, "name": self.name}
        said = " ".join(part for key in self.order.split() if (part := parts[key]))
        return f"{said} ({self.pronunciation})" if self.pronunciation else said
