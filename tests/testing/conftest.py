from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import pytest
from rooms import scenario

from comity.testing.cases import claims_in
from comity.testing.verdict import Verdict, judged


@pytest.fixture(scope="session", autouse=True)
def _own_cache(tmp_path_factory: pytest.TempPathFactory):
    """Orders that the developer's own tests left behind are not used, and none are left."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("COMITY_CACHE", str(tmp_path_factory.mktemp("cache")))
        yield


@pytest.fixture
def write(tmp_path: Path) -> Callable[..., Path]:
    """A scenario file of two people to greet and one who stands by, with sentences and further lines."""

    def written(
        *sentences: str,
        more: str = "",
        room: Callable[[str], str] = str,
        name: str = "room.scenario.yaml",
    ) -> Path:
        path = tmp_path / name
        path.write_text(scenario(*sentences, more=more, room=room), encoding="utf-8")
        return path

    return written


@pytest.fixture
def judge(write) -> Callable[..., Sequence[Verdict]]:
    """The verdicts on a scenario with these sentences."""

    def verdicts(*sentences: str, more: str = "", room: Callable[[str], str] = str) -> Sequence[Verdict]:
        return [judged(claim) for claim in claims_in(write(*sentences, more=more, room=room))]

    return verdicts
