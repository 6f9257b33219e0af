from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from pathlib import Path
from threading import Thread

import pytest
from rooms import scenario

from comity.testing.collection.cases import claims_in
from comity.testing.verdict import Verdict, judged


def in_a_group(room: str) -> str:
    """Sam stands beside the guest, and both are greeted at once."""
    return (
        room.replace("at_m: [4.6, 2.2], facing_deg: 0", "at_m: [6.8, 2.0], facing_deg: 180")
        .replace("goals:\n", "groups: {pair: [guest, sam]}\ngoals:\n")
        .replace("  - greet: guest\n", "  - greet: guest\n  - greet: sam\n")
    )


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


@pytest.fixture
def piped(tmp_path: Path) -> Iterator[Callable[[Path], None]]:
    """Puts a pipe in the place of a file: the first who opens it would be given what the file held."""
    other = tmp_path / "the same pipe"
    writers: list[Thread] = []

    def put(path: Path) -> None:
        content = path.read_bytes()
        path.unlink()
        os.mkfifo(path)
        os.link(path, other)
        writers.append(Thread(target=other.write_bytes, args=[content], daemon=True))
        writers[0].start()

    yield put
    handle = os.open(other, os.O_RDONLY | os.O_NONBLOCK)
    while writers[0].is_alive():
        with suppress(BlockingIOError):
            os.read(handle, 65_536)
    os.close(handle)
