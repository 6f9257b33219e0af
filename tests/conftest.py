"""How Hypothesis searches: never against the clock, and in CI with the same examples every time."""

from __future__ import annotations

import os
from collections.abc import Iterator

import pytest
from hypothesis import settings

settings.register_profile("comity", deadline=None, derandomize="CI" in os.environ)
settings.load_profile("comity")


@pytest.fixture(scope="session", autouse=True)
def _own_store(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """People whom the developer keeps are none of the tests' business."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COMITY_HOME", str(tmp_path_factory.mktemp("kept")))
        yield
