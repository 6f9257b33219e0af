"""Names in a scenario: on one line, so that tables and traces can hold them."""

from __future__ import annotations

from typing import Annotated

from pydantic import AfterValidator, StringConstraints

from comity_fis.errors import WrongValueError


def _one_line(name: str) -> str:
    if not name.isprintable():
        raise WrongValueError(
            expected="a name on one line, of printable characters",
            got=repr(name),
            remedy="Remove line breaks and other control characters.",
        )
    return name


Name = Annotated[str, StringConstraints(min_length=1, max_length=100), AfterValidator(_one_line)]
