"""Laws whose examples are whole episodes: a few of them in `make test`, a hundred in `make studies`."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import settings

Test = Callable[..., Any]


def sampled(few: int, **others: Any) -> Callable[[Test], Test]:
    """Hypothesis tries FEW examples, or with the profile `study` as many as that says.

    Args:
        few: Number of examples in `make test`; those written out with `@example` come on top.
        others: Further settings of Hypothesis.
    """
    studied = settings.default is settings.get_profile("study")
    examples = settings.default.max_examples if studied else few

    def limited(test: Test) -> Test:
        return pytest.mark.sampled(settings(max_examples=examples, **others)(test))

    return limited
