"""MATLAB's curved membership functions in a rulebook file: `gaussmf: [sigma, centre]`."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from comity_fis.membership.curved import CURVED, Curved

Numbers = list[Annotated[float, Field(strict=True, allow_inf_nan=False)]]
Two = Annotated[Numbers, Field(min_length=2, max_length=2)]
Three = Annotated[Numbers, Field(min_length=3, max_length=3)]
Four = Annotated[Numbers, Field(min_length=4, max_length=4)]


def _fits(name: str) -> AfterValidator:
    """Let the shape validate its numbers."""

    def checked(numbers: list[float]) -> list[float]:
        CURVED[name](*numbers)
        return numbers

    return AfterValidator(checked)


class MatlabShapesModel(BaseModel):
    """One of MATLAB's shapes, with its parameters in MATLAB's order."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    gaussmf: Annotated[Two, _fits("gaussmf")] | None = None
    gauss2mf: Annotated[Four, _fits("gauss2mf")] | None = None
    gbellmf: Annotated[Three, _fits("gbellmf")] | None = None
    sigmf: Annotated[Two, _fits("sigmf")] | None = None
    dsigmf: Annotated[Four, _fits("dsigmf")] | None = None
    psigmf: Annotated[Four, _fits("psigmf")] | None = None
    smf: Annotated[Two, _fits("smf")] | None = None
    zmf: Annotated[Two, _fits("zmf")] | None = None
    pimf: Annotated[Four, _fits("pimf")] | None = None

    def curved(self) -> Curved:
        """The shape whose key is given."""
        return next(shape(*numbers) for name, shape in CURVED.items() if (numbers := getattr(self, name)))
