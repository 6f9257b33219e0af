"""What the tests share: a store of its own."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture
def home(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A store of its own, outside the folder that a test works in."""
    home = tmp_path_factory.mktemp("home")
    monkeypatch.setenv("COMITY_HOME", str(home))
    return home
