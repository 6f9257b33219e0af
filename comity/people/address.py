"""How a person wants to be addressed."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from comity.people.fact import Word
from comity_fis.validation.one_line import one_line

Said = Annotated[Word, AfterValidator(one_line)]


class FormOfAddress(BaseModel):
    """What the person is called, in their own words; every part but the name may be left out."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    name: Said = Field(description="The name that they are called by: Anna, Okafor, Sato Yuki.")
    title: Said | None = Field(default=None, description="Before or after the name: Dr, Frau, san.")
    order: Literal["title name", "name title"] = Field(
        default="title name", description="Which of the two is said first."
    )
    pronunciation: Said | None = Field(
        default=None, description="How the name is spoken: in IPA, or in letters of any other kind."
    )

    def __str__(self) -> str:
        parts = {"title": self.title, "name": self.name}
        said = " ".join(part for key in self.order.split() if (part := parts[key]))
        return f"{said} ({self.pronunciation})" if self.pronunciation else said
